#include "kernels/complexity/contact_wedges.h"

#include <gtest/gtest.h>

#include <map>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

TEST(ContactWedges, around_a_fault_below_a_horizon_are_what_was_drawn) {
  const StructuralModel model = model_of(fault_below_horizon(35));
  const EdgeTable edges = build_edge_table(model.points.size(), model.triangles);
  const BoxElements box = find_box_elements(model);
  std::map<std::uint32_t, double> angle_of_region;
  for (const ContactWedge& wedge : find_contact_wedges(model, edges)) {
    if (box.lines[wedge.line] != 0) continue;
    EXPECT_NEAR(wedge.length_m, 10, 1e-12);
    angle_of_region[wedge.region] = wedge.angle_deg;
  }
  ASSERT_EQ(angle_of_region.size(), 3u);
  for (const auto& [region, angle] : angle_of_region) {
    const double volume = model.regions[region].volume_m3;
    EXPECT_NEAR(angle, volume > 399 ? 180 : volume > 200 ? 35 : 145, 1e-9);
  }
}

TEST(ContactWedges, around_every_edge_add_up_to_the_full_circle) {
  const StructuralModel model = reference_model("A5", 100);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> sums;
  for (const ContactWedge& wedge : find_contact_wedges(model, build_edge_table(model.points.size(), model.triangles)))
    sums[{wedge.line, wedge.edge}] += wedge.angle_deg;
  EXPECT_GT(sums.size(), 100u);
  for (const auto& [edge, sum] : sums) EXPECT_NEAR(sum, 360, 1e-9);
}

TEST(ContactWedges, round_a_free_border_is_the_whole_circle) {
  const StructuralModel model = model_of(support::box_with_floating_fault());
  const auto wedges = find_contact_wedges(model, build_edge_table(model.points.size(), model.triangles));
  ASSERT_EQ(wedges.size(), 4u);
  for (const ContactWedge& wedge : wedges) {
    EXPECT_EQ(wedge.angle_deg, 360);
    EXPECT_EQ(wedge.region, 0u);
  }
}

TEST(CornerAngles, of_a_rectangle_between_corners_are_right) {
  const StructuralModel model = model_of(fault_below_horizon(35));
  const EdgeTable edges = build_edge_table(model.points.size(), model.triangles);
  std::uint32_t fault_corners = 0;
  for (const CornerAngle& corner : find_corner_angles(model, edges)) {
    if (model.entities[model.surfaces[corner.surface].entity].name == "box") continue;
    EXPECT_NEAR(corner.angle_deg, 90, 1e-9);
    fault_corners += model.entities[model.surfaces[corner.surface].entity].name == "F1";
  }
  EXPECT_GE(fault_corners, 2u);
}

}  // namespace
}  // namespace strataflow
