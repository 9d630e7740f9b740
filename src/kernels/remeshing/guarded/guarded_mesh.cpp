#include "kernels/remeshing/guarded/guarded_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/remeshing/guarded/triangle_corners.h"
#include "kernels/topology/union_find.h"
#include "model/soup_of_model.h"

namespace strataflow {

namespace {

/// Cells of the grid, in edges to come: the triangles around a vertex then meet few of them.
constexpr double cell_edges = 1.7;

Triangle with(Triangle t, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t& v : t)
    if (v == from) v = to;
  return t;
}

/// A float beyond x, by no more than a millionth of it.
float rounded_out(double x, int way) { return static_cast<float>(x + way * (std::abs(x) * 0x1.0p-22 + 1e-30)); }

}  // namespace

double quality_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c, n = cross(ab, bc);
  double x = dot(ab, ab), y = dot(bc, bc), z = dot(ca, ca);
  if (x > y) std::swap(x, y);
  if (x > z) std::swap(x, z);  // the two longest sides enclose the smallest angle
  const double product = y * z;
  return product > 0 ? std::sqrt(dot(n, n) / product) : 0;
}

double shape_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double x = length(ab), y = length(bc), z = length(ca), longest = std::max({x, y, z});
  return longest > 0 ? 2 * std::numbers::sqrt3 * length(cross(ab, ca)) / (longest * (x + y + z)) : 0;
}

GuardedMesh::GuardedMesh(const InputSurfaces& inputs, const GuardOptions& options)
    : inputs_(inputs),
      options_(options),
      cos_turn_(std::cos(options.turn_angle_deg * std::numbers::pi / 180)),
      points_(inputs.model().points),
      triangles_(inputs.model().triangles),
      surface_of_(inputs.model().triangle_surface) {
  const StructuralModel& model = inputs.model();
  const std::size_t vertices = points_.size(), triangles = triangles_.size();
  first_sample_.assign(triangles, no_index);
  source_.resize(triangles);
  changed_at_.assign(triangles, 0);
  removed_mark_.assign(triangles, 0);
  seen_mark_.assign(triangles, 0);
  vertex_mark_.assign(vertices, 0);
  size_m_.assign(vertices, options.cell_m);
  for (std::uint32_t t = 0; t < triangles; ++t) source_[t] = t;
  link_all();
  find_kinds();
  note_radial_orders();
  std::vector<int>& flat_turn = frame_->flat_turn;
  flat_turn.assign(model.surfaces.size(), 0);
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s)
    if (const int axis = inputs.flat_axis(s); axis >= 0)
      for (std::uint32_t t = model.surfaces[s].first_triangle; t < model.surfaces[s].end_triangle; ++t)
        if (flat_turn[s] == 0)
          flat_turn[s] =
              orientation_2d(points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]], axis);
  place_samples();
  find_pieces();
}

void GuardedMesh::find_pieces() {
  UnionFind sets(points_.size());
  for (const Triangle& t : triangles_) {
    sets.unite(t[0], t[1]);
    sets.unite(t[0], t[2]);
  }
  std::vector<FloatBox>& pieces = frame_->pieces;
  std::vector<std::uint32_t> piece(points_.size(), no_index);
  for (const Surface& surface : inputs_.model().surfaces) {
    std::uint32_t& p = piece[sets.find(triangles_[surface.first_triangle][0])];
    if (p == no_index) {
      p = static_cast<std::uint32_t>(pieces.size());
      pieces.push_back(FloatBox::nothing());
    }
    frame_->piece_of.push_back(p);
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t)
      widen(pieces[p], box_of(triangles_[t]));
  }
  if (pieces.size() < 2) pieces.clear();
}

