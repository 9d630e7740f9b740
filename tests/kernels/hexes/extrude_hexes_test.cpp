#include "kernels/hexes/extrude_hexes.h"

#include <gtest/gtest.h>

#include "kernels/hexes/hex_checks.h"
#include "kernels/hexes/tet_models.h"
#include "kernels/reference_models/reference_plans.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::facet_count;

ExtrudedHexes extruded(const LayeredSpace& space, const QuadMesh& plan, const ExtrudeOptions& options = {}) {
  Result<ExtrudedHexes> hexes = extrude_hexes(space, plan, options);
  EXPECT_TRUE(hexes) << describe(hexes.failure());
  return hexes ? std::move(*hexes) : ExtrudedHexes{};
}

void expect_surfaces_met(const LayeredSpace& space, const ExtrudedHexes& hexes, double faults_m = 1e-6) {
  for (std::uint32_t e = 0; e < space.model.entities.size(); ++e) {
    const bool is_fault = space.model.entities[e].role == Role::fault;
    EXPECT_LE(support::furthest_from_entity_m(hexes.grid.mesh, space.model, e), is_fault ? faults_m : 1e-6)
        << space.model.entities[e].name;
  }
}

TEST(ExtrudeHexes, makes_one_cell_for_each_quad_and_layer) {
  const auto columns = vertical_faults(0, false);
  const LayeredSpace space = support::upright(support::filled(*columns, 100), {2, {{"H1", 3}}, {}});
  const QuadMesh plan = support::plan_of(*columns, 60);
  const ExtrudedHexes hexes = extruded(space, plan);
  EXPECT_EQ(hexes.grid.mesh.cell_count(), plan.quads.size() * 9);  // R20
  EXPECT_EQ(hexes.report.dead + hexes.report.degenerate, 0u);
  EXPECT_EQ(hexes.grid.mesh.points.size(), plan.points.size() * 10);
  support::expect_no_inverted_cell(hexes);
  support::expect_conforming(hexes.grid.mesh);
  expect_surfaces_met(space, hexes);
  EXPECT_NEAR(support::volume_m3(hexes) / (1600.0 * 1200 * 400), 1, 1e-9);  // R25
  for (const char* name : {"H1", "H2", "H3", "Top", "Bottom"})
    EXPECT_EQ(facet_count(hexes.grid.mesh, name), plan.quads.size()) << name;
}

TEST(ExtrudeHexes, lets_horizons_jump_at_a_vertical_fault_and_meets_both_sides) {
  const auto columns = vertical_faults(1, false);
  const LayeredSpace space = support::upright(support::filled(*columns, 80), {2, {}, {}});
  const QuadMesh plan = support::plan_of(*columns, 60);
  const ExtrudedHexes hexes = extruded(space, plan);
  support::expect_no_inverted_cell(hexes);
  support::expect_conforming(hexes.grid.mesh);
  expect_surfaces_met(space, hexes);
  EXPECT_NEAR(support::volume_m3(hexes) / (1600.0 * 1200 * 400), 1, 1e-9);
  const std::size_t edges_on_fault = static_cast<std::size_t>(
      std::count_if(plan.edges.begin(), plan.edges.end(),
                    [&](const FeatureEdge& e) { return plan.features[e.feature].name == "F1"; }));
  EXPECT_EQ(facet_count(hexes.grid.mesh, "F1"), 2 * 8 * edges_on_fault);  // both sides, every layer
  EXPECT_EQ(hexes.report.unreached, 0u);
  // The horizons of both sides are 30 m apart on the fault.
  double lowest = 1e9, highest = -1e9;
  for (const MeshFacet& facet : hexes.grid.mesh.facets) {
    if (hexes.grid.mesh.entities[facet.surface].name != "H2") continue;
    for (const std::uint32_t v : facet.vertices) {
      const Vec3& p = hexes.grid.mesh.points[v];
      if (std::abs(p.x - 1600 * 5.0 / 12) > 1e-6 || std::abs(p.y - 600) > 1e-6) continue;
      lowest = std::min(lowest, p.z);
      highest = std::max(highest, p.z);
    }
  }
  EXPECT_NEAR(highest - lowest, 30, 1e-6);
}

TEST(ExtrudeHexes, joins_both_sides_where_a_fault_dies) {
  const auto columns = vertical_faults(2, false);
  const LayeredSpace space = support::upright(support::filled(*columns, 80), {2, {}, {}});
  const QuadMesh plan = support::plan_of(*columns, 60);
  const ExtrudedHexes hexes = extruded(space, plan);
  support::expect_no_inverted_cell(hexes);
  support::expect_conforming(hexes.grid.mesh);
  expect_surfaces_met(space, hexes);
  // At the tips the faces of both sides meet in one edge, so facets of F2 touch each other there.
  std::map<std::uint32_t, int> uses;
  for (const MeshFacet& facet : hexes.grid.mesh.facets)
    if (hexes.grid.mesh.entities[facet.surface].name == "F2")
      for (const std::uint32_t v : facet.vertices) ++uses[v];
  EXPECT_TRUE(std::any_of(uses.begin(), uses.end(), [&](const auto& use) {
    const Vec3& p = hexes.grid.mesh.points[use.first];
    return std::abs(p.x - 1600 * 2.0 / 12) < 1e-6 && use.second == 4;  // two layers on both sides
  }));
}

