#include "kernels/quality/match_cell_faces.h"

#include <gtest/gtest.h>

#include "kernels/quality/small_meshes.h"

namespace strataflow {
namespace {

TEST(MatchCellFaces, a_box_of_hexahedra_has_the_counted_inner_and_boundary_faces) {
  const FaceMatching matching = match_cell_faces(box_mesh(3, 2, 2, 1, false));
  EXPECT_EQ(matching.boundary_faces.size(), 2u * (3 * 2 + 3 * 2 + 2 * 2));
  EXPECT_EQ(matching.inner_faces, 2u * 2 * 2 + 3u * 1 * 2 + 3u * 2 * 1);
  EXPECT_EQ(matching.nonconforming_faces, 0u);
}

TEST(MatchCellFaces, kuhn_tetrahedra_fit_from_cube_to_cube) {
  const FaceMatching matching = match_cell_faces(box_mesh(3, 2, 2, 1, true));
  EXPECT_EQ(matching.boundary_faces.size(), 2u * 32);
  EXPECT_EQ(matching.inner_faces, (12u * 6 * 4 - 64) / 2);
  EXPECT_EQ(matching.nonconforming_faces, 0u);
}

TEST(MatchCellFaces, keeps_only_the_cells_asked_for) {
  const std::vector<char> kept = {1, 0, 1};
  const FaceMatching matching = match_cell_faces(box_mesh(3, 1, 1, 1, false), &kept);
  EXPECT_EQ(matching.boundary_faces.size(), 12u);
  EXPECT_EQ(matching.inner_faces, 0u);
}

TEST(MatchCellFaces, a_face_of_three_cells_is_nonconforming) {
  VolumeMesh mesh;
  mesh.points.resize(6);
  add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 2, 1, 4});
  EXPECT_EQ(match_cell_faces(mesh).nonconforming_faces, 0u);
  add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 2, 1, 5});
  EXPECT_EQ(match_cell_faces(mesh).nonconforming_faces, 1u);
}

TEST(MatchCellFaces, two_cells_on_the_same_side_of_a_face_are_nonconforming) {
  VolumeMesh mesh;
  mesh.points.resize(5);
  add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 4});
  EXPECT_EQ(match_cell_faces(mesh).nonconforming_faces, 1u);
}

TEST(MatchCellFaces, a_quadrilateral_opposite_two_triangles_is_nonconforming_along_either_diagonal) {
  for (const bool first_diagonal : {true, false}) {
    VolumeMesh mesh;
    mesh.points.resize(9);
    add_cell(mesh, CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
    if (first_diagonal) {
      add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 8});
      add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{4, 6, 7, 8});
    } else {
      add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{5, 6, 7, 8});
      add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{5, 7, 4, 8});
    }
    EXPECT_EQ(match_cell_faces(mesh).nonconforming_faces, 1u);
  }
  VolumeMesh matched;
  matched.points.resize(9);
  add_cell(matched, CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  add_cell(matched, CellType::pyramid, std::array<std::uint32_t, 5>{4, 5, 6, 7, 8});
  EXPECT_EQ(match_cell_faces(matched).nonconforming_faces, 0u);
}

TEST(MatchCellFaces, quadrilaterals_that_pair_the_same_vertices_differently_do_not_fit) {
  VolumeMesh mesh;
  mesh.points.resize(9);
  add_cell(mesh, CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  add_cell(mesh, CellType::pyramid, std::array<std::uint32_t, 5>{4, 6, 5, 7, 8});
  EXPECT_EQ(match_cell_faces(mesh).nonconforming_faces, 1u);
}

TEST(MatchCellFaces, a_hexahedron_collapsed_to_a_prism_fits_a_tetrahedron_on_its_triangle) {
  VolumeMesh mesh;
  mesh.points.resize(9);
  add_cell(mesh, CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 2, 4, 5, 6, 6});
  add_cell(mesh, CellType::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 8});
  const FaceMatching matching = match_cell_faces(mesh);
  EXPECT_EQ(matching.inner_faces, 1u);
  EXPECT_EQ(matching.boundary_faces.size(), 4u + 3u);
  EXPECT_EQ(matching.nonconforming_faces, 0u);
}

}  // namespace
}  // namespace strataflow
