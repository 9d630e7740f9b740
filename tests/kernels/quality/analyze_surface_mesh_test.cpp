#include "kernels/quality/analyze_surface_mesh.h"

#include <gtest/gtest.h>

#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

SurfaceMeshReport report_of(const TriangleSoup& soup) {
  return analyze_surface_mesh(build_structural_model(soup)->model);
}

TEST(AnalyzeSurfaceMesh, a_horizon_in_a_box_meets_the_box_twice_along_its_whole_border) {
  const SurfaceMeshReport report = report_of(support::layered_box({0, 0.25, 1}));
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts[0].name, "H1 | box | box");
  EXPECT_EQ(report.contacts[0].valence, 3u);
  EXPECT_EQ(report.contacts[0].lines, 1u);
  EXPECT_EQ(report.contacts[0].edges, 4u);
  EXPECT_NEAR(report.contacts[0].length_m, 4, 1e-15);
  EXPECT_EQ(report.surfaces, 3u);
  EXPECT_EQ(report.regions, 2u);
  EXPECT_NEAR(report.triangles.area_m2, 7, 1e-14);
  EXPECT_EQ(report.edge_valences, (std::vector<std::uint64_t>{0, 0, report.edge_valences[2], 4}));
}

TEST(AnalyzeSurfaceMesh, a_floating_fault_has_a_free_border) {
  const SurfaceMeshReport report = report_of(support::box_with_floating_fault());
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts[0].name, "F1");
  EXPECT_EQ(report.contacts[0].valence, 1u);
  EXPECT_EQ(report.edge_valences[1], 4u);
}

TEST(ContactChanges, tell_what_was_lost_what_is_new_and_what_was_split) {
  const SurfaceMeshReport one = report_of(support::layered_box({0, 0.25, 1}));
  const SurfaceMeshReport other = report_of(support::box_with_floating_fault());
  EXPECT_TRUE(contact_changes(one, one).empty());
  const std::vector<Change> changes = contact_changes(one, other);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].kind, "contact_created");
  EXPECT_EQ(changes[0].what, "F1 (free border)");
  EXPECT_EQ(changes[1].kind, "contact_lost");
  EXPECT_EQ(changes[1].what, "H1 | box | box");
  SurfaceMeshReport split = one;
  ++split.contacts[0].lines;
  ASSERT_EQ(contact_changes(one, split).size(), 1u);
  EXPECT_EQ(contact_changes(one, split)[0].kind, "contact_lines_changed");
}

}  // namespace
}  // namespace strataflow
