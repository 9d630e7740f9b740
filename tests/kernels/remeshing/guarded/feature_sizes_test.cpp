#include "kernels/remeshing/guarded/feature_sizes.h"

#include "kernels/remeshing/guarded/guarded_shapes.h"

namespace strataflow {
namespace {

using support::built;

/// A wedge of two lines that open by 0.1 m per metre, 10 m long.
TriangleSoup wedge() {
  TriangleSoup soup;
  const auto patch = support::add_patch(soup, "wedge");
  for (int k = 0; k < 10; ++k) {
    const double x = k, y = k + 1;
    if (k > 0) support::add_triangle(soup, patch, {x, 0, 0}, {y, 0.1 * y, 0}, {x, 0.1 * x, 0});
    support::add_triangle(soup, patch, {x, 0, 0}, {y, 0, 0}, {y, 0.1 * y, 0});
  }
  // Sheets along both sides, so that its sides are two lines.
  const auto low = support::add_patch(soup, "low"), high = support::add_patch(soup, "high");
  for (int k = 0; k < 10; ++k) {
    const double x = k, y = k + 1;
    support::add_quad(soup, low, {x, -9, 5}, {y, -9, 5}, {y, 0, 0}, {x, 0, 0});
    support::add_quad(soup, high, {x, 0.1 * x, 0}, {y, 0.1 * y, 0}, {y, 9, 7}, {x, 9, 7});
  }
  return soup;
}

TEST(FeatureSizes, see_how_a_wedge_narrows) {
  const StructuralModel model = built(wedge());
  const InputSurfaces inputs(model);
  const GuardedMesh mesh(inputs, {.distance_m = 1, .cell_m = 1});
  const FeatureSizes features(inputs, 2);
  for (std::uint32_t v = 0; v < model.points.size(); ++v) {
    const Vec3& p = model.points[v];
    if (mesh.kind(v) == VertexKind::line && p.y == 0 && p.z == 0) {
      EXPECT_NEAR(features.at(mesh, v), 0.1 * p.x, 0.01 * p.x) << p.x;
    }
  }
}

TEST(FeatureSizes, do_not_take_the_neighbourhood_on_a_line_for_a_gap) {
  const StructuralModel model = built(support::standing_sheet());
  const InputSurfaces inputs(model);
  const GuardedMesh mesh(inputs, {.distance_m = 1, .cell_m = 1});
  const FeatureSizes features(inputs, 2);
  for (std::uint32_t v = 0; v < model.points.size(); ++v)
    if (const Vec3& p = model.points[v]; p.y == 4 && p.z == 0 && p.x > 2 && p.x < 6) {
      EXPECT_EQ(features.at(mesh, v), 2) << p.x;
    }
}

/// A strip 10 m long between the lines y = 0 and y = width, with a sheet beyond each.
TriangleSoup strip(double width) {
  TriangleSoup soup;
  const auto middle = support::add_patch(soup, "strip"), low = support::add_patch(soup, "low"),
             high = support::add_patch(soup, "high");
  for (int k = 0; k < 10; ++k) {
    const double x = k, y = k + 1;
    support::add_quad(soup, middle, {x, 0, 0}, {y, 0, 0}, {y, width, 0}, {x, width, 0});
    support::add_quad(soup, low, {x, -9, 5}, {y, -9, 5}, {y, 0, 0}, {x, 0, 0});
    support::add_quad(soup, high, {x, width, 0}, {y, width, 0}, {y, 9, 7}, {x, 9, 7});
  }
  return soup;
}

/// Least and largest size of a strip's mesh, asked for 2 m, at least a fifth of it.
std::array<double, 2> graded_sizes(double width, double growth) {
  const StructuralModel model = built(strip(width));
  const InputSurfaces inputs(model);
  GuardedMesh mesh(inputs, {.distance_m = 1, .cell_m = 1});
  set_graded_sizes(mesh, FeatureSizes(inputs, 2), std::vector<double>(model.surfaces.size(), 2), 0.2, growth);
  double least = 9, most = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangle(t)[k], b = mesh.triangle(t)[(k + 1) % 3];
      EXPECT_LE(mesh.size_m(b), (mesh.size_m(a) + growth * length(mesh.point(b) - mesh.point(a))) * 1.002);
      least = std::min(least, mesh.size_m(a));
      most = std::max(most, mesh.size_m(a));
    }
  return {least, most};
}

TEST(GradedSizes, grow_from_strips_at_the_rate_asked_for) {
  const auto [least, most] = graded_sizes(0.4, 0.25);
  EXPECT_NEAR(least, 0.8, 1e-12) << "twice the width";
  EXPECT_NEAR(most, 2, 1e-12);
  EXPECT_NEAR(graded_sizes(0.19, 0.25)[0], 0.4, 1e-12) << "the least allowed";
}

TEST(GradedSizes, leave_strips_alone_that_no_edge_allowed_would_help) {
  EXPECT_EQ(graded_sizes(0.1, 0.25)[0], 2);
}

TEST(FeatureSizes, of_strips_do_not_see_a_corner_that_opens) {
  const StructuralModel model = built(strip(0.4));
  const InputSurfaces inputs(model);
  const GuardedMesh mesh(inputs, {.distance_m = 1, .cell_m = 1});
  const FeatureSizes features(inputs, 2);
  bool has_seen_strip = false;
  for (std::uint32_t v = 0; v < model.points.size(); ++v)
    if (const Vec3& p = model.points[v]; mesh.kind(v) == VertexKind::line && p.y == 0 && p.z == 0) {
      EXPECT_NEAR(features.strip_m(mesh, v), 0.4, 1e-12) << p.x;
      has_seen_strip = true;
    }
  EXPECT_TRUE(has_seen_strip);
}

}  // namespace
}  // namespace strataflow
