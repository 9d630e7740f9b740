#include "kernels/cutting/cut_triangle.h"

#include <algorithm>
#include <numeric>

namespace strataflow {

namespace {

/// Extent of a segment along u and v of the triangle's view, from rounded positions widened by a relative margin.
struct Extent {
  double low_u, high_u, low_v, high_v;
};

Extent extent_of(const PointsInTriangle& points, std::uint32_t a, std::uint32_t b) {
  Extent e{std::min(points.u(a), points.u(b)), std::max(points.u(a), points.u(b)), std::min(points.v(a), points.v(b)),
           std::max(points.v(a), points.v(b))};
  const double room = 4 * points.roundoff();  // both ends and what is held against them were rounded
  return {e.low_u - room, e.high_u + room, e.low_v - room, e.high_v + room};
}

}  // namespace

void TriangleCutter::load(const TriangleContents& contents) {
  // The corner that is first by position starts: where circles tie, the input's numbering must not decide.
  Triangle t = (*triangles_)[contents.triangle];
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return lexicographically_less(cut_points_->position(a), cut_points_->position(b));
  };
  const int first = static_cast<int>(std::min_element(t.begin(), t.end(), before) - t.begin());
  std::rotate(t.begin(), t.begin() + first, t.end());
  local_.restart(t);
  ids_.assign(t.begin(), t.end());
  inserted_.clear();
  for (const PointOnTriangle& p : contents.points) {
    if (p.place < 3) continue;
    if (!inserted_.empty() && inserted_.back().point == p.point) continue;  // put there by several triangles
    inserted_.push_back(p);
    if (p.place < place_inside) inserted_.back().place = static_cast<PlaceInTriangle>(3 + (p.place - first) % 3);
  }
  std::sort(inserted_.begin(), inserted_.end(), [&](const PointOnTriangle& a, const PointOnTriangle& b) {
    return cut_points_->before(a.point, b.point);
  });
  for (const PointOnTriangle& p : inserted_) {
    local_.add(cut_points_->definition(p.point), cut_points_->position(p.point), p.place);
    ids_.push_back(p.point);
  }
  sorted_ids_.clear();
  for (std::uint32_t i = 0; i < ids_.size(); ++i) sorted_ids_.push_back({ids_[i], i});
  std::sort(sorted_ids_.begin(), sorted_ids_.end());
}

std::uint32_t TriangleCutter::local_of(std::uint32_t point) const {
  const auto at = std::lower_bound(sorted_ids_.begin(), sorted_ids_.end(), std::array<std::uint32_t, 2>{point, 0});
  return at != sorted_ids_.end() && (*at)[0] == point ? (*at)[1] : no_index;
}

PointDefinition TriangleCutter::crossing_of(const SegmentOnTriangle& a, const SegmentOnTriangle& b) const {
  const Triangle& own = (*triangles_)[a.triangle];
  const bool a_is_edge = a.edge[0] != no_index, b_is_edge = b.edge[0] != no_index;
  if (a_is_edge && b_is_edge) return two_edges_point(a.edge, b.edge, local_.axis());
  if (a_is_edge) return edge_and_plane_point(a.edge, (*triangles_)[b.other]);
  if (b_is_edge) return edge_and_plane_point(b.edge, (*triangles_)[a.other]);
  return three_planes_point({own, (*triangles_)[a.other], (*triangles_)[b.other]});
}

std::vector<SegmentCrossing> TriangleCutter::find_crossings(const TriangleContents& contents) {
  std::vector<SegmentCrossing> crossings;
  if (contents.segments.size() < 2) return crossings;
  load(contents);
  const auto count = static_cast<std::uint32_t>(contents.segments.size());
  std::vector<std::array<std::uint32_t, 2>> ends(count);
  std::vector<Extent> extents(count);
  for (std::uint32_t s = 0; s < count; ++s) {
    ends[s] = {local_of(contents.segments[s].ends[0]), local_of(contents.segments[s].ends[1])};
    extents[s] = extent_of(local_, ends[s][0], ends[s][1]);
  }
  by_u_.resize(count);
  std::iota(by_u_.begin(), by_u_.end(), 0u);
  std::sort(by_u_.begin(), by_u_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return extents[a].low_u != extents[b].low_u ? extents[a].low_u < extents[b].low_u : a < b;
  });
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t j = i + 1; j < count; ++j) {
      const std::uint32_t s = std::min(by_u_[i], by_u_[j]), t = std::max(by_u_[i], by_u_[j]);
      const Extent &a = extents[by_u_[i]], &b = extents[by_u_[j]];
      if (b.low_u > a.high_u) break;
      if (b.low_v > a.high_v || a.low_v > b.high_v) continue;
      const auto [p, q] = ends[s];
      const auto [r, v] = ends[t];
      if (p == r || p == v || q == r || q == v) continue;
      const int r_side = local_.orientation(p, q, r);
      if (r_side == 0) continue;
      const int v_side = local_.orientation(p, q, v);
      if (r_side * v_side >= 0) continue;
      if (local_.orientation(r, v, p) * local_.orientation(r, v, q) >= 0) continue;
      crossings.push_back({crossing_of(contents.segments[s], contents.segments[t]), {s, t}});
    }
  return crossings;
}

bool TriangleCutter::triangulate(const TriangleContents& contents) {
  load(contents);
  // Segments become pieces between consecutive points on them.
  pieces_.clear();
  const std::uint32_t count = local_.count();
  if (!contents.segments.empty()) {
    by_u_.resize(count);
    std::iota(by_u_.begin(), by_u_.end(), 0u);
    std::sort(by_u_.begin(), by_u_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return local_.u(a) != local_.u(b) ? local_.u(a) < local_.u(b) : a < b;
    });
  }
  for (const SegmentOnTriangle& segment : contents.segments) {
    const std::uint32_t from = local_of(segment.ends[0]), to = local_of(segment.ends[1]);
    if (from == no_index || to == no_index) return false;
    const Extent extent = extent_of(local_, from, to);
    on_segment_.clear();
    auto at = std::lower_bound(by_u_.begin(), by_u_.end(), extent.low_u,
                               [&](std::uint32_t a, double u) { return local_.u(a) < u; });
    for (; at != by_u_.end() && local_.u(*at) <= extent.high_u; ++at) {
      const std::uint32_t p = *at;
      if (p == from || p == to || local_.v(p) < extent.low_v || local_.v(p) > extent.high_v) continue;
      if (local_.orientation(from, to, p) == 0 && local_.is_between(p, from, to)) on_segment_.push_back(p);
    }
    std::sort(on_segment_.begin(), on_segment_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return local_.precedes(a, b, from, to); });
    std::uint32_t start = from;
    for (const std::uint32_t p : on_segment_) {
      pieces_.push_back({std::min(start, p), std::max(start, p)});
      start = p;
    }
    pieces_.push_back({std::min(start, to), std::max(start, to)});
  }
  std::sort(pieces_.begin(), pieces_.end());
  pieces_.erase(std::unique(pieces_.begin(), pieces_.end()), pieces_.end());
  return triangulation_.build(local_, pieces_);
}

}  // namespace strataflow
