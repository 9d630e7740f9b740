#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/geology.h"
#include "model/vector3.h"

namespace strataflow {

using Triangle = std::array<std::uint32_t, 3>;

/// Values carried by points: `width` numbers per point, point by point; NaN where the file says "no data".
struct PointProperty {
  std::string name;
  std::string unit;
  std::uint32_t width = 1;
  std::vector<double> values;
  template <class A>
  void archive(A& a) {
    a(name, unit, width, values);
  }
};

/// One side of a patch, as a file names it. Signs in real files cannot be trusted.
struct PatchSide {
  std::uint32_t patch = 0;
  std::uint8_t is_positive = 0;
  std::array<std::uint8_t, 3> zero{};  // no padding: the bytes are digested
  static constexpr bool is_flat = true;
};

/// A region as a file lists it: a name and the patches around it.
struct RegionRecord {
  std::string name;
  std::vector<PatchSide> sides;
  template <class A>
  void archive(A& a) {
    a(name, sides);
  }
};

/// A layer as a file lists it: a name and indices into `TriangleSoup::regions`.
struct LayerRecord {
  std::string name;
  std::vector<std::uint32_t> regions;
  template <class A>
  void archive(A& a) {
    a(name, regions);
  }
};

/// Triangles as they were read or generated: nothing is welded, oriented or checked beyond what a reader can see
/// (finite coordinates, indices in range). Coordinates are metres; see `local_origin`.
struct TriangleSoup {
  Vec3 local_origin;                        ///< add it to a point to get the file's own coordinates
  std::vector<Vec3> points;                 ///< may repeat a position
  std::vector<Triangle> triangles;          ///< indices into points
  std::vector<std::uint32_t> triangle_patch;  ///< per triangle: index into patch_entity
  /// A patch is what a file keeps together: one TFACE, one OBJ group, one file. Per patch: index into entities.
  std::vector<std::uint32_t> patch_entity;
  /// Per patch: further entities that coincide with it, ascending. May be empty: none anywhere.
  std::vector<std::vector<std::uint32_t>> patch_other_entities;
  std::vector<Entity> entities;

  // Records of a file about its own topology. They are compared with the geometry, never believed.
  std::vector<std::uint32_t> border_stones;               ///< points said to be ends of borders
  std::vector<std::array<std::uint32_t, 2>> border_starts;  ///< first edge of each border, as two points
  std::vector<RegionRecord> regions;
  std::vector<LayerRecord> layers;

  std::vector<PointProperty> properties;

  /// All entities of a patch, ascending.
  std::vector<std::uint32_t> entities_of(std::uint32_t patch) const {
    std::vector<std::uint32_t> all;
    if (!patch_other_entities.empty()) all = patch_other_entities[patch];
    all.insert(std::upper_bound(all.begin(), all.end(), patch_entity[patch]), patch_entity[patch]);
    return all;
  }

  template <class A>
  void archive(A& a) {
    a(local_origin, points, triangles, triangle_patch, patch_entity, patch_other_entities, entities, border_stones,
      border_starts, regions, layers, properties);
  }
};

}  // namespace strataflow
