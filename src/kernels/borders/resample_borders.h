#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/borders/border_lines.h"

namespace strataflow {

/// A mesh whose chosen borders are resampled, before anything is checked (euler1999 §2.9.3).
struct ResampledMesh {
  std::vector<Vec3> points;  ///< the old ones, then the new ones
  struct OnEdge {
    std::uint32_t a = 0, b = 0;
    double share = 0;  ///< of b
  };
  std::vector<OnEdge> new_points;        ///< where each new point stands
  std::vector<std::uint32_t> border_of;  ///< per point: the chosen border it is an inner node of, or no_index
  std::vector<Triangle> triangles;       ///< flat ones (a repeated node) included, see is_flat
  std::vector<std::uint32_t> source;     ///< per triangle: the one it is a piece of
  std::vector<std::array<std::uint32_t, 3>> borders;  ///< per triangle, per corner: the chosen border that moved it
  std::vector<char> is_flat;                          ///< per triangle: contraction left nothing of it
  std::vector<std::vector<std::uint32_t>> chains;     ///< per border of the network: its nodes now
};

/// Puts the wanted number of nodes at equal distances along each chosen border (the last of a loop is its first), and
/// contracts every other inner node to the nearest of them, measured along the border, the earlier one on a tie. A
/// place within a millionth of the spacing of an old node takes that node.
ResampledMesh resample_borders(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                               const BorderNetwork& network, const std::vector<char>& is_chosen);

}  // namespace strataflow
