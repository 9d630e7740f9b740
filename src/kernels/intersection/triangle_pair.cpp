#include "kernels/intersection/triangle_pair.h"

#include <algorithm>
#include <array>

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

using Corners = std::array<const Vec3*, 3>;

Corners corners_of(const std::vector<Vec3>& points, const Triangle& t) {
  return {&points[t[0]], &points[t[1]], &points[t[2]]};
}

/// Where a point of the triangle's plane lies: −1 outside, 0 on the border, +1 inside.
int place_in_plane(const Corners& t, const Vec3& p, int axis) {
  const int turn = orientation_2d(*t[0], *t[1], *t[2], axis);
  int lowest = 1;
  for (int k = 0; k < 3; ++k) lowest = std::min(lowest, turn * orientation_2d(*t[k], *t[(k + 1) % 3], p, axis));
  return lowest;
}

/// Two segments of one plane: 0 apart, 1 touching (an end on the other, or overlapping), 2 crossing inside both.
int segments_in_plane(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, int axis) {
  const int p_side = orientation_2d(r, s, p, axis), q_side = orientation_2d(r, s, q, axis);
  const int r_side = orientation_2d(p, q, r, axis), s_side = orientation_2d(p, q, s, axis);
  if (p_side * q_side > 0 || r_side * s_side > 0) return 0;
  if (p_side == 0 && q_side == 0) {  // one line: compare along it
    const auto least = [](const Vec3& a, const Vec3& b) { return lexicographically_less(a, b) ? a : b; };
    const auto most = [](const Vec3& a, const Vec3& b) { return lexicographically_less(a, b) ? b : a; };
    return lexicographically_less(most(p, q), least(r, s)) || lexicographically_less(most(r, s), least(p, q)) ? 0 : 1;
  }
  return p_side * q_side < 0 && r_side * s_side < 0 ? 2 : 1;
}

/// A segment against a triangle of another plane; `p_side` and `q_side` are the ends' sides of the triangle's plane,
/// not both 0. 0 apart, 1 touching a vertex or with an end, 2 piercing the inside or an edge.
int segment_through(const Corners& t, const Vec3& p, const Vec3& q, int p_side, int q_side, int axis) {
  if (p_side * q_side > 0) return 0;
  if (p_side == 0) return place_in_plane(t, p, axis) >= 0 ? 1 : 0;
  if (q_side == 0) return place_in_plane(t, q, axis) >= 0 ? 1 : 0;
  int lowest = 1, highest = -1, edges_met = 0;
  for (int k = 0; k < 3; ++k) {
    const int turn = orientation_3d(p, q, *t[k], *t[(k + 1) % 3]);
    lowest = std::min(lowest, turn);
    highest = std::max(highest, turn);
    edges_met += turn == 0;
    if (lowest < 0 && highest > 0) return 0;
  }
  return edges_met > 1 ? 1 : 2;
}

/// A segment in the triangle's plane. 0 apart, 1 touching its border, 2 passing through the inside.
int segment_in_plane(const Corners& t, const Vec3& p, const Vec3& q, int axis) {
  const int p_place = place_in_plane(t, p, axis), q_place = place_in_plane(t, q, axis);
  if (p_place > 0 || q_place > 0) return 2;
  int meeting = p_place == 0 || q_place == 0 ? 1 : 0;
  for (int k = 0; k < 3; ++k) meeting = std::max(meeting, segments_in_plane(p, q, *t[k], *t[(k + 1) % 3], axis));
  return meeting;
}

/// Two triangles of one plane share area: no edge of either has the whole other triangle beyond or on its line.
bool overlap_in_plane(const Corners& a, const Corners& b, int axis) {
  const auto has_parting_edge = [axis](const Corners& t, const Corners& other) {
    const int turn = orientation_2d(*t[0], *t[1], *t[2], axis);
    for (int k = 0; k < 3; ++k) {
      int innermost = -1;
      for (const Vec3* p : other)
        innermost = std::max(innermost, turn * orientation_2d(*t[k], *t[(k + 1) % 3], *p, axis));
      if (innermost <= 0) return true;
    }
    return false;
  };
  return !has_parting_edge(a, b) && !has_parting_edge(b, a);
}

PairMeeting as_meeting(int strength) {
  return strength == 0 ? PairMeeting::proper : strength == 1 ? PairMeeting::touching : PairMeeting::crossing;
}

/// Sides of the corners of `t` with respect to the plane of `plane`.
std::array<int, 3> sides_of(const Corners& plane, const Corners& t) {
  std::array<int, 3> side;
  for (int k = 0; k < 3; ++k) side[k] = orientation_3d(*plane[0], *plane[1], *plane[2], *t[k]);
  return side;
}

