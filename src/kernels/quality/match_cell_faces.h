#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/volume_mesh.h"

namespace strataflow {

/// A face as one cell sees it: counter-clockwise from outside that cell, repeated vertices dropped.
struct CellFace {
  std::array<std::uint32_t, 4> vertices{no_index, no_index, no_index, no_index};
  std::uint32_t cell = 0;
  bool is_triangle() const { return vertices[3] == no_index; }
};

/// Which faces of a mesh have one cell and which two, found from the vertex numbers alone.
struct FaceMatching {
  std::uint64_t inner_faces = 0;         ///< two cells that see it from opposite sides
  std::vector<CellFace> boundary_faces;  ///< one cell; ascending by smallest vertex, then by the others
  /// Vertex sets that break the rule: three or more cells; two cells on the same side, or that pair its vertices
  /// differently; a quadrilateral opposite triangles that use three of its vertices.
  std::uint64_t nonconforming_faces = 0;
  std::vector<CellFace> nonconforming_examples;  ///< the first few
};

/// Matches the faces of all cells, or of those with `is_kept[cell] != 0`. Faces that have shrunk to an edge or a point
/// (collapsed hexahedra) are no faces. Needs indices in range. Time and memory are linear in the number of cells.
FaceMatching match_cell_faces(const VolumeMesh& mesh, const std::vector<char>* is_kept = nullptr);

}  // namespace strataflow
