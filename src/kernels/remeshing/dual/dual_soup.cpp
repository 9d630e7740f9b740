#include "kernels/remeshing/dual/dual_soup.h"

#include <algorithm>
#include <map>

#include "graph/parallel/sort_total_order.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

using Indices = std::vector<std::uint32_t>;

/// Per triangle its patch, no_index where another stands for it; adds patches of joined surfaces.
Indices join_triangles(const DualMesh& mesh, std::vector<Indices>& patch_surfaces) {
  struct Key {
    Triangle sorted;
    std::uint32_t id;
  };
  std::vector<Key> keys(mesh.triangles.size());
  for (std::uint32_t t = 0; t < keys.size(); ++t) {
    keys[t] = {mesh.triangles[t], t};
    std::sort(keys[t].sorted.begin(), keys[t].sorted.end());
  }
  sort_total_order(keys,
                   [](const Key& a, const Key& b) { return a.sorted != b.sorted ? a.sorted < b.sorted : a.id < b.id; });
  Indices patch_of = mesh.triangle_surface;
  std::map<Indices, std::uint32_t> patch_of_set;
  for (std::size_t begin = 0, end; begin < keys.size(); begin = end) {
    for (end = begin + 1; end < keys.size() && keys[end].sorted == keys[begin].sorted;) ++end;
    if (end == begin + 1) continue;
    Indices surfaces;
    for (std::size_t k = begin; k < end; ++k) {
      surfaces.push_back(mesh.triangle_surface[keys[k].id]);
      patch_of[keys[k].id] = no_index;
    }
    const auto [entry, is_new] =
        patch_of_set.emplace(sorted_unique(std::move(surfaces)), static_cast<std::uint32_t>(patch_surfaces.size()));
    if (is_new) patch_surfaces.push_back(entry->first);
    patch_of[keys[begin].id] = entry->second;
  }
  return patch_of;
}

}  // namespace

DualSoup make_dual_soup(const StructuralModel& model, const DualMesh& mesh) {
  DualSoup made;
  TriangleSoup& soup = made.soup;
  soup.local_origin = model.local_origin;
  soup.entities = model.entities;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) made.patch_surfaces.push_back({s});
  const Indices patch_of = join_triangles(mesh, made.patch_surfaces);
  for (const Indices& surfaces : made.patch_surfaces) {
    Indices entities;
    for (const std::uint32_t s : surfaces)
      entities.insert(entities.end(), model.surfaces[s].all_entities.begin(), model.surfaces[s].all_entities.end());
    entities = sorted_unique(std::move(entities));
    const std::uint32_t main =
        surfaces.size() == 1 ? model.surfaces[surfaces[0]].entity : youngest_of(model.entities, entities);
    std::erase(entities, main);
    soup.patch_entity.push_back(main);
    soup.patch_other_entities.push_back(std::move(entities));
  }

  Indices new_id(mesh.points.size(), no_index);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (patch_of[t] != no_index)
      for (const std::uint32_t corner : mesh.triangles[t]) new_id[corner] = 0;
  for (std::size_t p = 0; p < new_id.size(); ++p) {
    if (new_id[p] == no_index) continue;
    new_id[p] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(mesh.points[p].position);
    made.points.push_back(mesh.points[p]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (patch_of[t] == no_index) continue;
    const Triangle& corners = mesh.triangles[t];
    soup.triangles.push_back({new_id[corners[0]], new_id[corners[1]], new_id[corners[2]]});
    soup.triangle_patch.push_back(patch_of[t]);
  }
  for (const std::uint32_t point : mesh.corner_point)
    made.corner_point.push_back(point == no_index ? no_index : new_id[point]);
  for (const Indices& along : mesh.line_points) {
    Indices kept;
    for (const std::uint32_t point : along)
      if (new_id[point] != no_index && (kept.empty() || kept.back() != new_id[point])) kept.push_back(new_id[point]);
    made.line_points.push_back(std::move(kept));
  }
  return made;
}

}  // namespace strataflow
