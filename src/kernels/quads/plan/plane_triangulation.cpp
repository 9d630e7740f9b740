#include "kernels/quads/plan/plane_triangulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/quads/plan/plane_geometry.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {

PlaneTriangulation::PlaneTriangulation(std::vector<Vec3> points, std::vector<Triangle> triangles,
                                       std::span<const std::array<std::uint32_t, 2>> fixed_edges)
    : points_(std::move(points)), triangles_(std::move(triangles)) {
  const EdgeTable table = build_edge_table(points_.size(), triangles_);
  across_.assign(3 * triangles_.size(), no_index);
  label_.assign(3 * triangles_.size(), no_index);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    const auto around = table.around(e);
    if (around.size() == 2) {
      across_[around[0]] = around[1];
      across_[around[1]] = around[0];
    }
  }
  for (std::uint32_t i = 0; i < fixed_edges.size(); ++i) {
    const std::uint32_t e = find_edge(table, fixed_edges[i][0], fixed_edges[i][1]);
    if (e == no_index) continue;
    for (const std::uint32_t h : table.around(e)) label_[h] = i;
  }
  triangle_at_.assign(points_.size(), no_index);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (const std::uint32_t p : triangles_[t]) triangle_at_[p] = t;
}

std::vector<std::uint32_t> PlaneTriangulation::half_edges_from(std::uint32_t point) const {
  std::vector<std::uint32_t> out;
  const std::uint32_t t = triangle_at_[point];
  if (t == no_index) return out;
  std::uint32_t first = 3 * t;
  while (origin(first) != point) ++first;
  // Clockwise to the boundary, or once around.
  for (std::uint32_t h = first;;) {
    const std::uint32_t clockwise = across_[h];
    if (clockwise == no_index) {
      first = h;
      break;
    }
    h = next(clockwise);
    if (h == first) break;
  }
  for (std::uint32_t h = first;;) {
    out.push_back(h);
    const std::uint32_t counter = across_[previous(h)];
    if (counter == no_index || counter == first) break;
    h = counter;
  }
  return out;
}

void PlaneTriangulation::keep(const std::vector<char>& is_kept) {
  std::vector<std::uint32_t> number(triangles_.size(), no_index);
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    if (is_kept[t]) number[t] = count++;
  triangle_at_.assign(points_.size(), no_index);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (!is_kept[t]) continue;
    const std::uint32_t to = number[t];
    triangles_[to] = triangles_[t];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t g = across_[3 * t + k];
      across_[3 * to + k] = g == no_index || number[g / 3] == no_index ? no_index : 3 * number[g / 3] + g % 3;
      label_[3 * to + k] = label_[3 * t + k];
      triangle_at_[triangles_[to][k]] = to;
    }
  }
  triangles_.resize(count);
  across_.resize(3 * count);
  label_.resize(3 * count);
}

void PlaneTriangulation::set(std::uint32_t t, const Triangle& corners, const std::array<std::uint32_t, 3>& across,
                             const std::array<std::uint32_t, 3>& labels) {
  triangles_[t] = corners;
  for (std::uint32_t k = 0; k < 3; ++k) {
    across_[3 * t + k] = across[k];
    if (across[k] != no_index) across_[across[k]] = 3 * t + k;
    label_[3 * t + k] = labels[k];
    triangle_at_[corners[k]] = t;
  }
  touched_.push_back(t);
}

std::uint32_t PlaneTriangulation::add_triangle() {
  triangles_.push_back({});
  across_.resize(across_.size() + 3, no_index);
  label_.resize(label_.size() + 3, no_index);
  return static_cast<std::uint32_t>(triangles_.size() - 1);
}

bool PlaneTriangulation::split_edge(std::uint32_t h, const Vec3& p) {
  const std::uint32_t a = origin(h), b = target(h), c = apex(h), g = across_[h];
  if (turn(points_[a], p, points_[c]) <= 0 || turn(p, points_[b], points_[c]) <= 0) return false;
  const std::uint32_t d = g == no_index ? no_index : apex(g);
  if (g != no_index && (turn(points_[b], p, points_[d]) <= 0 || turn(p, points_[a], points_[d]) <= 0)) return false;
  const auto m = static_cast<std::uint32_t>(points_.size());
  points_.push_back(p);
  triangle_at_.push_back(no_index);
  const std::uint32_t label = label_[h], t = h / 3;
  const std::uint32_t bc = across_[next(h)], bc_label = label_[next(h)];
  const std::uint32_t ca = across_[previous(h)], ca_label = label_[previous(h)];
  const std::uint32_t new_t = add_triangle();
  // t = (a, m, c), new_t = (m, b, c)
  set(new_t, {m, b, c}, {no_index, bc, no_index}, {label, bc_label, no_index});
  set(t, {a, m, c}, {no_index, 3 * new_t + 2, ca}, {label, no_index, ca_label});
  if (g != no_index) {
    const std::uint32_t u = g / 3;
    const std::uint32_t ad = across_[next(g)], ad_label = label_[next(g)];
    const std::uint32_t db = across_[previous(g)], db_label = label_[previous(g)];
    const std::uint32_t new_u = add_triangle();
    // u = (b, m, d), new_u = (m, a, d)
    set(new_u, {m, a, d}, {3 * t, ad, no_index}, {label, ad_label, no_index});
    set(u, {b, m, d}, {3 * new_t, 3 * new_u + 2, db}, {label, no_index, db_label});
  }
  std::vector<std::uint32_t> suspects;
  for (const std::uint32_t out : half_edges_from(m)) suspects.push_back(next(out));
  make_delaunay(std::move(suspects));
  return true;
}

