#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/warning.h"
#include "model/box3.h"
#include "model/triangle_soup.h"

namespace strataflow {

constexpr std::uint32_t universe = 0xffffffffu;  ///< the region outside the model

/// One side of a surface. Side 1 (`is_positive`) is the one its triangles' normals point to.
struct SurfaceSide {
  std::uint32_t surface = 0;
  std::uint32_t is_positive = 0;
  static constexpr bool is_flat = true;
  friend constexpr auto operator<=>(const SurfaceSide&, const SurfaceSide&) = default;
};

/// A point where lines end, or where the set of surfaces around a line changes (pellerin2014 §2.1).
struct Corner {
  std::uint32_t vertex = 0;
  static constexpr bool is_flat = true;
};

/// A maximal polyline along which the same surfaces meet: a contact, or the free border of one surface.
struct Line {
  std::vector<std::uint32_t> vertices;                       ///< in order; a closed line does not repeat its first
  std::array<std::uint32_t, 2> corners{universe, universe};  ///< indices into corners; `universe` when closed
  /// Surfaces around the line, one entry per border of a surface (a surface may come twice), ascending.
  std::vector<std::uint32_t> surfaces;
  bool is_closed() const { return corners[0] == universe; }
  bool is_free_border() const { return surfaces.size() == 1; }
  template <class A>
  void archive(A& a) {
    a(vertices, corners, surfaces);
  }
};

/// A connected piece of one entity, or of the same several that coincide, between lines, consistently oriented:
/// triangles [first_triangle, end_triangle).
struct Surface {
  std::uint32_t entity = 0;
  std::vector<std::uint32_t> all_entities;  ///< ascending; several where they coincide: `entity` is their youngest_of
  std::uint32_t first_triangle = 0;
  std::uint32_t end_triangle = 0;
  std::vector<std::uint32_t> lines;       ///< ascending
  std::uint32_t region_plus = universe;   ///< region on the positive side
  std::uint32_t region_minus = universe;  ///< region on the negative side
  bool is_dangling() const { return region_plus == region_minus; }
  template <class A>
  void archive(A& a) {
    a(entity, all_entities, first_triangle, end_triangle, lines, region_plus, region_minus);
  }
};

/// A connected set of surface sides that look at one region (euler1999 §2.2.3).
struct Frontier {
  std::vector<SurfaceSide> sides;  ///< ascending
  std::uint32_t region = universe;
  std::int32_t volume_sign = 0;  ///< exact: +1 external, −1 or 0 internal
  double signed_volume_m3 = 0;
  template <class A>
  void archive(A& a) {
    a(sides, region, volume_sign, signed_volume_m3);
  }
};

/// A connected volume: exactly one external frontier and any number of internal ones.
struct Region {
  std::string name;
  std::uint32_t external_frontier = 0;
  std::vector<std::uint32_t> internal_frontiers;
  /// NaN where the surfaces do not tell: the order around a line of its own, or of a body that may lie in it, is
  /// unknown.
  double volume_m3 = 0;
  template <class A>
  void archive(A& a) {
    a(name, external_frontier, internal_frontiers, volume_m3);
  }
};

/// Regions that share a stratigraphic attribute.
struct Layer {
  std::string name;
  std::vector<std::uint32_t> regions;
  template <class A>
  void archive(A& a) {
    a(name, regions);
  }
};

/// A boundary representation of a partition of space, non-manifold where surfaces meet (pellerin2014 §2.1,
/// euler1999 §2.1). Points are welded; triangles are grouped by surface and oriented coherently inside each.
/// Coordinates are metres relative to `local_origin`.
struct StructuralModel {
  Vec3 local_origin;
  Box3 box;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_surface;
  std::vector<Entity> entities;
  std::vector<Corner> corners;
  std::vector<Line> lines;
  std::vector<Surface> surfaces;
  std::vector<Frontier> frontiers;
  std::vector<Region> regions;
  std::vector<Layer> layers;
  std::vector<std::int32_t> point_line;    ///< per point: its line, −1 elsewhere (and at corners)
  std::vector<std::int32_t> point_corner;  ///< per point: its corner, −1 elsewhere
  std::vector<PointProperty> properties;
  bool is_sealed = false;  ///< the outer shell is closed; that contacts conform is for check_validity to say

  template <class A>
  void archive(A& a) {
    a(local_origin, box, points, triangles, triangle_surface, entities, corners, lines, surfaces, frontiers, regions,
      layers, point_line, point_corner, properties, is_sealed);
  }
};

}  // namespace strataflow
