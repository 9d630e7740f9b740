#include "kernels/cutting/repair_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/id.h"
#include "kernels/cutting/rounded_position.h"
#include "kernels/topology/building/weld_points.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

double squared_length(const Vec3& v) { return dot(v, v); }

/// Nearest point to p on the segment ab, and how far along it is (0 … 1).
struct OnSegment {
  Vec3 point;
  double share;
};
OnSegment nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double l = squared_length(d);
  const double share = l > 0 ? std::clamp(dot(p - a, d) / l, 0.0, 1.0) : 0.0;
  return {a + share * d, share};
}

/// p seen along the normal falls strictly inside the triangle; its distance to the plane, else infinity.
double height_over(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a);
  const double n = length(normal);
  if (!(n > 0)) return INFINITY;
  const double u = dot(cross(b - a, p - a), normal), v = dot(cross(c - b, p - b), normal),
               w = dot(cross(a - c, p - c), normal);
  if (!(u > 0 && v > 0 && w > 0)) return INFINITY;
  return std::abs(dot(p - a, normal)) / n;
}

class Repairer {
 public:
  Repairer(CutMesh& mesh, double reach, const Vec3& origin)
      : mesh_(mesh), reach_(reach), origin_(origin), becomes_(mesh.points.size()) {
    std::iota(becomes_.begin(), becomes_.end(), 0u);
    std::vector<std::uint32_t> count(mesh.points.size() + 1, 0);
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) ++count[v + 1];
    std::partial_sum(count.begin(), count.end(), count.begin());
    first_ = count;
    at_.resize(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) at_[count[v]++] = t;
    is_alive_.assign(mesh.triangles.size(), 1);
  }

  RoundingRepair run(std::vector<IntersectingPair> pairs) {
    sort_by_position(pairs);
    using Step = void (Repairer::*)(std::uint32_t, std::uint32_t);
    for (const Step step : {&Repairer::merge_vertices, &Repairer::put_vertices_on_edges, &Repairer::put_vertices_in,
                            &Repairer::join_edges}) {
      for (const IntersectingPair& pair : pairs) {
        (this->*step)(pair.first, pair.second);
        (this->*step)(pair.second, pair.first);
      }
      if (repair_.did_anything()) break;
    }
    finish();
    return repair_;
  }

 private:
  const Vec3& at(std::uint32_t v) const { return mesh_.points[v]; }

  bool before(std::uint32_t a, std::uint32_t b) const {
    return at(a) == at(b) ? a < b : lexicographically_less(at(a), at(b));
  }
  /// Corners by position.
  Triangle corners_of(std::uint32_t t) const {
    Triangle v = mesh_.triangles[t];
    std::sort(v.begin(), v.end(), [&](std::uint32_t a, std::uint32_t b) { return before(a, b); });
    return v;
  }
  bool before(const Triangle& a, const Triangle& b) const {
    for (int k = 0; k < 3; ++k)
      if (a[k] != b[k] && !(at(a[k]) == at(b[k]))) return before(a[k], b[k]);
    return false;
  }
  void sort_by_position(std::vector<IntersectingPair>& pairs) const {
    for (IntersectingPair& p : pairs)
      if (before(corners_of(p.second), corners_of(p.first))) std::swap(p.first, p.second);
    std::sort(pairs.begin(), pairs.end(), [&](const IntersectingPair& a, const IntersectingPair& b) {
      const Triangle a1 = corners_of(a.first), b1 = corners_of(b.first);
      if (before(a1, b1)) return true;
      if (before(b1, a1)) return false;
      const Triangle a2 = corners_of(a.second), b2 = corners_of(b.second);
      if (before(a2, b2)) return true;
      if (before(b2, a2)) return false;
      return a.first != b.first ? a.first < b.first : a.second < b.second;
    });
  }
  /// Which of two points stays when they become one: an input point, then the lexicographically smaller.
  bool stays(std::uint32_t v, std::uint32_t w) const {
    const bool v_is_input = v < mesh_.input_point_count, w_is_input = w < mesh_.input_point_count;
    return v_is_input != w_is_input ? v_is_input : before(v, w);
  }
  bool has(std::uint32_t t, std::uint32_t v) const {
    const Triangle& c = mesh_.triangles[t];
    return c[0] == v || c[1] == v || c[2] == v;
  }
  std::uint32_t final_of(std::uint32_t v) const {
    while (becomes_[v] != v) v = becomes_[v];
    return v;
  }
  void moved(double distance) { repair_.largest_move_m = std::max(repair_.largest_move_m, distance); }

  void merge_vertices(std::uint32_t t, std::uint32_t u) {
    for (const std::uint32_t corner : corners_of(t))
      for (const std::uint32_t other : corners_of(u)) {
        const std::uint32_t v = final_of(corner), w = final_of(other);
        if (v == w) continue;
        const double distance = length(at(v) - at(w));
        if (distance > reach_) continue;
        if (stays(v, w))
          becomes_[w] = v;
        else
          becomes_[v] = w;
        ++repair_.merged_points;
        moved(distance);
      }
  }

  /// Triangles with both vertices, those made since included.
  std::vector<std::uint32_t> around(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> found;
    if (a + 1 < first_.size())
      for (std::uint32_t i = first_[a]; i < first_[a + 1]; ++i)
        if (is_alive_[at_[i]] && has(at_[i], a) && has(at_[i], b)) found.push_back(at_[i]);
    for (const std::uint32_t t : made_)
      if (is_alive_[t] && has(t, a) && has(t, b)) found.push_back(t);
    return sorted_unique(std::move(found));
  }

  void replace(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t& v : mesh_.triangles[t])
      if (v == from) v = to;
    mesh_.is_changed[t] = 1;
    made_.push_back(t);  // it has a vertex now that first_ does not know of
  }
  void add_copy(std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    mesh_.triangles.push_back(mesh_.triangles[t]);
    mesh_.origin.push_back(mesh_.origin[t]);
    mesh_.is_changed.push_back(1);
    is_alive_.push_back(1);
    replace(static_cast<std::uint32_t>(mesh_.triangles.size() - 1), from, to);
  }

  void split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t v) {
    for (const std::uint32_t t : around(a, b)) {
      if (has(t, v)) {  // it lies between the edge and the vertex: flat now
        is_alive_[t] = 0;
        continue;
      }
      add_copy(t, a, v);
      replace(t, b, v);
    }
    ++repair_.split_edges;
  }

  void put_vertices_on_edges(std::uint32_t t, std::uint32_t u) {
    if (!is_alive_[t] || !is_alive_[u]) return;
    const Triangle corners = corners_of(t), other = corners_of(u);
    for (const std::uint32_t v : corners) {
      if (has(u, v)) continue;
      // Of a sliver's edges the longest: a shorter one would be flipped to and fro round by round.
      int best = 3;
      double longest = 0, distance = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3 &a = at(other[k]), &b = at(other[(k + 1) % 3]);
        const OnSegment nearest = nearest_on_segment(at(v), a, b);
        const double away = length(nearest.point - at(v));
        if (away > reach_ || !(nearest.share > 0 && nearest.share < 1) || !(length(b - a) > longest)) continue;
        best = k;
        longest = length(b - a);
        distance = away;
      }
      if (best == 3) continue;
      split_edge(other[best], other[(best + 1) % 3], v);
      moved(distance);
      return;  // u is another triangle now
    }
  }

  void put_vertices_in(std::uint32_t t, std::uint32_t u) {
    if (!is_alive_[t] || !is_alive_[u]) return;
    for (const std::uint32_t v : corners_of(t)) {
      if (has(u, v)) continue;
      const Triangle other = corners_of(u);
      const double distance = height_over(at(v), at(other[0]), at(other[1]), at(other[2]));
      if (!(distance <= reach_)) continue;
      add_copy(u, other[0], v);
      add_copy(u, other[1], v);
      replace(u, other[2], v);
      ++repair_.split_triangles;
      moved(distance);
      return;
    }
  }

  /// Edges that pass each other in reach, away from their ends.
  void join_edges(std::uint32_t t, std::uint32_t u) {
    if (!is_alive_[t] || !is_alive_[u] || before(corners_of(u), corners_of(t))) return;
    const Triangle first = corners_of(t), second = corners_of(u);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const std::uint32_t a = first[i], b = first[(i + 1) % 3], c = second[j], d = second[(j + 1) % 3];
        if (a == c || a == d || b == c || b == d) continue;
        const Vec3 along = at(b) - at(a), across = at(d) - at(c), between = at(c) - at(a);
        const Vec3 normal = cross(along, across);
        const double n = squared_length(normal);
        if (!(n > 0)) continue;
        const double s = dot(cross(between, across), normal) / n, r = dot(cross(between, along), normal) / n;
        if (!(s > 0 && s < 1 && r > 0 && r < 1)) continue;
        const Vec3 on_first = at(a) + s * along, on_second = at(c) + r * across;
        const double distance = length(on_first - on_second);
        if (distance > reach_) continue;
        const Vec3 middle = 0.5 * (on_first + on_second);
        const auto v = static_cast<std::uint32_t>(mesh_.points.size());
        mesh_.points.push_back(snapped_to_file(middle, origin_));
        becomes_.push_back(v);
        split_edge(a, b, v);
        split_edge(c, d, v);
        moved(distance);
        return;
      }
  }

  void finish() {
    if (mesh_.points.size() + 1 > first_.size()) {  // a new point may lie where another is
      const WeldedPoints welded = weld_points(mesh_.points);
      for (std::uint32_t v = 0; v < becomes_.size(); ++v)
        if (becomes_[v] == v) becomes_[v] = welded.source[welded.id[v]];
    }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!is_alive_[t]) continue;
      Triangle& v = mesh_.triangles[t];
      if (repair_.did_anything())
        for (std::uint32_t& corner : v) {
          const std::uint32_t to = final_of(corner);
          if (to != corner) mesh_.is_changed[t] = 1;
          corner = to;
        }
      is_alive_[t] = v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
    }
    mesh_.keep(is_alive_);
  }

  CutMesh& mesh_;
  double reach_;
  Vec3 origin_;
  std::vector<std::uint32_t> becomes_;
  std::vector<std::uint32_t> first_, at_;  ///< per vertex its triangles, before the repair
  std::vector<std::uint32_t> made_;        ///< triangles with a vertex they did not have before
  std::vector<char> is_alive_;
  RoundingRepair repair_;
};

}  // namespace

void CutMesh::keep(const std::vector<char>& is_kept) {
  std::size_t next = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!is_kept[t]) continue;
    triangles[next] = triangles[t];
    origin[next] = origin[t];
    is_changed[next++] = is_changed[t];
  }
  triangles.resize(next);
  origin.resize(next);
  is_changed.resize(next);
}

RoundingRepair repair_rounding(CutMesh& mesh, const std::vector<IntersectingPair>& pairs, double reach_m,
                               const Vec3& origin) {
  return Repairer(mesh, reach_m, origin).run(pairs);
}

}  // namespace strataflow
