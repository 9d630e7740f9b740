#include "kernels/sealing/trim_outside.h"

#include <algorithm>

#include "kernels/sealing/without_surfaces.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

bool is_boundary(const StructuralModel& model, const Surface& surface) {
  return std::any_of(surface.all_entities.begin(), surface.all_entities.end(),
                     [&](std::uint32_t e) { return model.entities[e].role == Role::boundary; });
}

/// Per region, and last for the universe: it can be reached from the universe without crossing a boundary surface.
/// Where that is every region, something else bounds the model (a topography), and only the universe counts.
std::vector<char> find_outside(const StructuralModel& model) {
  const auto beyond = static_cast<std::uint32_t>(model.regions.size());
  const auto node = [&](std::uint32_t region) { return region == universe ? beyond : region; };
  UnionFind reached(beyond + 1);
  for (const Surface& surface : model.surfaces)
    if (!is_boundary(model, surface)) reached.unite(node(surface.region_plus), node(surface.region_minus));
  std::vector<char> is_outside(beyond + 1, 0);
  for (std::uint32_t r = 0; r <= beyond; ++r) is_outside[r] = reached.find(r) == reached.find(beyond);
  if (std::find(is_outside.begin(), is_outside.end(), 0) == is_outside.end()) {
    std::fill(is_outside.begin(), is_outside.end(), 0);
    is_outside[beyond] = 1;
  }
  return is_outside;
}

}  // namespace

Result<TrimmedSurfaces> trim_outside(const TriangleSoup& soup) {
  TrimmedSurfaces result;
  result.soup = soup;
  const bool has_boundary =
      std::any_of(soup.entities.begin(), soup.entities.end(), [](const Entity& e) { return e.role == Role::boundary; });
  if (!has_boundary || soup.triangles.empty()) return result;
  const Result<BuiltModel> built = build_structural_model(soup);
  if (!built) return built.failure();
  const StructuralModel& model = built->model;
  if (model.regions.empty()) return result;

  const std::vector<char> is_outside = find_outside(model);
  const auto lies_outside = [&](std::uint32_t region) {
    return is_outside[region == universe ? model.regions.size() : region] != 0;
  };
  std::vector<std::uint32_t> outside;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    const bool is_beyond = surface.region_plus == universe && surface.region_minus == universe;
    if (!is_beyond &&
        (is_boundary(model, surface) || !lies_outside(surface.region_plus) || !lies_outside(surface.region_minus)))
      continue;
    result.pieces.push_back({surface.entity, surface.end_triangle - surface.first_triangle, area_m2(model, surface),
                             model.points[model.triangles[surface.first_triangle][0]]});
    outside.push_back(s);
  }
  if (!outside.empty()) result.soup = without_surfaces(soup, model, outside);
  return result;
}

}  // namespace strataflow
