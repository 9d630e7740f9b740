#include "kernels/remeshing/dual/polygon_triangles.h"

#include <algorithm>

namespace strataflow {

double signed_sharpness(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c, twice_area = cross(ab, c - a);
  const double ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca);
  // The smallest angle lies between the two longest edges.
  const double smallest = std::min({ab2, bc2, ca2});
  const double longest_two = smallest == ab2 ? bc2 * ca2 : smallest == bc2 ? ab2 * ca2 : ab2 * bc2;
  if (!(longest_two > 0)) return 0;
  const double sine = std::sqrt(dot(twice_area, twice_area) / longest_two);
  return dot(twice_area, normal) < 0 ? -sine : sine;
}

double triangulate_polygon(std::span<const std::uint32_t> corners, std::span<const Vec3> positions, const Vec3& normal,
                           std::vector<Triangle>& triangles) {
  const std::size_t n = corners.size();
  if (n < 3) return 1;
  const auto sharpness = [&](std::size_t i, std::size_t j, std::size_t k) {
    return signed_sharpness(positions[corners[i]], positions[corners[j]], positions[corners[k]], normal);
  };
  if (n == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return sharpness(0, 1, 2);
  }
  // worst[i][j]: of the best triangulation of corners i … j; apex[i][j]: its triangle at the edge i–j.
  std::vector<double> worst(n * n, 1);
  std::vector<std::size_t> apex(n * n, 0);
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      double best = -2;
      for (std::size_t k = i + 1; k < j; ++k) {
        const double value = std::min({worst[i * n + k], worst[k * n + j], sharpness(i, k, j)});
        if (value > best) {
          best = value;
          apex[i * n + j] = k;
        }
      }
      worst[i * n + j] = best;
    }
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::size_t k = apex[i * n + j];
    triangles.push_back({corners[i], corners[k], corners[j]});
    open.push_back({i, k});
    open.push_back({k, j});
  }
  return worst[n - 1];
}

void split_at_repeats(std::vector<std::uint32_t> walk, std::vector<std::vector<std::uint32_t>>& polygons) {
  std::vector<std::uint32_t> path;
  for (const std::uint32_t corner : walk) {
    const auto before = std::find(path.begin(), path.end(), corner);
    if (before == path.end()) {
      path.push_back(corner);
      continue;
    }
    if (path.end() - before > 2) polygons.emplace_back(before, path.end());
    path.erase(before + 1, path.end());
  }
  if (path.size() > 2) polygons.push_back(std::move(path));
}

}  // namespace strataflow
