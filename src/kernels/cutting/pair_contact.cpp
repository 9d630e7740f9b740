#include "kernels/cutting/pair_contact.h"

#include "base/id.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

constexpr PlaceInTriangle on_edge(int k) { return static_cast<PlaceInTriangle>(3 + k); }

int next(int k) { return k == 2 ? 0 : k + 1; }

/// Place of a vertex that lies in the triangle's plane.
PlaceInTriangle place_of_vertex(const std::vector<Vec3>& points, const Triangle& t, std::uint32_t v, int axis) {
  for (int k = 0; k < 3; ++k)
    if (t[k] == v) return static_cast<PlaceInTriangle>(k);
  const int turn = orientation_2d(points[t[0]], points[t[1]], points[t[2]], axis);
  PlaceInTriangle place = place_inside;
  for (int k = 0; k < 3; ++k) {
    const int side = turn * orientation_2d(points[t[k]], points[t[next(k)]], points[v], axis);
    if (side < 0) return place_outside;
    if (side == 0) place = on_edge(k);  // two zeros would be a corner, which has the vertex's own index
  }
  return place;
}

/// Where an edge whose ends lie strictly on both sides of a triangle's plane pierces the triangle.
PlaceInTriangle place_of_piercing(const std::vector<Vec3>& points, const Triangle& t, std::uint32_t p,
                                  std::uint32_t q) {
  int lowest = 1, highest = -1, zeros = 0, zero_edge = 0, first_zero = -1;
  for (int k = 0; k < 3; ++k) {
    const int side = orientation_3d(points[p], points[q], points[t[k]], points[t[next(k)]]);
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
    if (lowest < 0 && highest > 0) return place_outside;
    if (side == 0) {
      if (zeros++ == 0) first_zero = k;
      zero_edge = k;
    }
  }
  if (zeros == 0) return place_inside;
  if (zeros == 1) return on_edge(zero_edge);
  return static_cast<PlaceInTriangle>(first_zero == 0 && zero_edge == 2 ? 0 : zero_edge);  // where both edges end
}

class ContactBuilder {
 public:
  ContactBuilder(const std::vector<Vec3>& points, const Triangle& first, const Triangle& second)
      : points_(points), triangle_{first, second} {}

  PairContact build() {
    for (int s = 0; s < 2; ++s) {
      const Triangle &plane = triangle_[1 - s], &t = triangle_[s];
      for (int k = 0; k < 3; ++k) {
        side_[s][k] = plane[0] == t[k] || plane[1] == t[k] || plane[2] == t[k]
                          ? 0
                          : orientation_3d(points_[plane[0]], points_[plane[1]], points_[plane[2]], points_[t[k]]);
      }
      if (side_[s][0] == side_[s][1] && side_[s][1] == side_[s][2] && side_[s][0] != 0) return std::move(contact_);
      axis_[s] = projection_axis(points_[t[0]], points_[t[1]], points_[t[2]]);
    }
    contact_.is_coplanar = side_[0][0] == 0 && side_[0][1] == 0 && side_[0][2] == 0;
    if (contact_.is_coplanar)
      build_overlap();
    else
      build_crossing();
    return std::move(contact_);
  }

 private:
  std::uint8_t add(const PointDefinition& definition, PlaceInTriangle in_first, PlaceInTriangle in_second) {
    for (std::size_t i = 0; i < contact_.points.size(); ++i)
      if (contact_.points[i].definition == definition) return static_cast<std::uint8_t>(i);
    contact_.points.push_back({definition, in_first, in_second});
    return static_cast<std::uint8_t>(contact_.points.size() - 1);
  }
  /// The same with places named by which triangle is `own`.
  std::uint8_t add_by(int own, const PointDefinition& definition, PlaceInTriangle in_own, PlaceInTriangle in_other) {
    return own == 0 ? add(definition, in_own, in_other) : add(definition, in_other, in_own);
  }

  bool runs_along_an_edge(int s, const PairContact::Segment& segment) const {
    const auto place = [&](std::uint8_t i) {
      return s == 0 ? contact_.points[i].in_first : contact_.points[i].in_second;
    };
    return (edges_at(place(segment.from)) & edges_at(place(segment.to))) != 0;
  }

