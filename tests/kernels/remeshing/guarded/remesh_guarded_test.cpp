#include "kernels/remeshing/guarded/remesh_guarded.h"

#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <filesystem>

#include "graph/parallel/schedule.h"
#include "io/input/local_origin.h"
#include "io/read_input.h"
#include "kernels/quality/analyze_triangles.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/remeshing/guarded/guarded_shapes.h"

namespace strataflow {
namespace {

using support::built;

TEST(RemeshGuarded, keeps_a_box_with_two_horizons_a_box) {
  const StructuralModel before = built(support::layered_box(6));
  const Result<RemeshGuardedResult> result = remesh_guarded(before, {.target_edge_length_m = 0.8});
  ASSERT_TRUE(result) << describe(result.failure());
  const StructuralModel after = built(result->soup);
  support::expect_same_structure(before, after);
  EXPECT_EQ(after.box.low, before.box.low);
  EXPECT_EQ(after.box.high, before.box.high);
  for (const Surface& surface : after.surfaces) {
    if (after.entities[surface.entity].role != Role::boundary) continue;
    Box3 box;
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t)
      for (const std::uint32_t v : after.triangles[t]) box.take(after.points[v]);
    const Vec3 extent = box.high - box.low;
    EXPECT_EQ(std::min({extent.x, extent.y, extent.z}), 0) << after.entities[surface.entity].name << " is not flat";
  }
  double volume = 0;
  for (const Region& region : after.regions) volume += region.volume_m3;
  EXPECT_NEAR(volume, 900, 1e-9);
  const TriangleQualityReport quality = analyze_triangles(after.points, after.triangles);
  EXPECT_GT(quality.min_angle_deg, 15);
  EXPECT_GT(quality.mean_quality, 0.88);
  EXPECT_TRUE(result->report.bad_triangles.empty());
}

TEST(RemeshGuarded, coarsens_and_refines_by_surface) {
  const StructuralModel before = built(support::standing_sheet());
  std::vector<double> size_m;
  for (const Surface& surface : before.surfaces)
    size_m.push_back(before.entities[surface.entity].name == "standing" ? 0.4 : 1.6);
  const Result<RemeshGuardedResult> result = remesh_guarded(before, {.surface_edge_length_m = size_m});
  ASSERT_TRUE(result);
  const StructuralModel after = built(result->soup);
  support::expect_same_structure(before, after);
  std::array<int, 2> count{};
  for (const Surface& surface : after.surfaces)
    count[after.entities[surface.entity].name == "standing"] +=
        static_cast<int>(surface.end_triangle - surface.first_triangle);
  EXPECT_GT(count[1], 600);
  EXPECT_LT(count[0], 500);
}

TEST(RemeshGuarded, keeps_a_dying_fault_with_its_free_border) {
  const StructuralModel before = built(support::dying_fault());
  ASSERT_EQ(support::valences(before)[1], 2);  // outline, border of the fault
  for (const double size_m : {0.6, 1.5, 3.0}) {
    const Result<RemeshGuardedResult> result =
        remesh_guarded(before, {.target_edge_length_m = size_m, .distance_ratio = 0.01});
    ASSERT_TRUE(result);
    support::expect_same_structure(before, built(result->soup));
  }
}

TEST(RemeshGuarded, gives_the_same_mesh_on_every_schedule) {
  const StructuralModel model = built(support::layered_box(45));  // large enough to be cut into blocks
  const auto remeshed = [&] { return remesh_guarded(model, {.target_edge_length_m = 0.35, .rounds = 2})->soup; };
  TriangleSoup expected;
  {
    const ScheduleScope serial(ScheduleKind::serial);
    expected = remeshed();
  }
  support::expect_same_structure(model, built(expected));
  const auto expect_same = [&] {
    const TriangleSoup soup = remeshed();
    EXPECT_EQ(soup.points, expected.points);
    EXPECT_EQ(soup.triangles, expected.triangles);
  };
  for (const std::size_t threads : {1, 2, 3, 8}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    expect_same();
  }
  const ScheduleScope shuffled(ScheduleKind::shuffled, 7);
  expect_same();
}

TEST(RemeshGuarded, keeps_the_names_of_regions) {
  StructuralModel model = built(support::layered_box(4));
  for (std::size_t r = 0; r < model.regions.size(); ++r) model.regions[r].name = "layer " + std::to_string(r);
  const auto result = remesh_guarded(model, {.target_edge_length_m = 1.5});
  ASSERT_TRUE(result);
  const StructuralModel after = built(result->soup);
  std::map<std::string, double> volume;
  for (const Region& region : after.regions) volume[region.name] = region.volume_m3;
  for (const Region& region : model.regions)
    EXPECT_NEAR(volume[region.name], region.volume_m3, 0.02 * region.volume_m3);
}

TEST(RemeshGuarded, makes_good_triangles_of_a_faulted_reference_model) {
  const StructuralModel before = built(*generate_reference_model("A2", {.resolution_m = 60}));
  const Result<RemeshGuardedResult> result = remesh_guarded(before, {.target_edge_length_m = 45});
  ASSERT_TRUE(result);
  const StructuralModel after = built(result->soup);
  support::expect_same_structure(before, after);
  const TriangleQualityReport quality = analyze_triangles(after.points, after.triangles);
  EXPECT_LT(quality.angles_below_30_ratio, 0.02);
  EXPECT_GT(quality.mean_quality, 0.8);
  for (const BadTriangle& bad : result->report.bad_triangles)
    EXPECT_EQ(bad.reason, BadTriangleReason::touches_small_feature);
}

TEST(RemeshGuarded, stops_when_asked_to) {
  int asked = 0;
  const auto result = remesh_guarded(built(support::layered_box(6)),
                                     {.target_edge_length_m = 0.4, .is_cancelled = [&] { return ++asked > 3; }});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.failure().code, FailureCode::cancelled);
  EXPECT_EQ(asked, 4) << "nothing is tried any more";
}

