#pragma once
#include <cstdint>
#include <vector>

#include "kernels/intersection/bounding_volume_tree.h"
#include "model/structural_model.h"

namespace strataflow {

/// A stretch of a path inside one region. Lengths are metres along the path from its first point.
struct PathStretch {
  std::uint32_t region = universe;
  double begin_m = 0;
  double end_m = 0;
};

/// Which surface a path pierces, and where.
struct PathCrossing {
  std::uint32_t surface = 0;
  double at_m = 0;  ///< along the path
  Vec3 point;
};

/// Answers questions about points and paths (euler1999 §2.1: point → region, volumes, well paths). Keeps a reference
/// to the model, which must outlive it.
class ModelQueries {
 public:
  explicit ModelQueries(const StructuralModel& model);

  /// The region a point lies in, `universe` outside. Decided exactly; a point on a surface belongs to one of its two
  /// regions, the same one every time.
  std::uint32_t region_at(const Vec3& p) const;

  /// Where a polyline pierces surfaces, in order along it. A path inside a surface's plane does not pierce it.
  std::vector<PathCrossing> crossings_along(const std::vector<Vec3>& path) const;

  /// The regions a polyline passes through, in order; touching stretches of one region are joined.
  std::vector<PathStretch> regions_along(const std::vector<Vec3>& path) const;

  /// Surfaces of a region, lines of a surface … are stored; these are the ones that are not.
  std::vector<std::uint32_t> surfaces_of_line(std::uint32_t line) const;
  std::vector<std::uint32_t> lines_of_corner(std::uint32_t corner) const;
  std::vector<std::uint32_t> surfaces_of_region(std::uint32_t region) const;
  std::vector<std::uint32_t> neighbours_of_region(std::uint32_t region) const;

 private:
  const StructuralModel& model_;
  BoundingVolumeTree tree_;
};

}  // namespace strataflow