void GuardedMesh::place_samples() {
  const auto place = [&](const Vec3& p, std::uint32_t t) {
    next_sample_.push_back(first_sample_[t]);
    first_sample_[t] = static_cast<std::uint32_t>(samples_.size());
    samples_.push_back(p);
  };
  for (std::uint32_t v = 0; v < points_.size(); ++v)
    if (kind_[v] == VertexKind::surface && head_[v] != no_index && inputs_.flat_axis(owner_[v]) < 0)
      place(points_[v], place_[v]);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (inputs_.flat_axis(surface_of_[t]) >= 0) continue;
    const Vec3 &a = points_[triangles_[t][0]], ab = points_[triangles_[t][1]] - a, ac = points_[triangles_[t][2]] - a;
    const double widest = std::sqrt(std::max({dot(ab, ab), dot(ac, ac), dot(ac - ab, ac - ab)})) / options_.cell_m;
    if (widest < 0.25) continue;  // its corners will do
    const int n = static_cast<int>(std::clamp(2 * widest, 1.0, 64.0));
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) place(a + ((i + 1.0 / 3) / n) * ab + ((j + 1.0 / 3) / n) * ac, t);
  }
}

void GuardedMesh::find_kinds() {
  const StructuralModel& model = inputs_.model();
  const std::size_t vertices = points_.size();
  kind_.assign(vertices, VertexKind::surface);
  is_fixed_.assign(vertices, 0);
  owner_.assign(vertices, no_index);
  arc_m_.assign(vertices, 0);
  before_.assign(vertices, no_index);
  after_.assign(vertices, no_index);
  place_.assign(vertices, no_index);
  for (std::uint32_t c = 0; c < model.corners.size(); ++c) {
    const std::uint32_t v = model.corners[c].vertex;
    kind_[v] = VertexKind::corner;
    owner_[v] = c;
    is_fixed_[v] = 1;
  }
  std::vector<std::uint32_t> line_count(model.corners.size() + 1, 0);
  for (std::uint32_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const std::size_t n = line.vertices.size();
    line_edges_.push_back(static_cast<std::uint32_t>(n - !line.is_closed()));
    for (std::size_t k = 0; k < n; ++k)
      if (const std::uint32_t v = line.vertices[k]; kind_[v] != VertexKind::corner) {
        kind_[v] = VertexKind::line;
        owner_[v] = i;
        arc_m_[v] = inputs_.arc_of(i, k);
      }
    for (std::size_t k = 0; k < line_edges_[i]; ++k) link_line(line.vertices[k], line.vertices[(k + 1) % n]);
    if (!line.is_closed())
      for (const std::uint32_t c : line.corners) ++line_count[c + 1];
  }
  for (std::size_t c = 0; c < model.corners.size(); ++c) line_count[c + 1] += line_count[c];
  frame_->first_corner_line = line_count;
  frame_->corner_lines.resize(line_count.back());
  for (std::uint32_t i = 0; i < model.lines.size(); ++i)
    if (!model.lines[i].is_closed())
      for (const std::uint32_t c : model.lines[i].corners) frame_->corner_lines[line_count[c]++] = i;

  // A vertex whose triangles do not form one fan per surface side between lines is more than its kind says: it stays.
  std::vector<std::uint32_t> fan;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (head_[v] == no_index || kind_[v] == VertexKind::corner) continue;
    std::uint32_t count = 0, edge_uses = 0, line_uses = 0;
    visit_star(v, [&](std::uint32_t t) {
      ++count;
      for (const std::uint32_t w : triangles_[t])
        if (w != v) ++(line_of_edge(v, w) == no_index ? edge_uses : line_uses);
    });
    if (kind_[v] == VertexKind::surface) {
      place_[v] = head_[v] / 3;
      owner_[v] = surface_of_[head_[v] / 3];
    }
    // Walks the fan of the first triangle (from a line edge, where there is one) across edges that are no line's, and
    // counts fans.
    fan.clear();
    visit_star(v, [&](std::uint32_t t) { fan.push_back(t); });
    std::uint32_t fans = 0;
    while (!fan.empty()) {
      ++fans;
      std::vector<std::uint32_t> front{fan.back()};
      fan.pop_back();
      while (!front.empty()) {
        const std::uint32_t t = front.back();
        front.pop_back();
        for (const std::uint32_t w : triangles_[t]) {
          if (w == v || line_of_edge(v, w) != no_index) continue;
          for (std::size_t k = fan.size(); k-- > 0;)
            if (has(triangles_[fan[k]], w)) {
              front.push_back(fan[k]);
              fan.erase(fan.begin() + static_cast<std::ptrdiff_t>(k));
            }
        }
      }
    }
    const bool is_plain = kind_[v] == VertexKind::surface ? fans == 1 && line_uses == 0 : 2 * fans == line_uses;
    if (!is_plain || edge_uses + line_uses != 2 * count) is_fixed_[v] = 1;
  }
}

