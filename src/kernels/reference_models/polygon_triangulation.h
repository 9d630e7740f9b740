#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// A corner of a flat polygon: a point of the model and where it lies in the polygon's own plane, metres.
struct PolygonNode {
  std::uint32_t point = 0;
  double u = 0, v = 0;
};

/// Triangulates a simple polygon given counter-clockwise, without new points, by cutting the ear whose smallest angle
/// in space is largest. Collinear corners are fine. Consumes `polygon`; appends to `triangles`.
void triangulate_polygon(std::vector<PolygonNode>& polygon, const std::vector<Vec3>& points,
                         std::vector<Triangle>& triangles);

/// Triangulates the strip between two chains of points that run side by side, always along the shorter diagonal.
/// Chains may share their first or last point. Triangles turn left → right → up the chains.
void triangulate_strip(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right,
                       const std::vector<Vec3>& points, std::vector<Triangle>& triangles);

}  // namespace strataflow
