#include "kernels/quads/map/map_reduction.h"

#include <gtest/gtest.h>

#include "../field/feature_shapes.h"
#include "kernels/quads/field/frame_field.h"
#include "kernels/quads/field/separate_features.h"

namespace strataflow {
namespace {

/// A mesh, its field and its layout.
struct Prepared {
  FeatureMesh mesh;
  FeatureLayout layout;
  FrameField field;
  explicit Prepared(const FeatureMesh& raw)
      : mesh(*separate_features(raw)), layout(*build_feature_layout(mesh)), field(compute_frame_field(mesh)->field) {}
};

TEST(MapReduction, keeps_one_value_per_point_where_nothing_turns) {
  const Prepared p(support::square_with_fault(8));
  const auto reduction = reduce_map(p.mesh, p.layout, p.field.turns, p.field.axes);
  ASSERT_TRUE(reduction);
  EXPECT_EQ(reduction->cut_edges, 0u);
  std::size_t used = 0;
  for (std::uint32_t point = 0; point < p.mesh.points.size(); ++point) used += !p.layout.nodes_of(point).empty();
  EXPECT_EQ(reduction->place_count(), used);
}

TEST(MapReduction, any_x_satisfies_seams_and_features_exactly) {
  for (const FeatureMesh& raw : {support::wedge(8, 0.3), support::disc(6), support::box_surface(1, 2, 3, 3), support::torus(10, 6)}) {
    const Prepared p(raw);
    const auto reduction = reduce_map(p.mesh, p.layout, p.field.turns, p.field.axes);
    ASSERT_TRUE(reduction);
    std::vector<double> x(reduction->unknowns);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i * 37 % 101) / 7;
    const std::vector<double> v = reduction->scalars(x);
    const auto at = [&](std::uint32_t corner) {
      const std::uint32_t place = reduction->place_of[corner];
      return turned(std::complex<double>{v[2 * place], v[2 * place + 1]}, 4 - reduction->chart[corner / 3]);
    };
    for (std::uint32_t h = 0; h < p.layout.opposite.size(); ++h) {
      const auto along = at(next_half_edge(h)) - at(h);
      if (const std::uint32_t g = p.layout.opposite[h]; g != no_index) {
        EXPECT_NEAR(std::abs(along + turned(at(next_half_edge(g)) - at(g), p.field.turns[h])), 0, 1e-11);
      }
      if (p.field.axes[h] == MapAxis::real) {
        EXPECT_EQ(along.imag(), 0);
      }
      if (p.field.axes[h] == MapAxis::imaginary) {
        EXPECT_EQ(along.real(), 0);
      }
    }
  }
}

TEST(MapReduction, imposes_integers_with_auxiliary_unknowns_and_finds_contradictions) {
  const Prepared p(support::square(4));
  const auto half_edges = static_cast<std::uint32_t>(p.layout.opposite.size());
  std::uint32_t h = 0;
  while (p.field.axes[h] != MapAxis::real) ++h;
  const std::uint32_t end = next_half_edge(h);
  // ω_h = 3 and U_h + Y = 2 i.
  std::vector<IntegerConstraint> constraints{{{{end, {1, 0}}, {h, {-1, 0}}}, {3, 0}},
                                             {{{h, {1, 0}}, {half_edges, {1, 0}}}, {0, 2}}};
  const auto reduction = reduce_map(p.mesh, p.layout, p.field.turns, p.field.axes, constraints);
  ASSERT_TRUE(reduction);
  const std::vector<double> v = reduction->scalars(std::vector<double>(reduction->unknowns, 0.7));
  const auto at = [&](std::uint32_t corner) {
    const std::uint32_t place = reduction->place_of[corner];
    return turned(std::complex<double>{v[2 * place], v[2 * place + 1]}, 4 - reduction->chart[corner / 3]);
  };
  EXPECT_NEAR(std::abs(at(end) - at(h) - 3.0), 0, 1e-12);
  constraints[1] = {{{end, {0, 1}}, {h, {0, -1}}}, {0, 2}};
  const auto torn = reduce_map(p.mesh, p.layout, p.field.turns, p.field.axes, constraints);
  ASSERT_FALSE(torn);
  EXPECT_NE(torn.failure().what.find("contradict"), std::string::npos);
}

TEST(MapReduction, names_a_feature_that_would_vanish) {
  const Prepared p(support::square(4));
  std::uint32_t h = 0;
  while (p.field.axes[h] != MapAxis::real) ++h;
  const std::vector<IntegerConstraint> constraints{{{{next_half_edge(h), {1, 0}}, {h, {-1, 0}}}, {0, 0}}};
  const auto reduction = reduce_map(p.mesh, p.layout, p.field.turns, p.field.axes, constraints);
  ASSERT_FALSE(reduction);
  EXPECT_NE(reduction.failure().what.find("length zero"), std::string::npos);
  EXPECT_NE(reduction.failure().what.find(name_feature(p.mesh, p.layout, h)), std::string::npos);
}

}  // namespace
}  // namespace strataflow
