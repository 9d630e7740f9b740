#include "kernels/quads/plan/plan_graph.h"

#include <algorithm>
#include <map>

#include "base/id.h"
#include "kernels/adapters/cgal/constrained_delaunay.h"
#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

std::vector<std::vector<std::uint32_t>> PlanGraph::incident() const {
  std::vector<std::vector<std::uint32_t>> around(points.size());
  for (std::uint32_t s = 0; s < segments.size(); ++s)
    for (const std::uint32_t p : {segments[s].a, segments[s].b}) around[p].push_back(s);
  return around;
}

Result<PlanGraph> arrange_curves(PlanCurves plan) {
  PlanGraph graph;
  std::vector<PlaneSegment> ends;
  std::vector<std::uint32_t> curve_of;
  for (std::uint32_t c = 0; c < plan.curves.size(); ++c) {
    const PlanCurve& curve = plan.curves[c];
    const auto first = static_cast<std::uint32_t>(graph.points.size());
    const auto count = static_cast<std::uint32_t>(curve.points.size());
    graph.points.insert(graph.points.end(), curve.points.begin(), curve.points.end());
    for (std::uint32_t i = 0; i + (curve.is_closed ? 0 : 1) < count; ++i) {
      ends.push_back({first + i, first + (i + 1) % count});
      curve_of.push_back(c);
    }
  }
  std::vector<std::uint32_t> required;
  for (const Vec3& p : plan.points) {
    required.push_back(static_cast<std::uint32_t>(graph.points.size()));
    graph.points.push_back(p);
  }
  constexpr int pass_limit = 30;
  for (int pass = 0;; ++pass) {
    if (pass == pass_limit)
      return Failure{FailureCode::geometry_failed, "curves still cross after their crossings were rounded 30 times",
                     "give coordinates relative to a point near the curves"};
    SegmentArrangement arranged = arrange_segments(graph.points, ends);
    bool is_done = arranged.points.size() == graph.points.size();
    std::vector<PlaneSegment> pieces;
    std::vector<std::uint32_t> curve_of_piece;
    for (const SegmentArrangement::Piece& piece : arranged.pieces) {
      pieces.push_back({piece.a, piece.b});
      curve_of_piece.push_back(curve_of[piece.segment]);
    }
    for (std::uint32_t& p : required) p = arranged.place_of[p];
    is_done = is_done && pieces == ends;
    graph.points = std::move(arranged.points);
    ends = std::move(pieces);
    curve_of = std::move(curve_of_piece);
    if (is_done) break;
  }
  std::map<PlaneSegment, std::uint32_t> segment_at;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const PlanCurve& curve = plan.curves[curve_of[i]];
    const PlaneSegment key{std::min(ends[i][0], ends[i][1]), std::max(ends[i][0], ends[i][1])};
    const auto [place, is_new] = segment_at.try_emplace(key, static_cast<std::uint32_t>(graph.segments.size()));
    if (is_new) graph.segments.push_back({key[0], key[1], {}, curve.short_below_m, {}});
    PlanGraph::Segment& segment = graph.segments[place->second];
    segment.short_below_m = std::min(segment.short_below_m, curve.short_below_m);
    auto& features = segment.features;
    const auto where = std::lower_bound(features.begin(), features.end(), curve.feature);
    if (where == features.end() || *where != curve.feature) features.insert(where, curve.feature);
  }
  graph.is_required.assign(graph.points.size(), 0);
  for (const std::uint32_t p : required) graph.is_required[p] = 1;
  graph.stands_for.resize(graph.points.size());
  for (std::size_t p = 0; p < graph.points.size(); ++p) graph.stands_for[p].push_back(graph.points[p]);
  for (const auto& [from, to] : plan.moved)
    for (std::size_t p = 0; p < graph.points.size(); ++p)
      if (graph.points[p] == to) graph.stands_for[p].push_back(from);
  graph.features = std::move(plan.features);
  graph.changes = std::move(plan.changes);
  graph.edge_length_m = plan.edge_length_m;
  return graph;
}

namespace {

class EdgeContraction {
 public:
  EdgeContraction(PlanGraph& graph, double limit_m) : graph_(graph), limit_m_(limit_m), around_(graph.incident()) {
    is_alive_.assign(graph.segments.size(), 1);
    dropped_.assign(graph.features.size(), 0);
    moved_m_.assign(graph.features.size(), 0);
  }

  void run() {
    constexpr int pass_limit = 100;
    for (int pass = 0; pass < pass_limit && contract_once(); ++pass) {
    }
    tell();
    compact();
  }

