#pragma once
#include <memory>
#include <vector>

#include "model/point_definition.h"
#include "model/vector3.h"

namespace strataflow {

/// A point with exact rational coordinates. Cheap to copy; costs microseconds to make and to compare: ask only where
/// filters fail.
class ExactPosition {
 public:
  struct Coordinates;
  ExactPosition() = default;
  explicit ExactPosition(std::shared_ptr<const Coordinates> coordinates) : coordinates_(std::move(coordinates)) {}
  explicit operator bool() const { return coordinates_ != nullptr; }
  const Coordinates& operator*() const { return *coordinates_; }

 private:
  std::shared_ptr<const Coordinates> coordinates_;
};

/// Where a definition puts its point.
ExactPosition exact_position(const std::vector<Vec3>& points, const PointDefinition& definition);

/// −1, 0, +1: lexicographic order by x, y, z.
int compare(const ExactPosition& a, const ExactPosition& b);

/// Order of one coordinate.
int compare_along(const ExactPosition& a, const ExactPosition& b, int axis);

/// Sign of the area of abc seen along `axis`, as orientation_2d of doubles.
int orientation_2d(const ExactPosition& a, const ExactPosition& b, const ExactPosition& c, int axis);

/// The nearest doubles, ties to even.
Vec3 nearest_doubles(const ExactPosition& a);

}  // namespace strataflow
