#include "kernels/cutting/exact_reference.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include "model/box3.h"

namespace strataflow::support {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Solid = Kernel::Triangle_3;

Point exact(const Vec3& p) { return {p.x, p.y, p.z}; }
Solid exact(const Corners& t) { return {exact(t[0]), exact(t[1]), exact(t[2])}; }

/// The nearest double, ties to even, by comparing exact distances.
double nearest(const Kernel::FT& value) {
  const auto q = CGAL::exact(value);
  using Rational = std::decay_t<decltype(q)>;
  double best = CGAL::to_double(q);
  const auto distance = [&](double d) { return Rational(CGAL::abs(Rational(d) - q)); };
  for (bool moved = true; moved;) {
    moved = false;
    for (const double other : {std::nextafter(best, -INFINITY), std::nextafter(best, INFINITY)}) {
      const int order = static_cast<int>(CGAL::compare(distance(other), distance(best)));
      if (order < 0 || (order == 0 && (std::bit_cast<std::uint64_t>(other) & 1) == 0)) {
        best = other;
        moved = true;
        break;
      }
    }
  }
  return best + 0.0;
}

Vec3 nearest(const Point& p) { return {nearest(p.x()), nearest(p.y()), nearest(p.z())}; }

/// Corners of the convex set two triangles share, in order around it.
std::vector<Point> shared_corners(const Solid& a, const Solid& b) {
  const auto shared = CGAL::intersection(a, b);
  if (!shared) return {};
  if (const auto* point = boost::get<Point>(&*shared)) return {*point};
  if (const auto* segment = boost::get<Segment>(&*shared)) return {segment->source(), segment->target()};
  if (const auto* triangle = boost::get<Solid>(&*shared)) return {(*triangle)[0], (*triangle)[1], (*triangle)[2]};
  return boost::get<std::vector<Point>>(*shared);
}

std::vector<Segment> outline(const std::vector<Point>& corners) {
  std::vector<Segment> edges;
  if (corners.size() == 2) edges.emplace_back(corners[0], corners[1]);
  if (corners.size() > 2)
    for (std::size_t i = 0; i < corners.size(); ++i) edges.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
  return edges;
}

int dimension_of(const std::vector<Point>& corners) { return std::min<int>(static_cast<int>(corners.size()), 3) - 1; }

bool less(const Vec3& a, const Vec3& b) { return lexicographically_less(a, b); }

}  // namespace

SharedSet shared_set(const Corners& a, const Corners& b) {
  const std::vector<Point> corners = shared_corners(exact(a), exact(b));
  SharedSet set{dimension_of(corners), {}};
  for (const Point& p : corners) set.corners.push_back(nearest(p));
  std::sort(set.corners.begin(), set.corners.end(), less);
  return set;
}

namespace {

using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;

/// All of b on one side of the plane of a, or of the line of an edge when they share the plane, and of b only corners
/// of a on it: then they share these at most.
bool is_parted_from(const Corners& a, const Corners& b) {
  const auto parts = [&](auto&& side_of) {
    int lowest = 1, highest = -1;
    bool is_shared = true;
    for (const Vec3& p : b) {
      const int side = side_of(p);
      lowest = std::min(lowest, side);
      highest = std::max(highest, side);
      is_shared = is_shared && (side != 0 || std::find(a.begin(), a.end(), p) != a.end());
    }
    return std::array{lowest, highest, is_shared ? 1 : 0};
  };
  const auto in_space = [](const Vec3& p) { return Predicates::Point_3(p.x, p.y, p.z); };
  const auto [lowest, highest, is_shared] = parts([&](const Vec3& p) {
    return static_cast<int>(CGAL::orientation(in_space(a[0]), in_space(a[1]), in_space(a[2]), in_space(p)));
  });
  if (lowest != 0 || highest != 0) return is_shared && lowest * highest >= 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto in_view = [axis](const Vec3& p) { return Predicates::Point_2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
    const auto turn = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
      return static_cast<int>(CGAL::orientation(in_view(p), in_view(q), in_view(r)));
    };
    const int way = turn(a[0], a[1], a[2]);
    if (way == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const auto beyond = parts([&](const Vec3& p) { return way * turn(a[k], a[(k + 1) % 3], p); });
      if (beyond[1] <= 0 && beyond[2]) return true;
    }
    return false;
  }
  return false;
}

}  // namespace

