#pragma once
#include <cmath>
#include <vector>

#include "kernels/hexes/labelled_tets.h"

namespace strataflow {

/// The directions of I and J in the plan: unit vectors at a right angle, I within 45° of x.
struct PlanFrame {
  Vec3 i{1, 0, 0}, j{0, 1, 0};
};

/// Collects directions that should be I or J, with their weights, and finds the frame nearest to all.
class FrameFit {
 public:
  void take(const Vec3& direction, double weight) {
    // cos 4θ and sin 4θ: quarter turns do not matter
    const double squared = direction.x * direction.x + direction.y * direction.y;
    if (!(squared > 0)) return;
    const double c = (direction.x * direction.x - direction.y * direction.y) / squared;
    const double s = 2 * direction.x * direction.y / squared;
    cos_ += weight * (c * c - s * s);
    sin_ += weight * 2 * c * s;
  }
  PlanFrame frame() const {
    const double angle = std::atan2(sin_, cos_) / 4;
    if (std::abs(angle) < 1e-9) return {};  // sides along the axes: exactly
    return {{std::cos(angle), std::sin(angle), 0}, {-std::sin(angle), std::cos(angle), 0}};
  }

 private:
  double cos_ = 0, sin_ = 0;
};

}  // namespace strataflow
