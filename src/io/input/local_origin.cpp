#include "io/input/local_origin.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/box3.h"

namespace strataflow {

namespace {

std::vector<std::vector<Vec3>*> all_points(InputData& data) {
  std::vector<std::vector<Vec3>*> lists{&data.surfaces.points, &data.volume.points};
  for (Polyline& line : data.lines) lists.push_back(&line.points);
  for (PointSet& set : data.point_sets) lists.push_back(&set.points);
  return lists;
}

/// a − b has no rounding error (the error term of Knuth's TwoSum).
bool is_exact_difference(double a, double b) {
  const double difference = a - b;
  const double b_part = a - difference;
  const double a_part = difference + b_part;
  return (a - a_part) + (b_part - b) == 0;
}

bool is_exact_shift(const std::vector<std::vector<Vec3>*>& lists, int axis, double origin) {
  for (const std::vector<Vec3>* points : lists)
    for (const Vec3& point : *points)
      if (!is_exact_difference(point[axis], origin)) return false;
  return true;
}

/// The shift of one axis, whose coordinates lie in [low, high]; 0 when there is none worth having.
double exact_origin(const std::vector<std::vector<Vec3>*>& lists, int axis, double low, double high) {
  const double extent = high - low;
  const double centre = low + 0.5 * extent;
  // A shift pays only when the numbers are much larger than what they span.
  if (!std::isfinite(extent) || !(std::abs(centre) > extent) || !(std::abs(centre) >= 1)) return 0;
  const int coarsest = std::max(0, std::ilogb(std::max(extent, 1.0)) + 1);
  for (int power = coarsest; power >= std::max(0, coarsest - 8); --power) {
    const double step = std::ldexp(1.0, power);
    const double origin = std::nearbyint(centre / step) * step;
    if (origin != 0 && is_exact_shift(lists, axis, origin)) return origin;
  }
  return 0;
}

}  // namespace

void shift_to_local_origin(InputData& data) {
  if (data.surfaces.local_origin != Vec3{}) return;
  const std::vector<std::vector<Vec3>*> lists = all_points(data);
  Box3 box;
  for (const std::vector<Vec3>* points : lists)
    for (const Vec3& point : *points) box.take(point);
  if (box.is_empty()) return;
  Vec3 origin;
  for (int axis = 0; axis < 3; ++axis) origin[axis] = exact_origin(lists, axis, box.low[axis], box.high[axis]);
  for (std::vector<Vec3>* points : lists)
    for (Vec3& point : *points) point = point - origin;
  data.surfaces.local_origin = origin;
  data.volume.local_origin = origin;
}

}  // namespace strataflow
