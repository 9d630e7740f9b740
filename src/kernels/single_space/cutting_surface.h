#pragma once
#include <optional>
#include <vector>

#include "kernels/intersection/bounding_volume_tree.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// The cutting surface of a single-space cut: finds where segments pass through it.
class CuttingSurface {
 public:
  CuttingSurface(const std::vector<Vec3>& points, std::vector<Triangle> triangles);

  struct Crossing {
    Vec3 point;
    double share = 0;  ///< along the segment
    std::uint32_t triangle = 0;
    bool is_single = true;  ///< the segment passes through in one place only
  };
  /// Where pq passes from one side of the surface to the other: decided exactly, placed by rounding; of several places
  /// the one nearest to p. A segment that only touches does not cross.
  std::optional<Crossing> cross_segment(const Vec3& p, const Vec3& q) const;
  /// Unit normal of one of its triangles.
  Vec3 normal(std::uint32_t triangle) const;

 private:
  const std::vector<Vec3>& points_;
  std::vector<Triangle> triangles_;
  BoundingVolumeTree tree_;
};

}  // namespace strataflow