 private:
  using Segment = PlanGraph::Segment;

  double length_m(const Segment& s) const { return length(graph_.points[s.a] - graph_.points[s.b]); }
  std::uint32_t other_end(std::uint32_t segment, std::uint32_t p) const {
    const Segment& s = graph_.segments[segment];
    return s.a == p ? s.b : s.a;
  }

  bool is_preserved(std::uint32_t p) const {
    return graph_.is_required[p] || around_[p].size() != 2 ||
           graph_.segments[around_[p][0]].features != graph_.segments[around_[p][1]].features;
  }

  bool contract_once() {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t s = 0; s < graph_.segments.size(); ++s)
      if (is_alive_[s]) {
        const double l = length_m(graph_.segments[s]);
        if (l < graph_.segments[s].short_below_m) order.emplace_back(l, s);
      }
    std::sort(order.begin(), order.end());
    bool any = false;
    for (const auto& [l, s] : order) {
      if (!is_alive_[s]) continue;
      const std::uint32_t a = graph_.segments[s].a, b = graph_.segments[s].b;
      const double at_a = is_preserved(a) ? 2 * limit_m_ : deviation_without(a);
      const double at_b = is_preserved(b) ? 2 * limit_m_ : deviation_without(b);
      const bool a_first = at_a != at_b ? at_a < at_b : a < b;
      const std::uint32_t first = a_first ? a : b, second = a_first ? b : a;
      if (std::min(at_a, at_b) <= limit_m_ && drop_point(first)) {
        any = true;
      } else if (std::max(at_a, at_b) <= limit_m_ && drop_point(second)) {
        any = true;
      } else if (is_preserved(a) && is_preserved(b) && l <= limit_m_ && (merge(a, b, s) || merge(b, a, s))) {
        any = true;
      }
    }
    return any;
  }

  /// How far the input gets from the curve when p, between two segments, is dropped.
  double deviation_without(std::uint32_t p) const {
    const std::uint32_t s = around_[p][0], t = around_[p][1];
    const Vec3 u = graph_.points[other_end(s, p)], w = graph_.points[other_end(t, p)];
    double most = 0;
    const auto look = [&](const std::vector<Vec3>& points) {
      for (const Vec3& x : points) most = std::max(most, distance_to_segment(x, u, w));
    };
    look(graph_.segments[s].trace);
    look(graph_.segments[t].trace);
    look(graph_.stands_for[p]);
    return most;
  }