void GuardedMesh::note_radial_orders() {
  const StructuralModel& model = inputs_.model();
  std::vector<std::vector<std::uint32_t>>& radial = frame_->radial;
  radial.resize(model.lines.size());
  for (std::uint32_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    if (line.surfaces.size() < 3) continue;
    // Where the input itself changes the order along a line there is nothing to keep.
    for (std::size_t k = 0; k < line_edges_[i]; ++k) {
      const std::uint32_t a = line.vertices[k], b = line.vertices[(k + 1) % line.vertices.size()];
      begin_change();
      if (k == 0) {
        has_radial_order(i, a, b);
        radial[i] = leaf_words_;
      } else if (!has_radial_order(i, a, b)) {
        radial[i].clear();
      }
      if (radial[i].empty()) break;
    }
  }
}

std::uint32_t GuardedMesh::line_of_edge(std::uint32_t a, std::uint32_t b) const {
  if (kind_[a] == VertexKind::surface || kind_[b] == VertexKind::surface) return no_index;
  if (kind_[a] == VertexKind::line) return before_[a] == b || after_[a] == b ? owner_[a] : no_index;
  if (kind_[b] == VertexKind::line) return before_[b] == a || after_[b] == a ? owner_[b] : no_index;
  for (std::uint32_t k = frame_->first_corner_line[owner_[a]]; k < frame_->first_corner_line[owner_[a] + 1]; ++k) {
    const std::uint32_t i = frame_->corner_lines[k];
    if (line_edges_[i] != 1) continue;
    const auto& ends = inputs_.model().lines[i].corners;
    if (ends[0] == owner_[b] || ends[1] == owner_[b]) return i;
  }
  return no_index;
}

void GuardedMesh::link_line(std::uint32_t a, std::uint32_t b) {
  if (kind_[a] == VertexKind::line) after_[a] = b;
  if (kind_[b] == VertexKind::line) before_[b] = a;
}

bool GuardedMesh::is_in_line_order(std::uint32_t line, std::uint32_t a, std::uint32_t b) const {
  if (kind_[a] == VertexKind::line) return after_[a] == b;
  if (kind_[b] == VertexKind::line) return before_[b] == a;
  return inputs_.model().lines[line].corners[0] == owner_[a];
}

std::array<double, 2> GuardedMesh::arcs_of_edge(std::uint32_t line, std::uint32_t a, std::uint32_t b) const {
  if (!is_in_line_order(line, a, b)) std::swap(a, b);
  const double whole = inputs_.length_m(line);
  const double from = kind_[a] == VertexKind::corner ? 0 : arc_m_[a];
  double to = kind_[b] == VertexKind::corner ? whole : arc_m_[b];
  if (!(to > from)) to += whole;
  return {from, to};
}

std::array<double, 3> GuardedMesh::arcs_around(std::uint32_t v) const {
  const auto [from, here] = arcs_of_edge(owner_[v], before_[v], v);
  const auto [here_again, to] = arcs_of_edge(owner_[v], v, after_[v]);
  return {from, here, here + (to - here_again)};
}

bool GuardedMesh::line_stays_near(std::uint32_t line, std::uint32_t a, std::uint32_t b) const {
  auto [from, to] = arcs_of_edge(line, a, b);
  const double whole = inputs_.length_m(line);
  if (to > whole) to -= whole;
  return inputs_.deviation_m(line, from, to, points_[a], points_[b]) <= options_.distance_m;
}

bool GuardedMesh::has_edge(std::uint32_t a, std::uint32_t b) const {
  for (std::uint32_t h = head_[a]; h != no_index; h = next_[h])
    if (has(triangles_[h / 3], b)) return true;
  return false;
}

