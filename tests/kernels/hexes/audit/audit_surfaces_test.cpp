#include "kernels/hexes/audit/audit_surfaces.h"

#include <gtest/gtest.h>

#include "kernels/hexes/audit/audited_models.h"

namespace strataflow {
namespace {

const RegionVolumeAudit& region_named(const std::vector<RegionVolumeAudit>& regions, std::size_t r) {
  return regions.at(r);
}

TEST(AuditSurfaces, covers_horizons_seen_from_above) {
  const support::FilledGrid model = support::hexes_of(*vertical_faults(1, false), 120);
  for (const SurfaceAudit& surface : audit_surfaces(model.hexes.grid, live_cells(model.hexes.grid), model.space.model))
    EXPECT_NEAR(surface.grid_area_m2 / surface.model_area_m2, 1, 1e-9) << surface.name;
}

TEST(AuditSurfaces, counts_an_erosion_once_where_several_levels_lie_on_it) {
  const support::FilledGrid model = support::hexes_of(*unconformity(false), 80);
  for (const SurfaceAudit& surface :
       audit_surfaces(model.hexes.grid, live_cells(model.hexes.grid), model.space.model)) {
    if (surface.name != "E" && surface.name != "H1") continue;
    EXPECT_NEAR(surface.grid_area_m2 / surface.model_area_m2, 1, 1e-9) << surface.name;
  }
}

TEST(AuditSurfaces, tells_vertices_over_faults_from_the_others) {
  support::FilledGrid model = support::hexes_of(*vertical_faults(1, false), 120);
  VolumeMesh& mesh = model.hexes.grid.mesh;
  const std::vector<char> is_on_fault = vertices_on_faults(mesh);
  // Every vertex on the fault sinks by two metres, one of H1 elsewhere by one.
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (is_on_fault[v]) mesh.points[v].z -= 2;
  for (const MeshFacet& facet : mesh.facets) {
    if (mesh.entities[facet.surface].name != "H1" || is_on_fault[facet.vertices[0]]) continue;
    mesh.points[facet.vertices[0]].z -= 1;
    break;
  }
  for (const SurfaceAudit& surface :
       audit_surfaces(model.hexes.grid, live_cells(model.hexes.grid), model.space.model)) {
    if (surface.name != "H1" && surface.name != "H2") continue;
    EXPECT_NEAR(surface.furthest_on_traces_m, 2, 0.1) << surface.name;
    EXPECT_NEAR(surface.furthest_m, surface.name == "H1" ? 1 : 0, 0.05) << surface.name;
  }
}

TEST(AuditSurfaces, tells_steps_past_the_end_of_a_fault_from_faces_beside_it) {
  support::FilledGrid model = support::hexes_of(*vertical_faults(2, false), 120);
  const auto audited = [&] {
    for (const SurfaceAudit& surface :
         audit_surfaces(model.hexes.grid, live_cells(model.hexes.grid), model.space.model))
      if (surface.name == "F2") return surface;
    return SurfaceAudit{};
  };
  VolumeMesh& mesh = model.hexes.grid.mesh;
  std::uint32_t last = no_index;  // of F2, furthest west: at its tip
  for (const MeshFacet& facet : mesh.facets)
    for (const std::uint32_t v : facet.vertices)
      if (mesh.entities[facet.surface].name == "F2" && (last == no_index || mesh.points[v].x < mesh.points[last].x))
        last = v;
  EXPECT_LE(audited().furthest_beyond_m, 1e-9);
  mesh.points[last].x -= 20;
  EXPECT_NEAR(audited().furthest_beyond_m, 20, 0.5);
  EXPECT_LE(audited().furthest_m, 1e-9);
  mesh.points[last].x += 60;
  mesh.points[last].y += 7;
  EXPECT_NEAR(audited().furthest_m, 7, 1e-6);
}

TEST(AuditRegions, allows_more_beside_faults_that_die_than_beside_those_that_go_through) {
  const support::FilledGrid through = support::hexes_of(*vertical_faults(1, false), 120);
  for (const RegionVolumeAudit& region : audit_regions(through.hexes.grid, through.space.model)) {
    EXPECT_EQ(region.stepped_area_m2, 0) << region.name;
    EXPECT_NEAR(region.allowed_m3, 0.005 * region.model_m3, 1e-6 * region.model_m3) << region.name;
    EXPECT_TRUE(region.is_within) << region.name;
  }
  const support::FilledGrid dying = support::hexes_of(*vertical_faults(2, false), 120);
  double stepped = 0;
  for (const RegionVolumeAudit& region : audit_regions(dying.hexes.grid, dying.space.model))
    stepped += region.stepped_area_m2;
  double area = 0;
  for (const SurfaceAudit& surface : audit_surfaces(dying.hexes.grid, live_cells(dying.hexes.grid), dying.space.model))
    if (surface.name == "F2") area = surface.model_area_m2;
  EXPECT_NEAR(stepped, 2 * area, 1e-6 * area);  // both sides of F2 alone
}

TEST(AuditRegions, names_the_region_that_lost_volume) {
  support::FilledGrid model = support::hexes_of(*vertical_faults(0, false), 120);
  for (std::size_t c = 0; c < model.hexes.grid.mesh.cell_count(); ++c)
    if (model.hexes.grid.mesh.cell_region[c] == 1 && c % 7 == 0) model.hexes.grid.mesh.cell_region[c] = 2;
  const std::vector<RegionVolumeAudit> regions = audit_regions(model.hexes.grid, model.space.model);
  EXPECT_TRUE(region_named(regions, 0).is_within);
  EXPECT_FALSE(region_named(regions, 1).is_within);
  EXPECT_FALSE(region_named(regions, 2).is_within);
}

}  // namespace
}  // namespace strataflow