  bool triangle_is_free(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p) {
      if (p == a || p == b || p == c || (around_[p].empty() && !graph_.is_required[p])) continue;
      if (closed_triangle_holds(graph_.points[a], graph_.points[b], graph_.points[c], graph_.points[p])) return false;
    }
    return true;
  }

  std::uint32_t segment_between(std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t s : around_[a])
      if (other_end(s, a) == b) return s;
    return no_index;
  }

  void unlink(std::uint32_t segment, std::uint32_t p) { std::erase(around_[p], segment); }
  void link(std::uint32_t segment, std::uint32_t p) {
    around_[p].insert(std::upper_bound(around_[p].begin(), around_[p].end(), segment), segment);
  }

  bool drop_point(std::uint32_t p) {
    const std::uint32_t s = around_[p][0], t = around_[p][1];
    const std::uint32_t u = other_end(s, p), w = other_end(t, p);
    if (segment_between(u, w) != no_index || !triangle_is_free(u, p, w)) return false;
    for (const std::uint32_t f : graph_.segments[s].features) {
      ++dropped_[f];
      moved_m_[f] = std::max(moved_m_[f], deviation_without(p));
    }
    Segment& kept = graph_.segments[s];
    const Segment& gone = graph_.segments[t];
    kept.trace.insert(kept.trace.end(), graph_.stands_for[p].begin(), graph_.stands_for[p].end());
    kept.trace.insert(kept.trace.end(), gone.trace.begin(), gone.trace.end());
    kept.a = std::min(u, w);
    kept.b = std::max(u, w);
    kept.short_below_m = std::min(kept.short_below_m, gone.short_below_m);
    is_alive_[t] = 0;
    around_[p].clear();
    unlink(t, w);
    link(s, w);
    return true;
  }

  /// Moves junction `from` onto `to`, along the segment between them.
  bool merge(std::uint32_t from, std::uint32_t to, std::uint32_t along) {
    if (graph_.is_required[from] && graph_.is_required[to]) return false;
    const Vec3 target = graph_.points[to];
    for (const Vec3& x : graph_.stands_for[from])
      if (length(x - target) > limit_m_) return false;
    for (const Vec3& x : graph_.segments[along].trace)
      if (length(x - target) > limit_m_) return false;
    const auto goes_on = [&](std::uint32_t f) {
      for (const std::uint32_t p : {from, to})
        for (const std::uint32_t s : around_[p])
          if (s != along &&
              std::binary_search(graph_.segments[s].features.begin(), graph_.segments[s].features.end(), f))
            return true;
      return false;
    };
    for (const std::uint32_t f : graph_.segments[along].features)
      if (!goes_on(f)) return false;
    for (const std::uint32_t s : around_[from]) {
      if (s == along) continue;
      const std::uint32_t x = other_end(s, from);
      if (!triangle_is_free(from, to, x)) return false;
      for (const Vec3& q : graph_.segments[s].trace)
        if (distance_to_segment(q, target, graph_.points[x]) > limit_m_) return false;
    }
    const double away = length(graph_.points[from] - target);
    std::string names;
    std::vector<std::uint32_t> met;
    for (const std::uint32_t p : {from, to})
      for (const std::uint32_t s : around_[p])
        for (const std::uint32_t f : graph_.segments[s].features)
          if (std::find(met.begin(), met.end(), f) == met.end()) met.push_back(f);
    for (const std::uint32_t f : met) {
      names += (names.empty() ? "" : ", ") + graph_.features[f].name;
      moved_m_[f] = std::max(moved_m_[f], away);
    }
    graph_.changes.push_back({"merged", "junctions of " + names + " at " + place_text(graph_.points[from]),
                              "they are " + short_number(away) + " m apart"});
    is_alive_[along] = 0;
    unlink(along, to);
    const std::vector<std::uint32_t> moving = around_[from];
    for (const std::uint32_t s : moving) {
      if (s == along) continue;
      const std::uint32_t x = other_end(s, from);
      Segment& segment = graph_.segments[s];
      const std::uint32_t twin = segment_between(to, x);
      if (twin != no_index) {  // the triangle from, to, x has become one segment
        Segment& other = graph_.segments[twin];
        std::vector<std::uint32_t> all;
        std::set_union(other.features.begin(), other.features.end(), segment.features.begin(), segment.features.end(),
                       std::back_inserter(all));
        other.features = all;
        other.trace.insert(other.trace.end(), segment.trace.begin(), segment.trace.end());
        is_alive_[s] = 0;
        unlink(s, x);
        continue;
      }
      segment.a = std::min(to, x);
      segment.b = std::max(to, x);
      link(s, to);
    }
    around_[from].clear();
    graph_.is_required[to] |= graph_.is_required[from];
    graph_.is_required[from] = 0;
    auto& taken = graph_.stands_for[to];
    taken.insert(taken.end(), graph_.stands_for[from].begin(), graph_.stands_for[from].end());
    return true;
  }

  void tell() {
    for (std::size_t f = 0; f < dropped_.size(); ++f)
      if (dropped_[f] > 0)
        graph_.changes.push_back({"contracted",
                                  graph_.features[f].name + ": " + std::to_string(dropped_[f]) + " points",
                                  "their edges are shorter than " + short_number(graph_.edge_length_m) +
                                      " m; nothing moved by more than " + short_number(moved_m_[f]) + " m"});
  }

  void compact() {
    std::vector<std::uint32_t> number(graph_.points.size(), no_index);
    PlanGraph small;
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p) {
      if (around_[p].empty() && !graph_.is_required[p]) continue;
      number[p] = static_cast<std::uint32_t>(small.points.size());
      small.points.push_back(graph_.points[p]);
      small.is_required.push_back(graph_.is_required[p]);
      small.stands_for.push_back(std::move(graph_.stands_for[p]));
    }
    for (std::uint32_t s = 0; s < graph_.segments.size(); ++s) {
      if (!is_alive_[s]) continue;
      Segment& segment = graph_.segments[s];
      segment.a = number[segment.a];
      segment.b = number[segment.b];
      small.segments.push_back(std::move(segment));
    }
    small.features = std::move(graph_.features);
    small.changes = std::move(graph_.changes);
    small.edge_length_m = graph_.edge_length_m;
    graph_ = std::move(small);
  }

  PlanGraph& graph_;
  double limit_m_;
  std::vector<std::vector<std::uint32_t>> around_;
  std::vector<char> is_alive_;
  std::vector<std::uint32_t> dropped_;
  std::vector<double> moved_m_;
};

}  // namespace

void contract_short_edges(PlanGraph& graph, double limit_m) { EdgeContraction(graph, limit_m).run(); }

}  // namespace strataflow
