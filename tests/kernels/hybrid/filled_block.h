#pragma once
#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "base/id.h"
#include "kernels/volumes/region_boundary.h"
#include "kernels/volumes/region_mesh.h"

namespace strataflow::support {

/// A block of the given size whose sides are squares of edge 1, each cut in two.
struct FilledBlock {
  RegionBoundary boundary;
  RegionMesh mesh;
  double volume_m3 = 0;

  explicit FilledBlock(std::array<int, 3> size) : volume_m3(double(size[0]) * size[1] * size[2]) {
    std::vector<std::uint32_t> number(static_cast<std::size_t>((size[0] + 1) * (size[1] + 1) * (size[2] + 1)),
                                      no_index);
    const auto point = [&](const std::array<int, 3>& at) {
      std::uint32_t& n = number[static_cast<std::size_t>((at[2] * (size[1] + 1) + at[1]) * (size[0] + 1) + at[0])];
      if (n == no_index) {
        n = static_cast<std::uint32_t>(boundary.coordinates.size());
        boundary.coordinates.push_back({double(at[0]), double(at[1]), double(at[2])});
      }
      return n;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (const int end : {0, size[axis]})
        for (int i = 0; i < size[u]; ++i)
          for (int j = 0; j < size[v]; ++j) {
            const auto corner = [&](int di, int dj) {
              std::array<int, 3> at{};
              at[axis] = end;
              at[u] = i + di;
              at[v] = j + dj;
              return point(at);
            };
            // Counter-clockwise from outside: the region is on the negative side.
            const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
            const bool looks_out = end != 0;
            boundary.facets.push_back(looks_out ? Triangle{a, b, c} : Triangle{a, c, b});
            boundary.facets.push_back(looks_out ? Triangle{a, c, d} : Triangle{a, d, c});
          }
    }
    boundary.sides.assign(boundary.facets.size(), 1);
    for (std::uint32_t p = 0; p < boundary.coordinates.size(); ++p) boundary.points.push_back(p);
    boundary.triangles.resize(boundary.facets.size());
  }

  std::vector<Vec3> points() const {
    std::vector<Vec3> all = boundary.coordinates;
    all.insert(all.end(), mesh.interior_points.begin(), mesh.interior_points.end());
    return all;
  }
  /// Whether `tets` on the boundary's points and others are a mesh of the block, which it then has.
  bool take(const std::vector<Vec3>& all, const std::vector<Tet>& tets) {
    auto verdict = verified_region_mesh(boundary, all, tets, volume_m3);
    if (auto* good = std::get_if<RegionMesh>(&verdict)) mesh = std::move(*good);
    return std::holds_alternative<RegionMesh>(verdict);
  }
  /// A fan from a point inside, which any convex region has.
  bool take_fan(const Vec3& middle) {
    std::vector<Vec3> all = boundary.coordinates;
    all.push_back(middle);
    std::vector<Tet> tets;
    const auto apex = static_cast<std::uint32_t>(boundary.coordinates.size());
    for (const Triangle& facet : boundary.facets) tets.push_back({facet[0], facet[2], facet[1], apex});
    return take(all, tets);
  }
};

}  // namespace strataflow::support
