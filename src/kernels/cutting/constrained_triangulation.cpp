#include "kernels/cutting/constrained_triangulation.h"

#include <algorithm>

namespace strataflow {

namespace {
int next(int k) { return k == 2 ? 0 : k + 1; }
int previous(int k) { return k == 0 ? 2 : k - 1; }
}  // namespace

ConstrainedTriangulation::Edge ConstrainedTriangulation::across(std::uint32_t cell, int k) const {
  const std::uint32_t other = cells_[cell].neighbours[k];
  const std::uint32_t from = cells_[cell].vertices[next(k)];
  for (int m = 0; m < 3; ++m)
    if (cells_[other].vertices[m] == from && cells_[other].neighbours[m] == cell) return {other, m};
  return {other, 0};
}

void ConstrainedTriangulation::link(std::uint32_t cell, int k, std::uint32_t neighbour,
                                    std::uint32_t old_of_neighbour) {
  cells_[cell].neighbours[k] = neighbour;
  if (neighbour == no_index) return;
  const std::uint32_t from = cells_[cell].vertices[next(k)];
  for (int m = 0; m < 3; ++m)
    if (cells_[neighbour].vertices[m] == from && cells_[neighbour].neighbours[m] == old_of_neighbour)
      cells_[neighbour].neighbours[m] = cell;
}

/// (a, b, c) becomes (a, b, p), (b, c, p), (c, a, p).
void ConstrainedTriangulation::split_cell(std::uint32_t cell, std::uint32_t p) {
  const Cell old = cells_[cell];
  const auto second = static_cast<std::uint32_t>(cells_.size()), third = second + 1;
  const auto [a, b, c] = old.vertices;
  cells_[cell] = {{a, b, p}, {old.neighbours[0], second, third}, {old.is_fixed[0], 0, 0}};
  cells_.push_back({{b, c, p}, {old.neighbours[1], third, cell}, {old.is_fixed[1], 0, 0}});
  cells_.push_back({{c, a, p}, {old.neighbours[2], cell, second}, {old.is_fixed[2], 0, 0}});
  link(second, 0, old.neighbours[1], cell);
  link(third, 0, old.neighbours[2], cell);
  for (const std::uint32_t t : {cell, second, third}) note(t);
  suspect_.insert(suspect_.end(), {{a, b}, {b, c}, {c, a}});
}

/// Splits the edge a–b of (a, b, c) at p, and the cell beyond.
void ConstrainedTriangulation::split_edge(std::uint32_t cell, int k, std::uint32_t p) {
  const Cell old = cells_[cell];
  const std::uint32_t a = old.vertices[k], b = old.vertices[next(k)], c = old.vertices[previous(k)];
  const char fixed = old.is_fixed[k];
  const std::uint32_t beyond = old.neighbours[k];
  const int m = beyond == no_index ? 0 : across(cell, k).k;
  const auto second = static_cast<std::uint32_t>(cells_.size());
  cells_[cell] = {{a, p, c}, {no_index, second, old.neighbours[previous(k)]}, {fixed, 0, old.is_fixed[previous(k)]}};
  cells_.push_back({{p, b, c}, {no_index, old.neighbours[next(k)], cell}, {fixed, old.is_fixed[next(k)], 0}});
  link(second, 1, old.neighbours[next(k)], cell);
  suspect_.insert(suspect_.end(), {{b, c}, {c, a}});
  if (beyond != no_index) {  // (b, a, d)
    const Cell other = cells_[beyond];
    const std::uint32_t d = other.vertices[previous(m)];
    const auto fourth = static_cast<std::uint32_t>(cells_.size());
    cells_[beyond] = {
        {b, p, d}, {second, fourth, other.neighbours[previous(m)]}, {fixed, 0, other.is_fixed[previous(m)]}};
    cells_.push_back({{p, a, d}, {cell, other.neighbours[next(m)], beyond}, {fixed, other.is_fixed[next(m)], 0}});
    link(fourth, 1, other.neighbours[next(m)], beyond);
    cells_[cell].neighbours[0] = fourth;
    cells_[second].neighbours[0] = beyond;
    note(beyond);
    note(fourth);
    suspect_.insert(suspect_.end(), {{a, d}, {d, b}});
  }
  note(cell);
  note(second);
}

/// Turns the edge k of a cell inside its quadrilateral: (a, b, c) + (b, a, d) becomes (c, a, d) + (d, b, c).
void ConstrainedTriangulation::flip(std::uint32_t cell, int k) {
  const Edge beyond = across(cell, k);
  const Cell near = cells_[cell], far = cells_[beyond.cell];
  const std::uint32_t a = near.vertices[k], b = near.vertices[next(k)], c = near.vertices[previous(k)];
  const std::uint32_t d = far.vertices[previous(beyond.k)];
  const std::uint32_t bc = near.neighbours[next(k)], ca = near.neighbours[previous(k)];
  const std::uint32_t ad = far.neighbours[next(beyond.k)], db = far.neighbours[previous(beyond.k)];
  cells_[cell] = {{c, a, d}, {ca, ad, beyond.cell}, {near.is_fixed[previous(k)], far.is_fixed[next(beyond.k)], 0}};
  cells_[beyond.cell] = {{d, b, c}, {db, bc, cell}, {far.is_fixed[previous(beyond.k)], near.is_fixed[next(k)], 0}};
  link(cell, 1, ad, beyond.cell);
  link(beyond.cell, 1, bc, cell);
  note(cell);
  note(beyond.cell);
}

bool ConstrainedTriangulation::is_convex(std::uint32_t cell, int k) const {
  const Edge beyond = across(cell, k);
  const std::uint32_t a = cells_[cell].vertices[k], b = cells_[cell].vertices[next(k)];
  const std::uint32_t c = cells_[cell].vertices[previous(k)], d = cells_[beyond.cell].vertices[previous(beyond.k)];
  return points_->orientation(c, a, d) > 0 && points_->orientation(d, b, c) > 0;
}

/// Calls visit(cell, corner) for each cell at a vertex until it returns true.
template <class Visit>
bool ConstrainedTriangulation::around(std::uint32_t vertex, Visit&& visit) const {
  const auto corner_in = [&](std::uint32_t cell) {
    const auto& v = cells_[cell].vertices;
    return v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
  };
  const std::uint32_t start = cell_at_[vertex];
  std::uint32_t cell = start;
  do {  // counter-clockwise: leave over the edge that ends in the vertex
    const int k = corner_in(cell);
    if (visit(cell, k)) return true;
    cell = cells_[cell].neighbours[previous(k)];
  } while (cell != no_index && cell != start);
  if (cell == start) return false;
  for (cell = cells_[start].neighbours[corner_in(start)]; cell != no_index;) {
    const int k = corner_in(cell);
    if (visit(cell, k)) return true;
    cell = cells_[cell].neighbours[k];
  }
  return false;
}

bool ConstrainedTriangulation::find_edge(std::uint32_t from, std::uint32_t to, std::uint32_t& cell, int& k) const {
  return around(from, [&](std::uint32_t at, int corner) {
    if (cells_[at].vertices[next(corner)] == to) {
      cell = at;
      k = corner;
      return true;
    }
    if (cells_[at].vertices[previous(corner)] == to) {
      cell = at;
      k = previous(corner);
      return true;
    }
    return false;
  });
}

bool ConstrainedTriangulation::contains(std::uint32_t cell, std::uint32_t point, int& on_edge) const {
  const auto& v = cells_[cell].vertices;
  on_edge = -1;
  for (int k = 0; k < 3; ++k) {
    const int side = points_->orientation(v[k], v[next(k)], point);
    if (side < 0) return false;
    if (side == 0) on_edge = k;
  }
  return true;
}

bool ConstrainedTriangulation::locate(std::uint32_t point, std::uint32_t& cell, int& on_edge) const {
  // A walk towards the point; it may turn in circles where edges are fixed, then every cell is asked.
  cell = hint_ < cells_.size() ? hint_ : 0;
  std::uint32_t came_from = no_index;
  for (std::size_t step = 0; step < 16 + cells_.size() / 4; ++step) {
    const Cell& at = cells_[cell];
    int leave = -1;
    on_edge = -1;
    for (int i = 0; i < 3; ++i) {
      const int k = (i + static_cast<int>(step)) % 3;
      if (at.neighbours[k] != no_index && at.neighbours[k] == came_from) continue;
      const int side = points_->orientation(at.vertices[k], at.vertices[next(k)], point);
      if (side < 0) {
        leave = k;
        break;
      }
      if (side == 0) on_edge = k;
    }
    if (leave < 0) {
      if (contains(cell, point, on_edge)) return true;
      break;
    }
    if (at.neighbours[leave] == no_index) break;
    came_from = cell;
    cell = at.neighbours[leave];
  }
  for (cell = 0; cell < cells_.size(); ++cell)
    if (contains(cell, point, on_edge)) return true;
  return false;
}

void ConstrainedTriangulation::split_edges_of_the_triangle() {
  for (auto& list : on_edge_) list.clear();
  for (std::uint32_t i = 3; i < points_->count(); ++i) {
    const PlaceInTriangle place = points_->place(i);
    if (place >= 3 && place < place_inside) on_edge_[place - 3].push_back(i);
  }
  for (int k = 0; k < 3; ++k) {
    const auto from = static_cast<std::uint32_t>(k), to = static_cast<std::uint32_t>(next(k));
    std::sort(on_edge_[k].begin(), on_edge_[k].end(),
              [&](std::uint32_t i, std::uint32_t j) { return points_->precedes(i, j, from, to); });
    std::uint32_t start = from;
    for (const std::uint32_t p : on_edge_[k]) {
      std::uint32_t cell = 0;
      int edge = 0;
      if (find_edge(start, to, cell, edge)) split_edge(cell, edge, p);
      start = p;
    }
  }
}

bool ConstrainedTriangulation::insert_inside(std::uint32_t point) {
  std::uint32_t cell = 0;
  int on_edge = -1;
  if (!locate(point, cell, on_edge)) return false;
  if (on_edge >= 0)
    split_edge(cell, on_edge, point);
  else
    split_cell(cell, point);
  hint_ = cell;
  return true;
}

void ConstrainedTriangulation::legalize() {
  while (!suspect_.empty()) {
    const auto [a, b] = suspect_.back();
    suspect_.pop_back();
    std::uint32_t cell = 0;
    int k = 0;
    if (!find_edge(a, b, cell, k) || cells_[cell].is_fixed[k] || cells_[cell].neighbours[k] == no_index) continue;
    const Edge beyond = across(cell, k);
    const Cell& near = cells_[cell];
    const std::uint32_t p = near.vertices[k], q = near.vertices[next(k)], c = near.vertices[previous(k)];
    const std::uint32_t d = cells_[beyond.cell].vertices[previous(beyond.k)];
    if (!points_->is_surely_in_circle(p, q, c, d) || !is_convex(cell, k)) continue;
    flip(cell, k);
    suspect_.insert(suspect_.end(), {{p, c}, {c, q}, {q, d}, {d, p}});
  }
}

bool ConstrainedTriangulation::insert_segment(std::uint32_t from, std::uint32_t to) {
  std::uint32_t cell = 0;
  int k = 0;
  const auto fix = [&] {
    cells_[cell].is_fixed[k] = 1;
    if (cells_[cell].neighbours[k] != no_index) {
      const Edge beyond = across(cell, k);
      cells_[beyond.cell].is_fixed[beyond.k] = 1;
    }
  };
  if (find_edge(from, to, cell, k)) {
    fix();
    return true;
  }
  // The first edge crossed is opposite to `from` in one of its cells; then walk to `to`.
  const bool found = around(from, [&](std::uint32_t at, int corner) {
    const std::uint32_t right = cells_[at].vertices[next(corner)], left = cells_[at].vertices[previous(corner)];
    if (points_->orientation(from, to, right) < 0 && points_->orientation(from, to, left) > 0) {
      cell = at;
      k = next(corner);
      return true;
    }
    return false;
  });
  if (!found) return false;
  crossed_.clear();
  for (std::size_t step = 0; step <= cells_.size(); ++step) {
    if (cells_[cell].is_fixed[k] || cells_[cell].neighbours[k] == no_index) return false;
    crossed_.push_back({cells_[cell].vertices[k], cells_[cell].vertices[next(k)]});
    const Edge beyond = across(cell, k);
    const std::uint32_t apex = cells_[beyond.cell].vertices[previous(beyond.k)];
    if (apex == to) break;
    const int side = points_->orientation(from, to, apex);
    if (side == 0) return false;
    cell = beyond.cell;
    // The apex is left of the segment: leave between it and the right end, and the other way round.
    k = side > 0 ? next(beyond.k) : previous(beyond.k);
  }
  // Flip the crossed edges until none crosses (Sloan 1993).
  std::size_t head = 0, stalled = 0;
  while (head < crossed_.size()) {
    const auto [a, b] = crossed_[head++];
    if (!find_edge(a, b, cell, k)) return false;
    if (!is_convex(cell, k)) {
      crossed_.push_back({a, b});
      if (++stalled > 2 * (crossed_.size() - head) + 4) return false;
      continue;
    }
    stalled = 0;
    const Edge beyond = across(cell, k);
    const std::uint32_t c = cells_[cell].vertices[previous(k)], d = cells_[beyond.cell].vertices[previous(beyond.k)];
    flip(cell, k);
    const bool ends_there = c == from || c == to || d == from || d == to;
    if (!ends_there && points_->orientation(from, to, c) * points_->orientation(from, to, d) < 0)
      crossed_.push_back({c, d});
    else
      suspect_.push_back({c, d});
  }
  if (!find_edge(from, to, cell, k)) return false;
  fix();
  return true;
}

bool ConstrainedTriangulation::build(const PointsInTriangle& points,
                                     const std::vector<std::array<std::uint32_t, 2>>& segments) {
  points_ = &points;
  hint_ = 0;
  suspect_.clear();
  cells_.assign(1, {{0, 1, 2}, {no_index, no_index, no_index}, {1, 1, 1}});
  cell_at_.assign(points.count(), 0);
  split_edges_of_the_triangle();
  legalize();
  for (std::uint32_t i = 3; i < points.count(); ++i) {
    if (points.place(i) != place_inside) continue;
    if (!insert_inside(i)) return false;
    legalize();
  }
  for (const auto& [from, to] : segments)
    if (!insert_segment(from, to)) return false;
  legalize();
  return true;
}

}  // namespace strataflow
