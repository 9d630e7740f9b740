#pragma once
#include <cstdint>
#include <vector>

#include "base/id.h"
#include "kernels/hexes/layered_space.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

/// A piece of a vertical line in one tetrahedron; W grows or stays from its lower to its upper end.
struct PlumbPiece {
  double low_z = 0, high_z = 0;
  double low_w = 0, high_w = 0;
  std::uint32_t tet = 0;                                    ///< of the model
  bool starts_at_dropped = false, ends_at_dropped = false;  ///< at a fault that need not be followed
};

/// Where a level crosses a vertical line.
struct PlumbLevel {
  double z = 0;
  bool is_in_jump = false;  ///< W leaps over the level there: a fault, or an unconformity
};

/// Where W leaps at a fault that need not be followed: up over what is lost there, or back so that it comes again.
struct PlumbLeap {
  double from_w = 0, to_w = 0;
};

/// A vertical line through a layered model, from below.
class PlumbLine {
 public:
  explicit PlumbLine(std::vector<PlumbPiece> pieces) : pieces_(std::move(pieces)) {}

  bool is_empty() const { return pieces_.empty(); }
  /// The height at which W reaches a level; that of the line's end where it never does. Where a reverse fault repeats
  /// the level, the crossing further from the fault.
  PlumbLevel at_level(double w) const;
  /// The tetrahedron at a height, or the nearest on the line.
  std::uint32_t tet_at(double z) const;
  /// Leaps over faults that need not be followed, from below.
  std::vector<PlumbLeap> dropped_leaps() const;

 private:
  std::vector<PlumbPiece> pieces_;  ///< by their lower ends
};

/// Drops vertical lines through a layered model. Safe to use from several threads; keeps references to both arguments.
class PlumbLines {
 public:
  /// `places`, per point of the model: x and y as lines see them, in space or in the plan. Heights are the model's.
  PlumbLines(const LayeredSpace& space, const std::vector<Vec3>& places);

  /// The line through (x, y), relative to the model's local origin; empty beside the model.
  PlumbLine at(double x, double y) const;

 private:
  bool is_dropped(std::uint32_t face) const;

  const LayeredSpace& space_;
  const std::vector<Vec3>& places_;
  double low_z_ = 0, high_z_ = 0;
  std::vector<char> is_flipped_;  ///< per tet: left aside
  BoundingVolumeTree tree_;
};

}  // namespace strataflow