FloatBox GuardedMesh::box_of(const Triangle& t) const {
  const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = rounded_out(std::min({a[axis], b[axis], c[axis]}), -1);
    box.high[axis] = rounded_out(std::max({a[axis], b[axis], c[axis]}), 1);
  }
  return box;
}

void GuardedMesh::link_triangle(std::uint32_t t) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t v = triangles_[t][k];
    next_[3 * t + k] = head_[v];
    head_[v] = 3 * t + k;
  }
}

void GuardedMesh::link_all() {
  head_.assign(points_.size(), no_index);
  next_.assign(3 * triangles_.size(), no_index);
  for (std::uint32_t t = 0; t < triangle_count(); ++t)
    if (is_alive(t)) link_triangle(t);
}

void GuardedMesh::fill_grid() {
  Box3 box;
  for (std::uint32_t t = 0; t < triangle_count(); ++t)
    if (is_changeable(t))
      for (const std::uint32_t v : triangles_[t]) box.take(points_[v]);
  grid_ = TriangleGrid(box, cell_edges * options_.cell_m, std::max<std::size_t>(1u << 20, 4 * triangles_.size()));
  for (std::uint32_t t = 0; t < triangle_count(); ++t)
    if (is_alive(t)) grid_.insert(t, box_of(triangles_[t]));
  is_grid_filled_ = true;
}

void GuardedMesh::unlink_triangle(std::uint32_t t) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    std::uint32_t* link = &head_[triangles_[t][k]];
    while (*link != 3 * t + k) link = &next_[*link];
    *link = next_[3 * t + k];
  }
  if (is_grid_filled_) grid_.erase(t);
}

std::uint32_t GuardedMesh::new_mark() { return ++mark_; }

void GuardedMesh::begin_change() {
  ++change_;
  if (change_ % 1024 == 0 && options_.is_cancelled && options_.is_cancelled()) is_stopped_ = true;
  removed_.clear();
  added_.clear();
}

void GuardedMesh::remove(std::uint32_t t, const ShapeDemand& demand) {
  removed_mark_[t] = change_;
  const Vec3 &a = points_[triangles_[t][0]], &b = points_[triangles_[t][1]], &c = points_[triangles_[t][2]];
  removed_.push_back({t, quality_of(a, b, c), demand.must_raise_mean ? shape_of(a, b, c) : 0, cross(b - a, c - a)});
}

void GuardedMesh::add(const Triangle& corners, std::uint32_t parent) {
  added_.push_back({corners, parent, box_of(corners)});
}

void GuardedMesh::commit() {
  // Everything the new triangles inherit is read before the slots of the old ones are used again.
  std::vector<std::array<std::uint32_t, 2>>& inherited = inherited_;
  inherited.clear();
  ++steps_;
  for (const Added& a : added_) {
    const std::uint32_t parent = removed_[a.parent].triangle;
    inherited.push_back({surface_of_[parent], source_[parent]});
  }
  for (std::size_t k = removed_.size(); k-- > 0;) {
    const std::uint32_t t = removed_[k].triangle;
    unlink_triangle(t);
    first_sample_[t] = no_index;
    surface_of_[t] = no_index;
    free_.push_back(t);
  }
  for (std::size_t k = 0; k < added_.size(); ++k) {
    std::uint32_t t;
    if (free_.empty()) {
      t = triangle_count();
      triangles_.emplace_back();
      surface_of_.push_back(no_index);
      source_.push_back(no_index);
      first_sample_.push_back(no_index);
      changed_at_.push_back(0);
      removed_mark_.push_back(0);
      seen_mark_.push_back(0);
      next_.insert(next_.end(), 3, no_index);
    } else {
      t = free_.back();
      free_.pop_back();
    }
    triangles_[t] = added_[k].corners;
    surface_of_[t] = inherited[k][0];
    source_[t] = inherited[k][1];
    changed_at_[t] = steps_;
    link_triangle(t);
    if (is_grid_filled_) grid_.insert(t, added_[k].box);
    added_[k].parent = t;
  }
  for (const SampleMove& move : sample_moves_) {
    const std::uint32_t t = added_[move.added].parent;
    next_sample_[move.sample] = first_sample_[t];
    first_sample_[t] = move.sample;
  }
}

