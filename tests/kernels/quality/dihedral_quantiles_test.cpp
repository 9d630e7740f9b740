#include "kernels/quality/dihedral_quantiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "graph/parallel/schedule.h"

namespace strataflow {
namespace {

constexpr double degree = 0.017453292519943295;

/// Tetrahedra around the edge from (0, 0, 0) to (0, 0, 1), between rays at the given angles; the first and the last
/// face lie on surfaces.
VolumeMesh fan(const std::vector<double>& rays_deg) {
  VolumeMesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}};
  for (const double ray : rays_deg) mesh.points.push_back({std::cos(ray * degree), std::sin(ray * degree), 0.5});
  const auto last = static_cast<std::uint32_t>(mesh.points.size()) - 1;
  for (std::uint32_t ray = 2; ray < last; ++ray) {
    const std::array<std::uint32_t, 4> cell{0, ray, ray + 1, 1};
    mesh.add_cell(CellType::tetrahedron, cell.data(), 0);
  }
  mesh.facets = {{{0, 1, 2, no_index}, 0, 0, no_index}, {{0, 1, last, no_index}, 1, last - 3, no_index}};
  return mesh;
}

TEST(DihedralQuantiles, set_cells_between_surfaces_that_meet_below_20_degrees_apart) {
  const DihedralQuantiles sharp = dihedral_quantiles(fan({0, 6, 15}));
  EXPECT_EQ(sharp.cells_in_wedges, 2u);
  EXPECT_NEAR(sharp.sharpest_wedge_deg, 15, 1e-9);
  EXPECT_EQ(sharp.min_outside_wedges_deg, 0) << "no cell is outside";
  EXPECT_NEAR(sharp.all.front().angle_deg, 6, 1e-9);
}

TEST(DihedralQuantiles, do_not_excuse_thin_cells_between_surfaces_that_meet_at_a_wide_angle) {
  const DihedralQuantiles wide = dihedral_quantiles(fan({0, 4, 40}));
  EXPECT_EQ(wide.cells_in_wedges, 0u);
  EXPECT_EQ(wide.sharpest_wedge_deg, 0);
  EXPECT_NEAR(wide.min_outside_wedges_deg, 4, 1e-9);
}

TEST(DihedralQuantiles, tell_the_two_sectors_of_an_edge_between_three_surfaces) {
  VolumeMesh mesh = fan({0, 10, 70});
  mesh.facets.push_back({{0, 1, 3, no_index}, 2, 0, 1});
  const DihedralQuantiles report = dihedral_quantiles(mesh);
  EXPECT_EQ(report.cells_in_wedges, 1u);
  EXPECT_NEAR(report.sharpest_wedge_deg, 10, 1e-9);
}

TEST(DihedralQuantiles, are_nearest_ranks_and_ascend) {
  std::vector<double> rays;
  for (double ray = 0; ray <= 340; ray += 0.5) rays.push_back(ray);
  const DihedralQuantiles report = dihedral_quantiles(fan(rays));  // 680 cells, 4080 angles, 680 of them half a degree
  ASSERT_EQ(report.all.size(), 5u);
  EXPECT_NEAR(report.all[1].angle_deg, 0.5, 1e-9);
  EXPECT_NEAR(report.all[3].angle_deg, 0.5, 1e-9) << "a twentieth, of the sixth that is so small";
  EXPECT_GT(report.all[4].angle_deg, 10);
  EXPECT_EQ(report.all[4].share, 0.5);
}

TEST(DihedralQuantiles, of_no_mesh_are_none_and_do_not_depend_on_the_schedule) {
  EXPECT_TRUE(dihedral_quantiles({}).all.empty());
  VolumeMesh mesh;
  for (int copy = 0; copy < 20; ++copy) {  // more cells than one block holds
    std::vector<double> rays;
    for (double ray = 0; ray <= 340; ray += 1 + 0.01 * copy) rays.push_back(ray);
    const VolumeMesh one = fan(rays);
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), one.points.begin(), one.points.end());
    for (std::size_t cell = 0; cell < one.cell_count(); ++cell) {
      std::array<std::uint32_t, 4> vertices;
      for (std::size_t k = 0; k < 4; ++k) vertices[k] = first + one.cell_vertices[4 * cell + k];
      mesh.add_cell(CellType::tetrahedron, vertices.data(), 0);
    }
  }
  const auto serial = archived(dihedral_quantiles(mesh));
  const ScheduleScope scope(ScheduleKind::threads);
  EXPECT_EQ(archived(dihedral_quantiles(mesh)), serial);
}

}  // namespace
}  // namespace strataflow
