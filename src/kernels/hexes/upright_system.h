#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/hexes/trace_walls.h"

namespace strataflow {

/// Which points of a model may move in the plan, and how the others follow them: U = M · X by substitution.
struct UprightSystem {
  struct Share {
    std::uint32_t unknown = 0;
    double weight = 0;
  };
  std::uint32_t unknown_count = 0;
  std::vector<std::uint32_t> point_of;   ///< per unknown
  std::vector<std::uint32_t> first;      ///< per point, plus one: its shares
  std::vector<Share> shares;
  std::uint32_t dropped = 0;             ///< constraints that would have gone round in a circle

  /// u or v per point.
  std::vector<double> expanded(const std::vector<double>& unknowns) const;
};

UprightSystem substitute(std::size_t point_count, const std::vector<UprightConstraint>& constraints);

/// Gradients of the four corners' linear functions, 1/m, and the volume.
struct TetGradients {
  std::array<Vec3, 4> gradient;
  double volume_m3 = 0;
};
std::vector<TetGradients> tet_gradients(const LabelledTets& tets);

}  // namespace strataflow
