#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A triangle mesh that belongs to someone else.
struct TriangleMesh {
  std::span<const Vec3> points;
  std::span<const Triangle> triangles;
};

/// Finds the triangle nearest to a point. Copies what it needs; safe to read from several threads.
class NearestTriangle {
 public:
  struct Hit {
    std::uint32_t triangle = no_index;
    double squared_m2 = 0;  ///< infinite in an empty mesh
  };

  explicit NearestTriangle(const TriangleMesh& mesh);

  /// The nearest triangle, of equal ones the lowest. A good `guess` saves time and changes nothing else.
  Hit nearest(const Vec3& p, std::uint32_t guess = no_index) const;
  /// Whether a triangle lies within √squared_m2 of p. `guess` is tried first and becomes the one that does.
  bool is_within(const Vec3& p, double squared_m2, std::uint32_t& guess) const;
  /// Squared distance to one triangle.
  double squared_m2(const Vec3& p, std::uint32_t triangle) const;

 private:
  struct Shape {
    Vec3 a, ab, ac;
  };
  static double squared_m2(const Vec3& p, const Shape& shape);

  BoundingVolumeTree tree_;
  std::vector<Shape> shapes_;  ///< in the order of the tree
  std::vector<std::uint32_t> place_of_;
};

}  // namespace strataflow
