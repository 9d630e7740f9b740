#include "kernels/contacts/surface_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/seed.h"
#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

TriangleSoup wavy() {
  TriangleSoup soup;
  support::add_grid(soup, support::add_patch(soup, "H1"), 13, 11, [](double u, double v) {
    return Vec3{10 * u, 10 * v, std::sin(5 * u) + std::cos(7 * v)};
  });
  return soup;
}

TEST(SurfaceSearch, nearest_places_and_hits_equal_brute_force) {
  ContactMesh mesh(wavy());
  const SurfaceSearch search(mesh, 0);
  RandomStream random(7);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p{14 * random.unit() - 2, 14 * random.unit() - 2, 6 * random.unit() - 3};
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : mesh.triangles_of(0)) {
      const Triangle& tri = mesh.triangle(t);
      nearest = std::min(
          nearest, length(nearest_on_triangle(p, mesh.point(tri[0]), mesh.point(tri[1]), mesh.point(tri[2])) - p));
    }
    const auto found = search.nearest(p, 1e9);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->distance_m, nearest);
    EXPECT_FALSE(search.nearest(p, 0.99 * nearest));
    EXPECT_TRUE(search.nearest(p, nearest));
    const auto hit = search.along(p, {0, 0, 1}, 20);
    EXPECT_EQ(hit.has_value(), p.x >= 0 && p.x <= 10 && p.y >= 0 && p.y <= 10);
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->point.x, p.x, 1e-12);
    EXPECT_NEAR(hit->point.y, p.y, 1e-12);
    EXPECT_GE(hit->distance_m, nearest - 1e-12);
  }
  EXPECT_GT(hits, 100);
}

TEST(SurfaceSearch, finds_the_pieces_of_triangles_that_were_split_since) {
  ContactMesh mesh(wavy());
  SurfaceSearch search(mesh, 0);
  const Impact impact = *search.nearest({3.3, 4.4, 5}, 1e9);
  const std::uint32_t vertex = mesh.add_vertex(impact.point);
  mesh.split_triangle(impact.triangle, vertex);
  const Impact again = *search.nearest(impact.point, 1e9);
  EXPECT_EQ(again.distance_m, 0);
  EXPECT_FALSE(search.is_stale());
  mesh.merge(
      vertex,
      mesh.triangle(again.triangle)[0] == vertex ? mesh.triangle(again.triangle)[1] : mesh.triangle(again.triangle)[0],
      1e-9);
  EXPECT_TRUE(search.is_stale());
}

TEST(SurfaceSearch, a_place_on_an_upright_wall_keeps_its_coordinate_to_the_bit) {
  const double x = 0.1 + 0.2;
  const Vec3 q = nearest_on_triangle({7, 0.3, 0.4}, {x, 0, 0}, {x, 1, 1.0 / 3}, {x, 1.0 / 7, 1});
  EXPECT_EQ(q.x, x);
  EXPECT_NEAR(q.y, 0.3, 1e-15);
  EXPECT_EQ(nearest_on_segment({5, 5, 5}, {0, 0, 0}, {1, 1, 1}), (Vec3{1, 1, 1}));
  EXPECT_EQ(nearest_on_segment({5, 5, 5}, {2, 2, 2}, {2, 2, 2}), (Vec3{2, 2, 2}));
}

}  // namespace
}  // namespace strataflow
