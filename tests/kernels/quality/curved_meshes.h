#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

struct Mesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

/// A sphere of `rings` rings of 2·rings quads, poles included: 4 rings² − 4 rings triangles.
inline Mesh sphere(double radius_m, std::uint32_t rings, const Vec3& centre = {}) {
  Mesh mesh;
  const std::uint32_t around = 2 * rings;
  mesh.points.push_back(centre + Vec3{0, 0, -radius_m});
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const double height = std::numbers::pi * (static_cast<double>(i) / rings - 0.5);
      const double turn = 2 * std::numbers::pi * j / around;
      mesh.points.push_back(centre + Vec3{radius_m * std::cos(height) * std::cos(turn),
                                          radius_m * std::cos(height) * std::sin(turn), radius_m * std::sin(height)});
    }
  const auto top = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(centre + Vec3{0, 0, radius_m});
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * around + j % around; };
  for (std::uint32_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j + 1), at(1, j)});
    mesh.triangles.push_back({top, at(rings - 1, j), at(rings - 1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

/// A grid of quads that closes in one direction or both, or with a twist: only its vertices' numbers matter.
inline std::vector<Triangle> closed_grid(std::uint32_t n, bool closes_across, bool is_twisted) {
  std::vector<Triangle> triangles;
  const std::uint32_t rows = closes_across ? n : n + 1;
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    if (i == n) {
      i = 0;
      if (is_twisted) j = closes_across ? (n - j % n) % n : n - j;
    }
    return i * rows + (closes_across ? j % n : j);
  };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return triangles;
}

/// A vertical ribbon of height 1 over a polygon line; closed, or open after its last point.
inline Mesh ribbon(const std::vector<Vec3>& line, bool is_closed) {
  Mesh mesh;
  for (const Vec3& p : line) {
    mesh.points.push_back(p);
    mesh.points.push_back(p + Vec3{0, 0, 1});
  }
  const auto count = static_cast<std::uint32_t>(line.size());
  for (std::uint32_t i = 0; i < (is_closed ? count : count - 1); ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

/// Every `step`-th of the ten corners of a star with five tips, from corner `first` on; tips have even numbers.
inline std::vector<Vec3> star(double tip_m, double notch_m, std::uint32_t first = 0, std::uint32_t step = 1) {
  std::vector<Vec3> line;
  for (std::uint32_t i = first; i < 10 + first % step; i += step) {
    const double turn = 2 * std::numbers::pi * i / 10, radius = i % 2 == 0 ? tip_m : notch_m;
    line.push_back({radius * std::cos(turn), radius * std::sin(turn), 0});
  }
  return line;
}

}  // namespace strataflow
