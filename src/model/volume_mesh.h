#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/id.h"
#include "model/geology.h"
#include "model/vector3.h"

namespace strataflow {

/// Volume cells, with VTK's numbers and VTK's node order (positive orientation).
enum class CellType : std::uint8_t { tetrahedron = 10, hexahedron = 12, prism = 13, pyramid = 14 };

constexpr int vertex_count(CellType type) {
  switch (type) {
    case CellType::tetrahedron: return 4;
    case CellType::pyramid: return 5;
    case CellType::prism: return 6;
    case CellType::hexahedron: return 8;
  }
  return 0;
}

/// A face of the mesh that lies on a surface of the model. Triangles repeat no vertex; `vertices[3]` is `no_index`.
/// Seen from cell_0 the vertices turn counter-clockwise about the outward normal.
struct MeshFacet {
  std::array<std::uint32_t, 4> vertices{no_index, no_index, no_index, no_index};
  std::uint32_t surface = no_index;
  std::uint32_t cell_0 = no_index;
  std::uint32_t cell_1 = no_index;  ///< no_index: outside
  static constexpr bool is_flat = true;
};

/// What a stage altered, for the report.
struct Change {
  std::string kind;
  std::string what;
  std::string why;
  template <class A>
  void archive(A& a) {
    a(kind, what, why);
  }
};

/// A mesh of tetrahedra, pyramids, prisms and hexahedra in any mixture.
struct VolumeMesh {
  Vec3 local_origin;
  std::vector<Vec3> points;
  std::vector<CellType> cell_types;
  std::vector<std::uint32_t> cell_offsets{0};  ///< cell c owns cell_vertices[cell_offsets[c] … cell_offsets[c+1])
  std::vector<std::uint32_t> cell_vertices;
  std::vector<std::int32_t> cell_region;       ///< per cell; empty when the source names none
  std::vector<std::int32_t> cell_entity;       ///< per cell; empty when the source names none
  std::vector<MeshFacet> facets;               ///< faces on surfaces of the model; may be empty
  std::vector<std::int32_t> surface_entity;    ///< per surface named by facets
  std::vector<Entity> entities;
  std::vector<std::string> region_names;
  std::vector<std::int32_t> point_line;        ///< per point: the line it lies on, −1 elsewhere; may be empty
  std::vector<std::int32_t> point_corner;      ///< per point: the corner it is, −1 elsewhere; may be empty
  std::vector<Change> changes;

  std::size_t cell_count() const { return cell_types.size(); }
  void add_cell(CellType type, const std::uint32_t* vertices, std::int32_t region) {
    cell_types.push_back(type);
    cell_vertices.insert(cell_vertices.end(), vertices, vertices + vertex_count(type));
    cell_offsets.push_back(static_cast<std::uint32_t>(cell_vertices.size()));
    cell_region.push_back(region);
  }

  template <class A>
  void archive(A& a) {
    a(local_origin, points, cell_types, cell_offsets, cell_vertices, cell_region, cell_entity, facets, surface_entity,
      entities, region_names, point_line, point_corner, changes);
  }
};

}  // namespace strataflow