template <class Accepted>
Verdict GuardedMesh::try_move(std::uint32_t v, const Vec3& to, const ShapeDemand& demand, Accepted&& accepted) {
  begin_change();
  visit_star(v, [&](std::uint32_t t) { remove(t, demand); });
  const Vec3 old = points_[v];
  points_[v] = to;
  for (std::uint32_t k = 0; k < removed_.size(); ++k) add(triangles_[removed_[k].triangle], k);
  const Verdict verdict = judge(demand, kind_[v] == VertexKind::surface);
  if (verdict != Verdict::done) {
    points_[v] = old;
    return noted(verdict);
  }
  // The triangles stay what they are; only their boxes and samples change.
  ++steps_;
  for (const Added& added : added_) {
    const std::uint32_t t = removed_[added.parent].triangle;
    if (is_grid_filled_) grid_.move(t, added.box);
    changed_at_[t] = steps_;
    first_sample_[t] = no_index;
  }
  for (const SampleMove& move : sample_moves_) {
    const std::uint32_t t = removed_[added_[move.added].parent].triangle;
    next_sample_[move.sample] = first_sample_[t];
    first_sample_[t] = move.sample;
  }
  accepted();
  return noted(verdict);
}

Verdict GuardedMesh::move_vertex(std::uint32_t v, const Vec3& target, const ShapeDemand& demand) {
  if (is_stopped_ || kind_[v] != VertexKind::surface || is_fixed_[v]) return noted(Verdict::fixed);
  const Vec3 old = points_[v];
  InputSurfaces::Place place{place_[v], target};
  if (const int axis = inputs_.flat_axis(owner_[v]); axis >= 0)
    place.point[axis] = old[axis];
  else
    place = inputs_.nearest(target, place_[v]);
  if (place.point == old) return noted(Verdict::fixed);
  return try_move(v, place.point, demand, [&] { place_[v] = place.triangle; });
}

Verdict GuardedMesh::slide_vertex(std::uint32_t v, double arc_m, const ShapeDemand& demand) {
  if (is_stopped_ || kind_[v] != VertexKind::line || is_fixed_[v]) return noted(Verdict::fixed);
  const auto [from, here, to] = arcs_around(v);
  if (!(from < arc_m && arc_m < to) || arc_m == here) return noted(Verdict::fixed);
  const double whole = inputs_.length_m(owner_[v]), old_arc = arc_m_[v];
  if (arc_m >= whole) arc_m -= whole;
  const Vec3 old = points_[v];
  arc_m_[v] = arc_m;
  points_[v] = inputs_.point_at(owner_[v], arc_m);
  const bool is_near = line_stays_near(owner_[v], before_[v], v) && line_stays_near(owner_[v], v, after_[v]);
  const Vec3 moved = points_[v];
  points_[v] = old;
  const Verdict verdict = is_near ? try_move(v, moved, demand, [] {}) : noted(Verdict::strayed);
  if (verdict != Verdict::done) arc_m_[v] = old_arc;
  return verdict;
}