bool meet_improperly(const Corners& a, const Corners& b) {
  if (is_parted_from(a, b) || is_parted_from(b, a)) return false;
  const std::vector<Point> corners = shared_corners(exact(a), exact(b));
  if (corners.size() > 2) return true;
  for (const Point& p : corners) {
    const auto is_corner_of = [&](const Corners& t) {
      return std::any_of(t.begin(), t.end(), [&](const Vec3& v) { return exact(v) == p; });
    };
    if (!is_corner_of(a) || !is_corner_of(b)) return true;
  }
  return false;
}

std::size_t improper_pairs(const std::vector<Vec3>& points, const std::vector<Triangle>& given) {
  std::vector<Triangle> triangles;
  const auto by_place = [](const Corners& a, const Corners& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  };
  std::set<Corners, decltype(by_place)> places(by_place);
  for (const Triangle& t : given) {
    Corners place{points[t[0]], points[t[1]], points[t[2]]};
    std::sort(place.begin(), place.end(), less);
    if (places.insert(place).second) triangles.push_back(t);
  }
  std::vector<Box3> boxes(triangles.size());
  std::vector<std::uint32_t> order(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) boxes[t].take(points[v]);
    order[t] = t;
  }
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return boxes[a].low.x < boxes[b].low.x; });
  const auto corners = [&](std::uint32_t t) {
    return Corners{points[triangles[t][0]], points[triangles[t][1]], points[triangles[t][2]]};
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Box3 &a = boxes[order[i]], &b = boxes[order[j]];
      if (b.low.x > a.high.x) break;
      if (a.low.y > b.high.y || b.low.y > a.high.y || a.low.z > b.high.z || b.low.z > a.high.z) continue;
      count += meet_improperly(corners(order[i]), corners(order[j]));
    }
  return count;
}

