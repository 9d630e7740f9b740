#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/hexes/extrusion/plumb_line.h"

namespace strataflow {

/// How levels ascend on a vertical line that crosses faults which need not be followed. W leaps there, so that some
/// levels have no place on the line and others two. Horizons that the line meets keep their places, of two the one
/// further from the fault. In units that a leap cuts, and where horizons are lost, levels lie evenly between the
/// horizons kept below and above. Turned upside down, the line has the same levels turned upside down.
class BridgedLevels {
 public:
  /// `level_w`: the W of bottom, horizons and top.
  BridgedLevels(PlumbLine line, const std::vector<std::uint32_t>& level_w);

  /// Whether any leap is to be bridged; if not, nothing else may be asked.
  bool is_needed() const { return !leaps_.empty(); }
  struct Place {
    double z = 0;
    bool is_bridged = false;  ///< between horizons; not where W is that of the level
    double moved_m = 0;       ///< from where W is, or from the fault that W leaps over it at
  };
  Place at(double w) const;
  /// The tetrahedron at a height.
  std::uint32_t tet_at(double z) const { return line_.tet_at(z); }

 private:
  struct Kept {
    double w = 0, z = 0;
  };

  PlumbLine line_;
  std::vector<PlumbLeap> leaps_;
  std::vector<Kept> kept_;        ///< horizons, bottom and top
  std::vector<char> is_bridged_;  ///< per kept but the last: up to the next
};

}  // namespace strataflow
