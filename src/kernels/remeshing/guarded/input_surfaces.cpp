#include "kernels/remeshing/guarded/input_surfaces.h"

#include <algorithm>

#include "kernels/contacts/surface_search.h"

namespace strataflow {

double square_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac),
               pp = dot(ap, ap);
  const double area = bb * cc - bc * bc, u = cc * pb - bc * pc, v = bb * pc - bc * pb;  // of b and c, times area
  if (area > 0 && u >= 0 && v >= 0 && u + v <= area) return std::max(0.0, pp - (u * pb + v * pc) / area);
  const auto from_edge = [](double along, double whole, double square) {  // from its first end: along / whole of it
    if (!(along > 0)) return square;
    return along >= whole ? square - 2 * along + whole : std::max(0.0, square - along * along / whole);
  };
  const double from_ab = from_edge(pb, bb, pp), from_ac = from_edge(pc, cc, pp);
  const double from_bc = from_edge(pc - pb - bc + bb, bb - 2 * bc + cc, pp - 2 * pb + bb);
  return std::min({from_ab, from_ac, from_bc});
}

InputSurfaces::InputSurfaces(const StructuralModel& model) : model_(model) {
  first_around_.assign(model.points.size() + 1, 0);
  for (const Triangle& t : model.triangles)
    for (const std::uint32_t v : t) ++first_around_[v + 1];
  for (std::size_t v = 0; v < model.points.size(); ++v) first_around_[v + 1] += first_around_[v];
  around_.resize(3 * model.triangles.size());
  std::vector<std::uint32_t> next(first_around_.begin(), first_around_.end() - 1);
  Box3 box;
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t)
    for (const std::uint32_t v : model.triangles[t]) {
      around_[next[v]++] = t;
      box.take(model.points[v]);
    }
  for (const Surface& surface : model.surfaces) {
    Box3 own;
    double area = 0;
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
      const Triangle& tri = model.triangles[t];
      const Vec3 &a = model.points[tri[0]], &b = model.points[tri[1]], &c = model.points[tri[2]];
      for (const Vec3* p : {&a, &b, &c}) own.take(*p);
      area += 0.5 * length(cross(b - a, c - a));
    }
    int flat = -1;
    for (int axis = 0; axis < 3; ++axis)
      if (own.low[axis] == own.high[axis]) flat = axis;
    flat_axis_.push_back(static_cast<std::int8_t>(flat));
    is_outermost_.push_back(flat >= 0 && (own.low[flat] == box.low[flat] || own.low[flat] == box.high[flat]));
    area_m2_.push_back(area);
  }
  first_arc_.push_back(0);
  for (const Line& line : model.lines) {
    arcs_.push_back(0);
    for (std::size_t k = 1; k < line.vertices.size() + line.is_closed(); ++k)
      arcs_.push_back(arcs_.back() + length(model.points[line.vertices[k % line.vertices.size()]] -
                                            model.points[line.vertices[k - 1]]));
    first_arc_.push_back(static_cast<std::uint32_t>(arcs_.size()));
  }
}

InputSurfaces::Place InputSurfaces::nearest(const Vec3& p, std::uint32_t start) const {
  const auto square = [&](std::uint32_t t) {
    const Triangle& c = model_.triangles[t];
    return square_distance(p, model_.points[c[0]], model_.points[c[1]], model_.points[c[2]]);
  };
  const auto is_above = [&](std::uint32_t t) {  // no place beside it on the surface is nearer
    const Triangle& c = model_.triangles[t];
    const Vec3 ab = model_.points[c[1]] - model_.points[c[0]], ac = model_.points[c[2]] - model_.points[c[0]],
               n = cross(ab, ac), ap = p - model_.points[c[0]];
    const double whole = dot(n, n), u = dot(cross(ap, ac), n), v = dot(cross(ab, ap), n);
    return u > 0 && v > 0 && u + v < whole;
  };
  const std::uint32_t surface = model_.triangle_surface[start];
  std::uint32_t best = start;
  double best_square = square(start);
  for (std::uint32_t from = no_index; from != best && !is_above(best);) {
    from = best;
    for (const std::uint32_t v : model_.triangles[from])
      for (const std::uint32_t t : around(v)) {
        if (t == from || model_.triangle_surface[t] != surface) continue;
        const double d = square(t);
        if (!(d < best_square)) continue;
        best = t;
        best_square = d;
      }
  }
  const Triangle& c = model_.triangles[best];
  return {best, nearest_on_triangle(p, model_.points[c[0]], model_.points[c[1]], model_.points[c[2]])};
}

Vec3 InputSurfaces::line_vertex(std::uint32_t line, std::size_t index) const {
  const auto& vertices = model_.lines[line].vertices;
  return model_.points[vertices[index % vertices.size()]];
}

Vec3 InputSurfaces::point_at(std::uint32_t line, double arc_m) const {
  const double* first = arcs_.data() + first_arc_[line];
  const double* end = arcs_.data() + first_arc_[line + 1];
  if (model_.lines[line].is_closed() && arc_m >= *(end - 1)) arc_m -= *(end - 1);
  const double* after = std::upper_bound(first, end, arc_m);
  if (after == first) return line_vertex(line, 0);
  const auto k = static_cast<std::size_t>(after - first) - 1;
  const Vec3 a = line_vertex(line, k);
  if (after == end || first[k] == arc_m) return a;
  const Vec3 b = line_vertex(line, k + 1);
  Vec3 q = a + ((arc_m - first[k]) / (first[k + 1] - first[k])) * (b - a);
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis] == b[axis]) q[axis] = a[axis];
  return q;
}

double InputSurfaces::deviation_m(std::uint32_t line, double from_m, double to_m, const Vec3& a, const Vec3& b) const {
  const double* first = arcs_.data() + first_arc_[line];
  const double* end = arcs_.data() + first_arc_[line + 1];
  double most = 0;
  const auto look = [&](double from, double to) {
    for (const double* k = std::upper_bound(first, end, from); k != end && *k < to; ++k) {
      const Vec3 p = line_vertex(line, static_cast<std::size_t>(k - first));
      most = std::max(most, length(nearest_on_segment(p, a, b) - p));
    }
  };
  if (from_m < to_m) {
    look(from_m, to_m);
  } else {
    look(from_m, std::numeric_limits<double>::infinity());
    look(-1, to_m);
  }
  return most;
}

}  // namespace strataflow
