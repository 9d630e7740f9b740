// Curves that no map follows: they are laid into the quads, which are divided once (T30).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/quads/extraction/check_quads.h"
#include "stages/extract_quads_stage.h"
#include "stages/plan_problem_stage.h"
#include "support/quad_chains.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

std::vector<Vec3> circle(double radius_m, int segments) {
  std::vector<Vec3> points;
  for (int i = 0; i < segments; ++i) {
    const double a = 2 * std::numbers::pi * i / segments;
    points.push_back({radius_m * std::cos(a), radius_m * std::sin(a), 0});
  }
  return points;
}

std::vector<Vec3> spiral(double from_m, double to_m, double rounds, int segments) {
  std::vector<Vec3> points;
  for (int i = 0; i <= segments; ++i) {
    const double a = 2 * std::numbers::pi * rounds * i / segments, r = from_m + (to_m - from_m) * i / segments;
    points.push_back({r * std::cos(a), r * std::sin(a), 0});
  }
  return points;
}

/// A ring between circles of 40 and 100 m.
InputData ring_with(std::vector<Polyline> faults) {
  InputData input;
  input.lines = {{"outer", Role::outline, circle(100, 96), true}, {"inner", Role::hole, circle(40, 96), true}};
  for (Polyline& fault : faults) input.lines.push_back(std::move(fault));
  return input;
}

/// Myles and Zorin's strip: it goes around and comes out further than it went in, so it cannot close on an isoline.
InputData spiral_strip() { return ring_with({{"strip", Role::fault, spiral(50, 90, 2, 192), false}}); }

InputData square_with(std::vector<Polyline> faults) {
  InputData input;
  input.lines = {{"outline", Role::outline, {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}}, true}};
  for (Polyline& fault : faults) input.lines.push_back(std::move(fault));
  return input;
}

struct Made {
  FeatureMesh problem;
  Attempt<FieldAndMap> seamless;
  Attempt<GridMapping> grid;
  MeshedQuads quads;
  std::vector<Warning> warnings;
};

Result<Made> mesh_of(const InputData& input, double edge_m, const LooseCurves& curves = {},
                     std::string transfer = "auto") {
  StageContext context("test");
  Result<FeatureMesh> problem = PlanProblem{{.plan = {.edge_length_m = edge_m}}}(input, context);
  if (!problem) return problem.failure();
  FrameFieldStageOptions options;
  options.curves = curves;
  const auto field = ComputeFrameField{options}(*problem, context);
  if (!field) return field.failure();
  auto map = SeamlessMap{options}(*problem, *field, context);
  if (!map) return map.failure();
  Quantize quantize;
  quantize.options.transfer = transfer;
  auto grid = quantize(*problem, *map, context);
  if (!grid) return grid.failure();
  Result<MeshedQuads> quads = ExtractQuads{}(*problem, *grid, context);
  if (!quads) return quads.failure();
  return Made{std::move(*problem), std::move(*map), std::move(*grid), std::move(*quads), context.warnings()};
}

bool warns(const Made& made, const std::string& kind) {
  return std::any_of(made.warnings.begin(), made.warnings.end(), [&](const Warning& w) { return w.kind == kind; });
}

/// Every feature held by the independent check, nothing inverted, manifold, R12, and every irregular point is one of
/// the field's or named as created.
void expect_good(const Result<Made>& made, double least_jacobian) {
  ASSERT_TRUE(made) << describe(made.failure());
  const QuadMesh& quads = made->quads.mesh;
  EXPECT_EQ(features_not_held(made->problem, quads), std::vector<std::string>());
  EXPECT_EQ(made->quads.quality.inverted, 0u);
  EXPECT_GE(made->quads.quality.scaled_jacobian.minimum, least_jacobian);
  const auto valid = check_quads(quads);
  EXPECT_TRUE(valid) << describe(valid.failure());
  const auto valence = quad_valence(quads);
  const auto is_boundary = boundary_points(quads);
  std::int64_t sum = 0;
  std::size_t of_field = 0;
  for (std::uint32_t p = 0; p < valence.size(); ++p) {
    sum += (is_boundary[p] ? 2 : 4) - static_cast<std::int64_t>(valence[p]);
    if (is_boundary[p] || valence[p] == 4) continue;
    of_field += !std::binary_search(made->quads.created.begin(), made->quads.created.end(), p);
  }
  EXPECT_EQ(sum, 4 * euler_characteristic(quads.points.size(), quads.quads));
  const FrameFieldReport& field = made->seamless.value.field.report;
  EXPECT_LE(of_field, static_cast<std::size_t>(field.valence_3 + field.valence_5 + field.valence_other +
                                               field.feature_irregular));
}

