#include "stages/hybrid_stage.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "kernels/hybrid/shared_surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "stages/check_mesh_stage.h"
#include "stages/check_validity_stage.h"

namespace strataflow {
namespace {

struct Sample {
  BuiltModel built;
  ValidityReport validity;
};

Sample sample_of(std::string_view name, double resolution_m) {
  Sample sample;
  sample.built = *build_structural_model(*generate_reference_model(name, {.resolution_m = resolution_m}));
  StageContext context;
  sample.validity = *CheckValidity{}(sample.built, context);
  return sample;
}

StageContext seeded() { return StageContext("remesh_hybrid", 1); }

TEST(RemeshHybrid, gets_near_the_number_of_sites_asked_for_and_keeps_everything) {
  const Sample sample = sample_of("nested-spheres", 12);
  StageContext context = seeded();
  HybridOptions options;
  options.sites = 400;
  const Result<RemeshedSurfaces> remeshed = RemeshHybrid{options}(sample.built, sample.validity, context);
  ASSERT_TRUE(remeshed) << remeshed.failure().what;
  EXPECT_TRUE(context.warnings().empty());
  const BuiltModel after = *BuildSurfaces{}(*remeshed, context);
  ASSERT_TRUE(CompareSurfaces{}(sample.built, after, context));
  EXPECT_EQ(remeshed->soup.properties.front().name, site_property);
  EXPECT_EQ(after.model.regions.front().name, sample.built.model.regions.front().name);
}

TEST(RemeshHybrid, a_region_may_have_edges_of_its_own) {
  const Sample sample = sample_of("nested-spheres", 12);
  HybridOptions options;
  options.target_edge_length_m = 30;
  StageContext context = seeded();
  const Result<RemeshedSurfaces> even = RemeshHybrid{options}(sample.built, sample.validity, context);
  options.region_edge_length_m = {{sample.built.model.regions[0].name, 15.0}};
  const Result<RemeshedSurfaces> finer = RemeshHybrid{options}(sample.built, sample.validity, context);
  ASSERT_TRUE(even);
  ASSERT_TRUE(finer) << finer.failure().what;
  EXPECT_GT(finer->soup.triangles.size(), even->soup.triangles.size() * 5 / 4);
  options.region_edge_length_m = {{"nowhere", 15.0}};
  const Result<RemeshedSurfaces> unknown = RemeshHybrid{options}(sample.built, sample.validity, context);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.failure().what.find("'nowhere'"), std::string::npos);
}

TEST(FillHybridStage, gives_a_mesh_that_passes_the_check_and_can_be_stored) {
  const Sample sample = sample_of("wedge", 50);
  StageContext context = seeded();
  HybridOptions options;
  options.sites = 80;
  const Result<RemeshedSurfaces> remeshed = RemeshHybrid{options}(sample.built, sample.validity, context);
  ASSERT_TRUE(remeshed) << remeshed.failure().what;
  const BuiltModel surfaces = *BuildSurfaces{}(*remeshed, context);
  const ValidityReport validity = *CheckValidity{}(surfaces, context);
  const Result<HybridMesh> hybrid = FillHybrid{options}(surfaces, validity, context);
  ASSERT_TRUE(hybrid) << hybrid.failure().what;
  const VolumeMesh cells = *TakeHybridCells{}(*hybrid, context);
  const Result<VolumeQualityReport> quality = CheckMesh{}(surfaces, cells, context);
  ASSERT_TRUE(quality) << quality.failure().what;
  EXPECT_GT(quality->prisms, 20u);
  const auto restored = unarchived<HybridMesh>(archived(*hybrid));
  ASSERT_TRUE(restored);
  EXPECT_EQ(archived(*restored), archived(*hybrid));
}

TEST(FillHybridStage, sets_as_many_sites_inside_as_asked_for) {
  const Sample sample = sample_of("smooth-closed", 20);
  StageContext context = seeded();
  HybridOptions options;
  options.sites = 120;
  const Result<RemeshedSurfaces> remeshed = RemeshHybrid{options}(sample.built, sample.validity, context);
  ASSERT_TRUE(remeshed) << remeshed.failure().what;
  const BuiltModel surfaces = *BuildSurfaces{}(*remeshed, context);
  const ValidityReport validity = *CheckValidity{}(surfaces, context);
  for (const std::int64_t asked : {0, 30}) {
    options.interior_sites = asked;
    const Result<HybridMesh> hybrid = FillHybrid{options}(surfaces, validity, context);
    ASSERT_TRUE(hybrid) << hybrid.failure().what;
    EXPECT_EQ(hybrid->report.interior_sites, static_cast<std::uint64_t>(asked));
  }
  options.interior_sites.reset();
  EXPECT_GT(FillHybrid{options}(surfaces, validity, context)->report.interior_sites, 30u);
}

}  // namespace
}  // namespace strataflow