Verdict GuardedMesh::collapse_edge(std::uint32_t gone, std::uint32_t kept, const ShapeDemand& demand) {
  if (is_stopped_ || is_fixed_[gone]) return noted(Verdict::fixed);
  const std::uint32_t line = line_of_edge(gone, kept);
  if (kind_[gone] == VertexKind::line) {
    if (line == no_index) return noted(Verdict::fixed);
    const auto& ends = inputs_.model().lines[line].corners;
    if (line_edges_[line] <= (ends[0] == ends[1] ? 3u : 1u)) return noted(Verdict::fixed);
  }
  // Link condition: what both ends know, and only that, are the tips of the triangles on the edge.
  const std::uint32_t near_gone = new_mark(), tip = new_mark();
  begin_change();
  bool is_free = true;
  visit_star(gone, [&](std::uint32_t t) {
    for (const std::uint32_t w : triangles_[t])
      if (vertex_mark_[w] != tip) vertex_mark_[w] = near_gone;
    if (!has(triangles_[t], kept)) return;
    const std::uint32_t w = third_of(triangles_[t], gone, kept);
    if (vertex_mark_[w] == tip) is_free = false;
    vertex_mark_[w] = tip;
    if (line_of_edge(gone, w) != no_index && line_of_edge(kept, w) != no_index) is_free = false;
  });
  vertex_mark_[gone] = vertex_mark_[kept] = 0;
  visit_star(kept, [&](std::uint32_t t) {
    for (const std::uint32_t w : triangles_[t]) is_free &= vertex_mark_[w] != near_gone;
  });
  if (!is_free) return noted(Verdict::topology);
  visit_star(gone, [&](std::uint32_t t) { remove(t, demand); });
  for (std::uint32_t k = 0; k < removed_.size(); ++k)
    if (const Triangle& t = triangles_[removed_[k].triangle]; !has(t, kept)) add(with(t, gone, kept), k);
  if (added_.empty() || added_.size() == removed_.size()) return noted(Verdict::topology);
  if (demand.longest < std::numeric_limits<double>::infinity() && grows_long(gone, kept, demand.longest))
    return noted(Verdict::shape);
  const bool is_line = kind_[gone] == VertexKind::line;
  const std::array<std::uint32_t, 2> around{before_[gone], after_[gone]};
  const auto relink = [&] {
    if (around[0] == kept)
      link_line(kept, around[1]);
    else
      link_line(around[0], kept);
    --line_edges_[line];
  };
  if (is_line) {
    relink();
    if (!line_stays_near(line, around[0] == kept ? around[1] : around[0], kept)) {
      link_line(around[0], gone);
      link_line(gone, around[1]);
      ++line_edges_[line];
      return noted(Verdict::strayed);
    }
  }
  const Verdict verdict = judge(demand, !is_line);
  if (verdict == Verdict::done) {
    commit();
  } else if (is_line) {
    link_line(around[0], gone);
    link_line(gone, around[1]);
    ++line_edges_[line];
  }
  return noted(verdict);
}

Verdict GuardedMesh::split_edge(std::uint32_t a, std::uint32_t b, const ShapeDemand& demand) {
  if (is_stopped_) return noted(Verdict::fixed);
  begin_change();
  visit_star(a, [&](std::uint32_t t) {
    if (has(triangles_[t], b)) remove(t, demand);
  });
  if (removed_.empty()) return noted(Verdict::topology);
  for (const Removed& r : removed_)
    if (is_held(r.triangle)) return noted(Verdict::fixed);
  const std::uint32_t line = line_of_edge(a, b), m = vertex_count(), first = removed_[0].triangle;
  const Vec3 middle = 0.5 * (points_[a] + points_[b]);
  InputSurfaces::Place place{source_[first], middle};
  double arc = 0;
  if (line != no_index) {
    if (!is_in_line_order(line, a, b)) std::swap(a, b);
    const auto [from, to] = arcs_of_edge(line, a, b);
    arc = from + 0.5 * (to - from);
    if (arc >= inputs_.length_m(line)) arc -= inputs_.length_m(line);
    place.point = inputs_.point_at(line, arc);
  } else if (const int axis = inputs_.flat_axis(surface_of_[first]); axis >= 0) {
    place.point[axis] = points_[a][axis];
  } else {
    const std::uint32_t start = kind_[a] == VertexKind::surface   ? place_[a]
                                : kind_[b] == VertexKind::surface ? place_[b]
                                                                  : source_[first];
    place = inputs_.nearest(middle, start);
  }
  points_.push_back(place.point);
  kind_.push_back(line == no_index ? VertexKind::surface : VertexKind::line);
  is_fixed_.push_back(0);
  owner_.push_back(line == no_index ? surface_of_[first] : line);
  arc_m_.push_back(arc);
  size_m_.push_back(0.5 * (size_m_[a] + size_m_[b]));
  before_.push_back(no_index);
  after_.push_back(no_index);
  place_.push_back(line == no_index ? place.triangle : no_index);
  head_.push_back(no_index);
  vertex_mark_.push_back(0);
  if (line != no_index) {
    link_line(a, m);
    link_line(m, b);
    ++line_edges_[line];
  }
  for (std::uint32_t k = 0; k < removed_.size(); ++k) {
    const Triangle t = triangles_[removed_[k].triangle];
    add(with(t, b, m), k);
    add(with(t, a, m), k);
  }
  Verdict verdict = judge(demand, line == no_index);
  if (verdict != Verdict::done && line == no_index && inputs_.flat_axis(surface_of_[first]) < 0 &&
      points_[m] != middle) {
    points_[m] = middle;  // the chord itself may still do
    for (Added& added : added_) added.box = box_of(added.corners);
    verdict = judge(demand, true);
  }
  if (verdict == Verdict::done) {
    commit();
    return noted(verdict);
  }
  if (line != no_index) {
    link_line(a, b);
    --line_edges_[line];
  }
  points_.pop_back();
  kind_.pop_back();
  is_fixed_.pop_back();
  owner_.pop_back();
  arc_m_.pop_back();
  size_m_.pop_back();
  before_.pop_back();
  after_.pop_back();
  place_.pop_back();
  head_.pop_back();
  vertex_mark_.pop_back();
  return noted(verdict);
}