  void build_crossing() {
    for (int own = 0; own < 2; ++own) {
      const Triangle &t = triangle_[own], &other = triangle_[1 - own];
      for (int k = 0; k < 3; ++k)
        if (side_[own][k] == 0) {
          const PlaceInTriangle place = place_of_vertex(points_, other, t[k], axis_[1 - own]);
          if (place != place_outside) add_by(own, vertex_point(t[k]), static_cast<PlaceInTriangle>(k), place);
        }
    }
    for (int own = 0; own < 2; ++own) {
      const Triangle &t = triangle_[own], &other = triangle_[1 - own];
      for (int k = 0; k < 3; ++k) {
        if (side_[own][k] * side_[own][next(k)] >= 0) continue;
        const PlaceInTriangle place = place_of_piercing(points_, other, t[k], t[next(k)]);
        if (place == place_outside || place < 3) continue;  // a corner is that vertex, already found
        if (own == 1 && place < place_inside) {
          const int m = place - 3;  // two edges cross: found from the first triangle's edge unless it lies in the plane
          if (side_[0][m] * side_[0][next(m)] < 0) continue;
        }
        add_by(own, edge_and_plane_point({t[k], t[next(k)]}, other), on_edge(k), place);
      }
    }
    if (contact_.points.size() != 2) return;
    const PairContact::Segment segment{0, 1, {no_index, no_index}};
    if (!runs_along_an_edge(0, segment)) contact_.in_first.push_back(segment);
    if (!runs_along_an_edge(1, segment)) contact_.in_second.push_back(segment);
  }

  /// Clips the edges of `own` by the other triangle, in their common plane.
  void clip_edges(int own) {
    const Triangle &t = triangle_[own], &other = triangle_[1 - own];
    const int axis = axis_[1 - own];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t r = t[k], s = t[next(k)];
      std::uint8_t ends[8];
      int count = 0;
      const auto take = [&](std::uint8_t point) {
        for (int i = 0; i < count; ++i)
          if (ends[i] == point) return;
        ends[count++] = point;
      };
      for (const int corner : {k, next(k)}) {
        const PlaceInTriangle place = place_of_vertex(points_, other, t[corner], axis);
        if (place != place_outside)
          take(add_by(own, vertex_point(t[corner]), static_cast<PlaceInTriangle>(corner), place));
      }
      int side[3];  // of the other's corners with respect to this edge
      for (int m = 0; m < 3; ++m)
        side[m] = other[m] == r || other[m] == s ? 0 : orientation_2d(points_[r], points_[s], points_[other[m]], axis);
      for (int m = 0; m < 3; ++m) {
        if (side[m] == 0 && other[m] != r && other[m] != s && is_between(points_[r], points_[s], points_[other[m]]))
          take(add_by(own, vertex_point(other[m]), on_edge(k), static_cast<PlaceInTriangle>(m)));
        if (side[m] * side[next(m)] >= 0) continue;
        const int from = orientation_2d(points_[other[m]], points_[other[next(m)]], points_[r], axis);
        const int to = orientation_2d(points_[other[m]], points_[other[next(m)]], points_[s], axis);
        if (from * to < 0)
          take(add_by(own, two_edges_point({r, s}, {other[m], other[next(m)]}, axis), on_edge(k), on_edge(m)));
      }
      if (count != 2) continue;
      const PairContact::Segment segment{ends[0], ends[1], {r, s}};
      if (!runs_along_an_edge(1 - own, segment)) (own == 0 ? contact_.in_second : contact_.in_first).push_back(segment);
    }
  }

  /// p, known to be on the line rs, lies strictly between its ends.
  static bool is_between(const Vec3& r, const Vec3& s, const Vec3& p) {
    const bool ascending = lexicographically_less(r, s);
    return ascending ? lexicographically_less(r, p) && lexicographically_less(p, s)
                     : lexicographically_less(s, p) && lexicographically_less(p, r);
  }

  void build_overlap() {
    axis_[1] = axis_[0];  // one plane, one view: a crossing has one definition from either side
    clip_edges(0);
    clip_edges(1);
  }

  const std::vector<Vec3>& points_;
  std::array<Triangle, 2> triangle_;
  std::array<std::array<int, 3>, 2> side_{};
  std::array<int, 2> axis_{};
  PairContact contact_;
};

}  // namespace

PairContact contact_of(const std::vector<Vec3>& points, const Triangle& first, const Triangle& second) {
  return ContactBuilder(points, first, second).build();
}

}  // namespace strataflow
