#include "kernels/quads/map/carry_map.h"

#include <gtest/gtest.h>

#include "../field/feature_shapes.h"
#include "kernels/quads/field/frame_field.h"
#include "kernels/quads/field/separate_features.h"
#include "kernels/quads/map/map_reduction.h"
#include "kernels/quads/map/optimise_map.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

/// A shape, its seamless map, and the same map under one more constraint: its first real feature edge is `quads` long.
struct Carried {
  FeatureMesh mesh;
  FeatureLayout layout;
  FrameField field;
  CornerMap map;
  MapReduction reduction;
  std::uint32_t edge = 0;

  Carried(const FeatureMesh& shape, std::int64_t quads) : mesh(*separate_features(shape)) {
    layout = *build_feature_layout(mesh);
    field = compute_frame_field(mesh)->field;
    map = optimise_map(mesh, field)->map;
    while (field.axes[edge] != MapAxis::real) ++edge;
    const std::int64_t sign = along(map) > 0 ? 1 : -1;
    IntegerConstraint constraint;
    constraint.terms = {{next_half_edge(edge), {1, 0}}, {edge, {-1, 0}}};
    constraint.value = {sign * quads, 0};
    reduction = *reduce_map(mesh, layout, field.turns, field.axes, {constraint});
  }
  double along(const CornerMap& m) const { return (m.at(next_half_edge(edge)) - m.at(edge)).real(); }

  Result<std::vector<double>> run() const {
    auto energy = MapEnergy::build(layout, reduction, mesh.edge_length_m);
    return carry_map(*energy, reduction, *develop_map(layout, reduction, map));
  }
  double smallest_determinant(const std::vector<double>& x) const {
    auto energy = MapEnergy::build(layout, reduction, mesh.edge_length_m);
    double least = 1e300;
    for (const LinearPart& part : energy->linear_parts(x)) least = std::min(least, part.determinant());
    return least;
  }
};

TEST(CarryMap, meets_new_constraints_without_a_fold) {
  for (const std::int64_t quads : {1, 3, 10}) {
    const Carried carried(support::square(6), quads);
    ASSERT_LT(std::abs(carried.along(carried.map)), 0.9);
    const auto x = carried.run();
    ASSERT_TRUE(x) << describe(x.failure());
    EXPECT_GT(carried.smallest_determinant(*x), 0);
    const auto v = carried.reduction.scalars(*x);
    const auto a = carried.reduction.place_of[carried.edge], b = carried.reduction.place_of[next_half_edge(carried.edge)];
    const double long_x = std::abs(v[2 * b] - v[2 * a]), long_y = std::abs(v[2 * b + 1] - v[2 * a + 1]);
    EXPECT_NEAR(std::max(long_x, long_y), static_cast<double>(quads), 1e-9);
  }
}

TEST(CarryMap, develops_any_translation_of_the_triangles) {
  Carried carried(support::disc(8), 2);
  const auto before = develop_map(carried.layout, carried.reduction, carried.map);
  ASSERT_TRUE(before);
  // The first triangle gives the origin.
  for (std::uint32_t c = 3; c < carried.map.uv.size(); ++c) {
    carried.map.uv[c][0] += static_cast<double>(c / 3 % 7);
    carried.map.uv[c][1] -= static_cast<double>(c / 3 % 5);
  }
  const auto after = develop_map(carried.layout, carried.reduction, carried.map);
  ASSERT_TRUE(after);
  for (std::size_t s = 0; s < before->size(); ++s) EXPECT_NEAR((*after)[s], (*before)[s], 1e-9);
}

TEST(CarryMap, refuses_a_map_that_tears_or_is_folded) {
  Carried carried(support::square(4), 2);
  auto energy = MapEnergy::build(carried.layout, carried.reduction, carried.mesh.edge_length_m);
  auto scalars = *develop_map(carried.layout, carried.reduction, carried.map);
  for (std::size_t s = 0; s < scalars.size(); s += 2) scalars[s] = -scalars[s];
  EXPECT_FALSE(carry_map(*energy, carried.reduction, scalars)) << "mirrored";
  carried.map.uv[4][0] += 0.5;
  EXPECT_FALSE(develop_map(carried.layout, carried.reduction, carried.map)) << "one corner elsewhere";
}

TEST(CarryMap, has_the_same_bits_on_every_schedule) {
  const Carried carried(support::square_with_fault(12), 3);
  std::vector<double> reference;
  support::on_every_schedule([&](const char* schedule) {
    const auto x = carried.run();
    ASSERT_TRUE(x) << schedule;
    if (reference.empty()) reference = *x;
    EXPECT_EQ(*x, reference) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
