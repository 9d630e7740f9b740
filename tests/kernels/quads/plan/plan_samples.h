#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "kernels/quads/plan/plan_mesh.h"
#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow::plan_samples {

inline Polyline line(std::string name, Role role, std::vector<Vec3> points, bool is_closed = false) {
  return {std::move(name), role, std::move(points), is_closed};
}
inline Polyline fault(std::string name, std::vector<Vec3> points) {
  return line(std::move(name), Role::fault, std::move(points));
}
inline Polyline square(double side) {
  return line("outline", Role::outline, {{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}, true);
}
inline PlanOptions edge(double length_m) {
  PlanOptions options;
  options.edge_length_m = length_m;
  return options;
}

inline std::uint32_t feature_named(const std::vector<Feature>& features, const std::string& name) {
  for (std::uint32_t f = 0; f < features.size(); ++f)
    if (features[f].name == name) return f;
  return static_cast<std::uint32_t>(features.size());
}

/// Total length of a feature's edges.
inline double feature_length(const FeatureMesh& mesh, const std::string& name) {
  double sum = 0;
  for (const FeatureEdge& e : mesh.edges)
    if (mesh.features[e.feature].name == name) sum += length(mesh.points[e.a] - mesh.points[e.b]);
  return sum;
}

/// Distance from p to a feature's edges.
inline double distance_to_feature(const FeatureMesh& mesh, const std::string& name, const Vec3& p) {
  double least = 1e300;
  for (const FeatureEdge& e : mesh.edges)
    if (mesh.features[e.feature].name == name)
      least = std::min(least, distance_to_segment(p, mesh.points[e.a], mesh.points[e.b]));
  return least;
}

/// The largest distance from points along an input line to the feature of its name, skipping points outside the mesh.
inline double furthest_from_feature(const FeatureMesh& mesh, const Polyline& input) {
  const auto is_inside = [&](const Vec3& p) {
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return closed_triangle_holds(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], p);
    });
  };
  double most = 0;
  const std::size_t n = input.points.size();
  for (std::size_t i = 0; i + (input.is_closed ? 0 : 1) < n; ++i)
    for (int k = 0; k <= 8; ++k) {
      Vec3 p = between(input.points[i], input.points[(i + 1) % n], k / 8.0);
      p.z = 0;
      const double away = distance_to_feature(mesh, input.name, p);
      if (away > most && (input.role == Role::outline || is_inside(p))) most = away;
    }
  return most;
}

inline double mesh_area(const FeatureMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += 0.5 * cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]).z;
  return sum;
}

inline bool all_counter_clockwise(const FeatureMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return turn(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) > 0;
  });
}

inline bool has_corner_at(const FeatureMesh& mesh, const Vec3& p, double within = 1e-9) {
  return std::any_of(mesh.corners.begin(), mesh.corners.end(),
                     [&](std::uint32_t c) { return length(mesh.points[c] - p) <= within; });
}

inline int changes_of_kind(const std::vector<Change>& changes, const std::string& kind) {
  return static_cast<int>(
      std::count_if(changes.begin(), changes.end(), [&](const Change& c) { return c.kind == kind; }));
}

}  // namespace strataflow::plan_samples
