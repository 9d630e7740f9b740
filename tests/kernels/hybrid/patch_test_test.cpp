#include "kernels/hybrid/patch_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strataflow {
namespace {

/// The unit cube in `count`³ blocks, its points shaken but on the outside, each block cut into cells of one type;
/// `mixed` takes another type from layer to layer that shares quadrilaterals (hexahedra, prisms) below pyramids.
VolumeMesh cube(int count, const std::string& cells) {
  VolumeMesh mesh;
  const auto id = [&](int i, int j, int k) {
    return static_cast<std::uint32_t>((k * (count + 1) + j) * (count + 1) + i);
  };
  for (int k = 0; k <= count; ++k)
    for (int j = 0; j <= count; ++j)
      for (int i = 0; i <= count; ++i) {
        const bool is_inside = i > 0 && j > 0 && k > 0 && i < count && j < count && k < count;
        const double shake = is_inside ? 0.15 : 0;
        const int n = 7 * i + 3 * j + 5 * k;
        mesh.points.push_back({(i + shake * std::sin(n)) / count, (j + shake * std::cos(2.0 * n)) / count,
                               (k + shake * std::sin(3.0 * n)) / count});
      }
  const auto add = [&](CellType type, std::initializer_list<std::uint32_t> v) { mesh.add_cell(type, v.begin(), 0); };
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i) {
        const std::array<std::uint32_t, 8> h{
            id(i, j, k),     id(i + 1, j, k),     id(i + 1, j + 1, k),     id(i, j + 1, k),
            id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)};
        if (cells == "hexahedra" || (cells == "mixed" && k % 2 == 0)) {
          add(CellType::hexahedron, {h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7]});
        } else if (cells == "prisms") {  // cut along the vertical diagonal plane
          add(CellType::prism, {h[0], h[2], h[1], h[4], h[6], h[5]});
          add(CellType::prism, {h[0], h[3], h[2], h[4], h[7], h[6]});
        } else if (cells == "tetrahedra") {  // six around the diagonal 0–6
          for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
            add(CellType::tetrahedron, {h[0], h[a], h[b], h[6]});
        } else {  // six pyramids around a middle
          Vec3 sum;
          for (const std::uint32_t v : h) sum = sum + mesh.points[v];
          const auto m = static_cast<std::uint32_t>(mesh.points.size());
          mesh.points.push_back(0.125 * sum);
          add(CellType::pyramid, {h[0], h[1], h[2], h[3], m});
          add(CellType::pyramid, {h[7], h[6], h[5], h[4], m});
          add(CellType::pyramid, {h[0], h[4], h[5], h[1], m});
          add(CellType::pyramid, {h[1], h[5], h[6], h[2], m});
          add(CellType::pyramid, {h[2], h[6], h[7], h[3], m});
          add(CellType::pyramid, {h[3], h[7], h[4], h[0], m});
        }
      }
  return mesh;
}

TEST(RunPatchTest, reproduces_linear_fields_on_every_type_of_cell) {
  for (const std::string cells : {"tetrahedra", "pyramids", "prisms", "hexahedra", "mixed"}) {
    const Result<PatchTestReport> report = run_patch_test(cube(4, cells));
    ASSERT_TRUE(report) << cells << ": " << report.failure().what;
    EXPECT_LT(report->max_error_ratio, 1e-12) << cells;
    EXPECT_LT(report->energy_error_ratio, 1e-12) << cells;
    EXPECT_GE(report->unknowns, 27u) << cells;
    EXPECT_TRUE(report->passes());
  }
}

TEST(RunPatchTest, takes_both_sides_of_a_crack_for_boundary) {
  VolumeMesh mesh = cube(4, "hexahedra");
  // One block inside is cut off from its neighbours above: its upper vertices are copies.
  const std::size_t cell = (1 * 4 + 1) * 4 + 1;
  for (std::size_t v = 4; v < 8; ++v) {
    std::uint32_t& vertex = mesh.cell_vertices[mesh.cell_offsets[cell] + v];
    mesh.points.push_back(mesh.points[vertex] - Vec3{0, 0, 0.01});
    vertex = static_cast<std::uint32_t>(mesh.points.size() - 1);
  }
  const Result<PatchTestReport> report = run_patch_test(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->boundary_vertices, run_patch_test(cube(4, "hexahedra"))->boundary_vertices + 4 + 8);
}

TEST(RunPatchTest, refuses_cells_that_turn_over_and_empty_meshes) {
  VolumeMesh mesh = cube(2, "prisms");
  std::swap(mesh.cell_vertices[0], mesh.cell_vertices[1]);
  EXPECT_EQ(run_patch_test(mesh).failure().code, FailureCode::geometry_failed);
  EXPECT_EQ(run_patch_test({}).failure().code, FailureCode::invalid_input);
  mesh.cell_vertices[0] = 1000000;
  EXPECT_EQ(run_patch_test(mesh).failure().code, FailureCode::invalid_input);
}

TEST(SolvePoisson, converges_at_second_order_on_every_type_of_cell) {
  constexpr double pi = std::numbers::pi;
  const ScalarField exact = [](const Vec3& p) { return std::sin(pi * p.x) * std::sin(pi * p.y) * std::exp(p.z); };
  const ScalarField source = [&](const Vec3& p) { return (2 * pi * pi - 1) * exact(p); };
  for (const std::string cells : {"tetrahedra", "pyramids", "prisms", "hexahedra", "mixed"}) {
    const double coarse = solve_poisson(cube(4, cells), source, exact)->error_l2;
    const double fine = solve_poisson(cube(8, cells), source, exact)->error_l2;
    EXPECT_GT(coarse / fine, 3.2) << cells;  // 4 at the limit
    EXPECT_LT(coarse / fine, 5.2) << cells;
  }
}

}  // namespace
}  // namespace strataflow