Verdict GuardedMesh::flip_edge(std::uint32_t a, std::uint32_t b, const ShapeDemand& demand) {
  if (is_stopped_ || line_of_edge(a, b) != no_index) return noted(Verdict::fixed);
  begin_change();
  visit_star(a, [&](std::uint32_t t) {
    if (has(triangles_[t], b)) remove(t, demand);
  });
  if (removed_.size() != 2) return noted(Verdict::topology);
  if (is_held(removed_[0].triangle) || is_held(removed_[1].triangle)) return noted(Verdict::fixed);
  if (!runs_along(triangles_[removed_[0].triangle], a, b)) std::swap(removed_[0], removed_[1]);
  const Triangle &left = triangles_[removed_[0].triangle], &right = triangles_[removed_[1].triangle];
  if (!runs_along(left, a, b) || !runs_along(right, b, a)) return noted(Verdict::topology);
  const std::uint32_t c = third_of(left, a, b), d = third_of(right, a, b);
  add({a, d, c}, 1);
  add({d, b, c}, 0);
  if (!keeps_shape(demand)) return noted(Verdict::shape);  // settles most calls, before the search for the edge
  if (has_edge(c, d)) return noted(Verdict::topology);
  const Verdict verdict = judge(demand, true);
  if (verdict == Verdict::done) commit();
  return noted(verdict);
}

bool GuardedMesh::grows_long(std::uint32_t gone, std::uint32_t kept, double longest) const {
  double before_m = 0;
  for (const Removed& r : removed_)
    for (const std::uint32_t w : triangles_[r.triangle])
      before_m = std::max(before_m, length(points_[w] - points_[gone]));
  for (const Added& a : added_)
    for (const std::uint32_t w : a.corners)
      if (const double d = length(points_[w] - points_[kept]);
          d > before_m && d > longest * 0.5 * (size_m_[w] + size_m_[kept]))
        return true;
  return false;
}

std::vector<std::uint32_t> GuardedMesh::triangles_in_order() const {
  std::vector<std::uint32_t> alive;
  for (std::uint32_t t = 0; t < triangle_count(); ++t)
    if (is_alive(t)) alive.push_back(t);
  std::stable_sort(alive.begin(), alive.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return surface_of_[a] < surface_of_[b]; });
  return alive;
}

TriangleSoup GuardedMesh::soup() const {
  TriangleSoup soup = patches_of_model(inputs_.model());
  std::vector<std::uint32_t> number(vertex_count(), no_index);
  for (std::uint32_t v = 0; v < vertex_count(); ++v)
    if (is_alive_vertex(v)) {
      number[v] = static_cast<std::uint32_t>(soup.points.size());
      soup.points.push_back(points_[v]);
    }
  for (const std::uint32_t t : triangles_in_order()) {
    soup.triangles.push_back({number[triangles_[t][0]], number[triangles_[t][1]], number[triangles_[t][2]]});
    soup.triangle_patch.push_back(surface_of_[t]);
  }
  return soup;
}

}  // namespace strataflow
