#include "kernels/drawing/render.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "base/digest.h"
#include "graph/parallel/schedule.h"

namespace strataflow {
namespace {

/// Looks straight down: x to the right, y up, one unit to ten pixels. Two corner triangles, under everything else and
/// only a sliver wide, pin the scale to the square [0, 10]².
struct SquareScene {
  Scene scene;
  ViewOptions view;

  SquareScene() {
    view.width = view.height = 100;
    view.azimuth_deg = -90;
    view.elevation_deg = 90;
    view.vertical_exaggeration = 1;
    view.draws_mesh_edges = false;
    scene.legend = {{"red", {200, 0, 0}}, {"green", {0, 200, 0}}, {"blue", {0, 0, 200}}};
    scene.lines = {};
    scene.points = {{0, 0, -9}, {10, 10, -9}};
    scene.lines.push_back({0, 0});
    scene.lines.push_back({1, 1});
  }
  /// A square with corners (low, low) and (high, high) at height z, facing up.
  void add_square(double low, double high, double z, std::uint32_t colour) {
    const auto first = static_cast<std::uint32_t>(scene.points.size());
    for (const auto& [x, y] : {std::pair{low, low}, {high, low}, {high, high}, {low, high}})
      scene.points.push_back({x, y, z});
    scene.triangles.push_back({{first, first + 1, first + 2}, colour, colour, 3, 0});
    scene.triangles.push_back({{first, first + 2, first + 3}, colour, colour, 6, 0});
  }
  /// The pixel at a place of the square; the margin is 3 %.
  Colour seen_at(double x, double y) const {
    const Image image = render(scene, view);
    const auto pixel = [](double t) { return static_cast<std::uint32_t>(std::floor(50 + 9.4 * (t - 5))); };
    return image.at(pixel(x), 99 - pixel(y));
  }
};

bool is_shade_of(const Colour& seen, const Colour& base) {
  return (base.red > 0) == (seen.red > 50) && (base.green > 0) == (seen.green > 50) &&
         (base.blue > 0) == (seen.blue > 50);
}
constexpr Colour red{200, 0, 0}, green{0, 200, 0}, blue{0, 0, 200}, white{255, 255, 255};

TEST(Render, a_near_triangle_hides_a_far_one_whatever_their_order) {
  for (const bool near_first : {true, false}) {
    SquareScene s;
    s.add_square(2, 8, near_first ? 5 : 1, near_first ? 0 : 1);
    s.add_square(2, 8, near_first ? 1 : 5, near_first ? 1 : 0);
    EXPECT_TRUE(is_shade_of(s.seen_at(5, 5), red));
    EXPECT_TRUE(is_shade_of(s.seen_at(2.2, 7.8), red));
    EXPECT_EQ(s.seen_at(1, 5), white);
  }
}

TEST(Render, a_small_near_square_leaves_the_rest_of_the_far_one_visible) {
  SquareScene s;
  s.add_square(4, 6, 3, 1);
  s.add_square(1, 9, 0, 2);
  EXPECT_TRUE(is_shade_of(s.seen_at(5, 5), green));
  EXPECT_TRUE(is_shade_of(s.seen_at(2, 5), blue));
  EXPECT_TRUE(is_shade_of(s.seen_at(5, 8), blue));
}

TEST(Render, flat_shading_has_the_exact_colour) {
  SquareScene s;
  s.add_square(0, 10, 0, 0);
  // Light from (−0.4, 0.55, 0.75) in the eye's frame: 0.55 + 0.45 · 0.75 / |light| of the base colour.
  const double light = 0.55 + 0.45 * 0.75 / std::sqrt(0.4 * 0.4 + 0.55 * 0.55 + 0.75 * 0.75);
  EXPECT_EQ(s.seen_at(5, 5), (Colour{static_cast<std::uint8_t>(200 * light + 0.5), 0, 0}));
}

TEST(Render, intersecting_triangles_are_cut_where_they_cross) {
  SquareScene s;
  s.add_square(0, 10, 0, 0);
  s.add_square(0, 10, 0, 1);
  for (std::uint32_t i = 6; i < 10; ++i) s.scene.points[i].z = s.scene.points[i].x - 5;  // above the first for x > 5
  EXPECT_TRUE(is_shade_of(s.seen_at(2, 5), red));
  EXPECT_TRUE(is_shade_of(s.seen_at(8, 5), green));
}

TEST(Render, of_coincident_triangles_the_first_is_seen) {
  SquareScene s;
  s.add_square(1, 9, 2, 2);
  s.add_square(1, 9, 2, 0);
  for (const double x : {1.5, 3.3, 5.0, 8.5}) EXPECT_TRUE(is_shade_of(s.seen_at(x, 4), blue));
}

TEST(Render, the_two_sides_of_a_triangle_have_their_own_colours) {
  SquareScene s;
  s.add_square(1, 9, 0, 0);
  for (SceneTriangle& t : s.scene.triangles) t.back_colour = 2;
  EXPECT_TRUE(is_shade_of(s.seen_at(5, 5), red));
  s.view.elevation_deg = -90;
  s.view.azimuth_deg = 90;  // from below
  EXPECT_TRUE(is_shade_of(s.seen_at(5, 5), blue));
}

TEST(Render, an_opened_front_leaves_out_outer_walls_seen_from_outside_only) {
  SquareScene s;
  s.add_square(1, 9, 5, 0);  // a lid: outside is up
  s.scene.triangles[0].outside = s.scene.triangles[1].outside = 1;
  s.add_square(1, 9, 0, 1);  // a floor whose outside is down
  s.scene.triangles[2].outside = s.scene.triangles[3].outside = -1;
  EXPECT_TRUE(is_shade_of(s.seen_at(5, 5), red));
  s.view.opens_front = true;
  EXPECT_TRUE(is_shade_of(s.seen_at(5, 5), green));
}

TEST(Render, mesh_edges_darken_the_outline_but_not_the_diagonal_of_a_quadrilateral) {
  SquareScene s;
  s.add_square(2, 8, 0, 0);
  const Colour plain = s.seen_at(5, 5);
  s.view.draws_mesh_edges = true;
  EXPECT_EQ(s.seen_at(5, 5), plain);
  EXPECT_EQ(s.seen_at(4, 4), plain);
  EXPECT_LT(s.seen_at(2.05, 5).red, plain.red);
  s.scene.triangles[0].mesh_edges = s.scene.triangles[1].mesh_edges = 7;
  EXPECT_LT(s.seen_at(4, 4).red, plain.red);
}

TEST(Render, a_line_on_a_surface_is_drawn_over_it_and_one_behind_is_hidden) {
  SquareScene s;
  s.add_square(0, 10, 0, 0);
  const auto first = static_cast<std::uint32_t>(s.scene.points.size());
  for (const Vec3& p : {Vec3{2, 3, 0}, Vec3{8, 3, 0}, Vec3{2, 7, -5}, Vec3{8, 7, -5}}) s.scene.points.push_back(p);
  s.scene.lines.push_back({first, first + 1});
  s.scene.lines.push_back({first + 2, first + 3});
  EXPECT_LT(s.seen_at(5, 3).red, 60);
  EXPECT_GT(s.seen_at(5, 7).red, 120);
  s.view.draws_lines = false;
  EXPECT_GT(s.seen_at(5, 3).red, 120);
}

TEST(Render, neighbouring_triangles_leave_no_gap) {
  SquareScene s;
  s.scene.points.push_back({5.01, 4.97, 0});
  for (int i = 0; i < 37; ++i) {
    const double angle = 2 * M_PI * i / 37;
    s.scene.points.push_back({5 + 5 * std::cos(angle), 5 + 5 * std::sin(angle), 0});
  }
  for (std::uint32_t i = 0; i < 37; ++i) s.scene.triangles.push_back({{2, 3 + i, 3 + (i + 1) % 37}, 0, 0, 0, 0});
  const Image image = render(s.scene, s.view);
  for (std::uint32_t y = 30; y < 70; ++y)
    for (std::uint32_t x = 30; x < 70; ++x) EXPECT_EQ(image.at(x, y), image.at(50, 50)) << x << " " << y;
}

TEST(Render, an_empty_scene_is_all_background) {
  ViewOptions view;
  view.width = 7;
  view.height = 5;
  view.background = {1, 2, 3};
  const Image image = render({}, view);
  EXPECT_EQ(image.rgb.size(), 105u);
  for (std::uint32_t x = 0; x < 7; ++x) EXPECT_EQ(image.at(x, 4), (Colour{1, 2, 3}));
}

TEST(AutomaticExaggeration, stretches_flat_scenes_only) {
  const auto factor = [](double height) {
    SquareScene s;
    s.add_square(0, 10, 0, 0);
    s.scene.points.back().z = height;
    return automatic_exaggeration(s.scene);
  };
  EXPECT_EQ(factor(10), 1);
  EXPECT_EQ(factor(2.5), 1);
  EXPECT_EQ(factor(1.2), 2);
  EXPECT_EQ(factor(0.1), 20);
  EXPECT_EQ(factor(0), 1);
  EXPECT_EQ(automatic_exaggeration({}), 1);
}

TEST(Render, the_bytes_are_the_same_on_every_schedule) {
  Scene scene;
  scene.legend = {{"a", {200, 120, 40}}, {"b", {40, 120, 200}}};
  for (std::uint32_t i = 0; i < 800; ++i) {  // a tangle: many crossings and ties
    scene.points.push_back({std::sin(i * 1.7), std::cos(i * 0.9), std::sin(i * 0.3) * std::cos(i * 2.1)});
    if (i >= 2) scene.triangles.push_back({{i - 2, i - 1, i}, i % 2, 1, 7, 0});
    if (i >= 1 && i % 10 == 0) scene.lines.push_back({i - 1, i});
  }
  ViewOptions view;
  view.width = 321;
  view.height = 203;
  const auto digest = [&] { return digest_of(archived(render(scene, view))); };
  const Digest expected = digest();
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ScheduleScope scope(ScheduleKind::shuffled, seed);
    EXPECT_EQ(digest(), expected);
  }
  const ScheduleScope scope(ScheduleKind::serial);
  EXPECT_EQ(digest(), expected);
}

}  // namespace
}  // namespace strataflow
