#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "kernels/hexes/extrude_hexes.h"
#include "kernels/quality/measure_cell.h"
#include "kernels/quality/nearest_triangle.h"

namespace strataflow::support {

inline std::array<Vec3, 8> corners_of(const VolumeMesh& mesh, std::size_t cell) {
  std::array<Vec3, 8> p;
  for (std::size_t k = 0; k < 8; ++k) p[k] = mesh.points[mesh.cell_vertices[8 * cell + k]];
  return p;
}

/// The triangles of one entity in the model.
inline std::vector<Triangle> triangles_of(const LabelledTets& model, std::uint32_t entity) {
  std::vector<Triangle> triangles;
  for (const SheetFacet& facet : model.facets)
    if (facet.entity == entity) triangles.push_back(facet.vertices);
  return triangles;
}

/// Largest distance of the facets' vertices on an entity from its triangles.
inline double furthest_from_entity_m(const VolumeMesh& mesh, const LabelledTets& model, std::uint32_t entity) {
  const std::vector<Triangle> triangles = triangles_of(model, entity);
  const NearestTriangle nearest(TriangleMesh{model.points, triangles});
  double furthest = 0;
  for (const MeshFacet& facet : mesh.facets)
    if (facet.surface == entity)
      for (const std::uint32_t v : facet.vertices)
        furthest = std::max(furthest, nearest.nearest(mesh.points[v]).squared_m2);
  return std::sqrt(furthest);
}

/// R20: every cell right side out, but the dead ones.
inline void expect_no_inverted_cell(const ExtrudedHexes& hexes) {
  std::size_t inverted = 0;
  for (std::size_t c = 0; c < hexes.grid.mesh.cell_count(); ++c)
    inverted += hexes.grid.is_dead[c] == 0 && is_inverted(CellType::hexahedron, corners_of(hexes.grid.mesh, c)) ? 1 : 0;
  EXPECT_EQ(inverted, hexes.report.inverted + hexes.report.degenerate);
  EXPECT_EQ(hexes.report.inverted, 0u);
}

/// R22: two cells share nothing, a corner, an edge or a whole face.
inline void expect_conforming(const VolumeMesh& mesh) {
  std::map<std::array<std::uint32_t, 4>, int> faces;
  constexpr std::array<std::array<std::size_t, 4>, 6> local{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  std::map<std::array<std::uint32_t, 2>, std::set<std::size_t>> by_diagonal;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const auto& face : local) {
      std::array<std::uint32_t, 4> v{};
      for (std::size_t k = 0; k < 4; ++k) v[k] = mesh.cell_vertices[8 * c + face[k]];
      std::sort(v.begin(), v.end());
      EXPECT_TRUE(std::adjacent_find(v.begin(), v.end()) == v.end()) << "cell " << c << " repeats a vertex";
      ++faces[v];
    }
  for (const auto& [v, count] : faces) EXPECT_LE(count, 2);
  // Cells of one face's two opposite corners that do not share the face: they meet in more than an edge.
  std::map<std::uint32_t, std::vector<std::size_t>> around;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (std::size_t k = 0; k < 8; ++k) around[mesh.cell_vertices[8 * c + k]].push_back(c);
  for (const auto& [v, cells] : around)
    for (const std::size_t a : cells)
      for (const std::size_t b : cells) {
        if (a >= b) continue;
        std::set<std::uint32_t> of_a(mesh.cell_vertices.begin() + 8 * a, mesh.cell_vertices.begin() + 8 * a + 8);
        int common = 0;
        for (std::size_t k = 0; k < 8; ++k) common += static_cast<int>(of_a.count(mesh.cell_vertices[8 * b + k]));
        EXPECT_TRUE(common == 1 || common == 2 || common == 4) << common << " common vertices of " << a << ", " << b;
      }
}

inline double volume_m3(const ExtrudedHexes& hexes) {
  double volume = 0;
  for (std::size_t c = 0; c < hexes.grid.mesh.cell_count(); ++c)
    volume += cell_volume(CellType::hexahedron, corners_of(hexes.grid.mesh, c));
  return volume;
}

inline std::size_t facet_count(const VolumeMesh& mesh, std::string_view entity) {
  std::size_t count = 0;
  for (const MeshFacet& facet : mesh.facets) count += mesh.entities[facet.surface].name == entity ? 1 : 0;
  return count;
}

inline double min_scaled_jacobian(const ExtrudedHexes& hexes) {
  double least = 1;
  for (std::size_t c = 0; c < hexes.grid.mesh.cell_count(); ++c)
    if (hexes.grid.is_dead[c] == 0)
      least = std::min(least, measure_cell(CellType::hexahedron, corners_of(hexes.grid.mesh, c)).scaled_jacobian);
  return least;
}

}  // namespace strataflow::support
