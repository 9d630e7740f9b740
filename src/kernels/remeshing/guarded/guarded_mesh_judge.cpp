// What GuardedMesh asks before it takes a step.
#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/intersection/triangle_pair.h"
#include "kernels/remeshing/guarded/guarded_mesh.h"
#include "kernels/remeshing/guarded/triangle_corners.h"
#include "kernels/topology/building/radial_order.h"

namespace strataflow {

namespace {

/// A triangle whose smallest angle has this sine (35°) or more is good; the shortfall of others counts.
constexpr double good_quality = 0.5735764363510461;
/// No new triangle is ever worse than this, so that rounding cannot make it one without area.
constexpr double worst_quality = 1e-6;
/// A triangle of better shape than this raises the mean when it comes, others when they go.
constexpr double mean_shape = 0.95;

double shortfall_of(double quality) {
  const double missing = good_quality - quality;
  return missing > 0 ? missing * missing : 0;
}

/// Two triangles of which rounding alone tells that they meet in nothing but the vertices they share, as almost all
/// neighbours do; the exact answer takes ten times as long. Where it is false nothing is known.
bool is_plainly_apart(const std::vector<Vec3>& points, const Triangle& first, const Triangle& second) {
  constexpr double margin = 1e-12;  // rounding errors are below 1e-14 of products of lengths
  int shared = 0;
  std::array<std::size_t, 3> in_first{}, in_second{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (first[i] == second[j]) {
        in_first[static_cast<std::size_t>(shared)] = i;
        in_second[static_cast<std::size_t>(shared)] = j;
        if (++shared == 3) return false;
      }
  if (shared == 1) {
    // A plane through the shared vertex with one triangle on each side.
    const std::size_t i = in_first[0], j = in_second[0];
    const Vec3& apex = points[first[i]];
    const Vec3 a = points[first[(i + 1) % 3]] - apex, b = points[first[(i + 2) % 3]] - apex,
               c = points[second[(j + 1) % 3]] - apex, d = points[second[(j + 2) % 3]] - apex;
    const Vec3 normal = (a + b) - (c + d);
    const double least = margin * dot(normal, normal);
    const auto is_beyond = [&](double way, const Vec3& v) {
      const double height = way * dot(normal, v);
      return height > least && height > margin * dot(v, v);
    };
    return is_beyond(1, a) && is_beyond(1, b) && is_beyond(-1, c) && is_beyond(-1, d);
  }
  if (shared == 2) {
    // They overlap only when folded flat onto each other; these open by more than a right angle.
    const Vec3 &u = points[first[in_first[0]]], &v = points[first[in_first[1]]];
    const Vec3 along = v - u, a = points[first[3 - in_first[0] - in_first[1]]] - u,
               b = points[second[3 - in_second[0] - in_second[1]]] - u;
    const double opening = -dot(cross(along, a), cross(along, b)), square = dot(along, along);
    return opening > 0 && opening * opening > margin * margin * square * square * dot(a, a) * dot(b, b);
  }
  // A plane between them, across the way from one's middle to the other's.
  const Vec3& from = points[first[0]];
  std::array<Vec3, 3> a, b;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = points[first[k]] - from;
    b[k] = points[second[k]] - from;
  }
  const Vec3 way = (b[0] + b[1] + b[2]) - (a[0] + a[1] + a[2]);
  const double last = std::max({0.0, dot(way, a[1]), dot(way, a[2])});
  const double begin = std::min({dot(way, b[0]), dot(way, b[1]), dot(way, b[2])});
  const double most = std::max({dot(a[1], a[1]), dot(a[2], a[2]), dot(b[0], b[0]), dot(b[1], b[1]), dot(b[2], b[2])});
  const double gap = begin - last;
  return gap > 0 && gap * gap > margin * margin * dot(way, way) * most;
}

}  // namespace

Verdict GuardedMesh::judge(const ShapeDemand& demand, bool is_inside_surface) {
  if (!keeps_shape(demand)) return Verdict::shape;
  if (origin_ && leaves_block()) return Verdict::fixed;
  if (!keeps_direction()) return Verdict::turned;
  if (has_new_ear()) return Verdict::topology;
  if (!keeps_samples()) return Verdict::strayed;
  // On a side of the box triangles of one sense that fill the same polygon cannot overlap, and nothing else is there.
  const bool cannot_cross = is_inside_surface && inputs_.is_outermost(surface_of_[removed_[0].triangle]);
  if (!cannot_cross && !keeps_apart()) return Verdict::crossing;
  if (!keeps_radial_order()) return Verdict::reordered;
  return Verdict::done;
}

bool GuardedMesh::keeps_shape(const ShapeDemand& demand) const {
  double worst_before = 1, worst = 1, shortfall_before = 0, shortfall = 0;
  for (const Removed& r : removed_) {
    worst_before = std::min(worst_before, r.quality);
    shortfall_before += shortfall_of(r.quality);
  }
  for (const Added& a : added_) {
    const double q = quality_of(points_[a.corners[0]], points_[a.corners[1]], points_[a.corners[2]]);
    worst = std::min(worst, q);
    shortfall += shortfall_of(q);
  }
  if (!(worst > worst_quality)) return false;
  if (worst < demand.floor && worst < worst_before) return false;
  if (demand.must_improve && !(shortfall < shortfall_before * (1 - 1e-3))) return false;
  if (demand.must_raise_mean) {
    double gain = 0;
    for (const Removed& r : removed_) gain += mean_shape - r.shape;
    for (const Added& a : added_)
      gain += shape_of(points_[a.corners[0]], points_[a.corners[1]], points_[a.corners[2]]) - mean_shape;
    if (!(gain > 1e-4)) return false;
  }
  return !demand.must_raise_worst || worst > worst_before * (1 + 1e-6);
}

bool GuardedMesh::keeps_direction() {
  turns_.clear();
  const auto turn_of = [&](std::uint32_t surface) -> SurfaceTurn& {
    for (SurfaceTurn& turn : turns_)
      if (turn.surface == surface) return turn;
    return turns_.emplace_back(SurfaceTurn{surface, {}, 1});
  };
  for (const Removed& r : removed_) {
    SurfaceTurn& turn = turn_of(surface_of_[r.triangle]);
    turn.normal = turn.normal + r.normal;
  }
  for (SurfaceTurn& turn : turns_) {
    const double whole = length(turn.normal);
    if (whole > 0) turn.normal = (1 / whole) * turn.normal;
    turn.least_cos = cos_turn_;
  }
  for (const Removed& r :
       removed_)  // a rough place may stay as rough as it is; needles point anywhere and do not count
    if (r.quality > 0.1) {
      SurfaceTurn& turn = turn_of(surface_of_[r.triangle]);
      turn.least_cos = std::min(turn.least_cos, dot(r.normal, turn.normal) / length(r.normal));
    }
  for (const Added& added : added_) {
    const std::uint32_t surface = surface_of_[removed_[added.parent].triangle];
    const Vec3 &a = points_[added.corners[0]], &b = points_[added.corners[1]], &c = points_[added.corners[2]];
    if (const int axis = inputs_.flat_axis(surface); axis >= 0) {
      if (orientation_2d(a, b, c, axis) != frame_->flat_turn[surface]) return false;
      continue;
    }
    const SurfaceTurn& turn = turn_of(surface);
    const Vec3 normal = cross(b - a, c - a);
    if (!(dot(normal, turn.normal) >= turn.least_cos * length(normal) * (1 - 1e-9))) return false;
  }
  return true;
}

bool GuardedMesh::is_ear(const Triangle& t) const {
  if (kind_[t[0]] == VertexKind::surface || kind_[t[1]] == VertexKind::surface || kind_[t[2]] == VertexKind::surface)
    return false;
  const std::uint32_t ab = line_of_edge(t[0], t[1]), bc = line_of_edge(t[1], t[2]), ca = line_of_edge(t[2], t[0]);
  return (ab != no_index && (ab == bc || ab == ca)) || (bc != no_index && bc == ca);
}

bool GuardedMesh::has_new_ear() const {
  int ears = 0;
  for (const Added& a : added_) ears += is_ear(a.corners);
  if (ears == 0) return false;
  for (const Removed& r : removed_) ears -= is_ear(triangles_[r.triangle]);
  return ears > 0;
}

bool GuardedMesh::keeps_samples() {
  sample_moves_.clear();
  const double most = options_.distance_m * options_.distance_m, near_enough = most / 256;
  for (std::uint32_t i = 0; i < removed_.size(); ++i) {
    const Removed& r = removed_[i];
    const std::uint32_t surface = surface_of_[r.triangle];
    for (std::uint32_t s = first_sample_[r.triangle]; s != no_index; s = next_sample_[s]) {
      const Vec3& p = samples_[s];
      double best = std::numeric_limits<double>::infinity();
      std::uint32_t nearest = 0;
      for (std::uint32_t n = 0, k = i; n < added_.size(); ++n, ++k) {  // most stay where they were
        if (k >= added_.size()) k = 0;
        const Added& added = added_[k];
        if (surface_of_[removed_[added.parent].triangle] != surface) continue;
        const double square =
            square_distance(p, points_[added.corners[0]], points_[added.corners[1]], points_[added.corners[2]]);
        if (!(square < best)) continue;
        best = square;
        nearest = k;
        if (square < near_enough) break;
      }
      if (!(best <= most)) return false;
      sample_moves_.push_back({s, nearest});
    }
  }
  return true;
}

bool GuardedMesh::jumps_over_piece(FloatBox around) const {
  if (frame_->pieces.empty()) return false;
  for (const Removed& r : removed_) widen(around, grid_.box(r.triangle));
  const std::uint32_t own = frame_->piece_of[surface_of_[removed_[0].triangle]];
  for (std::uint32_t p = 0; p < frame_->pieces.size(); ++p) {
    if (p == own || !overlap(frame_->pieces[p], around)) continue;
    bool fits = true;
    for (int axis = 0; axis < 3; ++axis)
      fits &= frame_->pieces[p].high[axis] - frame_->pieces[p].low[axis] <= around.high[axis] - around.low[axis];
    if (fits) return true;
  }
  return false;
}

bool GuardedMesh::keeps_apart() {
  if (!is_grid_filled_) fill_grid();
  const auto are_apart = [&](const Triangle& a, const Triangle& b) {
    return is_plainly_apart(points_, a, b) || meeting_of(points_, a, b) == PairMeeting::proper;
  };
  FloatBox around = FloatBox::nothing();
  for (const Added& a : added_) widen(around, a.box);
  for (std::size_t i = 0; i < added_.size(); ++i)
    for (std::size_t j = i + 1; j < added_.size(); ++j)
      if (overlap(added_[i].box, added_[j].box) && !are_apart(added_[i].corners, added_[j].corners)) return false;
  if (jumps_over_piece(around)) return false;
  const std::uint32_t mark = new_mark();
  bool is_apart = true;
  grid_.visit(around, [&](std::uint32_t t) {
    if (!is_apart || is_removed(t) || seen_mark_[t] == mark) return;
    seen_mark_[t] = mark;
    for (const Added& a : added_)
      if (overlap(a.box, grid_.box(t)) && !are_apart(a.corners, triangles_[t])) {
        is_apart = false;
        return;
      }
  });
  return is_apart;
}

bool GuardedMesh::has_radial_order(std::uint32_t line, std::uint32_t a, std::uint32_t b) {
  if (!is_in_line_order(line, a, b)) std::swap(a, b);
  leaf_points_.assign({points_[a], points_[b]});
  leaf_triangles_.clear();
  leaf_half_edges_.clear();
  leaf_words_.clear();
  const auto take = [&](const Triangle& t, std::uint32_t surface) {
    const auto n = static_cast<std::uint32_t>(leaf_triangles_.size());
    leaf_points_.push_back(points_[third_of(t, a, b)]);
    leaf_triangles_.push_back({0, 1, n + 2});
    leaf_half_edges_.push_back(3 * n);
    leaf_words_.push_back(2 * surface + runs_along(t, a, b));
  };
  visit_star(a, [&](std::uint32_t t) {
    if (!is_removed(t) && has(triangles_[t], b)) take(triangles_[t], surface_of_[t]);
  });
  for (const Added& added : added_)
    if (has(added.corners, a) && has(added.corners, b))
      take(added.corners, surface_of_[removed_[added.parent].triangle]);
  const RadialOrder order = radial_order(leaf_points_, leaf_triangles_, leaf_half_edges_);
  if (order.is_ambiguous) {
    leaf_words_.clear();
    return false;
  }
  std::vector<std::uint32_t> words(leaf_words_.size());
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = leaf_words_[order.half_edges[k] / 3];
  leaf_words_ = words;
  const std::vector<std::uint32_t>& wanted = frame_->radial[line];
  if (words.size() != wanted.size()) return false;
  for (std::size_t shift = 0; shift < words.size(); ++shift) {
    bool is_same = true;
    for (std::size_t k = 0; is_same && k < words.size(); ++k) is_same = words[(k + shift) % words.size()] == wanted[k];
    if (is_same) return true;
  }
  return false;
}

bool GuardedMesh::keeps_radial_order() {
  for (const Added& added : added_)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = added.corners[k], b = added.corners[(k + 1) % 3], line = line_of_edge(a, b);
      if (line == no_index || frame_->radial[line].empty()) continue;
      const bool was_seen = std::any_of(static_cast<const Added*>(added_.data()), &added, [&](const Added& other) {
        return has(other.corners, a) && has(other.corners, b);
      });
      if (!was_seen && !has_radial_order(line, a, b)) return false;
    }
  return true;
}

}  // namespace strataflow
