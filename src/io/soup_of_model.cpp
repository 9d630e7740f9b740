#include "io/soup_of_model.h"

namespace strataflow {

TriangleSoup soup_of_model(const StructuralModel& model) {
  TriangleSoup soup;
  soup.local_origin = model.local_origin;
  soup.points = model.points;
  soup.triangles = model.triangles;
  soup.triangle_patch = model.triangle_surface;
  soup.entities = model.entities;
  soup.properties = model.properties;
  for (const Surface& surface : model.surfaces) soup.patch_entity.push_back(surface.entity);
  for (const Surface& surface : model.surfaces)
    for (const std::uint32_t entity : surface.all_entities) {
      if (entity == surface.entity) continue;
      const auto patch = static_cast<std::uint32_t>(soup.patch_entity.size());
      soup.patch_entity.push_back(entity);
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
        soup.triangles.push_back(model.triangles[t]);
        soup.triangle_patch.push_back(patch);
      }
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

}  // namespace strataflow
