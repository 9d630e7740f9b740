#include "kernels/hexes/extrusion/make_hex_facets.h"

#include <gtest/gtest.h>

#include "kernels/hexes/hex_checks.h"
#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

ExtrudedHexes extruded(const ColumnModel& columns) {
  const LayeredSpace space = support::upright(support::filled(columns, 100), {1, {}, {}});
  Result<ExtrudedHexes> hexes = extrude_hexes(space, support::plan_of(columns, 100));
  EXPECT_TRUE(hexes);
  return hexes ? std::move(*hexes) : ExtrudedHexes{};
}

/// A facet's normal, seen from its first cell, points away from that cell.
void expect_outward(const VolumeMesh& mesh) {
  for (const MeshFacet& facet : mesh.facets) {
    std::array<Vec3, 4> p;
    Vec3 middle, centre;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.points[facet.vertices[k]];
    for (const Vec3& corner : support::corners_of(mesh, facet.cell_0)) centre = centre + 0.125 * corner;
    for (const Vec3& corner : p) middle = middle + 0.25 * corner;
    const Vec3 n = cross(p[2] - p[0], p[3] - p[1]);
    if (!(length(n) > 1e-6)) continue;
    EXPECT_GT(dot(n, middle - centre), 0) << mesh.entities[facet.surface].name;
  }
}

TEST(MakeHexFacets, covers_every_level_once_and_looks_outward) {
  const ExtrudedHexes hexes = extruded(*vertical_faults(1, false));
  const std::size_t quads = hexes.grid.plan.quads.size();
  for (const char* name : {"H1", "H2", "H3", "Top", "Bottom"})
    EXPECT_EQ(support::facet_count(hexes.grid.mesh, name), quads) << name;
  expect_outward(hexes.grid.mesh);
}

TEST(MakeHexFacets, gives_an_offset_fault_a_facet_for_each_side_and_one_where_sides_match) {
  const ExtrudedHexes hexes = extruded(*vertical_faults(2, false));
  std::size_t single = 0, common = 0;
  for (const MeshFacet& facet : hexes.grid.mesh.facets) {
    if (hexes.grid.mesh.entities[facet.surface].role != Role::fault) continue;
    ++(facet.cell_1 == no_index ? single : common);
  }
  EXPECT_GT(single, 0u);
  EXPECT_EQ(single % 2, 0u);
}

TEST(MakeHexFacets, calls_coinciding_levels_by_the_surface_that_is_there) {
  const ExtrudedHexes hexes = extruded(*unconformity(false));
  const VolumeMesh& mesh = hexes.grid.mesh;
  std::size_t of_h3 = 0;
  for (const MeshFacet& facet : mesh.facets) {
    if (mesh.entities[facet.surface].name != "H3") continue;
    ++of_h3;
    EXPECT_EQ(hexes.grid.is_dead[facet.cell_1], 0) << "H3 has been eroded all over the quad";
  }
  EXPECT_GT(of_h3, 0u);
  EXPECT_LT(of_h3, hexes.grid.plan.quads.size());
}

}  // namespace
}  // namespace strataflow
