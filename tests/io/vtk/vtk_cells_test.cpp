#include "io/vtk/vtk_cells.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

InputBuilder unit_cube() {
  InputBuilder built("a.vtu");
  for (int i = 0; i < 8; ++i) built.points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return built;
}

TEST(VtkCells, a_voxel_is_a_hexahedron_in_another_order) {
  InputBuilder built = unit_cube();
  SkippedCells skipped;
  VtkPiece piece;
  piece.cells = {{0, 1, 2, 3, 4, 5, 6, 7}, {8}};
  piece.types = {11};
  ASSERT_TRUE(add_vtk_piece(built, skipped, piece, {}));
  const Result<InputData> input = std::move(built).finish();
  ASSERT_TRUE(input);
  EXPECT_DOUBLE_EQ(cell_volume(input->volume, 0), 1.0);
}

TEST(VtkCells, a_pixel_is_a_quad_in_another_order) {
  InputBuilder built = unit_cube();
  SkippedCells skipped;
  VtkPiece piece;
  piece.cells = {{0, 1, 2, 3}, {4}};
  piece.types = {8};
  ASSERT_TRUE(add_vtk_piece(built, skipped, piece, {}));
  const Result<InputData> input = std::move(built).finish();
  ASSERT_TRUE(input);
  EXPECT_EQ(input->surfaces.triangles, (std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}}));
}

TEST(VtkCells, a_swapped_prism_is_the_same_prism_seen_by_others) {
  std::uint32_t prism[] = {0, 1, 2, 3, 4, 5};
  swap_prism_order(CellType::prism, prism);
  EXPECT_EQ(std::vector<std::uint32_t>(prism, prism + 6), (std::vector<std::uint32_t>{0, 2, 1, 3, 5, 4}));
  std::uint32_t hexahedron[] = {0, 1, 2, 3, 4, 5, 6, 7};
  swap_prism_order(CellType::hexahedron, hexahedron);
  EXPECT_EQ(hexahedron[1], 1u);
}

TEST(VtkCells, labels_and_sizes_that_cannot_be_are_named) {
  SkippedCells skipped;
  VtkPiece piece;
  piece.polys = {{0, 1, 2}, {3}};
  piece.entity = {5};
  InputBuilder built = unit_cube();
  const Result<void> label = add_vtk_piece(built, skipped, piece, {0, 1});
  ASSERT_FALSE(label);
  EXPECT_NE(label.failure().what.find("entity 5, but only 2 have names"), std::string::npos) << label.failure().what;
  piece = {};
  piece.cells = {{0, 1, 2}, {3}};
  piece.types = {10};
  const Result<void> size = add_vtk_piece(built, skipped, piece, {});
  ASSERT_FALSE(size);
  EXPECT_NE(size.failure().what.find("of VTK type 10 has 3 points"), std::string::npos) << size.failure().what;
}

TEST(VtkCells, cells_that_are_not_read_are_counted) {
  InputBuilder built = unit_cube();
  SkippedCells skipped;
  VtkPiece piece;
  piece.cells = {{0, 1, 2, 0, 1, 2, 3, 4, 5, 6}, {3, 10}};
  piece.types = {5, 42};
  ASSERT_TRUE(add_vtk_piece(built, skipped, piece, {}));
  skipped.report(built);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_EQ(built.warnings[0].what, "a.vtu: 1 x cell of VTK type 42");
}

}  // namespace
}  // namespace strataflow
