#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/failure.h"
#include "model/structural_model.h"

namespace strataflow {

/// The number an object of a project has for ever: never given again, not even after the object is gone. 0: none.
using PermanentId = std::uint64_t;

/// What a section of a model file holds. The numbers are part of the file format.
enum class RecordKind : std::uint32_t {
  model = 1,
  point_block = 2,
  entity = 3,
  corner = 4,
  line = 5,
  surface = 6,
  frontier = 7,
  region = 8,
  layer = 9
};

std::string_view to_string(RecordKind kind);

/// `part`: an object is not whole without the other, they are loaded together. `touch`: it only says which one.
enum class ReferenceKind : std::uint8_t { part, touch };

// The objects of a StructuralModel as a file keeps them: same fields, but permanent ids where the model has indices.
// visit_references(visit) calls visit(id, kind of the object, part or touch); ids may be 0.
// Points are the exception: they are known by their index, and kept in blocks of points_per_block.

inline constexpr std::uint32_t points_per_block = 1u << 16;

struct StoredPointBlock {
  static constexpr RecordKind kind = RecordKind::point_block;
  std::vector<Vec3> points;
  std::vector<std::vector<double>> properties;  ///< per property of the model: width × points
  template <class A>
  void archive(A& a) {
    a(points, properties);
  }
  template <class Visit>
  void visit_references(Visit&&) const {}
};

struct StoredEntity {
  static constexpr RecordKind kind = RecordKind::entity;
  Entity entity;
  template <class A>
  void archive(A& a) {
    a(entity);
  }
  template <class Visit>
  void visit_references(Visit&&) const {}
};

struct StoredCorner {
  static constexpr RecordKind kind = RecordKind::corner;
  std::uint32_t vertex = 0;
  template <class A>
  void archive(A& a) {
    a(vertex);
  }
  template <class Visit>
  void visit_references(Visit&&) const {}
};

struct StoredLine {
  static constexpr RecordKind kind = RecordKind::line;
  std::vector<std::uint32_t> vertices;
  std::array<PermanentId, 2> corners{};  ///< 0 when closed
  std::vector<PermanentId> surfaces;
  template <class A>
  void archive(A& a) {
    a(vertices, corners, surfaces);
  }
  template <class Visit>
  void visit_references(Visit&& visit) const {
    for (const PermanentId id : corners) visit(id, RecordKind::corner, ReferenceKind::part);
    for (const PermanentId id : surfaces) visit(id, RecordKind::surface, ReferenceKind::touch);
  }
};

struct StoredSurface {
  static constexpr RecordKind kind = RecordKind::surface;
  PermanentId entity = 0;
  std::vector<PermanentId> all_entities;
  std::vector<Triangle> triangles;
  std::vector<PermanentId> lines;
  PermanentId region_plus = 0;  ///< 0: the universe
  PermanentId region_minus = 0;
  template <class A>
  void archive(A& a) {
    a(entity, all_entities, triangles, lines, region_plus, region_minus);
  }
  template <class Visit>
  void visit_references(Visit&& visit) const {
    visit(entity, RecordKind::entity, ReferenceKind::part);
    for (const PermanentId id : all_entities) visit(id, RecordKind::entity, ReferenceKind::part);
    for (const PermanentId id : lines) visit(id, RecordKind::line, ReferenceKind::part);
    visit(region_plus, RecordKind::region, ReferenceKind::touch);
    visit(region_minus, RecordKind::region, ReferenceKind::touch);
  }
};

struct StoredFrontier {
  static constexpr RecordKind kind = RecordKind::frontier;
  std::vector<PermanentId> surfaces;      ///< per side
  std::vector<std::uint8_t> is_positive;  ///< per side
  PermanentId region = 0;                 ///< 0: the universe
  std::int32_t volume_sign = 0;
  double signed_volume_m3 = 0;
  template <class A>
  void archive(A& a) {
    a(surfaces, is_positive, region, volume_sign, signed_volume_m3);
  }
  template <class Visit>
  void visit_references(Visit&& visit) const {
    for (const PermanentId id : surfaces) visit(id, RecordKind::surface, ReferenceKind::part);
    visit(region, RecordKind::region, ReferenceKind::touch);
  }
};

struct StoredRegion {
  static constexpr RecordKind kind = RecordKind::region;
  std::string name;
  PermanentId external_frontier = 0;
  std::vector<PermanentId> internal_frontiers;
  double volume_m3 = 0;
  template <class A>
  void archive(A& a) {
    a(name, external_frontier, internal_frontiers, volume_m3);
  }
  template <class Visit>
  void visit_references(Visit&& visit) const {
    visit(external_frontier, RecordKind::frontier, ReferenceKind::part);
    for (const PermanentId id : internal_frontiers) visit(id, RecordKind::frontier, ReferenceKind::part);
  }
};

struct StoredLayer {
  static constexpr RecordKind kind = RecordKind::layer;
  std::string name;
  std::vector<PermanentId> regions;
  template <class A>
  void archive(A& a) {
    a(name, regions);
  }
  template <class Visit>
  void visit_references(Visit&& visit) const {
    for (const PermanentId id : regions) visit(id, RecordKind::region, ReferenceKind::part);
  }
};

/// The ids of a model's objects, list by list in the model's order; 0 for an object that has none yet.
struct ModelIds {
  std::vector<PermanentId> point_blocks, entities, corners, lines, surfaces, frontiers, regions, layers;
  friend bool operator==(const ModelIds&, const ModelIds&) = default;
  template <class A>
  void archive(A& a) {
    a(point_blocks, entities, corners, lines, surfaces, frontiers, regions, layers);
  }
  /// visit(list, kind) for each list.
  template <class Self, class Visit>
  static void for_each_list(Self& self, Visit&& visit) {
    visit(self.point_blocks, RecordKind::point_block);
    visit(self.entities, RecordKind::entity);
    visit(self.corners, RecordKind::corner);
    visit(self.lines, RecordKind::line);
    visit(self.surfaces, RecordKind::surface);
    visit(self.frontiers, RecordKind::frontier);
    visit(self.regions, RecordKind::region);
    visit(self.layers, RecordKind::layer);
  }
};

/// The root: what belongs to the model as a whole, and the order of its objects.
struct StoredModel {
  static constexpr RecordKind kind = RecordKind::model;
  Vec3 local_origin;
  Box3 box;
  std::uint32_t point_count = 0;
  std::uint8_t is_sealed = 0;
  std::vector<PointProperty> properties;  ///< name, unit and width; the values are in the blocks
  ModelIds ids;
  template <class A>
  void archive(A& a) {
    a(local_origin, box, point_count, is_sealed, properties, ids);
  }
  template <class Visit>
  void visit_references(Visit&& visit) const {
    ModelIds::for_each_list(ids, [&](const std::vector<PermanentId>& list, RecordKind list_kind) {
      for (const PermanentId id : list) visit(id, list_kind, ReferenceKind::touch);
    });
  }
};

/// In the order of RecordKind.
using Record = std::variant<StoredModel, StoredPointBlock, StoredEntity, StoredCorner, StoredLine, StoredSurface,
                            StoredFrontier, StoredRegion, StoredLayer>;

inline RecordKind kind_of(const Record& record) { return static_cast<RecordKind>(record.index() + 1); }

}  // namespace strataflow