std::string flaw_of_cut(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                        const TriangleCut& cut) {
  const auto corners = [&](const Triangle& t) { return Corners{points[t[0]], points[t[1]], points[t[2]]}; };
  const std::size_t count = triangles.size();
  std::vector<Solid> solids;
  for (const Triangle& t : triangles) solids.push_back(exact(corners(t)));

  // The arrangement: corners of what pairs share, and where the outlines of that cross in a third triangle.
  std::set<Point> places;
  for (const Vec3& p : points) places.insert(exact(p));
  std::vector<std::vector<std::vector<Point>>> shared(count, std::vector<std::vector<Point>>(count));
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      shared[i][j] = shared[j][i] = shared_corners(solids[i], solids[j]);
      places.insert(shared[i][j].begin(), shared[i][j].end());
    }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k) {
        if (i == j || i == k) continue;
        for (const Segment& a : outline(shared[i][j]))
          for (const Segment& b : outline(shared[i][k]))
            if (const auto crossing = CGAL::intersection(a, b))
              if (const auto* p = boost::get<Point>(&*crossing)) places.insert(*p);
      }
  std::map<Vec3, Point, bool (*)(const Vec3&, const Vec3&)> place_at(less);
  for (const Point& p : places)
    if (!place_at.emplace(nearest(p), p).second) return "two places round to one: the test cannot tell them apart";
  if (cut.points.size() != places.size())
    return std::to_string(cut.points.size()) + " points instead of " + std::to_string(places.size());
  std::vector<Point> place_of;
  for (const Vec3& p : cut.points) {
    const auto found = place_at.find(p);
    if (found == place_at.end()) return "a point that the exact arrangement does not have";
    place_of.push_back(found->second);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!(cut.points[i] == points[i])) return "an input point moved or lost its index";
  int runs = 1;  // points that pairs share, then those where segments cross
  for (std::size_t i = points.size() + 1; i < cut.points.size(); ++i) runs += !less(cut.points[i - 1], cut.points[i]);
  if (runs > 2) return "new points are not in lexicographic order";

  // Pieces fill their triangles.
  const auto turn = [&](const Point& a, const Point& b, const Point& c, int axis) {
    const int s = axis == 0 ? 1 : 0, t = axis == 2 ? 1 : 2;
    return Kernel::FT((b[s] - a[s]) * (c[t] - a[t]) - (b[t] - a[t]) * (c[s] - a[s]));
  };
  std::vector<Kernel::FT> filled(count, 0);
  std::vector<std::set<Triangle>> pieces(count);
  std::vector<std::set<std::array<std::uint32_t, 2>>> edges(count);
  std::vector<int> axis(count, 0), way(count, 0);
  for (std::size_t t = 0; t < count; ++t)
    while ((way[t] = static_cast<int>(CGAL::sign(turn(solids[t][0], solids[t][1], solids[t][2], axis[t])))) == 0)
      ++axis[t];
  for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
    const Triangle& piece = cut.triangles[i];
    const std::uint32_t t = cut.source[i];
    const Solid& solid = solids[t];
    for (const std::uint32_t v : piece) {
      if (CGAL::orientation(solid[0], solid[1], solid[2], place_of[v]) != CGAL::COPLANAR)
        return "a piece leaves its plane";
      for (int k = 0; k < 3; ++k)
        if (static_cast<int>(CGAL::sign(turn(solid[k], solid[(k + 1) % 3], place_of[v], axis[t]))) == -way[t])
          return "a piece leaves its triangle";
    }
    const Kernel::FT area = turn(place_of[piece[0]], place_of[piece[1]], place_of[piece[2]], axis[t]);
    if (static_cast<int>(CGAL::sign(area)) != way[t]) return "a piece is flat or turned over";
    filled[t] += area;
    Triangle sorted = piece;
    std::sort(sorted.begin(), sorted.end());
    if (!pieces[t].insert(sorted).second) return "a piece comes twice";
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = piece[k], b = piece[(k + 1) % 3];
      edges[t].insert({std::min(a, b), std::max(a, b)});
    }
  }
  for (std::size_t t = 0; t < count; ++t)
    if (filled[t] != turn(solids[t][0], solids[t][1], solids[t][2], axis[t]))
      return "pieces do not fill their triangle";

  // What is shared is made of the same edges and pieces in both.
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      for (const Segment& segment : outline(shared[i][j])) {
        std::vector<std::uint32_t> on;
        for (std::uint32_t v = 0; v < place_of.size(); ++v)
          if (segment.has_on(place_of[v])) on.push_back(v);
        std::sort(on.begin(), on.end(), [&](std::uint32_t a, std::uint32_t b) { return place_of[a] < place_of[b]; });
        for (std::size_t k = 0; k + 1 < on.size(); ++k) {
          const std::array<std::uint32_t, 2> edge{std::min(on[k], on[k + 1]), std::max(on[k], on[k + 1])};
          if (!edges[i].count(edge) || !edges[j].count(edge)) return "a shared segment is no edge of both";
        }
      }
      if (shared[i][j].size() > 2) {
        const auto inside = [&](std::size_t own, std::size_t other) {
          std::set<Triangle> found;
          for (const Triangle& piece : pieces[own]) {
            const Point middle = CGAL::centroid(place_of[piece[0]], place_of[piece[1]], place_of[piece[2]]);
            bool is_in = true;
            for (int k = 0; k < 3; ++k)
              is_in = is_in && static_cast<int>(CGAL::sign(turn(solids[other][k], solids[other][(k + 1) % 3], middle,
                                                                axis[other]))) == way[other];
            if (is_in) found.insert(piece);
          }
          return found;
        };
        if (inside(i, j) != inside(j, i)) return "an overlap is not made of the same pieces";
      }
    }
  return {};
}

}  // namespace strataflow::support
