#pragma once
#include <vector>

#include "model/point_definition.h"
#include "model/vector3.h"

namespace strataflow {

/// The doubles nearest to where a definition puts its point, ties to even: the one rounding of a cut. Settled in
/// 106-bit arithmetic with an error bound nearly always, in rational arithmetic otherwise; the answer is the same.
Vec3 rounded_position(const std::vector<Vec3>& points, const PointDefinition& definition);

/// The nearest point that survives being moved by `origin` and back: what a file in the model's own, large coordinates
/// can hold. Keeps the order along every axis.
inline Vec3 snapped_to_file(const Vec3& p, const Vec3& origin) {
  const auto snapped = [](double x, double o) { return ((x + o) - o) + 0.0; };  // −0 becomes 0
  return {snapped(p.x, origin.x), snapped(p.y, origin.y), snapped(p.z, origin.z)};
}

}  // namespace strataflow