bool PlaneTriangulation::split_triangle(std::uint32_t t, const Vec3& p) {
  const Triangle corner = triangles_[t];
  for (int k = 0; k < 3; ++k)
    if (turn(points_[corner[k]], points_[corner[(k + 1) % 3]], p) <= 0) return false;
  const auto m = static_cast<std::uint32_t>(points_.size());
  points_.push_back(p);
  triangle_at_.push_back(no_index);
  const std::array<std::uint32_t, 3> across{across_[3 * t], across_[3 * t + 1], across_[3 * t + 2]};
  const std::array<std::uint32_t, 3> label{label_[3 * t], label_[3 * t + 1], label_[3 * t + 2]};
  const std::uint32_t parts[3] = {t, add_triangle(), add_triangle()};
  for (std::uint32_t k = 0; k < 3; ++k)
    set(parts[k], {corner[k], corner[(k + 1) % 3], m},
        {across[k], 3 * parts[(k + 1) % 3] + 2, 3 * parts[(k + 2) % 3] + 1}, {label[k], no_index, no_index});
  make_delaunay({3 * parts[0], 3 * parts[1], 3 * parts[2]});
  return true;
}

bool PlaneTriangulation::flip(std::uint32_t h) {
  const std::uint32_t g = across_[h];
  if (g == no_index || is_fixed(h)) return false;
  const std::uint32_t a = origin(h), b = target(h), c = apex(h), d = apex(g);
  if (turn(points_[a], points_[d], points_[c]) <= 0 || turn(points_[d], points_[b], points_[c]) <= 0) return false;
  const std::uint32_t bc = next(h), ca = previous(h), ad = next(g), db = previous(g);
  const std::array<std::uint32_t, 4> across{across_[ad], across_[ca], across_[db], across_[bc]};
  const std::array<std::uint32_t, 4> label{label_[ad], label_[ca], label_[db], label_[bc]};
  const std::uint32_t t = h / 3, u = g / 3;
  set(t, {a, d, c}, {across[0], no_index, across[1]}, {label[0], no_index, label[1]});
  set(u, {d, b, c}, {across[2], across[3], 3 * t + 1}, {label[2], label[3], no_index});
  return true;
}

bool PlaneTriangulation::in_circle(const Triangle& t, const Vec3& p) const {
  const double ax = points_[t[0]].x - p.x, ay = points_[t[0]].y - p.y;
  const double bx = points_[t[1]].x - p.x, by = points_[t[1]].y - p.y;
  const double cx = points_[t[2]].x - p.x, cy = points_[t[2]].y - p.y;
  const double bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
  const double a = ax * ax + ay * ay, b = bx * bx + by * by, c = cx * cx + cy * cy;
  const double determinant = a * (bc - cb) + b * (ca - ac) + c * (ab - ba);
  const double permanent =
      (std::abs(bc) + std::abs(cb)) * a + (std::abs(ca) + std::abs(ac)) * b + (std::abs(ab) + std::abs(ba)) * c;
  return determinant > 16 * 0x1.0p-53 * permanent;
}

void PlaneTriangulation::make_delaunay(std::vector<std::uint32_t> suspects) {
  // A certain sign means that every flip lowers the lifted surface: the loop ends.
  while (!suspects.empty()) {
    const std::uint32_t h = suspects.back();
    suspects.pop_back();
    const std::uint32_t g = across_[h];
    if (g == no_index || is_fixed(h) || !in_circle(triangles_[h / 3], points_[apex(g)])) continue;
    if (!flip(h)) continue;
    const std::uint32_t t = h / 3, u = g / 3;
    for (const std::uint32_t e : {3 * t, 3 * t + 2, 3 * u, 3 * u + 1}) suspects.push_back(e);
  }
}

bool PlaneTriangulation::move(std::uint32_t point, const Vec3& to) {
  const Vec3 before = points_[point];
  const auto out = half_edges_from(point);
  for (const std::uint32_t h : out)
    if (turn(to, points_[target(h)], points_[apex(h)]) <= 0) return false;
  points_[point] = to;
  return before != to;
}

std::vector<std::uint32_t> PlaneTriangulation::take_touched() {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  return std::exchange(touched_, {});
}

}  // namespace strataflow
