#include "stages/seal_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"
#include "stages/cut_stage.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

const SealingNeed needed{true, "asked for"};

CutResult cut(double gap) {
  StageContext context;
  return *Cut{}({support::raw_box(gap, 3), {}, {}}, needed, context);
}

std::vector<std::string> kinds(const StageContext& context) {
  std::vector<std::string> kinds;
  for (const Warning& warning : context.warnings()) kinds.push_back(warning.kind);
  return kinds;
}

TEST(SealStage, closes_small_gaps_and_tells_every_change) {
  StageContext context;
  const Result<CutResult> sealed = Seal{}(cut(0.1), needed, context);
  ASSERT_TRUE(sealed) << describe(sealed.failure());
  EXPECT_EQ(support::region_volumes(sealed->soup).size(), 4u) << support::violations(sealed->soup);
  EXPECT_EQ(context.warnings().size(), sealed->changes.size());
  EXPECT_FALSE(sealed->changes.empty());
}

TEST(SealStage, a_leak_fails_by_name_with_what_to_set) {
  StageContext context;
  const Result<CutResult> sealed = Seal{}(cut(0.5), needed, context);
  ASSERT_FALSE(sealed);
  EXPECT_EQ(sealed.failure().code, FailureCode::invalid_input);
  EXPECT_THAT(sealed.failure().what, HasSubstr("H1 stops 0.5 m short of box"));
  EXPECT_THAT(sealed.failure().remedy, HasSubstr("set seal.distance_m to at least 0.5"));
  EXPECT_THAT(sealed.failure().remedy, HasSubstr("seal.contacts = [\"H1 -> "));
  EXPECT_THAT(kinds(context), testing::Contains("leak"));
}

TEST(SealStage, the_remedy_is_one) {
  Seal stage;
  stage.options.distance_m = 0.7;
  StageContext context;
  const Result<CutResult> sealed = stage(cut(0.5), needed, context);
  ASSERT_TRUE(sealed) << describe(sealed.failure());
  EXPECT_EQ(support::region_volumes(sealed->soup).size(), 4u);
}

TEST(SealStage, a_sealed_model_in_doubt_fails_too) {
  TriangleSoup soup = support::box({0, 0, 0}, {10, 10, 10});
  support::add_grid(soup, support::add_patch(soup, "F1", Role::fault), 2, 2,
                    [](double u, double v) { return Vec3{5, 10 * u, 10 * v}; });
  for (const auto& [name, z] : {std::pair{"H1", 5.0}, {"H2", 5.05}})
    support::add_grid(soup, support::add_patch(soup, name, Role::horizon), 2, 2,
                      [z = z](double u, double v) { return Vec3{5 * u, 10 * v, z}; });
  StageContext context;
  const Result<CutResult> thin = Cut{}({soup, {}, {}}, needed, context);
  Seal stage;
  stage.options.distance_m = 1.4;
  stage.options.micro_region_volume_m3 = 0;
  const Result<CutResult> sealed = stage(*thin, needed, context);
  ASSERT_FALSE(sealed);
  EXPECT_THAT(sealed.failure().what, HasSubstr("in doubt:\n  a sliver of 2.5 m3 between box, F1, H1, H2"));
  EXPECT_THAT(sealed.failure().remedy, HasSubstr("seal.micro_region_volume_m3 = 2.75"));
  EXPECT_THAT(kinds(context), testing::Contains("doubt"));
  stage.options.micro_region_volume_m3 = 2.75;
  EXPECT_TRUE(stage(*thin, needed, context));
}

TEST(SealStage, leaks_that_are_meant_are_a_warning) {
  Seal stage;
  stage.options.on_leak = "warn";
  StageContext context;
  const Result<CutResult> sealed = stage(cut(0.5), needed, context);
  ASSERT_TRUE(sealed) << describe(sealed.failure());
  EXPECT_THAT(kinds(context), testing::Contains("leak"));
}

TEST(SealStage, leaves_surfaces_that_need_no_sealing) {
  StageContext context;
  const Result<CutResult> same = Seal{}(cut(0.5), {}, context);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->soup.points, cut(0.5).soup.points);
  EXPECT_TRUE(context.warnings().empty());
}

}  // namespace
}  // namespace strataflow
