#include "kernels/volumes/merge_regions.h"

#include <array>

#include "base/index_range.h"

namespace strataflow {

Result<VolumeMesh> merged_regions(const StructuralModel& model, FilledRegions filled) {
  std::uint64_t point_count = filled.surfaces.points.size(), tet_count = 0;
  for (const RegionMesh& region : filled.meshes) {
    point_count += region.interior_points.size();
    tet_count += region.tets.size();
  }
  if (const Result<void> checked = check_index_range(point_count, "points", "the mesh of all regions"); !checked)
    return checked.failure();
  if (const Result<void> checked = check_index_range(4 * tet_count, "vertices of cells", "the mesh of all regions");
      !checked)
    return checked.failure();
  VolumeMesh mesh;
  mesh.local_origin = model.local_origin;
  mesh.entities = model.entities;
  for (const Surface& surface : model.surfaces)
    mesh.surface_entity.push_back(static_cast<std::int32_t>(surface.entity));
  for (const Region& region : model.regions) mesh.region_names.push_back(region.name);
  mesh.changes = std::move(filled.changes);
  mesh.points = std::move(filled.surfaces.points);
  mesh.point_line = std::move(filled.surfaces.point_line);
  mesh.point_corner = model.point_corner;

  // Per triangle of the surfaces: the cell on its negative and on its positive side.
  std::vector<std::array<std::uint32_t, 2>> sides(filled.surfaces.triangles.size(), {no_index, no_index});
  for (std::size_t r = 0; r < filled.meshes.size(); ++r) {
    const RegionBoundary& boundary = filled.boundaries[r];
    const RegionMesh& region = filled.meshes[r];
    const auto first_cell = static_cast<std::uint32_t>(mesh.cell_count());
    const auto first_point = static_cast<std::uint32_t>(mesh.points.size());
    const auto boundary_points = static_cast<std::uint32_t>(boundary.points.size());
    mesh.points.insert(mesh.points.end(), region.interior_points.begin(), region.interior_points.end());
    for (const Tet& tet : region.tets) {
      Tet vertices{};
      for (std::size_t k = 0; k < 4; ++k)
        vertices[k] = tet[k] < boundary_points ? boundary.points[tet[k]] : first_point + (tet[k] - boundary_points);
      mesh.add_cell(CellType::tetrahedron, vertices.data(), static_cast<std::int32_t>(r));
    }
    for (std::size_t f = 0; f < boundary.triangles.size(); ++f)
      for (std::size_t side = 0; side < 2; ++side)
        if (region.facet_tets[f][side] != no_index)
          sides[boundary.triangles[f]][side] = first_cell + region.facet_tets[f][side];
  }
  mesh.point_line.resize(mesh.points.size(), -1);
  mesh.point_corner.resize(mesh.points.size(), -1);

  for (std::size_t t = 0; t < sides.size(); ++t) {
    if (sides[t][0] == no_index && sides[t][1] == no_index) continue;  // hangs outside the model
    const Triangle& v = filled.surfaces.triangles[t];
    const std::uint32_t surface = filled.surfaces.triangle_surface[t];
    if (sides[t][0] != no_index)
      mesh.facets.push_back({{v[0], v[1], v[2], no_index}, surface, sides[t][0], sides[t][1]});
    else
      mesh.facets.push_back({{v[0], v[2], v[1], no_index}, surface, sides[t][1], no_index});
  }
  for (std::size_t s = 0; s < model.surfaces.size(); ++s)
    if (model.surfaces[s].region_minus == universe && model.surfaces[s].region_plus == universe)
      mesh.changes.push_back(
          {"skipped_surface",
           "surface " + std::to_string(s) + " (" + model.entities[model.surfaces[s].entity].name + ")",
           "it lies outside every region"});
  return mesh;
}

}  // namespace strataflow
