#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "kernels/quality/small_meshes.h"
#include "model/structural_model.h"

namespace strataflow {

/// The box [0,2]³ in cubes, its two regions with the interface z = 1, and the mesh of it with all facets. Surfaces:
/// 0 around region 0, 1 around region 1, 2 between them.
struct TwoLayers {
  VolumeMesh mesh = box_mesh(2, 2, 2, 1, true);
  StructuralModel model;

  TwoLayers() {
    model.points = mesh.points;
    model.entities = {{"lower", Role::boundary}, {"upper", Role::boundary}, {"interface", Role::horizon}};
    std::map<std::set<std::uint32_t>, std::uint32_t> facet_of;
    for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
      const std::uint32_t* v = &mesh.cell_vertices[mesh.cell_offsets[cell]];
      for (const auto& [a, b, c] :
           {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{0, 3, 2}}) {
        const auto [found, is_new] =
            facet_of.try_emplace({v[a], v[b], v[c]}, static_cast<std::uint32_t>(mesh.facets.size()));
        if (is_new)
          mesh.facets.push_back({{v[a], v[b], v[c], no_index}, no_index, cell, no_index});
        else
          mesh.facets[found->second].cell_1 = cell;
      }
    }
    std::vector<MeshFacet> kept;
    for (MeshFacet facet : mesh.facets) {
      const std::int32_t below = mesh.cell_region[facet.cell_0];
      if (facet.cell_1 == no_index)
        facet.surface = static_cast<std::uint32_t>(below);
      else if (below != mesh.cell_region[facet.cell_1])
        facet.surface = 2;
      else
        continue;
      kept.push_back(facet);
    }
    mesh.facets = kept;
    for (std::uint32_t surface = 0; surface < 3; ++surface) {
      Surface s;
      s.entity = surface;
      s.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
      for (const MeshFacet& facet : mesh.facets)
        if (facet.surface == surface)
          model.triangles.push_back({facet.vertices[0], facet.vertices[1], facet.vertices[2]});
      s.end_triangle = static_cast<std::uint32_t>(model.triangles.size());
      s.region_minus = surface == 1 ? 1 : 0;
      s.region_plus = surface == 2 ? 1 : universe;
      model.surfaces.push_back(s);
    }
    model.regions = {{"below", 0, {}, 4}, {"above", 1, {}, 4}};
  }
};

}  // namespace strataflow
