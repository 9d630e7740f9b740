#include "kernels/complexity/box_elements.h"

#include <algorithm>

namespace strataflow {

BoxElements find_box_elements(const StructuralModel& model) {
  const auto is_boundary = [&](std::uint32_t entity) { return model.entities[entity].role == Role::boundary; };
  bool is_named = false;
  for (const Surface& surface : model.surfaces)
    is_named = is_named || std::any_of(surface.all_entities.begin(), surface.all_entities.end(), is_boundary);
  BoxElements box{std::vector<char>(model.surfaces.size(), 0), std::vector<char>(model.lines.size(), 0),
                  std::vector<char>(model.corners.size(), 0)};
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    box.surfaces[s] = is_named
                          ? std::any_of(surface.all_entities.begin(), surface.all_entities.end(), is_boundary)
                          : (surface.region_plus == universe) != (surface.region_minus == universe);
    if (box.surfaces[s] == 0) continue;
    // A corner can stand on a surface without ending one of its lines.
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t)
      for (const std::uint32_t v : model.triangles[t])
        if (model.point_corner[v] >= 0) box.corners[static_cast<std::size_t>(model.point_corner[v])] = 1;
  }
  for (std::size_t l = 0; l < model.lines.size(); ++l)
    for (const std::uint32_t surface : model.lines[l].surfaces)
      if (box.surfaces[surface] != 0) box.lines[l] = 1;
  return box;
}

ElementCounts count_elements(const StructuralModel& model, const BoxElements& box) {
  const auto counted = [](const std::vector<char>& is_box) {
    return static_cast<std::uint64_t>(std::count(is_box.begin(), is_box.end(), 0));
  };
  return {model.regions.size(), counted(box.surfaces), counted(box.lines), counted(box.corners)};
}

}  // namespace strataflow
