#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/box3.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A position in the map of a model: `a` and `b` are the model's own map coordinates, `shift_m` moves the column
/// sideways (only raw sheets that overshoot use it).
struct MapPoint {
  double a = 0, b = 0, shift_m = 0;
};

/// How a level behaves where it would pass the block's cutter (an erosion surface or a surface of onlap).
enum class Cut : std::uint8_t { plain, cutter, below_cutter, above_cutter };

/// One surface of a block: an entity, and what cuts it.
struct Level {
  std::uint32_t entity = 0;
  Cut cut = Cut::plain;
};

struct MapTriangle {
  std::array<std::uint32_t, 3> corners{};  ///< counter-clockwise seen from above
  std::uint32_t block = 0;
};

/// A surface that stands on one edge of the map: a fault, the side of the box, the wall of an intrusion. It spans
/// the heights `low_m` to `high_m`, given at both ends of the edge.
struct Wall {
  std::array<std::uint32_t, 2> ends{};
  std::uint32_t entity = 0;
  std::array<double, 2> low_m{}, high_m{};
};

/// A triangulated map: every horizon of a block is meshed over the same triangles, every wall over some edges.
struct ColumnMap {
  std::vector<MapPoint> points;
  std::vector<MapTriangle> triangles;
  std::vector<Wall> walls;
};

/// A structural model told column by column. A column is a curve, one point per height, that stands on a map point;
/// columns never cross, and those on a fault lie in the fault. Blocks are parts of the map; in each, the levels are
/// heights along the columns, in one order from the bottom to the top. Where two blocks meet, levels of the same
/// height are the same point; where they differ there is a throw.
class ColumnModel {
 public:
  virtual ~ColumnModel() = default;

  std::vector<Entity> entities;
  std::vector<std::vector<Level>> blocks;  ///< per block its levels, bottom first; the first and last are box sides
  Box3 box;

  /// The point at height `z_m` of the column on `p`. Its z is `z_m` exactly; on a shared map point all blocks agree
  /// to the bit.
  virtual Vec3 at(std::uint32_t block, const MapPoint& p, double z_m) const = 0;
  /// The height at which the column on `p` meets a level of a block, before any cutting.
  virtual double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const = 0;
  /// A map whose edges are about `edge_m` long.
  virtual ColumnMap map(double edge_m) const = 0;
  /// The surfaces as an interpreter delivers them: each meshed on its own, stopping short of what it should touch
  /// by the share `ratio` of its extent (negative: overshooting), and the six sides of the box.
  virtual TriangleSoup raw_surfaces(double edge_m, double ratio) const = 0;
};

}  // namespace strataflow
