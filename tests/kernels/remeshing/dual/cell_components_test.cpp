#include "kernels/remeshing/dual/cell_components.h"

#include <numeric>

#include "kernels/remeshing/dual/dual_samples.h"

namespace strataflow {
namespace {

using sample::Dual;
using sample::dual_of;
using sample::Patches;

TEST(CellComponents, two_concentric_spheres_give_every_cell_between_them_two_discs) {
  const auto sites = sample::sphere(1, 1.05).points;  // 18 sites
  const Dual dual = dual_of(Patches()
                                .add("in", Role::horizon, sample::sphere(3, 1))
                                .add("out", Role::horizon, sample::sphere(3, 1.1))
                                .model(),
                            sites);
  ASSERT_EQ(dual.components.surfaces.size(), 2 * sites.size());
  for (const SurfaceComponent& component : dual.components.surfaces) EXPECT_EQ(component.euler, 1);
  EXPECT_TRUE(dual.components.lines.empty());
}

TEST(CellComponents, twins_are_mutual_and_share_their_ends) {
  const Dual dual = dual_of(sample::junction(), sample::sites_in_box(sample::junction(), 30, 5));
  const CellComponents& c = dual.components;
  for (std::uint32_t slot = 0; slot < c.slot_twin.size(); ++slot) {
    EXPECT_NE(c.slot_twin[slot] == no_index, c.slot_part[slot] == no_index);
    if (c.slot_twin[slot] == no_index) continue;
    const std::uint32_t twin = c.slot_twin[slot];
    EXPECT_EQ(c.slot_twin[twin], slot);
    EXPECT_EQ(dual.diagram.points[slot], dual.diagram.points[next_in_piece(dual.diagram, c.slot_piece[twin], twin)]);
  }
}

TEST(CellComponents, contact_lines_cut_a_cell_apart_and_are_shared_by_its_parts) {
  // One site at the crossing of the contacts of the junction: six half sheets and two half cross sheets, one network.
  const Dual dual = dual_of(sample::junction(), {{0.5, 0, 0}, {9, 9, 9}});
  EXPECT_EQ(dual.components.surfaces.size(), dual.model.surfaces.size());
  ASSERT_EQ(dual.components.site_lines[1], 1u) << "all lines of the model are linked";
  EXPECT_EQ(dual.components.corners_of(0).size(), dual.model.corners.size());
  for (std::uint32_t c = 0; c < dual.components.surfaces.size(); ++c)
    EXPECT_EQ(dual.components.touched_by(c).size(), 1u);
}

TEST(CellComponents, six_parts_of_a_cell_with_four_linked_corners) {
  Patches patches;
  const auto tile = [&](double x0, double x1, double y0, double y1) {
    // Twentieths, so that neighbours share points bit for bit.
    sample::Mesh mesh =
        sample::rectangle({std::round(20 * x0), std::round(20 * y0), 0}, {std::round(20 * (x1 - x0)), 0, 0},
                          {0, std::round(20 * (y1 - y0)), 0}, static_cast<std::uint32_t>(std::round(20 * (x1 - x0))),
                          static_cast<std::uint32_t>(std::round(20 * (y1 - y0))));
    patches.add("P", Role::horizon, mesh);
  };
  tile(0, 0.3, 0.5, 1), tile(0.3, 0.7, 0.5, 1), tile(0.7, 1, 0.5, 1);
  tile(0, 0.4, 0, 0.5), tile(0.4, 0.6, 0, 0.5), tile(0.6, 1, 0, 0.5);
  const Dual dual = dual_of(patches.model(), {{10, 10, 0}, {10, 24, 0}, {10, -4, 0}, {-4, 10, 0}, {24, 10, 0}});
  EXPECT_EQ(dual.components.site_surfaces[1], 6u);
  ASSERT_EQ(dual.components.site_lines[1], 1u);
  EXPECT_EQ(dual.components.corners_of(0).size(), 4u);
}

TEST(CellComponents, parts_of_lines_add_up_to_their_length) {
  const Dual dual = dual_of(sample::junction(), sample::sites_in_box(sample::junction(), 40, 3));
  for (std::size_t l = 0; l < dual.model.lines.size(); ++l) {
    const auto& vertices = dual.model.lines[l].vertices;
    double length_of_line = 0, length_of_parts = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i)
      length_of_line += length(dual.model.points[vertices[i]] - dual.model.points[vertices[i - 1]]);
    for (std::uint32_t p = dual.components.line_begin[l]; p < dual.components.line_begin[l + 1]; ++p) {
      const LinePart& part = dual.components.parts[p];
      length_of_parts += length(part.end - part.begin);
      if (p == dual.components.line_begin[l]) continue;
      EXPECT_EQ(part.begin, dual.components.parts[p - 1].end);
    }
    EXPECT_NEAR(length_of_parts, length_of_line, 1e-12);
  }
}

TEST(CellComponents, euler_numbers_and_borders_tell_a_tube_from_a_disc) {
  // A cell that holds the equator of a sphere between two caps.
  const Dual dual =
      dual_of(Patches().add("S", Role::horizon, sample::sphere(3)).model(), {{0, 0, 0}, {0, 0, 1.4}, {0, 0, -1.4}});
  ASSERT_EQ(dual.components.surfaces.size(), 3u);
  EXPECT_EQ(dual.components.surfaces[0].euler, 0);
  EXPECT_EQ(dual.components.surfaces[1].euler, 1);
  EXPECT_EQ(std::count(dual.components.loop_component.begin(), dual.components.loop_component.end(), 0u), 2);
}

}  // namespace
}  // namespace strataflow