PairMeeting meeting_of_disjoint(const Corners& a, const Corners& b) {
  const std::array<int, 3> a_side = sides_of(b, a);
  if (a_side[0] == a_side[1] && a_side[1] == a_side[2] && a_side[0] != 0) return PairMeeting::proper;
  const std::array<int, 3> b_side = sides_of(a, b);
  if (b_side[0] == b_side[1] && b_side[1] == b_side[2] && b_side[0] != 0) return PairMeeting::proper;
  int strength = 0;
  const auto edges_against = [&](const Corners& of, const std::array<int, 3>& side, const Corners& other) {
    const int axis = projection_axis(*other[0], *other[1], *other[2]);
    for (int k = 0; k < 3 && strength < 2; ++k) {
      const int m = (k + 1) % 3;
      const int met = side[k] == 0 && side[m] == 0 ? segment_in_plane(other, *of[k], *of[m], axis)
                                                   : segment_through(other, *of[k], *of[m], side[k], side[m], axis);
      strength = std::max(strength, met);
    }
  };
  edges_against(a, a_side, b);
  edges_against(b, b_side, a);
  const bool is_one_plane = a_side[0] == 0 && a_side[1] == 0 && a_side[2] == 0;
  if (strength == 1 && is_one_plane && overlap_in_plane(a, b, projection_axis(*a[0], *a[1], *a[2]))) strength = 2;
  return as_meeting(strength);
}

/// In one plane with a common apex [0]: the triangle lies beyond the line of one ray of the wedge, or has an edge on
/// that line which leads away from the ray. This settles almost all neighbours on the flat sides of a box.
bool is_beyond_a_ray(const Corners& wedge, int turn, const Corners& t, int axis) {
  const Vec3& apex = *wedge[0];
  const auto beyond = [&](const Vec3& end, int way, const Vec3& p) {
    const int side = way * orientation_2d(apex, end, p, axis);
    return side < 0 || (side == 0 && lexicographically_less(p, apex) != lexicographically_less(end, apex));
  };
  return (beyond(*wedge[1], turn, *t[1]) && beyond(*wedge[1], turn, *t[2])) ||
         (beyond(*wedge[2], -turn, *t[1]) && beyond(*wedge[2], -turn, *t[2]));
}

/// a[0] and b[0] are the shared vertex. Whatever else is shared reaches an opposite edge, because both are convex.
PairMeeting meeting_at_vertex(const Corners& a, const Corners& b) {
  const int a1 = orientation_3d(*b[0], *b[1], *b[2], *a[1]), a2 = orientation_3d(*b[0], *b[1], *b[2], *a[2]);
  if (a1 * a2 > 0) return PairMeeting::proper;
  const int b1 = orientation_3d(*a[0], *a[1], *a[2], *b[1]), b2 = orientation_3d(*a[0], *a[1], *a[2], *b[2]);
  if (b1 * b2 > 0) return PairMeeting::proper;
  const int a_axis = projection_axis(*a[0], *a[1], *a[2]);
  if (a1 == 0 && a2 == 0) {  // one plane: two wedges at one point; an opposite edge inside the other means overlap
    const int turn_a = orientation_2d(*a[0], *a[1], *a[2], a_axis), turn_b = orientation_2d(*b[0], *b[1], *b[2], a_axis);
    if (is_beyond_a_ray(a, turn_a, b, a_axis) || is_beyond_a_ray(b, turn_b, a, a_axis)) return PairMeeting::proper;
    const int strength = std::max(segment_in_plane(b, *a[1], *a[2], a_axis), segment_in_plane(a, *b[1], *b[2], a_axis));
    if (strength == 0) return PairMeeting::proper;
    // Wedges that only share a ray touch; any more is an overlap with area.
    return overlap_in_plane(a, b, a_axis) ? PairMeeting::crossing : PairMeeting::touching;
  }
  const int b_axis = projection_axis(*b[0], *b[1], *b[2]);
  return as_meeting(std::max(segment_through(b, *a[1], *a[2], a1, a2, b_axis),
                             b1 == 0 && b2 == 0 ? 0 : segment_through(a, *b[1], *b[2], b1, b2, a_axis)));
}

}  // namespace

PairMeeting meeting_of(const std::vector<Vec3>& points, const Triangle& first, const Triangle& second) {
  int shared = 0;
  std::array<int, 3> in_first{}, in_second{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (first[i] == second[j]) {
        in_first[shared] = i;
        in_second[shared] = j;
        if (++shared == 3) return PairMeeting::crossing;
      }
  const Corners a = corners_of(points, first), b = corners_of(points, second);
  if (shared == 0) return meeting_of_disjoint(a, b);
  if (shared == 1) {
    const int i = in_first[0], j = in_second[0];
    return meeting_at_vertex({a[i], a[(i + 1) % 3], a[(i + 2) % 3]}, {b[j], b[(j + 1) % 3], b[(j + 2) % 3]});
  }
  // A shared edge: they overlap only when folded flat onto each other.
  const Vec3 &u = *a[in_first[0]], &v = *a[in_first[1]];
  const Vec3 &x = *a[3 - in_first[0] - in_first[1]], &y = *b[3 - in_second[0] - in_second[1]];
  if (orientation_3d(u, v, x, y) != 0) return PairMeeting::proper;
  const int axis = projection_axis(u, v, x);
  return orientation_2d(u, v, x, axis) == orientation_2d(u, v, y, axis) ? PairMeeting::crossing : PairMeeting::proper;
}

}  // namespace strataflow
