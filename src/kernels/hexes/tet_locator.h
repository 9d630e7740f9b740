#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/hexes/layered_space.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

/// Finds tetrahedra in (U, V, W). W is scaled by `w_scale_m`, metres per layer, so that distances mean something in all
/// directions. Safe to read from several threads; keeps a reference to `space`.
class TetLocator {
 public:
  TetLocator(const LayeredSpace& space, double w_scale_m);

  /// A tetrahedron, and how far outside of it a point lies, metres; ≤ 0 inside.
  struct Place {
    std::uint32_t tet = no_index;
    double outside_m = 0;
  };

  /// (u, v, w · scale).
  Vec3 at(const Vec3& plan, double w) const { return {plan.x, plan.y, w * w_scale_m_}; }
  /// The tetrahedron that holds p; of several the one whose faces are furthest from it, then the lowest. None: the
  /// least far outside, if any is within `reach_m`.
  Place locate(const Vec3& p, double reach_m) const;
  /// Tetrahedra that reach into the ball around p, ascending.
  std::vector<std::uint32_t> in_ball(const Vec3& p, double radius_m) const;
  /// How far p lies outside a tetrahedron: the largest signed distance from its faces, metres.
  double outside_m(std::uint32_t tet, const Vec3& p) const;
  /// The point of a tetrahedron at the height of p that is nearest to p, and how far away; infinite when the tetrahedron
  /// does not reach that height.
  struct LevelPoint {
    Vec3 at;
    double distance_m = 0;
  };
  LevelPoint nearest_at_level(std::uint32_t tet, const Vec3& p) const;
  /// The same of a face of a tetrahedron that is not level.
  LevelPoint nearest_on_face(std::uint32_t tet, std::uint32_t k, const Vec3& p) const;
  /// The position in XYZ that the affine map of a tetrahedron gives to p, even outside of it.
  Vec3 lifted(std::uint32_t tet, const Vec3& p) const;

 private:
  std::array<Vec3, 4> corners(std::uint32_t tet) const;

  const LayeredSpace& space_;
  double w_scale_m_ = 1;
  std::vector<char> is_flipped_;  ///< per tet: left aside
  BoundingVolumeTree tree_;
};

}  // namespace strataflow
