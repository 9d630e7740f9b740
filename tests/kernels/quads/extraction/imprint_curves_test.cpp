#include "kernels/quads/extraction/imprint_curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "graph/parallel/schedule.h"
#include "kernels/quads/extraction/check_features.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/map_samples.h"
#include "kernels/quads/extraction/quad_quality.h"
#include "kernels/quads/extraction/smooth_quads.h"

namespace strataflow {
namespace {

using namespace map_samples;

/// A map and the edges that it does not follow: those of the features named `loose …`.
struct LooseSample {
  MappedMesh mapped;  // without these edges
  FeatureMesh whole;  // with them
  std::vector<FeatureEdge> loose;
};

LooseSample loosen(MappedMesh mapped) {
  LooseSample sample{mapped, mapped.mesh, {}};
  sample.mapped.mesh.edges.clear();
  for (const FeatureEdge& e : mapped.mesh.edges) {
    const bool is_loose = mapped.mesh.features[e.feature].name.starts_with("loose");
    (is_loose ? sample.loose : sample.mapped.mesh.edges).push_back(e);
  }
  derive_turns_and_axes(sample.mapped);
  return sample;
}

Result<ImprintedCurves> imprinted(const LooseSample& sample, double snap = 0.35) {
  const Result<QuadsOnGrid> grid = extract_quads_on_grid(sample.mapped.mesh, sample.mapped.map);
  if (!grid) return grid.failure();
  return imprint_curves(sample.mapped.mesh, *grid, sample.loose, snap);
}

Polyline loose(std::vector<Vec3> points, const std::string& name = "loose", bool is_closed = false) {
  return line(name, Role::fault, std::move(points), is_closed);
}

/// All quads, every feature followed from end to end, nothing turned over, and valences that sum up (R12).
void expect_whole(const LooseSample& sample, const Result<ImprintedCurves>& made, double least_jacobian) {
  ASSERT_TRUE(made) << describe(made.failure());
  QuadMesh quads = made->quads;
  EXPECT_EQ(features_not_followed(sample.whole, quads), std::vector<std::string>());
  ASSERT_TRUE(smooth_quads(quads, sample.whole));
  const auto valid = check_quads(quads);
  EXPECT_TRUE(valid) << describe(valid.failure());
  EXPECT_EQ(features_not_followed(sample.whole, quads), std::vector<std::string>());
  EXPECT_EQ(measure_quads(quads).inverted, 0u);
  EXPECT_GE(measure_quads(quads).scaled_jacobian.minimum, least_jacobian);
  const auto valence = quad_valence(quads);
  const auto is_boundary = boundary_points(quads);
  std::int64_t sum = 0;
  for (std::size_t p = 0; p < valence.size(); ++p)
    sum += (is_boundary[p] ? 2 : 4) - static_cast<std::int64_t>(valence[p]);
  EXPECT_EQ(sum, 4 * euler_characteristic(quads.points.size(), quads.quads));
  std::size_t irregular = 0;
  for (std::size_t p = 0; p < valence.size(); ++p) irregular += !is_boundary[p] && valence[p] != 4;
  EXPECT_EQ(made->created.size(), irregular) << "the map is regular: all are created";
}

TEST(ImprintCurves, a_line_across_the_grid_becomes_a_chain_and_every_quad_four) {
  const LooseSample sample = loosen(rectangle(8, 6, {loose({{2, 1, 0}, {6, 4, 0}})}));
  const auto made = imprinted(sample, 0);
  expect_whole(sample, made, 0.1);
  ASSERT_TRUE(made);
  // From (2, 1) to (6, 4) it crosses 3 + 2 sides and no vertex: six quads are split, each into cells whose corners
  // number six in all, or seven, or eight.
  EXPECT_GE(made->quads.quads.size(), 4 * 48 + 6 * 2u);
  EXPECT_EQ(made->quads.edges.size(), 2 * (28 + 6u)) << "the outline's 28 sides and the six pieces, halved";
}

TEST(ImprintCurves, vertices_near_the_curve_move_onto_it) {
  const LooseSample sample = loosen(rectangle(12, 6, {loose({{1, 2, 0}, {11, 3, 0}})}));
  const auto narrow = imprinted(sample, 0);
  const auto snapped = imprinted(sample);
  expect_whole(sample, narrow, 0.02);
  expect_whole(sample, snapped, 0.3);
  ASSERT_TRUE(narrow && snapped);
  EXPECT_LT(measure_quads(narrow->quads).scaled_jacobian.minimum, 0.1) << "as narrow as it comes";
}

TEST(ImprintCurves, curves_that_bend_close_branch_and_run_side_by_side) {
  std::vector<Vec3> ring;
  for (int i = 0; i < 40; ++i) {
    const double a = i * 3.141592653589793 / 20;
    ring.push_back({6 + 2.6 * std::cos(a), 9 + 2.6 * std::sin(a), 0});
  }
  std::vector<Vec3> wave;
  for (int i = 0; i <= 30; ++i) wave.push_back({1 + i / 3.0, 2 + std::sin(i / 30.0 * 6.283185307179586), 0});
  const LooseSample sample = loosen(rectangle(
      12, 12,
      {loose(ring, "loose ring", true), loose(wave, "loose wave"), loose({{1, 4, 0}, {11, 5, 0}}, "loose under"),
       loose({{1, 5, 0}, {11, 6, 0}}, "loose over"), line("kept", Role::fault, {{6, 5, 0}, {6, 1, 0}})},
      0.5));
  // Junctions of the plan that are no whole numbers are not corners of this map.
  LooseSample whole = sample;
  std::erase_if(whole.mapped.mesh.corners, [&](std::uint32_t p) {
    const Vec3& x = whole.mapped.mesh.points[p];
    return x.x != std::round(x.x) || x.y != std::round(x.y);
  });
  whole.whole.corners = whole.mapped.mesh.corners;
  expect_whole(whole, imprinted(whole), 0.05);
}

TEST(ImprintCurves, a_curve_along_the_grid_splits_nothing) {
  const LooseSample sample = loosen(rectangle(8, 6, {loose({{2, 3, 0}, {6, 3, 0}, {6, 5, 0}})}));
  const auto made = imprinted(sample);
  expect_whole(sample, made, 0.9999);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->quads.quads.size(), 4 * 48u);
  EXPECT_TRUE(made->created.empty());
}

TEST(ImprintCurves, charts_and_their_seams_do_not_matter) {
  const LooseSample sample =
      loosen(rectangle(10, 8, {loose({{1, 1, 0}, {9, 4, 0}}), loose({{1, 7, 0}, {8, 5, 0}}, "loose b")}));
  const auto plain = imprinted(sample);
  ASSERT_TRUE(plain) << describe(plain.failure());
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    LooseSample turned = sample;
    rechart(turned.mapped, seed);
    const auto made = imprinted(turned);
    expect_whole(turned, made, 0.2);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->quads.quads.size(), plain->quads.quads.size());
    EXPECT_EQ(made->created.size(), plain->created.size());
  }
}

