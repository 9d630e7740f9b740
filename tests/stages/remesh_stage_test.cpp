#include "stages/remesh_stage.h"

#include <gtest/gtest.h>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "stages/check_validity_stage.h"

namespace strataflow {
namespace {

struct Sample {
  BuiltModel built;
  ValidityReport validity;
};

Sample sample_of(std::string_view name) {
  Sample sample;
  sample.built = *build_structural_model(*generate_reference_model(name, {.resolution_m = 80}));
  StageContext context;
  sample.validity = *CheckValidity{}(sample.built, context);
  return sample;
}

SiteSet sites_of(const Sample& sample, const SiteOptions& options) {
  StageContext context("optimise_sites", 1);
  return *OptimiseSites{options}(sample.built, context);
}

TEST(PlanSites, sites_of_the_box_come_on_top_at_the_same_spacing) {
  const Sample sample = sample_of("A1");
  const SitePlan plan = *plan_sites(sample.built.model, {.sites = 500});
  EXPECT_EQ(plan.sites, 500u);
  const double box_area = 2 * (1600.0 * 930 + 1600.0 * 500 + 930.0 * 500);
  const double per_site = std::sqrt(3.0) / 2 * plan.edge_length_m * plan.edge_length_m;
  EXPECT_NEAR(static_cast<double>(plan.sites_on_box), box_area / per_site, 1);
}

TEST(PlanSites, an_entity_may_have_edges_of_its_own) {
  const Sample sample = sample_of("A1");
  const SitePlan plan =
      *plan_sites(sample.built.model, {.target_edge_length_m = 50, .entity_edge_length_m = {{"H2", 25}}});
  const SitePlan even = *plan_sites(sample.built.model, {.target_edge_length_m = 50});
  EXPECT_GT(plan.sites, even.sites * 3 / 2);  // one of three horizons has four times as many
  const auto unknown = plan_sites(sample.built.model, {.entity_edge_length_m = {{"H9", 25}}});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.failure().what.find("'H9'"), std::string::npos);
}

TEST(Remesh, keeps_everything_and_names_regions_alike) {
  const Sample sample = sample_of("A2");
  StageContext context;
  Remesh remesh;
  remesh.options.sites.target_edge_length_m = 60;
  const Result<RemeshedSurfaces> remeshed = remesh(sample.built, sample.validity, context);
  ASSERT_TRUE(remeshed) << remeshed.failure().what;
  const Result<BuiltModel> after = BuildSurfaces{}(*remeshed, context);
  ASSERT_TRUE(after);
  ASSERT_EQ(after->model.regions.size(), sample.built.model.regions.size());
  for (std::size_t i = 0; i < after->model.regions.size(); ++i)
    EXPECT_EQ(after->model.regions[i].name, sample.built.model.regions[i].name);
  const Result<ValidityReport> validity = CheckValidity{}(*after, context);
  ASSERT_TRUE(validity) << validity.failure().what;
  EXPECT_EQ(validity->intersecting_triangle_pairs, 0u);
  const Result<SurfacesReport> report = CompareSurfaces{}(sample.built, *after, context);
  ASSERT_TRUE(report) << report.failure().what;
  EXPECT_TRUE(remeshed->changes.empty());
  EXPECT_LT(report->hausdorff.ratio(), 0.003);
  EXPECT_GT(report->after.triangles.mean_quality, 0.85);
}

TEST(RemeshByCells, keeps_all_though_its_sites_are_far_too_few) {
  const Sample sample = sample_of("A4");
  StageContext context;
  RemeshByCells remesh;
  remesh.options.sites.sites = 20;  // cells far larger than what they are to keep
  remesh.options.sites.iterations = 5;
  const SiteSet few = sites_of(sample, remesh.options.sites);
  const Result<RemeshedSurfaces> remeshed = remesh(sample.built, sample.validity, few, context);
  ASSERT_TRUE(remeshed) << remeshed.failure().what;
  EXPECT_GT(remeshed->added_sites, 0u);
  const BuiltModel after = *BuildSurfaces{}(*remeshed, context);
  EXPECT_TRUE(CompareSurfaces{}(sample.built, after, context));
}

TEST(RemeshByCells, that_must_keep_all_falls_back_to_local_steps_where_the_dual_cannot) {
  const Sample sample = sample_of("A1");
  StageContext context, by_steps;
  RemeshByCells remesh;
  remesh.options.sites.sites = 20;
  remesh.options.sites.iterations = 2;
  remesh.options.d_resolution_m = 400;  // merges what is to be kept
  const SiteSet few = sites_of(sample, remesh.options.sites);
  const Result<RemeshedSurfaces> remeshed = remesh(sample.built, sample.validity, few, context);
  ASSERT_TRUE(remeshed) << remeshed.failure().what;
  ASSERT_EQ(context.warnings().size(), 1u);
  EXPECT_EQ(context.warnings()[0].kind, "kept_triangulation");
  EXPECT_NE(context.warnings()[0].what.find("the dual is still not valid"), std::string::npos)
      << context.warnings()[0].what;
  EXPECT_TRUE(remeshed->changes.empty());
  EXPECT_EQ(remeshed->soup.points, Remesh{remesh.options}(sample.built, sample.validity, by_steps)->soup.points);
  const BuiltModel after = *BuildSurfaces{}(*remeshed, context);
  EXPECT_TRUE(CompareSurfaces{}(sample.built, after, context));
}

TEST(Remesh, refuses_a_model_that_is_not_sealed) {
  TriangleSoup soup = *generate_reference_model("A1", {.resolution_m = 100});
  soup.triangles.pop_back();
  soup.triangle_patch.pop_back();
  const BuiltModel built = *build_structural_model(soup);
  StageContext context;
  CheckValidity check;
  check.options.must_be_sealed = false;
  const ValidityReport validity = *check(built, context);
  EXPECT_FALSE(Remesh{}(built, validity, context));
  EXPECT_FALSE(RemeshByCells{}(built, validity, SiteSet{}, context));
}

TEST(RemeshByCells, tells_what_it_changed_and_how_many_sites_it_took) {
  const Sample sample = sample_of("A4");
  StageContext context;
  RemeshStageOptions options;
  options.sites.sites = 600;
  options.sites.iterations = 20;
  options.preserve = "resolution";
  options.d_resolution_m = 20;
  const Result<RemeshedSurfaces> remeshed =
      RemeshByCells{options}(sample.built, sample.validity, sites_of(sample, options.sites), context);
  ASSERT_TRUE(remeshed) << remeshed.failure().what;
  EXPECT_EQ(remeshed->sites_asked, 600u);
  const BuiltModel after = *BuildSurfaces{}(*remeshed, context);
  const Result<ValidityReport> validity = CheckValidity{}(after, context);
  ASSERT_TRUE(validity) << validity.failure().what;
  EXPECT_EQ(remeshed->changes.empty(), after.model.corners.size() == sample.built.model.corners.size() &&
                                           after.model.lines.size() == sample.built.model.lines.size() &&
                                           after.model.surfaces.size() == sample.built.model.surfaces.size());
}

TEST(CompareSurfaces, fails_when_something_is_gone_though_all_was_to_stay) {
  const Sample four = sample_of("A2"), three = sample_of("A1");
  StageContext context;
  const Result<SurfacesReport> strict = CompareSurfaces{}(four.built, three.built, context);
  ASSERT_FALSE(strict);
  EXPECT_EQ(strict.failure().code, FailureCode::geometry_failed);
  CompareSurfaces lenient;
  lenient.options.must_preserve_all = false;
  EXPECT_TRUE(lenient(four.built, three.built, context));
}

}  // namespace
}  // namespace strataflow
