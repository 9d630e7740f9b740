#include "kernels/topology/query_model.h"

#include <algorithm>
#include <limits>

#include "base/id.h"

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/topology/shell_containment.h"

namespace strataflow {

namespace {

std::vector<std::uint32_t> sorted_unique(std::vector<std::uint32_t> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

BoundingVolumeTree tree_of(const StructuralModel& model) {
  std::vector<FloatBox> boxes;
  boxes.reserve(model.triangles.size());
  for (const Triangle& t : model.triangles) {
    Box3 box;
    for (const std::uint32_t v : t) box.take(model.points[v]);
    boxes.push_back(enclosing(box));
  }
  return BoundingVolumeTree(boxes);
}

}  // namespace

ModelQueries::ModelQueries(const StructuralModel& model) : model_(model), tree_(tree_of(model)) {}

std::uint32_t ModelQueries::region_at(const Vec3& p) const {
  Box3 ray;
  ray.take(p);
  ray.take(Vec3{p.x, p.y, std::max(p.z, model_.box.high.z)});
  // The parity of crossings above p, per region: odd for the one region that holds p.
  std::vector<std::uint32_t> crossed;
  std::uint32_t on_surface = no_index;
  tree_.visit_items(enclosing(ray), [&](std::uint32_t t) {
    const Triangle& v = model_.triangles[t];
    const RayMeeting meeting = meeting_of_upward_ray(p, model_.points[v[0]], model_.points[v[1]], model_.points[v[2]]);
    if (meeting == RayMeeting::misses) return;
    const Surface& surface = model_.surfaces[model_.triangle_surface[t]];
    if (meeting == RayMeeting::starts_on) {
      on_surface = std::min(on_surface, std::min(surface.region_plus, surface.region_minus));
    } else if (!surface.is_dangling()) {
      crossed.push_back(surface.region_plus);
      crossed.push_back(surface.region_minus);
    }
  });
  if (on_surface != no_index) return on_surface;
  std::sort(crossed.begin(), crossed.end());
  for (std::size_t begin = 0; begin < crossed.size();) {
    std::size_t end = begin;
    while (end < crossed.size() && crossed[end] == crossed[begin]) ++end;
    if (crossed[begin] != universe && (end - begin) % 2 == 1) return crossed[begin];
    begin = end;
  }
  return universe;
}

std::vector<PathCrossing> ModelQueries::crossings_along(const std::vector<Vec3>& path) const {
  std::vector<PathCrossing> crossings;
  double start_m = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec3 &p = path[i], &q = path[i + 1];
    const double segment_m = length(q - p);
    Box3 box;
    box.take(p);
    box.take(q);
    tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
      const Triangle& v = model_.triangles[t];
      const Vec3 &a = model_.points[v[0]], &b = model_.points[v[1]], &c = model_.points[v[2]];
      const int p_side = orientation_3d(a, b, c, p), q_side = orientation_3d(a, b, c, q);
      if (p_side == q_side) return;
      const int first = orientation_3d(p, q, a, b), second = orientation_3d(p, q, b, c), third = orientation_3d(p, q, c, a);
      if (std::min({first, second, third}) < 0 && std::max({first, second, third}) > 0) return;
      const Vec3 n = cross(b - a, c - a);
      const double to_p = dot(n, p - a), to_q = dot(n, q - a);
      // An end that lies on the plane exactly is the place: where two segments join, both then give the same one.
      const double share = p_side == 0 || to_p == to_q ? 0.0 : q_side == 0 ? 1.0 : std::clamp(to_p / (to_p - to_q), 0.0, 1.0);
      crossings.push_back({model_.triangle_surface[t], start_m + share * segment_m, p + share * (q - p)});
    });
    start_m += segment_m;
  }
  std::sort(crossings.begin(), crossings.end(), [](const PathCrossing& a, const PathCrossing& b) {
    if (a.at_m != b.at_m) return a.at_m < b.at_m;
    if (a.surface != b.surface) return a.surface < b.surface;
    return lexicographically_less(a.point, b.point);
  });
  // A path through an edge or a vertex meets every triangle there: one crossing of the surface.
  const auto same = [](const PathCrossing& a, const PathCrossing& b) { return a.surface == b.surface && a.at_m == b.at_m; };
  crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
  return crossings;
}

std::vector<PathStretch> ModelQueries::regions_along(const std::vector<Vec3>& path) const {
  std::vector<double> stops{0.0};
  for (const PathCrossing& crossing : crossings_along(path)) stops.push_back(crossing.at_m);
  std::vector<double> vertex_at{0.0};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) vertex_at.push_back(vertex_at.back() + length(path[i + 1] - path[i]));
  stops.push_back(vertex_at.back());
  const auto point_at = [&](double at_m) {
    const auto after = std::upper_bound(vertex_at.begin(), vertex_at.end(), at_m);
    const auto i = static_cast<std::size_t>(std::min(after, vertex_at.end() - 1) - vertex_at.begin());
    const double segment_m = vertex_at[i] - vertex_at[i - 1];
    return path[i - 1] + (at_m - vertex_at[i - 1]) / (segment_m > 0 ? segment_m : 1.0) * (path[i] - path[i - 1]);
  };
  std::vector<PathStretch> stretches;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    if (!(stops[i + 1] > stops[i])) continue;
    const std::uint32_t region = region_at(point_at(0.5 * (stops[i] + stops[i + 1])));
    if (!stretches.empty() && stretches.back().region == region)
      stretches.back().end_m = stops[i + 1];
    else
      stretches.push_back({region, stops[i], stops[i + 1]});
  }
  return stretches;
}

std::vector<std::uint32_t> ModelQueries::surfaces_of_line(std::uint32_t line) const {
  return sorted_unique(model_.lines[line].surfaces);
}

std::vector<std::uint32_t> ModelQueries::lines_of_corner(std::uint32_t corner) const {
  std::vector<std::uint32_t> lines;
  for (std::uint32_t l = 0; l < model_.lines.size(); ++l)
    if (model_.lines[l].corners[0] == corner || model_.lines[l].corners[1] == corner) lines.push_back(l);
  return lines;
}

std::vector<std::uint32_t> ModelQueries::surfaces_of_region(std::uint32_t region) const {
  std::vector<std::uint32_t> surfaces;
  for (std::uint32_t s = 0; s < model_.surfaces.size(); ++s)
    if (model_.surfaces[s].region_plus == region || model_.surfaces[s].region_minus == region) surfaces.push_back(s);
  return surfaces;
}

std::vector<std::uint32_t> ModelQueries::neighbours_of_region(std::uint32_t region) const {
  std::vector<std::uint32_t> neighbours;
  for (const std::uint32_t s : surfaces_of_region(region)) {
    const Surface& surface = model_.surfaces[s];
    const std::uint32_t other = surface.region_plus == region ? surface.region_minus : surface.region_plus;
    if (other != universe && other != region) neighbours.push_back(other);
  }
  return sorted_unique(std::move(neighbours));
}

}  // namespace strataflow
