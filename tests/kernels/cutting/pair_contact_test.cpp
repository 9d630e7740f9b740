#include "kernels/cutting/pair_contact.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/id.h"
#include "kernels/cutting/exact_reference.h"
#include "kernels/cutting/random_triangles.h"
#include "kernels/cutting/rounded_position.h"
#include "support/sanitized.h"

namespace strataflow {
namespace {

using support::RandomMesh;

struct Pair {
  std::vector<Vec3> points;
  Triangle first{0, 1, 2}, second{3, 4, 5};
  PairContact contact() const { return contact_of(points, first, second); }
};

/// The unit right triangle in z = 0, and another one.
Pair against_unit_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, a, b, c}};
}

TEST(PairContact, of_triangles_apart_is_empty) {
  EXPECT_TRUE(against_unit_triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1}).contact().points.empty());
  EXPECT_TRUE(against_unit_triangle({5, 5, -1}, {5, 5, 1}, {6, 5, 1}).contact().points.empty());
}

TEST(PairContact, of_a_vertex_on_the_plane_is_that_vertex) {
  const PairContact contact = against_unit_triangle({0.25, 0.25, 0}, {0, 0, 1}, {1, 0, 1}).contact();
  ASSERT_EQ(contact.points.size(), 1u);
  EXPECT_EQ(contact.points[0].definition, vertex_point(3));
  EXPECT_EQ(contact.points[0].in_first, place_inside);
  EXPECT_EQ(contact.points[0].in_second, 0);
  EXPECT_TRUE(contact.in_first.empty() && contact.in_second.empty());
}

TEST(PairContact, of_an_edge_on_an_edge_is_one_point_on_both) {
  const Pair pair = against_unit_triangle({0.5, -1, -1}, {0.5, 1, 1}, {0.5, -2, 1});
  const PairContact contact = pair.contact();
  ASSERT_EQ(contact.points.size(), 1u);
  EXPECT_EQ(contact.points[0].in_first, 3);
  EXPECT_EQ(contact.points[0].in_second, 3);
  EXPECT_EQ(contact_of(pair.points, pair.second, pair.first).points[0].in_first, 3);
}

TEST(PairContact, of_a_shared_edge_draws_nothing) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PairContact contact = contact_of(points, {0, 1, 2}, {1, 0, 3});
  EXPECT_EQ(contact.points.size(), 2u);
  EXPECT_TRUE(contact.in_first.empty() && contact.in_second.empty());
  EXPECT_FALSE(contact.is_coplanar);
}

TEST(PairContact, of_a_shared_vertex_with_a_crossing_beyond_is_a_segment) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 2, -1}, {2, 2, 1}};
  const PairContact contact = contact_of(points, {0, 1, 2}, {0, 3, 4});
  ASSERT_EQ(contact.points.size(), 2u);
  EXPECT_EQ(contact.in_first.size(), 1u);
  EXPECT_EQ(contact.in_second.size(), 1u);
}

TEST(PairContact, of_two_triangles_as_a_star_has_six_points_and_three_segments_each) {
  const PairContact contact = Pair{{{0, 0, 0}, {6, 0, 0}, {3, 6, 0}, {0, 4, 0}, {3, -2, 0}, {6, 4, 0}}}.contact();
  EXPECT_TRUE(contact.is_coplanar);
  EXPECT_EQ(contact.points.size(), 6u);
  EXPECT_EQ(contact.in_first.size(), 3u);
  EXPECT_EQ(contact.in_second.size(), 3u);
  for (const PairContact::Segment& segment : contact.in_first) EXPECT_NE(segment.edge[0], no_index);
}

TEST(PairContact, of_equal_triangles_draws_nothing) {
  const PairContact contact = contact_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}, {2, 1, 0});
  EXPECT_EQ(contact.points.size(), 3u);
  EXPECT_TRUE(contact.in_first.empty() && contact.in_second.empty());
}

bool ascends(const Vec3& a, const Vec3& b) { return lexicographically_less(a, b); }

/// Points are the corners of what the exact kernel says is shared, places are true, segments bound it, and the pair is
/// found to meet improperly exactly when it does.
void expect_exact(const RandomMesh& mesh) {
  const Triangle &first = mesh.triangles[0], &second = mesh.triangles[1];
  const auto corners = [&](const Triangle& t) {
    return support::Corners{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
  };
  const support::SharedSet expected = support::shared_set(corners(first), corners(second));
  const PairContact contact = contact_of(mesh.points, first, second);
  std::vector<Vec3> found;
  for (const PairContact::Point& p : contact.points) {
    found.push_back(rounded_position(mesh.points, p.definition));
    for (const auto& [triangle, place] : {std::pair{first, p.in_first}, std::pair{second, p.in_second}}) {
      ASSERT_NE(place, place_outside);
      const bool is_own_corner = p.definition.kind == PointDefinition::Kind::vertex &&
                                 std::count(triangle.begin(), triangle.end(), p.definition.vertices[0]) > 0;
      ASSERT_EQ(place < 3, is_own_corner);
      if (place < 3) {
        ASSERT_EQ(triangle[place], p.definition.vertices[0]);
      }
    }
  }
  std::sort(found.begin(), found.end(), ascends);
  ASSERT_EQ(found, expected.corners);
  ASSERT_EQ(contact.is_coplanar && contact.points.size() > 2, expected.dimension == 2);
  // Told the other way round, the same places (an edge on an edge may be defined by the other one).
  std::vector<Vec3> found_other_way;
  for (const PairContact::Point& p : contact_of(mesh.points, second, first).points)
    found_other_way.push_back(rounded_position(mesh.points, p.definition));
  std::sort(found_other_way.begin(), found_other_way.end(), ascends);
  ASSERT_EQ(found_other_way, found);
  if (expected.dimension == 1) {
    ASSERT_LE(contact.in_first.size(), 1u);
    ASSERT_LE(contact.in_second.size(), 1u);
  }
  if (expected.dimension < 1) {
    ASSERT_TRUE(contact.in_first.empty() && contact.in_second.empty());
  }
  // Shared: each point a corner of both, and no area.
  bool is_proper = expected.dimension < 2;
  for (const PairContact::Point& p : contact.points) is_proper = is_proper && p.in_first < 3 && p.in_second < 3;
  ASSERT_EQ(meeting_of(mesh.points, first, second) == PairMeeting::proper, is_proper);
}

class PairContactOfKind : public testing::TestWithParam<support::TriangleKind> {};

TEST_P(PairContactOfKind, is_what_exact_arithmetic_says_for_ten_thousand_pairs) {
  const std::uint64_t trials = support::sanitized ? 200 : 11000;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const RandomMesh mesh = support::random_mesh(GetParam(), 2, seed);
    if (mesh.triangles.size() < 2) continue;
    expect_exact(mesh);
    ASSERT_FALSE(HasFatalFailure()) << describe(mesh) << "seed " << seed;
    contacts += !contact_of(mesh.points, mesh.triangles[0], mesh.triangles[1]).points.empty();
  }
  EXPECT_GT(contacts, trials / 50);
}
INSTANTIATE_TEST_SUITE_P(RandomIntegers, PairContactOfKind, testing::ValuesIn(support::all_triangle_kinds));

}  // namespace
}  // namespace strataflow
