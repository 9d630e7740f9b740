#include "kernels/adapters/cgal/delaunay_tetrahedra.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/id.h"
#include "base/seed.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {
namespace {

std::vector<Vec3> random_points(std::size_t count) {
  RandomStream random(3);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({random.unit(), random.unit(), random.unit()});
  return points;
}

TEST(DelaunayTetrahedra, hold_no_other_point_in_their_spheres) {
  const std::vector<Vec3> points = random_points(60);
  const DelaunayTetrahedra delaunay = delaunay_tetrahedra(points);
  ASSERT_GT(delaunay.tets.size(), 150u);
  double volume = 0;
  for (const auto& tet : delaunay.tets) {
    const Vec3 &a = points[tet[0]], u = points[tet[1]] - a, v = points[tet[2]] - a, w = points[tet[3]] - a;
    const double six_volumes = dot(cross(u, v), w);
    ASSERT_GT(six_volumes, 0);
    volume += six_volumes / 6;
    const Vec3 centre =
        (0.5 / six_volumes) * (dot(w, w) * cross(u, v) + dot(v, v) * cross(w, u) + dot(u, u) * cross(v, w));
    for (const Vec3& p : points) EXPECT_GE(length(p - (a + centre)), length(centre) * (1 - 1e-9));
  }
  EXPECT_GT(volume, 0.4);
  EXPECT_LT(volume, 1);
}

TEST(DelaunayTetrahedra, know_what_lies_beyond_each_face) {
  const DelaunayTetrahedra delaunay = delaunay_tetrahedra(random_points(40));
  std::size_t on_hull = 0;
  for (std::uint32_t t = 0; t < delaunay.tets.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t beyond = delaunay.beyond[t][k];
      if (beyond == no_index) {
        ++on_hull;
        continue;
      }
      const auto& other = delaunay.tets[beyond];
      EXPECT_EQ(std::count(delaunay.beyond[beyond].begin(), delaunay.beyond[beyond].end(), t), 1);
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(std::count(other.begin(), other.end(), delaunay.tets[t][i]), i == k ? 0 : 1);
    }
  EXPECT_GT(on_hull, 10u);
  EXPECT_EQ(on_hull % 2, 0u);  // a closed surface of triangles
}

TEST(DelaunayTetrahedra, of_points_on_a_sphere_do_not_depend_on_their_order) {
  std::vector<Vec3> cube;  // the corners of eight cubes
  for (int i = 0; i < 27; ++i) cube.push_back({double(i % 3), double(i / 3 % 3), double(i / 9)});
  const DelaunayTetrahedra delaunay = delaunay_tetrahedra(cube);
  std::vector<Vec3> reversed(cube.rbegin(), cube.rend());
  std::vector<std::array<std::uint32_t, 4>> a = delaunay.tets, b = delaunay_tetrahedra(reversed).tets;
  for (auto& tet : b)
    for (std::uint32_t& p : tet) p = 26 - p;
  for (auto* tets : {&a, &b}) {
    for (auto& tet : *tets) std::sort(tet.begin(), tet.end());
    std::sort(tets->begin(), tets->end());
  }
  EXPECT_EQ(a, b);
  EXPECT_GE(a.size(), 40u);  // five or six to a cube
}

TEST(DelaunayTetrahedra, take_the_lowest_of_points_at_one_position_and_are_none_in_a_plane) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {0, 0, 1}};
  const DelaunayTetrahedra delaunay = delaunay_tetrahedra(points);
  ASSERT_EQ(delaunay.tets.size(), 1u);
  EXPECT_EQ(delaunay.tets[0], (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
  EXPECT_EQ(delaunay_tetrahedra(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}}).tets.size(),
            0u);
}

}  // namespace
}  // namespace strataflow
