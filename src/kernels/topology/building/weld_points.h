#pragma once
#include <cstdint>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// Points with bit-identical coordinates made one (−0 counts as 0).
struct WeldedPoints {
  std::vector<std::uint32_t> id;      ///< per input point: its welded id
  std::vector<std::uint32_t> source;  ///< per welded id: the first input point at that position
};

/// Welds exactly coincident points; ids follow the order of first appearance (pellerin2014 §2.1, builder step 1).
WeldedPoints weld_points(const std::vector<Vec3>& points);

}  // namespace strataflow
