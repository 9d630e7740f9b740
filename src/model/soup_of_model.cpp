#include "model/soup_of_model.h"

namespace strataflow {

TriangleSoup patches_of_model(const StructuralModel& model) {
  TriangleSoup soup;
  soup.local_origin = model.local_origin;
  soup.entities = model.entities;
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    soup.patch_entity.push_back(surface.entity);
    if (surface.all_entities.size() < 2) continue;
    soup.patch_other_entities.resize(model.surfaces.size());
    for (const std::uint32_t entity : surface.all_entities)
      if (entity != surface.entity) soup.patch_other_entities[s].push_back(entity);
  }
  for (const Region& region : model.regions) soup.regions.push_back({region.name, {}});
  for (const Frontier& frontier : model.frontiers) {
    if (frontier.region == universe) continue;
    for (const SurfaceSide& side : frontier.sides)
      soup.regions[frontier.region].sides.push_back({side.surface, static_cast<std::uint8_t>(side.is_positive)});
  }
  for (const Layer& layer : model.layers) soup.layers.push_back({layer.name, layer.regions});
  return soup;
}

TriangleSoup soup_of_model(const StructuralModel& model) {
  TriangleSoup soup = patches_of_model(model);
  soup.points = model.points;
  soup.triangles = model.triangles;
  soup.triangle_patch = model.triangle_surface;
  soup.properties = model.properties;
  return soup;
}

}  // namespace strataflow
