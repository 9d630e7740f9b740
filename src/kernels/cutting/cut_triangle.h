#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/cutting/constrained_triangulation.h"
#include "kernels/cutting/identify_points.h"

namespace strataflow {

/// A point that some other triangle puts into a triangle.
struct PointOnTriangle {
  std::uint32_t triangle = 0;
  std::uint32_t point = 0;
  PlaceInTriangle place = place_outside;
  friend constexpr auto operator<=>(const PointOnTriangle&, const PointOnTriangle&) = default;
};

/// A segment that another triangle draws in a triangle.
struct SegmentOnTriangle {
  std::uint32_t triangle = 0;
  std::array<std::uint32_t, 2> ends{};  ///< points, ascending
  std::uint32_t other = 0;              ///< the triangle that draws it
  std::array<std::uint32_t, 2> edge{};  ///< its edge the segment lies on, when the planes agree; else no_index
  friend constexpr auto operator<=>(const SegmentOnTriangle&, const SegmentOnTriangle&) = default;
};

/// Two segments of a triangle that cross, and the point where.
struct SegmentCrossing {
  PointDefinition definition;
  std::array<std::uint32_t, 2> segments{};  ///< by their place in the triangle's list
};

/// What lies in one triangle.
struct TriangleContents {
  std::uint32_t triangle = 0;
  std::span<const PointOnTriangle> points;
  std::span<const SegmentOnTriangle> segments;
};

/// Cuts single triangles; keeps its memory from one to the next.
class TriangleCutter {
 public:
  TriangleCutter(const CutPoints& points, const std::vector<Triangle>& triangles)
      : cut_points_(&points), triangles_(&triangles), local_(points.input(), points.origin()) {}

  /// Crossings of the segments inside the triangle (euler1999 §2.6: triple points by topology, no tolerance).
  std::vector<SegmentCrossing> find_crossings(const TriangleContents& contents);

  /// The triangulation of the triangle with all its points and segments. Returns false on contents that contradict
  /// each other: our bug.
  bool triangulate(const TriangleContents& contents);
  const std::vector<ConstrainedTriangulation::Cell>& cells() const { return triangulation_.cells(); }
  std::uint32_t point(std::uint32_t local) const { return ids_[local]; }

 private:
  void load(const TriangleContents& contents);
  std::uint32_t local_of(std::uint32_t point) const;
  PointDefinition crossing_of(const SegmentOnTriangle& a, const SegmentOnTriangle& b) const;

  const CutPoints* cut_points_;
  const std::vector<Triangle>* triangles_;
  PointsInTriangle local_;
  ConstrainedTriangulation triangulation_;
  std::vector<PointOnTriangle> inserted_;
  std::vector<std::uint32_t> ids_;                                 ///< per local point
  std::vector<std::array<std::uint32_t, 2>> sorted_ids_;           ///< (point, local)
  std::vector<std::array<std::uint32_t, 2>> pieces_;
  std::vector<std::uint32_t> by_u_, on_segment_;
};

}  // namespace strataflow