TEST(ExtrudeHexes, follows_faults_that_cross_abut_and_die) {
  const auto columns = vertical_faults(12, true);
  const LayeredSpace space = support::upright(support::filled(*columns, 60), {2, {}, {}});
  const QuadMesh plan = support::plan_of(*columns, 60);
  const ExtrudedHexes hexes = extruded(space, plan);
  support::expect_no_inverted_cell(hexes);
  support::expect_conforming(hexes.grid.mesh);
  expect_surfaces_met(space, hexes);
  EXPECT_EQ(hexes.report.unreached, 0u);
}

TEST(ExtrudeHexes, keeps_cells_without_volume_beside_an_erosion) {
  const auto columns = unconformity(false);
  const LayeredSpace space = support::upright(support::filled(*columns, 80), {2, {}, {}});
  const QuadMesh plan = support::plan_of(*columns, 50);
  const ExtrudedHexes hexes = extruded(space, plan);
  EXPECT_EQ(hexes.grid.mesh.cell_count(), plan.quads.size() * 12);
  EXPECT_GT(hexes.report.dead, 100u);
  EXPECT_GT(hexes.report.degenerate, 0u);
  support::expect_no_inverted_cell(hexes);
  support::expect_conforming(hexes.grid.mesh);
  // Whole quads beyond the line where E cuts a horizon off lie on E; quads across that line reach past it.
  for (const char* name : {"H1", "H4", "E", "Top", "Bottom"}) {
    const auto entity = static_cast<std::uint32_t>(
        std::find_if(space.model.entities.begin(), space.model.entities.end(),
                     [&](const Entity& e) { return e.name == name; }) - space.model.entities.begin());
    EXPECT_LE(support::furthest_from_entity_m(hexes.grid.mesh, space.model, entity), 1e-6) << name;
  }
  for (const std::uint32_t entity : {1u, 2u})
    EXPECT_LE(support::furthest_from_entity_m(hexes.grid.mesh, space.model, entity), 75);  // a diagonal
  EXPECT_LT(facet_count(hexes.grid.mesh, "H3"), facet_count(hexes.grid.mesh, "H2"));
  EXPECT_NEAR(support::volume_m3(hexes) / (1600.0 * 1000 * 540), 1, 1e-6);
}

TEST(ExtrudeHexes, of_layers_a_centimetre_thick_are_right_side_out) {
  const auto columns = thin_layers();
  const LayeredSpace space = support::upright(support::filled(*columns, 50), {1, {}, {}});
  const ExtrudedHexes hexes = extruded(space, support::plan_of(*columns, 50));
  support::expect_no_inverted_cell(hexes);
  EXPECT_EQ(hexes.report.dead, 0u);
  expect_surfaces_met(space, hexes);
}

TEST(ExtrudeHexes, follows_dipping_faults) {
  for (const std::vector<double>& cots : {std::vector{0.577}, std::vector{0.176, 0.577, 1.0}}) {
    const auto columns = dipping_faults(cots, 15);
    const LayeredSpace space = support::layered(support::filled(*columns, 60), {{}, {3, {}, {}}, false, 600});
    const QuadMesh plan = support::plan_in(space, *columns, 60);
    const ExtrudedHexes hexes = extruded(space, plan);
    support::expect_no_inverted_cell(hexes);
    support::expect_conforming(hexes.grid.mesh);
    expect_surfaces_met(space, hexes);
    EXPECT_EQ(hexes.report.unreached, 0u);
    EXPECT_GT(support::min_scaled_jacobian(hexes), 0.2);  // 45° and 80°
    EXPECT_NEAR(support::volume_m3(hexes) / (2000.0 * 1000 * 400), 1, 5e-3);
  }
}

TEST(ExtrudeHexes, makes_cells_of_the_anticlines_with_faults_of_60_degrees) {
  for (const char* name : {"A1", "A2", "A3", "A4", "A6"}) {
    const auto columns = anticline_model(name);
    const LayeredSpace space = support::layered(support::filled(*columns, 60), {{}, {2, {}, {}}, false, 600});
    const ExtrudedHexes hexes = extruded(space, support::plan_in(space, *columns, 60));
    EXPECT_EQ(hexes.report.inverted, 0u) << name;
    EXPECT_EQ(hexes.report.unreached, 0u) << name;
    EXPECT_EQ(hexes.report.dead > 0, std::string_view(name) == "A6") << name;
    EXPECT_NEAR(support::volume_m3(hexes) / (1600.0 * 930 * 500), 1, 5e-3) << name;
  }
}

