#include "io/input/combine_inputs.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/index_range.h"
#include "base/internal_error.h"

namespace strataflow {

namespace {

constexpr double no_data = std::numeric_limits<double>::quiet_NaN();

template <class T>
void append(std::vector<T>& all, const std::vector<T>& part) {
  all.insert(all.end(), part.begin(), part.end());
}

template <class T>
void append_shifted(std::vector<T>& all, const std::vector<T>& part, T offset) {
  for (const T value : part) all.push_back(value + offset);
}

/// Where the entities of each part ended up.
class EntityMerger {
 public:
  explicit EntityMerger(std::vector<Entity>& entities) : entities_(entities) {}
  std::vector<std::uint32_t> merge(const std::vector<Entity>& part) {
    std::vector<std::uint32_t> place;
    for (const Entity& entity : part) {
      const std::string key = std::string(to_string(entity.role)) + "/" + entity.name;
      const auto [found, is_new] = index_of_.try_emplace(key, static_cast<std::uint32_t>(entities_.size()));
      if (is_new) entities_.push_back(entity);
      place.push_back(found->second);
    }
    return place;
  }

 private:
  std::vector<Entity>& entities_;
  std::unordered_map<std::string, std::uint32_t> index_of_;  // looked up, never iterated
};

/// Adds the values of one part, whose points are [first, end) of the whole.
void append_properties(std::vector<PointProperty>& all, const std::vector<PointProperty>& part, std::size_t first,
                       std::size_t end) {
  std::vector<std::uint8_t> is_taken(all.size(), 0);
  for (const PointProperty& property : part) {
    std::size_t slot = 0;
    while (slot < is_taken.size() && (is_taken[slot] || all[slot].name != property.name ||
                                      all[slot].unit != property.unit || all[slot].width != property.width))
      ++slot;
    if (slot == is_taken.size()) {
      all.push_back({property.name, property.unit, property.width, {}});
      is_taken.push_back(0);
    }
    is_taken[slot] = 1;
    all[slot].values.resize(first * property.width, no_data);
    append(all[slot].values, property.values);
  }
  for (PointProperty& property : all) property.values.resize(end * property.width, no_data);
}

void append_surfaces(TriangleSoup& all, const TriangleSoup& part, EntityMerger& merger) {
  const auto point = static_cast<std::uint32_t>(all.points.size());
  const auto patch = static_cast<std::uint32_t>(all.patch_entity.size());
  const auto region = static_cast<std::uint32_t>(all.regions.size());
  const std::vector<std::uint32_t> entity = merger.merge(part.entities);
  append(all.points, part.points);
  for (const Triangle& t : part.triangles) all.triangles.push_back({t[0] + point, t[1] + point, t[2] + point});
  append_shifted(all.triangle_patch, part.triangle_patch, patch);
  for (const std::uint32_t e : part.patch_entity) all.patch_entity.push_back(entity[e]);
  if (!part.patch_other_entities.empty() || !all.patch_other_entities.empty())
    all.patch_other_entities.resize(all.patch_entity.size());
  for (std::size_t p = 0; p < part.patch_other_entities.size(); ++p) {
    std::vector<std::uint32_t>& others = all.patch_other_entities[patch + p];
    for (const std::uint32_t e : part.patch_other_entities[p])
      if (entity[e] != all.patch_entity[patch + p]) others.push_back(entity[e]);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
  }
  append_shifted(all.border_stones, part.border_stones, point);
  for (const auto& edge : part.border_starts) all.border_starts.push_back({edge[0] + point, edge[1] + point});
  for (RegionRecord record : part.regions) {
    for (PatchSide& side : record.sides) side.patch += patch;
    all.regions.push_back(std::move(record));
  }
  for (LayerRecord record : part.layers) {
    for (std::uint32_t& r : record.regions) r += region;
    all.layers.push_back(std::move(record));
  }
  append_properties(all.properties, part.properties, point, all.points.size());
}

/// Per-item lists that may be absent: absent in one part means `filler` there once any part has them.
void append_optional(std::vector<std::int32_t>& all, const std::vector<std::int32_t>& part, std::size_t first,
                     std::size_t count, std::int32_t filler, std::int32_t offset) {
  if (all.empty() && part.empty()) return;
  all.resize(first, filler);
  for (const std::int32_t value : part) all.push_back(value < 0 ? value : value + offset);
  all.resize(first + count, filler);
}

std::int32_t largest_plus_one(const std::vector<std::int32_t>& values) {
  std::int32_t largest = -1;
  for (const std::int32_t value : values) largest = value > largest ? value : largest;
  return largest + 1;
}

void append_volume(VolumeMesh& all, VolumeMesh& part, EntityMerger& merger) {
  const auto point = static_cast<std::uint32_t>(all.points.size());
  const auto cell = static_cast<std::uint32_t>(all.cell_count());
  const auto vertex = static_cast<std::uint32_t>(all.cell_vertices.size());
  const auto surface = static_cast<std::uint32_t>(all.surface_entity.size());
  const std::int32_t region =
      std::max(static_cast<std::int32_t>(all.region_names.size()), largest_plus_one(all.cell_region));
  const std::int32_t line = largest_plus_one(all.point_line);
  const std::int32_t corner = largest_plus_one(all.point_corner);
  const std::vector<std::uint32_t> entity = merger.merge(part.entities);
  const auto moved = [](std::uint32_t index, std::uint32_t offset) {
    return index == no_index ? no_index : index + offset;
  };

  append(all.points, part.points);
  append(all.cell_types, part.cell_types);
  for (std::size_t c = 1; c < part.cell_offsets.size(); ++c) all.cell_offsets.push_back(part.cell_offsets[c] + vertex);
  append_shifted(all.cell_vertices, part.cell_vertices, point);
  append_optional(all.cell_region, part.cell_region, cell, part.cell_count(), -1, region);
  for (std::int32_t& e : part.cell_entity)
    if (e >= 0 && static_cast<std::size_t>(e) < entity.size()) e = static_cast<std::int32_t>(entity[e]);
  append_optional(all.cell_entity, part.cell_entity, cell, part.cell_count(), -1, 0);
  for (MeshFacet facet : part.facets) {
    for (std::uint32_t& v : facet.vertices) v = moved(v, point);
    facet.surface = moved(facet.surface, surface);
    facet.cell_0 = moved(facet.cell_0, cell);
    facet.cell_1 = moved(facet.cell_1, cell);
    all.facets.push_back(facet);
  }
  for (const std::int32_t e : part.surface_entity)
    all.surface_entity.push_back(
        e >= 0 && static_cast<std::size_t>(e) < entity.size() ? static_cast<std::int32_t>(entity[e]) : e);
  if (!part.region_names.empty()) all.region_names.resize(static_cast<std::size_t>(region));
  append(all.region_names, part.region_names);
  append_optional(all.point_line, part.point_line, point, part.points.size(), -1, line);
  append_optional(all.point_corner, part.point_corner, point, part.points.size(), -1, corner);
  append(all.changes, part.changes);
}

Result<void> check_sizes(const std::vector<InputData>& parts) {
  std::uint64_t points = 0, triangles = 0, volume_points = 0, cell_vertices = 0, facets = 0;
  for (const InputData& part : parts) {
    points += part.surfaces.points.size();
    triangles += part.surfaces.triangles.size();
    volume_points += part.volume.points.size();
    cell_vertices += part.volume.cell_vertices.size();  // cells are fewer
    facets += part.volume.facets.size();
  }
  for (const auto& [count, things] :
       {std::pair(points, "points"), std::pair(triangles, "triangles"), std::pair(volume_points, "points of cells"),
        std::pair(cell_vertices, "vertices of cells"), std::pair(facets, "facets")})
    if (const Result<void> checked = check_index_range(count, things, "the inputs together"); !checked) return checked;
  return {};
}

}  // namespace

Result<InputData> combine_inputs(std::vector<InputData> parts) {
  if (const Result<void> checked = check_sizes(parts); !checked) return checked.failure();
  if (parts.size() == 1) return std::move(parts.front());
  InputData all;
  EntityMerger surface_entities(all.surfaces.entities);
  EntityMerger volume_entities(all.volume.entities);
  for (InputData& part : parts) {
    STRATAFLOW_ASSERT(part.surfaces.local_origin == parts.front().surfaces.local_origin,
                      "parts have different origins");
    append_surfaces(all.surfaces, part.surfaces, surface_entities);
    append_volume(all.volume, part.volume, volume_entities);
    append(all.lines, part.lines);
    append(all.point_sets, part.point_sets);
    append(all.warnings, part.warnings);
  }
  if (!parts.empty()) all.surfaces.local_origin = all.volume.local_origin = parts.front().surfaces.local_origin;
  return all;
}

}  // namespace strataflow