TEST(ImprintCurves, a_curve_over_the_edge_of_a_box_stays_on_its_surface) {
  LooseSample sample;
  sample.mapped = box_faces({4, 4, 4}, {1, 5}, 8);  // +x and +z
  const auto at = [&](double x, double y, double z) {
    for (std::uint32_t p = 0; p < sample.mapped.mesh.points.size(); ++p)
      if (length(sample.mapped.mesh.points[p] - Vec3{x, y, z}) < 1e-9) return p;
    return no_index;
  };
  // Down the diagonals of both faces' triangles: half a quad per step.
  std::vector<std::uint32_t> chain;
  for (int k = 0; k <= 4; ++k) chain.push_back(at(2 + 0.5 * k, 1 + 0.5 * k, 4));
  for (int k = 1; k <= 4; ++k) chain.push_back(at(4, 3, 4 - 0.5 * k));
  sample.mapped.mesh.features.push_back({"loose", Role::fault, 0, -1});
  sample.whole = sample.mapped.mesh;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    ASSERT_NE(chain[i + 1], no_index);
    sample.loose.push_back({std::min(chain[i], chain[i + 1]), std::max(chain[i], chain[i + 1]), 1});
  }
  const auto less = [](const FeatureEdge& a, const FeatureEdge& b) { return std::tie(a.a, a.b) < std::tie(b.a, b.b); };
  std::sort(sample.loose.begin(), sample.loose.end(), less);
  sample.whole.edges.insert(sample.whole.edges.end(), sample.loose.begin(), sample.loose.end());
  std::sort(sample.whole.edges.begin(), sample.whole.edges.end(), less);
  sample.mapped.mesh.corners =
      sample.whole.corners = {std::min(chain.front(), chain.back()), std::max(chain.front(), chain.back())};
  const auto made = imprinted(sample);
  ASSERT_TRUE(made) << describe(made.failure());
  EXPECT_EQ(features_not_followed(sample.whole, made->quads), std::vector<std::string>());
  for (const Vec3& p : made->quads.points) EXPECT_LT(std::min(std::abs(p.x - 4), std::abs(p.z - 4)), 1e-12);
  EXPECT_EQ(measure_quads(made->quads).inverted, 0u);
  EXPECT_EQ(made->quads.quads.size(), 4 * 32 + 2 * 2u) << "two quads were cut along their diagonals";
}

TEST(ImprintCurves, says_where_an_open_curve_ends_inside_a_quad) {
  const LooseSample sample = loosen(rectangle(8, 6, {loose({{2, 1, 0}, {5.5, 4.25, 0}})}));
  LooseSample ends = sample;
  const Vec3 tip{5.5, 4.25, 0};
  std::erase_if(ends.mapped.mesh.corners, [&](std::uint32_t p) { return ends.mapped.mesh.points[p] == tip; });
  const auto made = imprinted(ends);
  ASSERT_FALSE(made);
  EXPECT_NE(made.failure().what.find("'loose'"), std::string::npos);
  EXPECT_NE(made.failure().what.find("ends inside a quad at (5.50, 4.25)"), std::string::npos) << made.failure().what;
}

}  // namespace
}  // namespace strataflow
