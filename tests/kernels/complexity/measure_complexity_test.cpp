// The tables of pellerin2014 §1.3 and the rules M1–M6 of its §3, on the models rebuilt from its §4.2 and on the author's
// own (ten times the thesis's size, so h = 100 m there).
#include "kernels/complexity/measure_complexity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/archive.h"
#include "graph/parallel/schedule.h"
#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

ComplexityOptions with_edge(double edge_length_m, std::vector<std::int64_t> cells = {100, 1000, 10000}) {
  ComplexityOptions options;
  options.edge_length_m = edge_length_m;
  options.cells = std::move(cells);
  options.neighbourhoods = "voxels";  // fast; Voronoi cells have tests of their own
  return options;
}

struct GivenModel {
  const char* name;
  std::array<std::uint64_t, 4> counts;     ///< regions, surfaces, lines, corners: Table 3.1, A2's lines by its erratum
  std::array<double, 3> variation;         ///< Table 3.3
  std::array<double, 2> surfaces_lines;    ///< Table 3.2
  struct {
    double mean;
    std::uint32_t q50, q90;
  } in_1000_cells;  ///< Table 3.4
};

class GivenModels : public testing::TestWithParam<GivenModel> {};

TEST_P(GivenModels, give_the_numbers_of_the_thesis) {
  const std::string name = GetParam().name;
  const auto file = data_folder() / ("ringmesh-" + name) / ("model" + name + ".ml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there: set STRATAFLOW_DATA";
  const Result<ComplexityReport> found = measure_complexity(model_of(read_input(file)->surfaces), with_edge(100));
  ASSERT_TRUE(found) << describe(found.failure());
  EXPECT_EQ((std::array{found->counts.regions, found->counts.surfaces, found->counts.lines, found->counts.corners}),
            GetParam().counts);
  const SizeVariation& variation = found->size_variation;
  EXPECT_NEAR(variation.regions, GetParam().variation[0], 0.006);
  EXPECT_NEAR(variation.surfaces, GetParam().variation[1], 0.006);
  if (found->counts.lines > 0) {
    EXPECT_NEAR(variation.lines, GetParam().variation[2], 0.006);
  }
  EXPECT_NEAR(found->geometric.sum_of(ElementType::surface).total() / GetParam().surfaces_lines[0], 1,
              GetParam().surfaces_lines[0] > 1 ? 0.05 : 0.5);
  EXPECT_NEAR(found->geometric.sum_of(ElementType::line).total(), GetParam().surfaces_lines[1], 0.006);
  for (std::size_t i = 1; i < found->cells.size(); ++i) EXPECT_LT(found->cells[i].mean, found->cells[i - 1].mean);  // M6
}

TEST_P(GivenModels, hold_in_voronoi_cells_as_many_features_as_in_the_thesis) {  // Table 3.4, 1 000 cells
  const std::string name = GetParam().name;
  const auto file = data_folder() / ("ringmesh-" + name) / ("model" + name + ".ml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there: set STRATAFLOW_DATA";
  ComplexityOptions options = with_edge(100, {1000});
  options.neighbourhoods = "voronoi";
  options.count_by = "features";
  const ComplexityReport found = *measure_complexity(model_of(read_input(file)->surfaces), options, 2);
  const auto [mean, q50, q90] = GetParam().in_1000_cells;
  EXPECT_NEAR(found.cells[0].mean / mean, 1, 0.05);
  EXPECT_EQ(found.cells[0].q50, q50);
  EXPECT_NEAR(found.cells[0].q90, q90, 1);
  EXPECT_EQ(found.cells[0].q10, 1u);
}

INSTANTIATE_TEST_SUITE_P(Thesis, GivenModels,
                         testing::Values(GivenModel{"A1", {4, 3, 0, 0}, {0.74, 0.00, 0}, {0.03, 0.00}, {2.500, 1, 5}},
                                         GivenModel{"A2", {12, 23, 12, 0}, {0.76, 0.93, 0.01}, {3.21, 0.01}, {3.137, 3, 7}},
                                         GivenModel{"A4", {8, 23, 22, 6}, {0.84, 1.41, 0.67}, {7.41, 0.10}, {2.960, 3, 7}}));

class GeneratedModels : public testing::TestWithParam<const char*> {};

TEST_P(GeneratedModels, obey_the_rules_of_the_measures) {
  const std::string name = GetParam();
  const StructuralModel model = reference_model(name, name == "D" ? 8 : 80);
  const ComplexityReport found = *measure_complexity(model, with_edge(20));
  for (const ElementComplexity& one : found.geometric.elements)  // M1
    for (const double part : {one.too_small, one.shape, one.thin, one.sharp}) {
      EXPECT_GE(part, 0);
      EXPECT_LE(part, 1);
    }
  EXPECT_EQ(found.geometric.elements.size(), found.counts.total() - found.counts.corners);  // M5
  double sum = 0;
  for (const ElementType type : {ElementType::region, ElementType::surface, ElementType::line})
    sum += found.geometric.sum_of(type).total();
  EXPECT_NEAR(found.geometric.total(), sum, 1e-12);
  ASSERT_EQ(found.fields[0].name, "elements");
  EXPECT_EQ(found.fields[0].values.size(), found.map.cell_count());
  for (const double elements : found.fields[0].values) EXPECT_GE(elements, 1);  // M4
  for (std::size_t i = 1; i < found.cells.size(); ++i) EXPECT_LT(found.cells[i].mean, found.cells[i - 1].mean);  // M6
}

INSTANTIATE_TEST_SUITE_P(All, GeneratedModels, testing::Values("A1", "A2", "A3", "A4", "A5", "A6", "B", "C", "D"));

TEST(Complexity, ranks_the_generated_models_in_the_two_groups_of_the_thesis) {  // pellerin2014 §4.2
  std::map<std::string, ComplexityReport> found;
  for (const char* name : {"A1", "A2", "A3", "A4", "A5", "A6", "B", "C"})
    found[name] = *measure_complexity(reference_model(name, 80), with_edge(10));
  for (const char* simple : {"A1", "B", "C"})
    for (const char* faulted : {"A2", "A3", "A4", "A5", "A6"}) {
      EXPECT_LT(found[simple].counts.total(), found[faulted].counts.total()) << simple << " " << faulted;
      EXPECT_LT(found[simple].size_variation.total(), found[faulted].size_variation.total()) << simple << " " << faulted;
      EXPECT_LE(found[simple].cells[1].max, found[faulted].cells[1].max) << simple << " " << faulted;
    }
  for (const char* other : {"A1", "A2", "A3", "A4", "B", "C"}) {
    EXPECT_GT(found["A5"].cells[2].max, found[other].cells[2].max) << other;    // A5 tops the largest count
    EXPECT_GT(found["A6"].cells[2].mean, found[other].cells[2].mean) << other;  // A6 the mean
    EXPECT_GE(found["A6"].cells[2].above_6, found[other].cells[2].above_6) << other;
    EXPECT_GT(found["A6"].geometric.total(), found[other].geometric.total()) << other;
  }
  EXPECT_EQ(found["A1"].cells[2].above_6, 0u);
  EXPECT_EQ(found["A1"].cells[0].max, 7u);
}

TEST(Complexity, does_not_change_with_place_turn_or_scale) {  // M2
  const TriangleSoup soup = *generate_reference_model("A4", {100});
  const StructuralModel here = model_of(soup);
  const ComplexityReport one = *measure_complexity(here, with_edge(10, {100}));
  const ComplexityReport moved = *measure_complexity(model_of(placed(soup, 1, {500, -300, 20}, 40)), with_edge(10, {100}));
  const ComplexityReport large = *measure_complexity(model_of(placed(soup, 8, {})), with_edge(80, {100}));
  for (const ComplexityReport* other : {&moved, &large}) {
    EXPECT_EQ(archived(other->counts), archived(one.counts));
    EXPECT_NEAR(other->size_variation.total(), one.size_variation.total(), 1e-9);
    EXPECT_NEAR(other->geometric.total(), one.geometric.total(), 0.02);  // samples may fall on either side of h
  }
  EXPECT_EQ(archived(large.cells[0].mean), archived(one.cells[0].mean));  // the same voxels, larger
}

TEST(Complexity, does_not_change_with_the_triangles) {  // M3
  const TriangleSoup soup = *generate_reference_model("A4", {100});
  const ComplexityReport coarse = *measure_complexity(model_of(soup), with_edge(10, {1000}));
  const ComplexityReport fine = *measure_complexity(model_of(refined(soup)), with_edge(10, {1000}));
  EXPECT_EQ(archived(coarse.counts), archived(fine.counts));
  EXPECT_NEAR(coarse.geometric.total(), fine.geometric.total(), 0.02);
  EXPECT_NEAR(coarse.size_variation.total(), fine.size_variation.total(), 1e-9);
  EXPECT_NEAR(coarse.cells[0].mean, fine.cells[0].mean, 1e-2);
}

TEST(Complexity, is_the_same_on_every_schedule) {
  const StructuralModel model = reference_model("A3", 100);
  std::vector<std::byte> expected;
  {
    const ScheduleScope serial(ScheduleKind::serial);
    expected = archived(*measure_complexity(model, with_edge(20, {500})));
  }
  {
    const ScheduleScope shuffled(ScheduleKind::shuffled, 7);
    EXPECT_EQ(archived(*measure_complexity(model, with_edge(20, {500}))), expected);
  }
  EXPECT_EQ(archived(*measure_complexity(model, with_edge(20, {500}))), expected);
}

TEST(Complexity, in_balls_sees_what_voxels_see) {
  const StructuralModel model = reference_model("A2", 80);
  ComplexityOptions options = with_edge(10, {1000});
  const double voxels = measure_complexity(model, options)->cells[0].mean;
  options.neighbourhoods = "balls";
  EXPECT_NEAR(measure_complexity(model, options)->cells[0].mean / voxels, 1, 0.15);
}

TEST(Complexity, tells_what_each_region_needs) {
  const ComplexityReport found =
      *measure_complexity(model_of(support::layered_box({0, 0.3, 0.32, 1})), with_edge(0.05, {8}));
  ASSERT_EQ(found.needs.size(), 3u);
  for (const RegionNeed& need : found.needs) {
    const bool is_thin = need.volume_m3 < 0.1;
    EXPECT_EQ(std::isfinite(need.thinnest_m), is_thin);
    EXPECT_NEAR(need.needed_edge_m, is_thin ? 0.02 : std::cbrt(need.volume_m3), 1e-9);
  }
}

TEST(Complexity, refuses_senseless_options_and_flat_models) {
  const StructuralModel model = model_of(support::layered_box({0, 0.3, 1}));
  EXPECT_EQ(measure_complexity(model, with_edge(NAN)).failure().code, FailureCode::invalid_options);
  EXPECT_EQ(measure_complexity(model, with_edge(0.1, {0})).failure().code, FailureCode::invalid_options);
  ComplexityOptions options;
  options.neighbourhoods = "hexagons";
  EXPECT_EQ(measure_complexity(model, options).failure().code, FailureCode::invalid_options);
  TriangleSoup flat;
  support::add_sheet(flat, support::add_patch(flat, "H1", Role::horizon), {0, 0, 0}, {1, 1, 0}, 0);
  EXPECT_EQ(measure_complexity(model_of(flat)).failure().code, FailureCode::invalid_input);
}

}  // namespace
}  // namespace strataflow
