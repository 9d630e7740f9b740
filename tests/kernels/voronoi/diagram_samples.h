#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/seed.h"
#include "model/triangle_soup.h"

namespace strataflow::sample {

struct Mesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

/// The unit square in n × n squares of two triangles each, z = height(x, y).
template <class Height>
Mesh sheet(std::uint32_t n, Height height) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = double(i) / n, y = double(j) / n;
      mesh.points.push_back({x, y, height(x, y)});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

inline Mesh flat_sheet(std::uint32_t n) {
  return sheet(n, [](double, double) { return 0.0; });
}
inline Mesh wavy_sheet(std::uint32_t n) {
  return sheet(n, [](double x, double y) { return 0.2 * std::sin(5 * x) * std::cos(4 * y); });
}

/// The unit sphere: an octahedron halved `times` over.
inline Mesh sphere(int times, double radius = 1) {
  Mesh mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    mesh.triangles.push_back({i, (i + 1) % 4, 4});
    mesh.triangles.push_back({(i + 1) % 4, i, 5});
  }
  for (int step = 0; step < times; ++step) {
    std::vector<Triangle> finer;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
      for (const auto& [edge, point] : middles)
        if (edge == key) return point;
      const Vec3 m = mesh.points[a] + mesh.points[b];
      mesh.points.push_back((1 / length(m)) * m);
      middles.push_back({key, static_cast<std::uint32_t>(mesh.points.size() - 1)});
      return middles.back().second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  for (Vec3& p : mesh.points) p = radius * p;
  return mesh;
}

inline std::vector<Vec3> random_sites(std::size_t count, unsigned seed, const Vec3& low, const Vec3& high) {
  RandomStream random(seed);
  const auto number = [&](double from, double to) { return from + (to - from) * random.unit(); };
  std::vector<Vec3> sites(count);
  for (Vec3& s : sites) s = {number(low.x, high.x), number(low.y, high.y), number(low.z, high.z)};
  return sites;
}

inline double polygon_area(std::span<const Vec3> points) {
  Vec3 sum;
  for (std::size_t k = 2; k < points.size(); ++k)
    sum = sum + 0.5 * cross(points[k - 1] - points[0], points[k] - points[0]);
  return length(sum);
}

inline double triangle_area(const Mesh& mesh, const Triangle& t) {
  return 0.5 * length(cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]));
}

}  // namespace strataflow::sample
