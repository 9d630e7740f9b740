#include "kernels/volumes/region_boundary.h"

#include <algorithm>

namespace strataflow {

SurfaceTriangles surface_triangles_of(const StructuralModel& model) {
  SurfaceTriangles surfaces{model.points, model.triangles, model.triangle_surface, model.point_line, {}};
  surfaces.point_line.resize(model.points.size(), -1);
  for (std::uint32_t l = 0; l < model.lines.size(); ++l) {
    const std::vector<std::uint32_t>& vertices = model.lines[l].vertices;
    for (std::size_t i = 0; i + (model.lines[l].is_closed() ? 0 : 1) < vertices.size(); ++i) {
      const std::uint32_t a = vertices[i], b = vertices[(i + 1) % vertices.size()];
      surfaces.segments.push_back({std::min(a, b), std::max(a, b), l});
    }
  }
  std::sort(surfaces.segments.begin(), surfaces.segments.end(), [](const LineSegment& a, const LineSegment& b) {
    if (a.first != b.first) return a.first < b.first;
    if (a.second != b.second) return a.second < b.second;
    return a.line < b.line;
  });
  return surfaces;
}

RegionBoundary region_boundary(const StructuralModel& model, const SurfaceTriangles& surfaces, std::uint32_t region) {
  RegionBoundary boundary;
  boundary.region = region;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Surface& surface = model.surfaces[surfaces.triangle_surface[t]];
    const int sides = (surface.region_minus == region ? 1 : 0) | (surface.region_plus == region ? 2 : 0);
    if (sides == 0) continue;
    boundary.triangles.push_back(t);
    boundary.sides.push_back(static_cast<std::uint8_t>(sides));
    boundary.points.insert(boundary.points.end(), surfaces.triangles[t].begin(), surfaces.triangles[t].end());
  }
  std::sort(boundary.points.begin(), boundary.points.end());
  boundary.points.erase(std::unique(boundary.points.begin(), boundary.points.end()), boundary.points.end());
  for (const std::uint32_t point : boundary.points) boundary.coordinates.push_back(surfaces.points[point]);
  for (const std::uint32_t t : boundary.triangles) {
    Triangle facet{};
    for (std::size_t k = 0; k < 3; ++k)
      facet[k] = static_cast<std::uint32_t>(
          std::lower_bound(boundary.points.begin(), boundary.points.end(), surfaces.triangles[t][k]) -
          boundary.points.begin());
    boundary.facets.push_back(facet);
  }
  return boundary;
}

}  // namespace strataflow