TEST(ExtrudeHexes, follows_a_listric_fault) {
  const auto columns = listric_fault();
  const LayeredSpace space = support::layered(support::filled(*columns, 60), {{}, {3, {}, {}}, false, 600});
  const ExtrudedHexes hexes = extruded(space, support::plan_in(space, *columns, 60));
  support::expect_no_inverted_cell(hexes);
  EXPECT_GT(space.turned_over_at_first, 0u);
  EXPECT_TRUE(space.flipped.empty());
  for (std::uint32_t e = 0; e < space.model.entities.size(); ++e) {
    const bool is_wall = space.model.entities[e].role != Role::horizon && space.model.entities[e].name != "Top" &&
                         space.model.entities[e].name != "Bottom";
    // Walls within weak verticality: here the plan's outline bends by metres between its points.
    EXPECT_LE(support::furthest_from_entity_m(hexes.grid.mesh, space.model, e), is_wall ? 5 : 1e-6)
        << space.model.entities[e].name;
  }
  EXPECT_NEAR(support::volume_m3(hexes) / (2000.0 * 1000 * 400), 1, 5e-3);
}

TEST(ExtrudeHexes, gives_every_region_its_volume) {
  const auto columns = dipping_faults(std::array{0.577, 0.176}, 15);
  const VolumeMesh mesh = support::filled(*columns, 60);
  const LayeredSpace space = support::layered(mesh, {{}, {2, {}, {}}, false, 600});
  const ExtrudedHexes hexes = extruded(space, support::plan_in(space, *columns, 60));
  std::vector<double> of_model(mesh.region_names.size(), 0), of_hexes(mesh.region_names.size(), 0);
  for (std::size_t t = 0; t < space.model.tets.size(); ++t) {
    const Tet& v = space.model.tets[t];
    const std::vector<Vec3>& p = space.model.points;
    of_model[static_cast<std::size_t>(space.model.region[t])] += support::six_volumes(p[v[0]], p[v[1]], p[v[2]], p[v[3]]) / 6;
  }
  for (std::size_t c = 0; c < hexes.grid.mesh.cell_count(); ++c)
    of_hexes[static_cast<std::size_t>(hexes.grid.mesh.cell_region[c])] +=
        cell_volume(CellType::hexahedron, support::corners_of(hexes.grid.mesh, c));
  for (std::size_t r = 0; r < of_model.size(); ++r) EXPECT_NEAR(of_hexes[r] / of_model[r], 1, 5e-3) << r;
}

TEST(ExtrudeHexes, sabotaged_by_the_barycentres_tetrahedron_leaves_the_horizons) {
  const auto columns = vertical_faults(1, false);
  const LayeredSpace space = support::upright(support::filled(*columns, 40), {2, {}, {}});
  const QuadMesh plan = support::plan_of(*columns, 80);
  expect_surfaces_met(space, extruded(space, plan));
  EXPECT_GT(support::furthest_from_entity_m(extruded(space, plan, {0.1, true}).grid.mesh, space.model, 1), 0.1);
}

TEST(ExtrudeHexes, sabotaged_by_a_ball_of_no_size_does_not_find_the_side) {
  const auto columns = vertical_faults(1, true);
  const LayeredSpace space = support::upright(support::filled(*columns, 80), {2, {}, {}});
  EXPECT_GT(extruded(space, support::plan_of(*columns, 60), {0, false}).report.unreached, 0u);
}

TEST(ExtrudeHexes, is_the_same_on_every_schedule) {
  const auto columns = vertical_faults(3, true);
  const LayeredSpace space = support::upright(support::filled(*columns, 130), {1, {}, {}});
  const QuadMesh plan = support::plan_of(*columns, 130);
  const ExtrudedHexes expected = extruded(space, plan);
  support::on_every_schedule([&](const char* schedule) {
    const ExtrudedHexes hexes = extruded(space, plan);
    EXPECT_EQ(hexes.grid.mesh.points, expected.grid.mesh.points) << schedule;
    EXPECT_EQ(hexes.grid.mesh.cell_vertices, expected.grid.mesh.cell_vertices) << schedule;
  });
}

TEST(ExtrudeHexes, refuses_plans_that_leave_the_model) {
  const auto columns = vertical_faults(1, false);
  const LayeredSpace space = support::upright(support::filled(*columns, 130), {1, {}, {}});
  QuadMesh plan = support::plan_of(*columns, 130);
  for (Vec3& p : plan.points) p.x += 900;
  EXPECT_FALSE(extrude_hexes(space, plan));
  EXPECT_FALSE(extrude_hexes(space, QuadMesh{}));
  plan = support::plan_of(*columns, 130);
  for (Feature& feature : plan.features) feature.name += "?";
  EXPECT_FALSE(extrude_hexes(space, plan));
  EXPECT_FALSE(extrude_hexes(space, support::plan_of(*columns, 130), {std::nan(""), false}));
}

}  // namespace
}  // namespace strataflow
