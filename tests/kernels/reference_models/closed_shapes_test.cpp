#include "kernels/reference_models/closed_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/soup_topology.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"

namespace strataflow {
namespace {

using namespace testing_support;

/// Everything, sides of the box included: a closed shape has no other sides.
struct Shape {
  std::string_view name;
  std::size_t regions, surfaces, lines, corners;
  double volume_m3, volume_error;  ///< of the smooth shape; how much polygons inside it lack at most, relative
  std::array<double, 3> edges_m{};
};

class ClosedShape : public testing::TestWithParam<Shape> {};

TEST_P(ClosedShape, is_valid_sealed_and_has_the_parts_of_its_kind_at_every_resolution) {
  for (const double edge_m : GetParam().edges_m) {
    const TriangleSoup soup = *generate_reference_model(GetParam().name, {edge_m, {}});
    const BuiltModel built = *build_structural_model(soup);
    const ValidityReport validity = check_validity(built);
    EXPECT_TRUE(validity.is_valid()) << edge_m;
    EXPECT_TRUE(is_sealed(built.model, validity));
    EXPECT_EQ(built.model.points.size(), soup.points.size()) << "no position twice";
    EXPECT_EQ(built.model.regions.size(), GetParam().regions);
    EXPECT_EQ(built.model.surfaces.size(), GetParam().surfaces);
    EXPECT_EQ(built.model.lines.size(), GetParam().lines);
    EXPECT_EQ(built.model.corners.size(), GetParam().corners);
    double volume = 0;
    for (const Region& region : built.model.regions) volume += region.volume_m3;
    EXPECT_NEAR(volume / GetParam().volume_m3, 1, GetParam().volume_error) << edge_m;
  }
}

// bracket: 12 flat faces (Holes is the other entity) and four holes; a corner has three lines, a hole's rims none.
// impeller: hub, bore, two ends and five faces of each of seven blades; eight corners and twelve lines a blade.
constexpr double pi = std::numbers::pi;
INSTANTIATE_TEST_SUITE_P(Shapes, ClosedShape,
                         testing::Values(Shape{"nested-spheres", 3, 3, 0, 0, 4e6 * pi / 3, 0.05, {25, 12, 7}},
                                         Shape{"slab", 1, 6, 12, 8, 1000. * 800 * 20, 1e-12, {125, 40, 10}},
                                         Shape{"wedge", 1, 5, 9, 6, 1000. * 800 * 30, 1e-12, {125, 40, 10}},
                                         Shape{"smooth-closed", 1, 1, 0, 0, 1.73e6, 0.05, {25, 12, 7}},
                                         Shape{"torus", 1, 1, 0, 0, 2 * pi * 70 * pi * 30 * 30, 0.12, {25, 9, 3}},
                                         Shape{
                                             "bracket",
                                             1,
                                             11 + 4,
                                             18 * 3 / 2 + 8,
                                             18,
                                             200. * 120 * 12 + 12. * 120 * 88 + 12. * 68 * 68 / 2 - 4 * 12. * 144 * pi,
                                             0.01,
                                             {25, 9, 3}},
                                         Shape{"impeller", 1, 4 + 7 * 5, 4 + 7 * 12, 7 * 8, 3.87e5, 0.02, {25, 9, 3}}),
                         [](const auto& shape) {
                           std::string name(shape.param.name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(NestedSpheres, have_their_points_on_the_spheres_and_triangles_that_look_outwards) {
  const TriangleSoup soup = nested_spheres(20);
  const std::array<double, 3> radius{70, 90, 100};
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const Vec3 from_centre = soup.points[a] - Vec3{100, 100, 100};
    EXPECT_NEAR(length(from_centre), radius[entity_of(soup, t)], 1e-10);
    EXPECT_GT(dot(from_centre, cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a])), 0);
  }
}

TEST(Wedge, is_60_m_thick_in_the_west_and_closes_to_a_line_in_the_east) {
  for (const Vec3& p : points_of(wedge(50), "Top")) EXPECT_NEAR(p.z, 60 * (1 - p.x / 1000), 1e-12);
  for (const Vec3& p : points_of(wedge(50), "Bottom")) EXPECT_EQ(p.z, 0);
}

TEST(Slab, is_thinner_than_its_edges_unless_they_are_fine) {
  const auto heights = [](double edge_m) {
    std::set<double> z;
    for (const Vec3& p : slab(edge_m).points) z.insert(p.z);
    return z.size();
  };
  EXPECT_EQ(heights(50), 2u);
  EXPECT_EQ(heights(5), 5u);
}

TEST(SmoothClosedSurface, has_dents_and_bulges_but_no_edge_sharper_than_its_mesh) {
  const TriangleSoup soup = smooth_closed_surface(4);
  double nearest = 1e9, farthest = 0, sharpest = 1;
  for (const Vec3& p : soup.points) {
    nearest = std::min(nearest, length(p - Vec3{100, 100, 100}));
    farthest = std::max(farthest, length(p - Vec3{100, 100, 100}));
  }
  for (const auto& [edge, around] : topology_of(soup).edge_triangles) {
    std::array<Vec3, 2> normal;
    ASSERT_EQ(around.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& [a, b, c] = soup.triangles[around[k]];
      normal[k] = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
      normal[k] = (1 / length(normal[k])) * normal[k];
    }
    sharpest = std::min(sharpest, dot(normal[0], normal[1]));
  }
  EXPECT_GT(farthest / nearest, 1.4);
  EXPECT_GT(sharpest, std::cos(pi / 12));
}

}  // namespace
}  // namespace strataflow
