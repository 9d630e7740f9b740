#pragma once
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "kernels/hexes/layered_space.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

/// Finds tetrahedra in (U, V, W), or in (U, V, Z). W is scaled by `w_scale_m`, metres per layer, so that distances mean
/// something in all directions. Safe to read from several threads; keeps a reference to `space`.
class TetLocator {
 public:
  TetLocator(const LayeredSpace& space, double w_scale_m);
  /// In (U, V, Z): the place of W is taken by the model's height, metres, which no fault makes leap.
  static TetLocator of_heights(const LayeredSpace& space);

  /// A tetrahedron, and how far outside of it a point lies, metres; ≤ 0 inside.
  struct Place {
    std::uint32_t tet = no_index;
    double outside_m = 0;
    bool is_on_level = false;  ///< on a face that lies on the point's level: on a horizon, whatever W does beside it

    /// On a level, then furthest from the faces, then the lowest tetrahedron.
    bool is_before(const Place& other) const {
      return std::tuple(!is_on_level, outside_m, tet) < std::tuple(!other.is_on_level, other.outside_m, other.tet);
    }
  };

  /// (u, v, w · scale); of heights the scale is 1.
  Vec3 at(const Vec3& plan, double w) const { return {plan.x, plan.y, w * w_scale_m_}; }
  /// The tetrahedron that holds p; of several the first (Place::is_before). None: the least far outside, if any is
  /// within `reach_m`.
  Place locate(const Vec3& p, double reach_m) const;
  /// Tetrahedra that reach into the ball around p, ascending.
  std::vector<std::uint32_t> in_ball(const Vec3& p, double radius_m) const;
  Place place_in(std::uint32_t tet, const Vec3& p) const;
  /// How far p lies outside a tetrahedron: the largest signed distance from its faces, metres.
  double outside_m(std::uint32_t tet, const Vec3& p) const;
  /// The point of a tetrahedron at the height of p that is nearest to p, and how far away; infinite when the
  /// tetrahedron does not reach that height.
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
  TetLocator(const LayeredSpace& space, double w_scale_m, std::vector<double> height_m,
             std::vector<char> is_left_aside);
  std::array<Vec3, 4> corners(std::uint32_t tet) const;

  const LayeredSpace& space_;
  double w_scale_m_ = 1;
  std::vector<double> height_m_;     ///< per copy: the third coordinate
  std::vector<char> is_left_aside_;  ///< per tet
  BoundingVolumeTree tree_;
};

}  // namespace strataflow
