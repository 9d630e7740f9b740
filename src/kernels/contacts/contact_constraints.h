#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// A border, or a part of one, that slides on a surface (BCS of euler1999 §2.4.1).
struct BorderOnSurface {
  std::uint32_t entity = 0;                ///< whose border it is
  std::uint32_t controller = 0;            ///< the entity it slides on
  std::vector<std::uint32_t> points = {};  ///< its nodes in order, as indices into the soup's points
  bool is_closed = false;                  ///< the last node is joined to the first
  Vec3 direction = {};                     ///< of projection; zero: each node goes on as its own triangles do
  double max_move_m = std::numeric_limits<double>::infinity();  ///< no node may move further
};

/// A border stone that slides along the border of another surface (NBCB of euler1999 §2.4.1): the end of a slit at the
/// tip of a fault, or a horizon's corner on the end of a fault.
struct StoneOnBorder {
  std::uint32_t entity = 0;
  std::uint32_t point = 0;       ///< the stone, as an index into the soup's points
  std::uint32_t controller = 0;  ///< the entity along whose free border it slides
};

struct ContactConstraints {
  std::vector<BorderOnSurface> borders;
  std::vector<StoneOnBorder> stones;
};

}  // namespace strataflow
