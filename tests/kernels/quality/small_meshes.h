#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/volume_mesh.h"

namespace strataflow {

inline const std::vector<Vec3>& unit_cube_points() {
  static const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  return points;
}

template <std::size_t N>
void add_cell(VolumeMesh& mesh, CellType type, const std::array<std::uint32_t, N>& vertices, std::int32_t region = 0) {
  mesh.add_cell(type, vertices.data(), region);
}

/// [0, nx] × [0, ny] × [0, nz] in unit cubes; region 0 below `interface`, 1 from there on. Each cube is one hexahedron
/// or the six tetrahedra around its diagonal, which fit from cube to cube.
inline VolumeMesh box_mesh(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz, std::uint32_t interface,
                           bool in_tetrahedra) {
  VolumeMesh mesh;
  for (std::uint32_t z = 0; z <= nz; ++z)
    for (std::uint32_t y = 0; y <= ny; ++y)
      for (std::uint32_t x = 0; x <= nx; ++x)
        mesh.points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return (z * (ny + 1) + y) * (nx + 1) + x; };
  constexpr std::array<std::array<int, 4>, 6> kuhn = {
      {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};
  for (std::uint32_t z = 0; z < nz; ++z)
    for (std::uint32_t y = 0; y < ny; ++y)
      for (std::uint32_t x = 0; x < nx; ++x) {
        const std::array<std::uint32_t, 8> cube = {
            at(x, y, z),     at(x + 1, y, z),     at(x + 1, y + 1, z),     at(x, y + 1, z),
            at(x, y, z + 1), at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)};
        const std::int32_t region = z < interface ? 0 : 1;
        if (!in_tetrahedra) {
          add_cell(mesh, CellType::hexahedron, cube, region);
          continue;
        }
        for (const auto& [a, b, c, d] : kuhn)
          add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{cube[a], cube[b], cube[c], cube[d]},
                   region);
      }
  return mesh;
}

}  // namespace strataflow
