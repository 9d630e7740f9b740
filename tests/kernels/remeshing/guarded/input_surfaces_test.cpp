#include "kernels/remeshing/guarded/input_surfaces.h"

#include "kernels/contacts/surface_search.h"
#include "kernels/remeshing/guarded/guarded_shapes.h"

namespace strataflow {
namespace {

using support::built;

TEST(SquareDistance, agrees_with_the_nearest_point_all_around_a_triangle) {
  const Vec3 a{0, 0, 0}, b{4, 1, 0.5}, c{1, 3, -1};
  for (double x = -2; x <= 6; x += 0.7)
    for (double y = -2; y <= 5; y += 0.7)
      for (const double z : {-1.5, 0.0, 2.0}) {
        const Vec3 p{x, y, z}, d = nearest_on_triangle(p, a, b, c) - p;
        EXPECT_NEAR(square_distance(p, a, b, c), dot(d, d), 1e-12);
      }
}

TEST(SquareDistance, of_a_triangle_without_area_is_that_of_its_longest_edge) {
  EXPECT_NEAR(square_distance({1, 1, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(square_distance({5, 0, 0}, {0, 0, 0}, {2, 0, 0}, {4, 0, 0}), 1, 1e-12);
}

TEST(InputSurfaces, know_the_sides_of_a_box) {
  const StructuralModel model = built(support::layered_box(4));
  const InputSurfaces inputs(model);
  int flat = 0, outermost = 0;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    flat += inputs.flat_axis(s) >= 0;
    outermost += inputs.is_outermost(s);
    EXPECT_EQ(inputs.flat_axis(s) >= 0, model.entities[model.surfaces[s].entity].role == Role::boundary);
  }
  EXPECT_EQ(flat, 14);
  EXPECT_EQ(outermost, 14);
}

TEST(InputSurfaces, lead_a_point_to_the_near_branch_of_a_fold_they_started_on) {
  // Two walls 1 m apart, joined 10 m further down: nearest by air is the other wall.
  TriangleSoup soup;
  support::add_grid(soup, "fold", 20, [](double u, double v) {
    const double s = 21 * u;
    return s < 10 ? Vec3{0, v, 10 - s} : s < 11 ? Vec3{s - 10, v, 0} : Vec3{1, v, s - 11};
  });
  const StructuralModel model = built(soup);
  const InputSurfaces inputs(model);
  std::uint32_t start = no_index;
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t)
    if (const Vec3& p = model.points[model.triangles[t][0]]; p.x == 0 && p.z > 8) start = t;
  ASSERT_NE(start, no_index);
  const InputSurfaces::Place place = inputs.nearest({0.9, 0.5, 7}, start);
  EXPECT_NEAR(place.point.x, 0, 1e-12);
  EXPECT_NEAR(place.point.z, 7, 1e-9);
}

TEST(InputSurfaces, place_arcs_on_lines_and_keep_shared_coordinates) {
  const StructuralModel model = built(support::standing_sheet());
  const InputSurfaces inputs(model);
  for (std::uint32_t i = 0; i < model.lines.size(); ++i) {
    if (model.lines[i].surfaces.size() != 3) continue;
    EXPECT_NEAR(inputs.length_m(i), 8, 1e-12);
    const Vec3 p = inputs.point_at(i, 2.3);
    EXPECT_EQ(p.y, 4);
    EXPECT_EQ(p.z, 0);
    EXPECT_EQ(inputs.point_at(i, inputs.arc_of(i, 3)), model.points[model.lines[i].vertices[3]]);
    EXPECT_NEAR(inputs.deviation_m(i, 0, 4, inputs.point_at(i, 0), inputs.point_at(i, 4) + Vec3{0, 4, 0}),
                3 / std::sqrt(2), 1e-9);
  }
}

TEST(InputSurfaces, measure_closed_lines_across_their_first_vertex) {
  TriangleSoup soup;
  const auto patch = support::add_patch(soup, "disc");
  const auto rim = [](int k) { return Vec3{std::cos(k * 0.5235987755982988), std::sin(k * 0.5235987755982988), 0}; };
  for (int k = 0; k < 12; ++k) support::add_triangle(soup, patch, {0, 0, 0}, rim(k), rim((k + 1) % 12));
  const StructuralModel model = built(soup);
  ASSERT_EQ(model.lines.size(), 1u);
  ASSERT_TRUE(model.lines[0].is_closed());
  const InputSurfaces inputs(model);
  const double edge = inputs.length_m(0) / 12;
  EXPECT_LT(length(inputs.point_at(0, inputs.length_m(0) + edge) - model.points[model.lines[0].vertices[1]]), 1e-9);
  // From the 11th vertex to the second, over the first: three vertices in between.
  const Vec3 a = inputs.point_at(0, 10.5 * edge), b = inputs.point_at(0, 1.5 * edge);
  EXPECT_GT(inputs.deviation_m(0, 10.5 * edge, 1.5 * edge, a, b), 0.2);
  EXPECT_NEAR(inputs.deviation_m(0, 10.5 * edge, 11.5 * edge, a, inputs.point_at(0, 11.5 * edge)), 0.067, 1e-4);
}

}  // namespace
}  // namespace strataflow
