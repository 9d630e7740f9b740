#include "kernels/voronoi/site_density.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "graph/parallel/parallel_map.h"
#include "kernels/voronoi/site_neighbours.h"
#include "kernels/voronoi/triangle_cells.h"

namespace strataflow {

namespace {

/// Per point of the model, the distance to the nearest of `targets`; nothing to be near to: 0.
std::vector<double> distances_to(const StructuralModel& model, const std::vector<std::uint32_t>& targets) {
  std::vector<double> distances(model.points.size(), 0);
  if (targets.empty()) return distances;
  SiteNeighbours search;
  std::vector<Vec3> places;
  for (const std::uint32_t point : targets) places.push_back(model.points[point]);
  search.move_to(places);
  parallel_ranges(model.points.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& x = model.points[i];
      distances[i] = length(x - places[find_nearest_site(search, x, search.find_nearest_listed(x))]);
    }
  });
  return distances;
}

/// (1 − d / d_max)⁴
std::vector<double> falling_with(std::vector<double> distances) {
  const double farthest = *std::max_element(distances.begin(), distances.end());
  for (double& value : distances) {
    const double nearness = farthest > 0 ? 1 - value / farthest : 1;
    value = nearness * nearness * nearness * nearness;
  }
  return distances;
}

/// Per point, how much normals turn per metre around it: the largest over the inner edges of its surfaces, to the
/// fourth power, since spacing goes with the fourth root.
std::vector<double> bending(const StructuralModel& model) {
  std::vector<Vec3> normals;
  for (const auto& [a, b, c] : model.triangles) {
    const Vec3 n = cross(model.points[b] - model.points[a], model.points[c] - model.points[a]);
    normals.push_back(length(n) > 0 ? (1 / length(n)) * n : Vec3{});
  }
  struct Side {
    std::uint32_t low, high, surface, triangle;
  };
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = model.triangles[t][k], b = model.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), model.triangle_surface[t], t});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.surface, a.triangle) < std::tie(b.low, b.high, b.surface, b.triangle);
  });
  std::vector<double> largest(model.points.size(), 0);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &one = sides[i], &two = sides[i + 1];
    if (one.low != two.low || one.high != two.high || one.surface != two.surface) continue;
    const double angle = std::atan2(length(cross(normals[one.triangle], normals[two.triangle])),
                                    dot(normals[one.triangle], normals[two.triangle]));
    const double width = length(model.points[one.low] - model.points[one.high]);
    if (!(width > 0)) continue;
    const double rate = std::pow(angle / width, 4);
    largest[one.low] = std::max(largest[one.low], rate);
    largest[one.high] = std::max(largest[one.high], rate);
  }
  return largest;
}

}  // namespace

Result<std::vector<double>> site_density(const StructuralModel& model, const DensityOptions& options) {
  std::vector<double> density;
  switch (options.kind) {
    case DensityKind::uniform:
      break;
    case DensityKind::near_corners:
    case DensityKind::near_lines: {
      std::vector<std::uint32_t> targets;
      for (const Corner& corner : model.corners) targets.push_back(corner.vertex);
      if (options.kind == DensityKind::near_lines)
        for (const Line& line : model.lines) targets.insert(targets.end(), line.vertices.begin(), line.vertices.end());
      density = falling_with(distances_to(model, targets));
      break;
    }
    case DensityKind::curvature:
      density = bending(model);
      break;
    case DensityKind::property: {
      const auto found = std::find_if(model.properties.begin(), model.properties.end(),
                                      [&](const PointProperty& p) { return p.name == options.property; });
      if (found == model.properties.end())
        return Failure{FailureCode::invalid_input, "no point property is called '" + options.property + "'",
                       "name a property of the input's points in remesh.density_property"};
      if (found->width != 1 || found->values.size() != model.points.size())
        return Failure{FailureCode::invalid_input, "property '" + options.property + "' has several values a point",
                       "name one with one number a point"};
      density = found->values;
      for (double& value : density)
        if (!(value > 0) || !std::isfinite(value)) value = 0;  // also "no data"
      break;
    }
  }
  if (!density.empty()) {
    const double largest = *std::max_element(density.begin(), density.end());
    if (!(largest > 0)) {
      if (options.kind == DensityKind::property)
        return Failure{FailureCode::invalid_input, "property '" + options.property + "' is positive nowhere",
                       "densities of sites must be positive"};
      density.clear();  // flat everywhere: nothing to crowd at
    }
    for (double& value : density) value = std::max(value / largest, options.smallest_ratio);
  }
  if (options.surface_edge_length_m.empty()) return density;
  if (density.empty()) density.assign(model.points.size(), 1);
  std::vector<double> factor(model.points.size(), 0);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const double shrink = options.edge_length_m / options.surface_edge_length_m[model.triangle_surface[t]];
    for (const std::uint32_t point : model.triangles[t]) factor[point] = std::max(factor[point], std::pow(shrink, 4));
  }
  for (std::size_t i = 0; i < density.size(); ++i)
    if (factor[i] > 0) density[i] *= factor[i];
  return density;
}

}  // namespace strataflow