TEST(RemeshGuarded, refuses_options_out_of_their_domain) {
  const StructuralModel model = built(support::standing_sheet());
  for (const RemeshGuardedOptions& options :
       {RemeshGuardedOptions{.target_edge_length_m = 0}, RemeshGuardedOptions{.target_edge_length_m = std::nan("")},
        RemeshGuardedOptions{.surface_edge_length_m = {1}}, RemeshGuardedOptions{.distance_ratio = -1},
        RemeshGuardedOptions{.turn_angle_deg = 90}, RemeshGuardedOptions{.smallest_size_ratio = 0},
        RemeshGuardedOptions{.size_growth_ratio = std::nan("")}}) {
    const auto result = remesh_guarded(model, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.failure().code, FailureCode::invalid_options);
  }
}

TEST(RemeshGuarded, keeps_cloudspin_whole) {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  const std::filesystem::path file =
      (folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data") /
      "cloudspin/CloudSpin_fixed.ml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here (set STRATAFLOW_DATA)";
  Result<InputData> input = read_input(file);
  ASSERT_TRUE(input) << describe(input.failure());
  shift_to_local_origin(*input);
  const StructuralModel before = built(input->surfaces);
  double area_m2 = 0;
  const InputSurfaces inputs(before);
  for (std::uint32_t s = 0; s < before.surfaces.size(); ++s)
    if (before.entities[before.surfaces[s].entity].role != Role::boundary) area_m2 += inputs.area_m2(s);
  const Result<RemeshGuardedResult> result =
      remesh_guarded(before, {.target_edge_length_m = edge_length_of(area_m2, 5000)});
  ASSERT_TRUE(result);
  const StructuralModel after = built(result->soup);
  support::expect_same_structure(before, after);
  const TriangleQualityReport quality = analyze_triangles(after.points, after.triangles);
  EXPECT_LT(quality.angles_below_30_ratio, 0.01);
  EXPECT_GT(quality.mean_quality, 0.895);
  for (const BadTriangle& bad : result->report.bad_triangles)
    EXPECT_EQ(bad.reason, BadTriangleReason::touches_small_feature) << bad.triangle;
}

}  // namespace
}  // namespace strataflow
