#pragma once
#include <cstdint>
#include <vector>

#include "kernels/hexes/labelled_tets.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

/// The triangles of one fault, to be hit by rays. Keeps a reference to the points.
class FaultSurface {
 public:
  FaultSurface(const LabelledTets& model, std::uint32_t entity) : FaultSurface(model, entity, model.points) {}
  /// The same fault with the model's points elsewhere: where it stands upright.
  FaultSurface(const LabelledTets& model, std::uint32_t entity, const std::vector<Vec3>& points);

  /// Whether the closed segment meets a closed triangle, decided exactly: rays through common edges are not lost.
  bool meets(const Vec3& a, const Vec3& b) const;

 private:
  const std::vector<Vec3>* points_;
  std::vector<Triangle> triangles_;
  BoundingVolumeTree tree_;
};

}  // namespace strataflow
