#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Collects sheets that are each meshed on their own: one patch per sheet.
class SheetSoup {
 public:
  explicit SheetSoup(const std::vector<Entity>& entities) { soup_.entities = entities; }

  /// A sheet of columns × rows points, `point(i, j)`; quads are halved along the same diagonal.
  void add_grid(std::uint32_t entity, std::uint32_t columns, std::uint32_t rows,
                const std::function<Vec3(std::uint32_t, std::uint32_t)>& point);
  /// A sheet of any triangles; points they do not use are dropped.
  void add_sheet(std::uint32_t entity, const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);
  /// As add_sheet, keeping only what lies where `clearance` (per point, linear in triangles) is ≥ 0.
  void add_clipped_sheet(std::uint32_t entity, std::vector<Vec3> points, const std::vector<Triangle>& triangles,
                         std::vector<double> clearance);
  /// The six sides of `box` as plain rectangles whose edges match: entities `top` … `top + 5` are Top, Bottom,
  /// North, South, East, West.
  void add_box_sides(std::uint32_t top, const Vec3& low, const Vec3& high, double edge_m);

  TriangleSoup take() { return std::move(soup_); }
  /// The same with every position once: sheets that met in equal points share them.
  TriangleSoup take_welded();

 private:
  TriangleSoup soup_;
};

}  // namespace strataflow
