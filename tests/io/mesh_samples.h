#pragma once
#include "io/mesh_damage.h"

namespace strataflow::support {

/// Six times the signed volume of a tetrahedron.
inline double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(cross(b - a, c - a), d - a);
}

/// Volume enclosed by the cell's faces in VTK's order, each looking outwards.
inline double cell_volume(const VolumeMesh& mesh, std::size_t cell) {
  static const std::vector<std::vector<int>> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  static const std::vector<std::vector<int>> pyramid{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  static const std::vector<std::vector<int>> prism{{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<std::vector<int>> hexahedron{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                                        {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  const CellType type = mesh.cell_types[cell];
  const auto& faces = type == CellType::tetrahedron ? tetrahedron
                      : type == CellType::pyramid   ? pyramid
                      : type == CellType::prism     ? prism
                                                    : hexahedron;
  double sum = 0;
  for (const std::vector<int>& face : faces)
    for (std::size_t i = 2; i < face.size(); ++i) {
      const auto at = [&](std::size_t k) {
        return mesh.points[mesh.cell_vertices[mesh.cell_offsets[cell] + static_cast<std::uint32_t>(face[k])]];
      };
      sum += six_volumes({}, at(0), at(i - 1), at(i));
    }
  return sum / 6;
}

/// The samples `mixed`, made by another program: a unit cube, a pyramid on it, a prism and two tetrahedra beside it,
/// and three polygons. The same cells whatever the file format.
inline void expect_the_mixed_mesh(const InputData& input) {
  const VolumeMesh& mesh = input.volume;
  ASSERT_EQ(mesh.points.size(), 12u);
  ASSERT_EQ(mesh.cell_types, (std::vector<CellType>{CellType::hexahedron, CellType::pyramid, CellType::prism,
                                                    CellType::tetrahedron, CellType::tetrahedron}));
  const double expected[] = {1.0, 1.0 / 6, 0.5, 1.0 / 6, 1.0 / 6};
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(cell_volume(mesh, c), expected[c], 1e-12) << "cell " << c;
  EXPECT_EQ(mesh.cell_region, (std::vector<std::int32_t>{0, 0, 1, 1, 1}));
  EXPECT_EQ(input.surfaces.triangles.size(), 4u) << "two triangles, a quad in two";
  EXPECT_EQ(input.surfaces.points.size(), 6u) << "only the points the surfaces use";
}

/// A mesh of two regions with every type of cell, facets on two surfaces, and large coordinates.
inline VolumeMesh two_region_mesh() {
  VolumeMesh mesh;
  mesh.local_origin = {500000, 6000000, -1000};
  mesh.points = {{0, 0, 0}, {1, 0, 0},      {1, 1, 0},     {0, 1, 0},  {0, 0, 1},  {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1.0625}, {.5, .5, 1.5}, {2, 0, .5}, {2, 1, .5}, {.5, 2, .5}};
  const std::uint32_t tet_1[] = {3, 6, 2, 11}, tet_2[] = {3, 7, 6, 11}, pyramid[] = {4, 5, 6, 7, 8},
                      prism[] = {1, 9, 5, 2, 10, 6}, hex[] = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh.add_cell(CellType::tetrahedron, tet_1, 1);
  mesh.add_cell(CellType::tetrahedron, tet_2, 1);
  mesh.add_cell(CellType::pyramid, pyramid, 0);
  mesh.add_cell(CellType::prism, prism, 1);
  mesh.add_cell(CellType::hexahedron, hex, 0);
  mesh.region_names = {"lower", "upper"};
  mesh.entities = {{"F1", Role::fault}, {"Top \xc3\xa9", Role::horizon}};
  mesh.facets = {{{0, 2, 1, no_index}, 0, 4, no_index}, {{0, 3, 2, no_index}, 0, 4, no_index}, {{4, 5, 6, 7}, 1, 2, 4}};
  mesh.surface_entity = {0, 1};
  mesh.point_line = {0, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1};
  mesh.point_corner = {-1, -1, -1, -1, 0, -1, -1, -1, -1, -1, -1, -1};
  return mesh;
}

/// Two surfaces of a fault and a horizon, in coordinates that have no short decimal form.
inline TriangleSoup two_surface_soup() {
  TriangleSoup soup;
  soup.local_origin = {500000, 6000000, 0};
  soup.points = {{0.1, 0.2, -1.0 / 3}, {1, 0, 1e-17}, {0, 1, 12345.678901234567}, {1, 1, -0.0}, {2, 1, 0}};
  soup.triangles = {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}};
  soup.triangle_patch = {0, 1, 2};
  soup.entities = {{"F1", Role::fault}, {"Top", Role::horizon}};
  soup.patch_entity = {0, 0, 1};
  soup.properties = {{"porosity", "", 1, {0.1, 0.2, 0.3, 0.4, 0.5}}};
  return soup;
}

/// The same with the points in the file's own coordinates, as readers give them.
inline TriangleSoup in_world_coordinates(TriangleSoup soup) {
  for (Vec3& point : soup.points) point = point + soup.local_origin;
  soup.local_origin = {};
  return soup;
}

}  // namespace strataflow::support
