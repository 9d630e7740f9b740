#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "io/model_file/model_project.h"

// A StructuralModel to the objects of a project and back: indices become permanent ids and the other way round.
namespace strataflow {

namespace {

std::size_t block_count(std::size_t points) { return (points + points_per_block - 1) / points_per_block; }

/// Says what in `model` cannot be written, if anything.
std::optional<Failure> check(const StructuralModel& model) {
  const auto refuse = [](const std::string& what) {
    return Failure{FailureCode::invalid_input, "model: " + what, "build the model again from its surfaces"};
  };
  const auto below = [](const auto& values, std::size_t limit) {
    return std::all_of(values.begin(), values.end(), [&](std::uint32_t value) { return value < limit; });
  };
  const auto is_region = [&](std::uint32_t region) { return region == universe || region < model.regions.size(); };
  for (const Corner& corner : model.corners)
    if (corner.vertex >= model.points.size()) return refuse("a corner has no point");
  for (const Line& line : model.lines)
    if (!below(line.vertices, model.points.size()) || !below(line.surfaces, model.surfaces.size()) ||
        (line.corners[0] == universe) != (line.corners[1] == universe) ||
        (!line.is_closed() && !below(line.corners, model.corners.size())))
      return refuse("a line has an index out of range");
  std::uint32_t next_triangle = 0;
  for (const Surface& surface : model.surfaces) {
    if (surface.first_triangle != next_triangle || surface.end_triangle < next_triangle)
      return refuse("its triangles are not grouped by surface");
    next_triangle = surface.end_triangle;
    if (surface.entity >= model.entities.size() || !below(surface.all_entities, model.entities.size()) ||
        !below(surface.lines, model.lines.size()) || !is_region(surface.region_plus) ||
        !is_region(surface.region_minus))
      return refuse("a surface has an index out of range");
  }
  if (next_triangle != model.triangles.size()) return refuse("its triangles are not grouped by surface");
  for (const Triangle& triangle : model.triangles)
    if (!below(triangle, model.points.size())) return refuse("a triangle has no point");
  for (const Frontier& frontier : model.frontiers)
    if (!is_region(frontier.region) || std::any_of(frontier.sides.begin(), frontier.sides.end(), [&](SurfaceSide side) {
          return side.surface >= model.surfaces.size();
        }))
      return refuse("a frontier has an index out of range");
  for (const Region& region : model.regions)
    if (region.external_frontier >= model.frontiers.size() || !below(region.internal_frontiers, model.frontiers.size()))
      return refuse("a region has no frontier");
  for (const Layer& layer : model.layers)
    if (!below(layer.regions, model.regions.size())) return refuse("a layer has no region");
  for (const PointProperty& property : model.properties)
    if (property.values.size() != property.width * model.points.size()) return refuse("a property lacks values");
  return std::nullopt;
}

std::vector<PermanentId> at(const std::vector<PermanentId>& ids, const std::vector<std::uint32_t>& indices) {
  std::vector<PermanentId> result;
  for (const std::uint32_t index : indices) result.push_back(ids[index]);
  return result;
}

PermanentId region_at(const ModelIds& ids, std::uint32_t region) {
  return region == universe ? 0 : ids.regions[region];
}

StoredPointBlock point_block(const StructuralModel& model, std::size_t block) {
  const std::size_t begin = block * points_per_block;
  const std::size_t end = std::min<std::size_t>(model.points.size(), begin + points_per_block);
  StoredPointBlock stored;
  stored.points.assign(model.points.begin() + static_cast<std::ptrdiff_t>(begin),
                       model.points.begin() + static_cast<std::ptrdiff_t>(end));
  for (const PointProperty& property : model.properties)
    stored.properties.emplace_back(property.values.begin() + static_cast<std::ptrdiff_t>(begin * property.width),
                                   property.values.begin() + static_cast<std::ptrdiff_t>(end * property.width));
  return stored;
}

}  // namespace

Result<void> ModelProject::set_model(const StructuralModel& model, ModelIds& ids) {
  if (auto problem = check(model)) return *problem;
  const std::array<std::size_t, 8> sizes = {block_count(model.points.size()),
                                            model.entities.size(),
                                            model.corners.size(),
                                            model.lines.size(),
                                            model.surfaces.size(),
                                            model.frontiers.size(),
                                            model.regions.size(),
                                            model.layers.size()};
  ids.point_blocks.resize(sizes[0]);
  std::unordered_set<PermanentId> kept;
  std::optional<Failure> problem;
  const std::size_t* size = sizes.data();
  ModelIds::for_each_list(ids, [&](std::vector<PermanentId>& list, RecordKind kind) {
    if (list.size() > *size)
      problem =
          Failure{FailureCode::invalid_input, "there are more ids than objects of kind " + std::string(to_string(kind)),
                  "remove the ids of removed objects"};
    list.resize(*size++);
    for (const PermanentId id : list) {
      if (id == 0 || problem) continue;
      const auto section = sections_.find(id);
      if (section == sections_.end() || section->second.kind != kind || !kept.insert(id).second)
        problem = Failure{
            FailureCode::invalid_input,
            "the id " + std::to_string(id) + " is not that of one " + std::string(to_string(kind)) + " of the project",
            "use 0 for new objects"};
    }
  });
  if (problem) return *problem;

  const auto roots = this->ids(RecordKind::model);
  PermanentId root_id = roots.empty() ? 0 : roots.front();
  if (root_id != 0) kept.insert(root_id);
  std::erase_if(sections_, [&](const auto& section) { return !kept.contains(section.first); });
  if (root_id == 0) root_id = ++counter_;
  ModelIds::for_each_list(ids, [&](std::vector<PermanentId>& list, RecordKind) {
    for (PermanentId& id : list)
      if (id == 0) id = ++counter_;
  });

  StoredModel root{model.local_origin, model.box, static_cast<std::uint32_t>(model.points.size()),
                   model.is_sealed,    {},        ids};
  for (const PointProperty& property : model.properties)
    root.properties.push_back({property.name, property.unit, property.width, {}});
  store(root_id, std::move(root));
  for (std::size_t i = 0; i < ids.point_blocks.size(); ++i) store(ids.point_blocks[i], point_block(model, i));
  for (std::size_t i = 0; i < ids.entities.size(); ++i) store(ids.entities[i], StoredEntity{model.entities[i]});
  for (std::size_t i = 0; i < ids.corners.size(); ++i) store(ids.corners[i], StoredCorner{model.corners[i].vertex});
  for (std::size_t i = 0; i < ids.lines.size(); ++i) {
    const Line& line = model.lines[i];
    StoredLine stored{line.vertices, {}, at(ids.surfaces, line.surfaces)};
    if (!line.is_closed()) stored.corners = {ids.corners[line.corners[0]], ids.corners[line.corners[1]]};
    store(ids.lines[i], std::move(stored));
  }
  for (std::size_t i = 0; i < ids.surfaces.size(); ++i) {
    const Surface& surface = model.surfaces[i];
    store(ids.surfaces[i], StoredSurface{ids.entities[surface.entity],
                                         at(ids.entities, surface.all_entities),
                                         {model.triangles.begin() + surface.first_triangle,
                                          model.triangles.begin() + surface.end_triangle},
                                         at(ids.lines, surface.lines),
                                         region_at(ids, surface.region_plus),
                                         region_at(ids, surface.region_minus)});
  }
  for (std::size_t i = 0; i < ids.frontiers.size(); ++i) {
    const Frontier& frontier = model.frontiers[i];
    StoredFrontier stored{{}, {}, region_at(ids, frontier.region), frontier.volume_sign, frontier.signed_volume_m3};
    for (const SurfaceSide& side : frontier.sides) {
      stored.surfaces.push_back(ids.surfaces[side.surface]);
      stored.is_positive.push_back(side.is_positive != 0);
    }
    store(ids.frontiers[i], std::move(stored));
  }
  for (std::size_t i = 0; i < ids.regions.size(); ++i) {
    const Region& region = model.regions[i];
    store(ids.regions[i], StoredRegion{region.name, ids.frontiers[region.external_frontier],
                                       at(ids.frontiers, region.internal_frontiers), region.volume_m3});
  }
  for (std::size_t i = 0; i < ids.layers.size(); ++i)
    store(ids.layers[i], StoredLayer{model.layers[i].name, at(ids.regions, model.layers[i].regions)});
  return {};
}

Result<StructuralModel> ModelProject::model(ModelIds* ids) const {
  const StoredModel* root = this->root();
  if (!root) return malformed((file_.empty() ? "project" : file_.string()) + ": holds no model");
  StructuralModel model;
  model.local_origin = root->local_origin;
  model.box = root->box;
  model.properties = root->properties;

  // What is loaded keeps its order; links become indices into that.
  std::unordered_map<PermanentId, std::uint32_t> index_of;
  ModelIds loaded;
  bool is_whole = true;
  std::optional<Failure> problem;
  std::vector<std::vector<PermanentId>*> lists;
  ModelIds::for_each_list(loaded, [&](std::vector<PermanentId>& list, RecordKind) { lists.push_back(&list); });
  auto list = lists.begin();
  ModelIds::for_each_list(root->ids, [&](const std::vector<PermanentId>& all, RecordKind) {
    for (const PermanentId id : all) {
      const auto section = sections_.find(id);
      if (section == sections_.end() || !section->second.record) continue;
      if (!index_of.try_emplace(id, static_cast<std::uint32_t>((*list)->size())).second)
        problem = malformed(name_of(id) + " is in the model twice");
      (*list)->push_back(id);
    }
    if ((*list)->size() < all.size()) is_whole = false;
    ++list;
  });
  if (problem) return *problem;
  model.is_sealed = root->is_sealed && is_whole;

  const auto part = [&](PermanentId owner, PermanentId id) -> std::uint32_t {
    const auto found = index_of.find(id);
    if (found != index_of.end()) return found->second;
    problem = malformed(name_of(owner) + " lacks a part: " + std::to_string(id) + " is not in the model");
    return 0;
  };
  const auto touched = [&](const std::vector<PermanentId>& all) {
    std::vector<std::uint32_t> indices;
    for (const PermanentId id : all)
      if (const auto found = index_of.find(id); found != index_of.end()) indices.push_back(found->second);
    return indices;
  };
  const auto parts = [&](PermanentId owner, const std::vector<PermanentId>& all) {
    std::vector<std::uint32_t> indices;
    for (const PermanentId id : all) indices.push_back(part(owner, id));
    return indices;
  };
  const auto region = [&](PermanentId id) {
    const auto found = index_of.find(id);
    return found == index_of.end() ? universe : found->second;
  };

  constexpr std::uint32_t absent = 0xffffffffu;
  std::vector<std::uint32_t> block_start(root->ids.point_blocks.size(), absent);
  for (std::size_t block = 0; block < block_start.size(); ++block) {
    const PermanentId id = root->ids.point_blocks[block];
    const auto* stored = find<StoredPointBlock>(id);
    if (!stored) continue;
    block_start[block] = static_cast<std::uint32_t>(model.points.size());
    const std::size_t expected = std::min<std::size_t>(points_per_block, root->point_count - block * points_per_block);
    bool is_ok = block_count(root->point_count) == block_start.size() && stored->points.size() == expected &&
                 stored->properties.size() == model.properties.size() &&
                 std::all_of(stored->points.begin(), stored->points.end(), is_finite);
    for (std::size_t i = 0; is_ok && i < stored->properties.size(); ++i)
      is_ok = stored->properties[i].size() == expected * model.properties[i].width;
    if (!is_ok) return malformed(name_of(id) + " does not fit the model");
    model.points.insert(model.points.end(), stored->points.begin(), stored->points.end());
    for (std::size_t i = 0; i < stored->properties.size(); ++i)
      model.properties[i].values.insert(model.properties[i].values.end(), stored->properties[i].begin(),
                                        stored->properties[i].end());
  }
  const auto point = [&](PermanentId owner, std::uint32_t vertex) -> std::uint32_t {
    if (vertex < root->point_count && vertex / points_per_block < block_start.size() &&
        block_start[vertex / points_per_block] != absent)
      return block_start[vertex / points_per_block] + vertex % points_per_block;
    problem = malformed(name_of(owner) + " refers to point " + std::to_string(vertex) + ", which is not there");
    return 0;
  };

  for (const PermanentId id : loaded.entities) {
    model.entities.push_back(find<StoredEntity>(id)->entity);
    if (model.entities.back().role > Role::curve) return malformed(name_of(id) + " has a role that does not exist");
  }
  for (const PermanentId id : loaded.corners) model.corners.push_back({point(id, find<StoredCorner>(id)->vertex)});
  for (const PermanentId id : loaded.lines) {
    const auto* stored = find<StoredLine>(id);
    Line& line = model.lines.emplace_back();
    for (const std::uint32_t vertex : stored->vertices) line.vertices.push_back(point(id, vertex));
    if (stored->corners[0] != 0) line.corners = {part(id, stored->corners[0]), part(id, stored->corners[1])};
    line.surfaces = touched(stored->surfaces);
  }
  for (const PermanentId id : loaded.surfaces) {
    const auto* stored = find<StoredSurface>(id);
    Surface& surface = model.surfaces.emplace_back();
    surface.entity = part(id, stored->entity);
    surface.all_entities = parts(id, stored->all_entities);
    surface.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
    for (const Triangle& triangle : stored->triangles)
      model.triangles.push_back({point(id, triangle[0]), point(id, triangle[1]), point(id, triangle[2])});
    surface.end_triangle = static_cast<std::uint32_t>(model.triangles.size());
    surface.lines = parts(id, stored->lines);
    surface.region_plus = region(stored->region_plus);
    surface.region_minus = region(stored->region_minus);
    model.triangle_surface.resize(model.triangles.size(), static_cast<std::uint32_t>(model.surfaces.size() - 1));
  }
  for (const PermanentId id : loaded.frontiers) {
    const auto* stored = find<StoredFrontier>(id);
    const auto is_side = [](std::uint32_t side) { return side <= 1; };
    if (stored->is_positive.size() != stored->surfaces.size() ||
        !std::all_of(stored->is_positive.begin(), stored->is_positive.end(), is_side))
      return malformed(name_of(id) + " contradicts itself");
    Frontier& frontier = model.frontiers.emplace_back();
    for (std::size_t i = 0; i < stored->surfaces.size(); ++i)
      frontier.sides.push_back({part(id, stored->surfaces[i]), stored->is_positive[i]});
    frontier.region = region(stored->region);
    frontier.volume_sign = stored->volume_sign;
    frontier.signed_volume_m3 = stored->signed_volume_m3;
  }
  for (const PermanentId id : loaded.regions) {
    const auto* stored = find<StoredRegion>(id);
    model.regions.push_back(
        {stored->name, part(id, stored->external_frontier), parts(id, stored->internal_frontiers), stored->volume_m3});
  }
  for (const PermanentId id : loaded.layers) {
    const auto* stored = find<StoredLayer>(id);
    model.layers.push_back({stored->name, parts(id, stored->regions)});
  }
  if (problem) return *problem;

  model.point_line.assign(model.points.size(), -1);
  model.point_corner.assign(model.points.size(), -1);
  for (std::size_t i = 0; i < model.lines.size(); ++i)
    for (const std::uint32_t vertex : model.lines[i].vertices) model.point_line[vertex] = static_cast<std::int32_t>(i);
  for (std::size_t i = 0; i < model.corners.size(); ++i) {
    model.point_corner[model.corners[i].vertex] = static_cast<std::int32_t>(i);
    model.point_line[model.corners[i].vertex] = -1;
  }
  if (ids) *ids = std::move(loaded);
  return model;
}

}  // namespace strataflow
