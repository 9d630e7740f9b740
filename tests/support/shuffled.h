#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow::support {

inline std::vector<std::uint32_t> shuffled_order(std::size_t count, std::mt19937& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

/// Entities, patches, points and triangles in another order, triangles turned over at random, no point shared.
inline TriangleSoup shuffled(const TriangleSoup& soup, std::uint32_t seed) {
  std::mt19937 random(seed);
  TriangleSoup result;
  result.local_origin = soup.local_origin;
  const auto new_entity = shuffled_order(soup.entities.size(), random);
  const auto new_patch = shuffled_order(soup.patch_entity.size(), random);
  const auto new_point = shuffled_order(3 * soup.triangles.size(), random);
  result.entities.resize(soup.entities.size());
  result.patch_entity.resize(soup.patch_entity.size());
  result.points.resize(new_point.size());
  for (std::size_t e = 0; e < new_entity.size(); ++e) result.entities[new_entity[e]] = soup.entities[e];
  for (std::size_t p = 0; p < new_patch.size(); ++p)
    result.patch_entity[new_patch[p]] = new_entity[soup.patch_entity[p]];
  for (const std::uint32_t t : shuffled_order(soup.triangles.size(), random)) {
    Triangle corners{0, 1, 2};
    std::shuffle(corners.begin(), corners.end(), random);
    Triangle triangle{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      triangle[k] = new_point[3 * t + k];
      result.points[triangle[k]] = soup.points[soup.triangles[t][corners[k]]];
    }
    result.triangles.push_back(triangle);
    result.triangle_patch.push_back(new_patch[soup.triangle_patch[t]]);
  }
  return result;
}

}  // namespace strataflow::support
