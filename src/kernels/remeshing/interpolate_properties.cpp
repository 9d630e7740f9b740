#include "kernels/remeshing/interpolate_properties.h"

#include <array>
#include <cmath>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "kernels/contacts/surface_search.h"
#include "kernels/quality/nearest_triangle.h"

namespace strataflow {

namespace {

struct Place {
  Triangle corners{};
  std::array<double, 3> weight{};
};

Place place_of(const StructuralModel& model, const Vec3& p, std::uint32_t triangle) {
  Place place{model.triangles[triangle], {1, 0, 0}};
  const auto [i, j, k] = place.corners;
  const Vec3 &a = model.points[i], &b = model.points[j], &c = model.points[k], q = nearest_on_triangle(p, a, b, c);
  const Vec3 normal = cross(b - a, c - a);
  if (const double square = dot(normal, normal); square > 0) {
    place.weight[1] = std::clamp(dot(cross(q - a, c - a), normal) / square, 0.0, 1.0);
    place.weight[2] = std::clamp(dot(cross(b - a, q - a), normal) / square, 0.0, 1.0 - place.weight[1]);
    place.weight[0] = 1 - place.weight[1] - place.weight[2];
  }
  return place;
}

}  // namespace

std::vector<PointProperty> interpolate_properties(const StructuralModel& model, std::span<const Vec3> points) {
  std::vector<PointProperty> properties;
  if (model.properties.empty() || model.triangles.empty()) return properties;
  const NearestTriangle nearest({model.points, model.triangles});
  const std::vector<Place> places = parallel_map(
      points.size(), [&](std::size_t i) { return place_of(model, points[i], nearest.nearest(points[i]).triangle); },
      256);
  for (const PointProperty& from : model.properties) {
    PointProperty& to = properties.emplace_back(PointProperty{from.name, from.unit, from.width, {}});
    to.values.reserve(points.size() * from.width);
    for (const Place& place : places)
      for (std::uint32_t n = 0; n < from.width; ++n) {
        double sum = 0, whole = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const double value = from.values[place.corners[k] * std::size_t{from.width} + n];
          if (!(place.weight[k] > 0) || std::isnan(value)) continue;
          sum += place.weight[k] * value;
          whole += place.weight[k];
        }
        to.values.push_back(whole > 0 ? sum / whole : std::numeric_limits<double>::quiet_NaN());
      }
  }
  return properties;
}

}  // namespace strataflow
