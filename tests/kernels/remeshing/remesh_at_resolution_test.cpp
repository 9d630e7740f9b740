#include "kernels/remeshing/remesh_at_resolution.h"

#include <gtest/gtest.h>

#include "graph/parallel/schedule.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "kernels/voronoi/sample_sites.h"

namespace strataflow {
namespace {

StructuralModel model_of(std::string_view name) {
  return build_structural_model(*generate_reference_model(name, {.resolution_m = 60}))->model;
}

Result<RemeshedAtResolution> remeshed(const StructuralModel& model, std::size_t sites, double resolution_m) {
  RemeshAtResolutionOptions options;
  options.merge.resolution_m = resolution_m;
  options.edge_length_m = 80;
  options.reoptimise.iterations = 15;
  const OptimisedSites start = optimise_sites({model.points, model.triangles, {}, {}},
                                              sample_sites(model.points, model.triangles, {}, sites, 7), {},
                                              {.iterations = 20});
  return remesh_at_resolution(model, start.sites, options);
}

TEST(RemeshAtResolution, gives_a_valid_sealed_model_whose_changes_are_told) {
  const StructuralModel model = model_of("A4");
  const Result<RemeshedAtResolution> result = remeshed(model, 1500, 20);
  ASSERT_TRUE(result) << result.failure().what;
  EXPECT_TRUE(find_intersections(result->evened.soup.points, result->evened.soup.triangles).empty());
  const BuiltModel built = *build_structural_model(result->evened.soup);
  EXPECT_TRUE(is_sealed(built.model, check_validity(built)));
  const bool is_as_before = built.model.corners.size() == model.corners.size() &&
                            built.model.lines.size() == model.lines.size() &&
                            built.model.surfaces.size() == model.surfaces.size() &&
                            built.model.regions.size() == model.regions.size();
  EXPECT_EQ(result->changes.empty(), is_as_before);
}

TEST(RemeshAtResolution, of_a_simple_model_changes_nothing) {
  const StructuralModel model = model_of("A1");
  const Result<RemeshedAtResolution> result = remeshed(model, 1500, 1);
  ASSERT_TRUE(result) << result.failure().what;
  EXPECT_TRUE(result->changes.empty()) << result->changes.front().what;
  EXPECT_EQ(build_structural_model(result->evened.soup)->model.regions.size(), model.regions.size());
}

TEST(RemeshAtResolution, needs_sites_and_says_so_when_it_must_give_up) {
  const StructuralModel model = model_of("A1");
  EXPECT_FALSE(remesh_at_resolution(model, {}, {}));
  RemeshAtResolutionOptions options;
  options.rounds = 0;
  options.edge_length_m = 500;
  const auto hopeless = remesh_at_resolution(model, {{800, 400, 200}, {100, 100, 100}}, options);
  ASSERT_FALSE(hopeless);
  EXPECT_EQ(hopeless.failure().code, FailureCode::geometry_failed);
}

TEST(RemeshAtResolution, is_the_same_on_any_schedule) {
  const StructuralModel model = model_of("A2");
  const auto run = [&](ScheduleKind kind, std::uint64_t seed) {
    const ScheduleScope scope(kind, seed);
    return remeshed(model, 1000, 15)->evened.soup.points;
  };
  const auto expected = run(ScheduleKind::serial, 0);
  EXPECT_EQ(run(ScheduleKind::threads, 0), expected);
  EXPECT_EQ(run(ScheduleKind::shuffled, 2), expected);
}

}  // namespace
}  // namespace strataflow
