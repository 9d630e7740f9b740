#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// The triangles of a soup over welded points; those with a repeated position are left out.
struct WeldedSoup {
  std::vector<std::uint32_t> id;      ///< per point of the soup: its welded point
  std::vector<Vec3> points;           ///< welded
  std::vector<Triangle> triangles;    ///< indices into points
  std::vector<std::uint32_t> entity;  ///< per triangle
  std::vector<std::uint32_t> origin;  ///< per triangle: the one of the soup

  explicit WeldedSoup(const TriangleSoup& soup);
};

}  // namespace strataflow
