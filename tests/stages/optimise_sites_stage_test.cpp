#include "stages/optimise_sites_stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "stages/restrict_voronoi_stage.h"

namespace strataflow {
namespace {

BuiltModel coarse_anticline() { return *build_structural_model(*generate_reference_model("A1", {.resolution_m = 100})); }

SiteSet sites_with(const BuiltModel& built, const SiteOptions& options, std::uint64_t seed) {
  StageContext context("optimise_sites", seed);
  return *OptimiseSites{options}(built, context);
}

TEST(OptimiseSites, depends_on_the_seed_and_lowers_the_energy) {
  const BuiltModel built = coarse_anticline();
  const SiteOptions options{.sites = 200, .iterations = 20};
  const SiteSet one = sites_with(built, options, 1);
  EXPECT_EQ(one.sites, sites_with(built, options, 1).sites);
  EXPECT_NE(one.sites, sites_with(built, options, 2).sites);
  EXPECT_EQ(one.sites.size(), 200 + one.sites_on_box);
  EXPECT_LT(one.newton_steps.back().energy, one.newton_steps.front().energy);
  EXPECT_GT(one.line_attraction, 0);
}

TEST(OptimiseSites, names_the_property_that_is_missing) {
  StageContext context("optimise_sites", 1);
  const auto failed = OptimiseSites{{.sites = 50, .density = "property", .density_property = "porosity"}}(
      coarse_anticline(), context);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.failure().what.find("'porosity'"), std::string::npos);
}

TEST(RestrictVoronoi, tiles_every_triangle) {
  const BuiltModel built = coarse_anticline();
  StageContext context;
  const Result<RestrictedDiagram> diagram = RestrictVoronoi{}(built, sites_with(built, {.sites = 100, .iterations = 5}, 1), context);
  ASSERT_TRUE(diagram);
  double area = 0, expected = 0;
  for (std::size_t i = 0; i < diagram->piece_count(); ++i) {
    const auto points = diagram->piece_points(i);
    Vec3 sum;
    for (std::size_t k = 2; k < points.size(); ++k)
      sum = sum + 0.5 * cross(points[k - 1] - points[0], points[k] - points[0]);
    area += length(sum);
  }
  for (const auto& [a, b, c] : built.model.triangles)
    expected += 0.5 * length(cross(built.model.points[b] - built.model.points[a], built.model.points[c] - built.model.points[a]));
  EXPECT_NEAR(area, expected, 1e-9 * expected);
  EXPECT_FALSE(RestrictVoronoi{}(built, SiteSet{}, context));
}

}  // namespace
}  // namespace strataflow
