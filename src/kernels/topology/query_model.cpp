#include "kernels/topology/query_model.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "base/id.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/topology/building/shell_containment.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

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

/// A crossing and what is hit, decided exactly: {2·i, 0, 0} vertex i of the path; inside segment i {2·i + 1, v, v} a
/// vertex of the model, {2·i + 1, v, w} its edge from v to w > v, {2·i + 1, no_index, t} the inside of triangle t.
struct Hit {
  PathCrossing crossing;
  std::array<std::uint32_t, 3> target;
};

/// Where segment i of a path meets a triangle, if not along it. Hits of the same target get the same place to the bit,
/// whatever the triangle.
std::optional<Hit> hit_of(const StructuralModel& model, std::uint32_t triangle, const std::vector<Vec3>& path,
                          std::uint32_t i, double start_m, double segment_m) {
  const Triangle& v = model.triangles[triangle];
  const Vec3 &p = path[i], &q = path[i + 1], &a = model.points[v[0]], &b = model.points[v[1]], &c = model.points[v[2]];
  const int p_side = orientation_3d(a, b, c, p), q_side = orientation_3d(a, b, c, q);
  if (p_side == q_side) return std::nullopt;
  const std::array<int, 3> turn{orientation_3d(p, q, a, b), orientation_3d(p, q, b, c), orientation_3d(p, q, c, a)};
  if (*std::min_element(turn.begin(), turn.end()) < 0 && *std::max_element(turn.begin(), turn.end()) > 0)
    return std::nullopt;
  const std::uint32_t surface = model.triangle_surface[triangle];
  if (p_side == 0) return Hit{{surface, start_m, p}, {2 * i, 0, 0}};
  if (q_side == 0) return Hit{{surface, start_m + segment_m, q}, {2 * i + 2, 0, 0}};

  const Vec3 d = q - p;
  const auto hit_at = [&](double share, std::uint32_t first, std::uint32_t second) {
    share = std::clamp(share, 0.0, 1.0);
    return Hit{{surface, start_m + share * segment_m, p + share * d}, {2 * i + 1, first, second}};
  };
  const auto on_edges = std::count(turn.begin(), turn.end(), 0);
  if (on_edges == 0) {
    const Vec3 n = cross(b - a, c - a);
    const double to_p = dot(n, p - a), to_q = dot(n, q - a);
    return hit_at(to_p == to_q ? 0.0 : to_p / (to_p - to_q), no_index, triangle);
  }
  if (on_edges == 1) {
    const auto k = static_cast<std::size_t>(std::find(turn.begin(), turn.end(), 0) - turn.begin());
    const auto [low, high] = std::minmax({v[k], v[(k + 1) % 3]});
    const Vec3 e = model.points[high] - model.points[low], n = cross(d, e);
    return hit_at(dot(cross(model.points[low] - p, e), n) / dot(n, n), low, high);
  }
  const std::uint32_t vertex = turn[0] != 0 ? v[2] : turn[1] != 0 ? v[0] : v[1];
  return hit_at(dot(model.points[vertex] - p, d) / dot(d, d), vertex, vertex);
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
  std::vector<Hit> hits;
  double start_m = 0;
  for (std::uint32_t i = 0; i + 1 < path.size(); ++i) {
    const double segment_m = length(path[i + 1] - path[i]);
    Box3 box;
    box.take(path[i]);
    box.take(path[i + 1]);
    tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
      if (auto hit = hit_of(model_, t, path, i, start_m, segment_m)) hits.push_back(*hit);
    });
    start_m += segment_m;
  }
  // A path through an edge or a vertex, or with a vertex of its own on a surface, meets every triangle there: one
  // crossing of the surface. Which hits are the same is decided by what they hit, not by where the roundings put it.
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return std::tie(a.crossing.surface, a.target) < std::tie(b.crossing.surface, b.target);
  });
  const auto same = [](const Hit& a, const Hit& b) {
    return a.crossing.surface == b.crossing.surface && a.target == b.target;
  };
  hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return std::tie(a.crossing.at_m, a.crossing.surface, a.target) <
           std::tie(b.crossing.at_m, b.crossing.surface, b.target);
  });
  std::vector<PathCrossing> crossings;
  for (const Hit& hit : hits) crossings.push_back(hit.crossing);
  return crossings;
}

std::vector<PathStretch> ModelQueries::regions_along(const std::vector<Vec3>& path) const {
  std::vector<double> stops{0.0};
  for (const PathCrossing& crossing : crossings_along(path)) stops.push_back(crossing.at_m);
  std::vector<double> vertex_at{0.0};
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    vertex_at.push_back(vertex_at.back() + length(path[i + 1] - path[i]));
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
