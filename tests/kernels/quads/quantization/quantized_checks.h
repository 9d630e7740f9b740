#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "map_shapes.h"

namespace strataflow::support {

/// Rules R16 and R18 for a map: every triangle positive, transitions exact and integer, features of `skipped` aside on
/// integer lines, `integer_points` at integers. Returns the quads that the map's area stands for.
inline double expect_grid_preserving(const FeatureMesh& mesh, const CornerMap& map,
                                     const std::vector<std::uint32_t>& integer_points,
                                     const std::vector<std::uint32_t>& skipped = {}) {
  const auto is_whole = [](double x) { return x == std::nearbyint(x); };
  const auto opposite = opposites(mesh);
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto a = map.at(3 * t), b = map.at(3 * t + 1), c = map.at(3 * t + 2);
    EXPECT_GT(orientation_2d(a.real(), a.imag(), b.real(), b.imag(), c.real(), c.imag()), 0) << "triangle " << t;
    area += 0.5 * (std::conj(b - a) * (c - a)).imag();
  }
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    const std::uint32_t p = mesh.triangles[h / 3][h % 3];
    const auto u = map.at(h), v = map.at(FlatMesh::next(h));
    const bool is_kept = std::binary_search(integer_points.begin(), integer_points.end(), p);
    EXPECT_TRUE(!is_kept || (is_whole(u.real()) && is_whole(u.imag()))) << "point " << p;
    if (skipped.empty()) {
      EXPECT_TRUE(map.axes[h] != MapAxis::real || (u.imag() == v.imag() && is_whole(u.imag()))) << "half-edge " << h;
      EXPECT_TRUE(map.axes[h] != MapAxis::imaginary || (u.real() == v.real() && is_whole(u.real())))
          << "half-edge " << h;
    }
    if (opposite[h] == FlatMesh::outside) continue;
    const auto first = u - turned(map.at(FlatMesh::next(opposite[h])), map.turns[h]);
    const auto second = v - turned(map.at(opposite[h]), map.turns[h]);
    EXPECT_EQ(first, second) << "half-edge " << h;
    EXPECT_TRUE(is_whole(first.real()) && is_whole(first.imag())) << "half-edge " << h;
  }
  return area;
}

}  // namespace strataflow::support