TEST(LooseCurves, a_spiral_strip_that_no_map_follows_is_laid_into_the_quads) {
  const auto strict = mesh_of(spiral_strip(), 16, {{}, false});
  ASSERT_FALSE(strict);
  EXPECT_NE(strict.failure().what.find("strip"), std::string::npos) << strict.failure().what;

  const auto made = mesh_of(spiral_strip(), 16);
  expect_good(made, 0.3);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->quads.imprinted, (std::vector<std::string>{"strip"}));
  EXPECT_FALSE(made->quads.created.empty()) << "it crosses from row to row";
  EXPECT_TRUE(warns(*made, "loose_curve") && warns(*made, "imprinted_curve"));
  EXPECT_EQ(made->quads.mesh.changes.back().kind, "imprinted");
  EXPECT_NEAR(made->quads.quality.edge_length_m.mean(), 16, 6) << "divided once, quads are as long as was asked";
  double strip_m = 0;
  for (const FeatureEdge& e : made->quads.mesh.edges)
    if (made->quads.mesh.features[e.feature].name == "strip")
      strip_m += length(made->quads.mesh.points[e.a] - made->quads.mesh.points[e.b]);
  EXPECT_NEAR(strip_m, 2 * std::numbers::pi * 140, 20);
}

TEST(LooseCurves, of_two_curves_that_close_a_spiral_only_the_one_in_the_way_gets_loose) {
  std::vector<Vec3> ray;
  for (int i = 0; i <= 8; ++i) ray.push_back({62.0 + 2 * i, 0, 0});
  const auto made = mesh_of(
      ring_with({{"around", Role::fault, spiral(62, 78, 1, 96), false}, {"back", Role::fault, ray, false}}), 12);
  expect_good(made, 0.2);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->seamless.value.loose.size(), 1u);
}

TEST(LooseCurves, two_curves_side_by_side_cross_the_grid_where_they_are_named) {
  const auto made = mesh_of(square_with({{"F1", Role::fault, {{20, 20, 0}, {75, 70, 0}}, false},
                                         {"F2", Role::fault, {{26, 20, 0}, {81, 70, 0}}, false},
                                         {"F3", Role::fault, {{0, 85, 0}, {60, 85, 0}}, false}}),
                            10, {.loose = {"F1", "F2"}});
  expect_good(made, 0.1);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->quads.imprinted, (std::vector<std::string>{"F1", "F2"}));
  EXPECT_EQ(made->seamless.value.field.report.valence_3, 0) << "nothing turns the field";
}

TEST(LooseCurves, are_found_again_on_the_refinement_that_a_map_was_laid_over) {
  const auto made =
      mesh_of(square_with({{"F1", Role::fault, {{22, 24, 0}, {40, 37, 0}, {54, 57, 0}, {71, 70, 0}}, false}}), 10,
              {.loose = {"F1"}}, "imprint");
  expect_good(made, 0.1);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->grid.value.transfer, "imprint");
  EXPECT_GT(made->grid.value.mesh.points.size(), made->problem.points.size());
  EXPECT_GT(made->grid.value.loose_edges.size(), made->problem.edges.size() - made->grid.value.mesh.edges.size())
      << "paths cross the curve";
  EXPECT_EQ(made->quads.imprinted, (std::vector<std::string>{"F1"}));
}

TEST(LooseCurves, what_whole_numbers_can_align_is_not_laid_in) {
  const auto made =
      mesh_of(square_with({{"F1", Role::fault, {{0, 52, 0}, {60, 47, 0}}, false}}), 10, {.loose = {"F1"}});
  expect_good(made, 0.5);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->quads.imprinted.empty());
  EXPECT_TRUE(made->grid.value.loose_edges.empty());
  EXPECT_EQ(made->quads.quality.interior_irregular, 0u);
  EXPECT_NEAR(static_cast<double>(made->quads.mesh.quads.size()), 100, 40);
}

TEST(LooseCurves, names_that_are_no_curves_or_bound_the_domain_are_refused) {
  const InputData input = square_with({{"F1", Role::fault, {{0, 52, 0}, {60, 47, 0}}, false}});
  const auto unknown = mesh_of(input, 10, {.loose = {"F9"}});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.failure().code, FailureCode::invalid_options);
  EXPECT_NE(unknown.failure().remedy.find("F1"), std::string::npos);
  const auto border = mesh_of(input, 10, {.loose = {"outline"}});
  ASSERT_FALSE(border);
  EXPECT_NE(border.failure().what.find("boundary"), std::string::npos);
}

TEST(LooseCurves, come_out_the_same_bits_on_every_schedule) {
  std::optional<MeshedQuads> first;
  support::on_every_schedule(
      [&](const char* schedule) {
        const auto made = mesh_of(spiral_strip(), 16, {.loose = {"strip"}});
        ASSERT_TRUE(made) << describe(made.failure());
        if (!first) first = made->quads;
        EXPECT_EQ(made->quads.mesh.points, first->mesh.points) << schedule;
        EXPECT_EQ(made->quads.mesh.quads, first->mesh.quads) << schedule;
        EXPECT_EQ(made->quads.created, first->created) << schedule;
      },
      2);
}

}  // namespace
}  // namespace strataflow
