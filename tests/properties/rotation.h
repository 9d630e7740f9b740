#pragma once
#include <cmath>

#include "model/vector3.h"

namespace strataflow::support {

/// A turn about an axis through the origin, by an angle in degrees. The same point always lands on the same bits.
class Rotation {
 public:
  Rotation(const Vec3& axis, double angle_deg)
      : axis_((1 / length(axis)) * axis),
        cosine_(std::cos(angle_deg * std::acos(-1.0) / 180)),
        sine_(std::sin(angle_deg * std::acos(-1.0) / 180)) {}

  Vec3 operator()(const Vec3& p) const {
    return cosine_ * p + sine_ * cross(axis_, p) + (1 - cosine_) * dot(axis_, p) * axis_;
  }

 private:
  Vec3 axis_;
  double cosine_, sine_;
};

inline const Rotation about_z({0, 0, 1}, 30);
inline const Rotation about_skew_axis({1, -2, 3}, 40);

}  // namespace strataflow::support
