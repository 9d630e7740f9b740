#include "kernels/quality/find_hanging_vertices.h"

#include <gtest/gtest.h>

#include "kernels/quality/analyze_volume_mesh.h"
#include "kernels/quality/small_meshes.h"

namespace strataflow {
namespace {

/// Two unit cubes of tetrahedra side by side, the right one with its own copy of the shared points.
VolumeMesh unwelded_pair(double shift_y) {
  VolumeMesh mesh = box_mesh(1, 1, 1, 1, true);
  const VolumeMesh other = mesh;
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const Vec3& p : other.points) mesh.points.push_back({p.x + 1, p.y + shift_y, p.z});
  for (std::size_t c = 0; c < other.cell_count(); ++c) {
    std::array<std::uint32_t, 4> cell;
    for (std::uint32_t k = 0; k < 4; ++k) cell[k] = first + other.cell_vertices[other.cell_offsets[c] + k];
    add_cell(mesh, CellType::tetrahedron, cell);
  }
  return mesh;
}

TEST(FindHangingVertices, a_welded_mesh_has_none) {
  EXPECT_EQ(analyze_volume_mesh(box_mesh(2, 2, 2, 1, true)).nonconforming_faces, 0u);
}

TEST(FindHangingVertices, a_vertex_inside_a_neighbours_face_is_found) {
  EXPECT_GT(analyze_volume_mesh(unwelded_pair(0.5)).nonconforming_faces, 0u);
}

TEST(FindHangingVertices, copies_of_vertices_are_counted_but_no_violation) {
  EXPECT_EQ(analyze_volume_mesh(unwelded_pair(0)).nonconforming_faces, 0u);
}

}  // namespace
}  // namespace strataflow
