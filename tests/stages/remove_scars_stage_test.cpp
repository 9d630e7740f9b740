#include "stages/remove_scars_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace strataflow {
namespace {

/// Four loose unit squares around (1, 1), two triangles each, sewn inside each square only.
InputData slit_sheet() {
  InputData data;
  TriangleSoup& soup = data.surfaces;
  const std::uint32_t patch = support::add_patch(soup, "H", Role::horizon);
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      soup.points.insert(soup.points.end(), {{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}});
      soup.triangles.insert(soup.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
      soup.triangle_patch.insert(soup.triangle_patch.end(), {patch, patch});
    }
  return data;
}

std::vector<std::string> kinds(const StageContext& context) {
  std::vector<std::string> kinds;
  for (const Warning& warning : context.warnings()) kinds.push_back(warning.kind);
  return kinds;
}

TEST(RemoveScarsStage, does_nothing_unless_asked) {
  StageContext context;
  const Result<InputData> same = RemoveScars{}(slit_sheet(), context);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->surfaces.points.size(), 16u);
  EXPECT_TRUE(context.warnings().empty());
}

TEST(RemoveScarsStage, sews_slits_and_says_what_it_did) {
  StageContext context;
  const Result<InputData> healed = RemoveScars{{true, true}}(slit_sheet(), context);
  ASSERT_TRUE(healed) << describe(healed.failure());
  EXPECT_EQ(healed->surfaces.points.size(), 8u);
  EXPECT_EQ(healed->surfaces.triangles.size(), 6u);
  EXPECT_THAT(kinds(context), testing::ElementsAre("scar_removed", "scar_node_kept"));
  EXPECT_EQ(context.warnings()[0].what, "sewed 4 edges and erased 1 nodes, 1 of them by a Delaunay filling");
}

TEST(RemoveScarsStage, believes_the_marks_of_a_cut_and_uses_them_up) {
  InputData marked = slit_sheet();
  marked.surfaces.properties.push_back({"inserted_by_cut", "", 1, std::vector<double>(16, 0)});
  StageContext context;
  const Result<InputData> healed = RemoveScars{{true, true}}(marked, context);
  ASSERT_TRUE(healed);
  EXPECT_EQ(healed->surfaces.points.size(), 9u) << "sewn, but the middle was not inserted by a cut";
  EXPECT_TRUE(healed->surfaces.properties.empty());
}

}  // namespace
}  // namespace strataflow
