#pragma once
#include <vector>

#include "kernels/reference_models/column_model.h"

namespace strataflow {

/// A fault on the line between block `line − 1` and block `line`: where along the strike it is there, and which of
/// its four ends touch something (the others are tips).
struct SectionFault {
  std::uint32_t line = 1;
  std::uint32_t entity = 0;
  double south_m = 0, north_m = 0;  ///< y of its ends
  bool touches_south = true, touches_north = true, touches_below = true, touches_above = true;
};

/// A model of west–east sections, one per row (y): blocks side by side from west to east, separated by lines (the
/// faults), which are curves x(y, z). The map coordinates are a = block + share of its width, b = y.
class SectionModel : public ColumnModel {
 public:
  Vec3 at(std::uint32_t block, const MapPoint& p, double z_m) const final;
  double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const final;
  ColumnMap map(double edge_m) const final;
  TriangleSoup raw_surfaces(double edge_m, double ratio) const final;

 protected:
  std::vector<SectionFault> faults;
  std::vector<double> row_breaks;  ///< y of rows that must exist, ascending, from the south to the north side
  std::uint32_t top_entity = 0;    ///< Top; Bottom, North, South, East, West follow

  /// x of a line: 0 is the west side, `blocks.size()` the east side.
  virtual double line_x(std::uint32_t line, double y, double z) const = 0;
  /// Height of a level where its block has been displaced; `share` is the place in the block, 0 west, 1 east.
  virtual double surface_z(std::uint32_t block, std::uint32_t level, double share, double x, double y,
                           double z) const = 0;
  /// The heights a fault spans at a row.
  virtual std::array<double, 2> fault_span(const SectionFault& fault, double y) const;
  /// Whether a fault separates the two sides of a level.
  virtual bool cuts_level(const SectionFault&, const Level& level) const { return level.cut != Cut::cutter; }

  std::uint32_t block_count() const { return static_cast<std::uint32_t>(blocks.size()); }
  /// Adds the entities of the box and the levels Bottom … Top of every block around `inner`.
  void close_with_box(std::uint32_t number_of_blocks, const std::vector<Level>& inner);

 private:
  friend class RawSections;
  std::vector<double> rows(double edge_m) const;
  std::uint32_t columns_in(std::uint32_t block, double edge_m) const;
  bool is_closed(std::uint32_t block, double y) const;
};

}  // namespace strataflow
