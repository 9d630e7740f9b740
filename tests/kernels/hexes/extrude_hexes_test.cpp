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
  const std::size_t edges_on_fault =
      static_cast<std::size_t>(std::count_if(plan.edges.begin(), plan.edges.end(), [&](const FeatureEdge& e) {
        return plan.features[e.feature].name == "F1";
      }));
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
    const auto entity =
        static_cast<std::uint32_t>(std::find_if(space.model.entities.begin(), space.model.entities.end(),
                                                [&](const Entity& e) { return e.name == name; }) -
                                   space.model.entities.begin());
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
    EXPECT_LE(support::furthest_from_entity_m(hexes.grid.mesh, space.model, e), is_wall ? 0.1 : 1e-6)
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
    of_model[static_cast<std::size_t>(space.model.region[t])] +=
        support::six_volumes(p[v[0]], p[v[1]], p[v[2]], p[v[3]]) / 6;
  }
  for (std::size_t c = 0; c < hexes.grid.mesh.cell_count(); ++c)
    of_hexes[static_cast<std::size_t>(hexes.grid.mesh.cell_region[c])] +=
        cell_volume(CellType::hexahedron, support::corners_of(hexes.grid.mesh, c));
  for (std::size_t r = 0; r < of_model.size(); ++r) EXPECT_NEAR(of_hexes[r] / of_model[r], 1, 5e-3) << r;
}

/// Heights of layer `layer` of unit H2 (between H1 and H2) at the corners of all cells, from thinnest to thickest.
std::array<double, 2> thickness_m(const ExtrudedHexes& hexes, std::uint32_t layer) {
  std::array<double, 2> range{1e9, 0};
  for (std::size_t c = 0; c < hexes.grid.mesh.cell_count(); ++c) {
    if (hexes.grid.cell_layer[c] != layer) continue;
    const auto p = support::corners_of(hexes.grid.mesh, c);
    for (std::size_t k = 0; k < 4; ++k) {
      range[0] = std::min(range[0], p[4 + k].z - p[k].z);
      range[1] = std::max(range[1], p[4 + k].z - p[k].z);
    }
  }
  return range;
}

TEST(ExtrudeHexes, lays_layers_parallel_to_the_roof_or_the_floor_of_their_unit) {
  const auto columns = vertical_faults(1, false);
  const VolumeMesh mesh = support::filled(*columns, 80);
  const QuadMesh plan = support::plan_of(*columns, 80);
  for (const LayerLayout layout : {LayerLayout::parallel_to_top, LayerLayout::parallel_to_base}) {
    LayerOptions layers{
        4, {{"H1", 4}, {"H2", 4}, {"H3", 4}, {"Top", 4}}, 12.0, LayerLayout::proportional, {{"H2", layout}}};
    const LayeredSpace space = support::upright(mesh, layers);
    const ExtrudedHexes hexes = extruded(space, plan);
    EXPECT_EQ(hexes.report.squeezed, 0u);
    support::expect_no_inverted_cell(hexes);
    support::expect_conforming(hexes.grid.mesh);
    expect_surfaces_met(space, hexes);
    const bool is_from_top = layout == LayerLayout::parallel_to_top;
    for (const std::uint32_t layer : {4u, 5u, 6u, 7u}) {
      const auto range = thickness_m(hexes, layer);
      if (layer == (is_from_top ? 4u : 7u)) {
        EXPECT_GT(range[1] - range[0], 5) << layer;  // takes what is left
        EXPECT_GT(range[0], 12) << layer;
      } else {
        EXPECT_NEAR(range[0], 12, 1e-3) << layer;
        EXPECT_NEAR(range[1], 12, 1e-3) << layer;
      }
    }
    const auto proportional = thickness_m(hexes, 1);  // of the unit below
    EXPECT_GT(proportional[1] - proportional[0], 2);
  }
}

TEST(ExtrudeHexes, squeezes_parallel_layers_where_their_unit_is_too_thin) {
  const auto columns = vertical_faults(1, false);
  LayerOptions layers{4, {{"H2", 4}}, std::nullopt, LayerLayout::proportional, {{"H2", LayerLayout::parallel_to_top}}};
  const LayeredSpace space = support::upright(support::filled(*columns, 80), layers);  // thickness: the mean of a layer
  const ExtrudedHexes hexes = extruded(space, support::plan_of(*columns, 80));
  EXPECT_GT(hexes.report.squeezed, 0u);
  EXPECT_LT(hexes.report.squeezed, space.layers.level_w.size() * hexes.grid.plan.points.size());
  support::expect_no_inverted_cell(hexes);
  EXPECT_GT(thickness_m(hexes, 4)[0], 10);  // positive everywhere
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

TEST(ExtrudeHexes, makes_a_volumetric_fault_one_cell_thick_that_joins_both_sides) {
  const auto columns = vertical_faults(1, false);
  const LayeredSpace space = support::upright(support::filled(*columns, 80), {2, {}, {}});
  QuadMesh plan = support::plan_of(*columns, 60);
  // The fault's line moves 8 m to the west, the next one to where it lies 8 m to the east of the fault.
  const double fault_x = 1600 * 5.0 / 12, next_x = fault_x + 1600 / 24.0;
  std::vector<char> is_west(plan.points.size(), 0), is_east(plan.points.size(), 0);
  for (std::size_t p = 0; p < plan.points.size(); ++p) {
    is_west[p] = std::abs(plan.points[p].x - fault_x) < 1e-6;
    is_east[p] = std::abs(plan.points[p].x - next_x) < 1e-6;
    if (is_west[p]) plan.points[p].x = fault_x - 8;
    if (is_east[p]) plan.points[p].x = fault_x + 8;
  }
  const auto right = static_cast<std::uint32_t>(plan.features.size());
  plan.features.push_back({"F1 right", Role::fault, 0, -1});
  const auto left = static_cast<std::uint32_t>(
      std::find_if(plan.features.begin(), plan.features.end(), [](const Feature& f) { return f.name == "F1"; }) -
      plan.features.begin());
  plan.features[left] = {"F1 left", Role::fault, 1, static_cast<std::int32_t>(right)};
  for (const auto& quad : plan.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t a = quad[k], b = quad[(k + 1) % 4];
      if (is_east[a] && is_east[b] && a < b) plan.edges.push_back({a, b, right});
    }
  ASSERT_GT(plan.edges.back().feature, left);
  const ExtrudedHexes hexes = extruded(space, plan);
  const VolumeMesh& mesh = hexes.grid.mesh;
  EXPECT_EQ(facet_count(mesh, "F1"), 0u);  // cells instead of faces
  support::expect_no_inverted_cell(hexes);
  support::expect_conforming(mesh);
  ASSERT_EQ(mesh.cell_entity.size(), mesh.cell_count());
  std::size_t in_fault = 0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.cell_entity[c] < 0) continue;
    ++in_fault;
    EXPECT_EQ(mesh.entities[static_cast<std::size_t>(mesh.cell_entity[c])].name, "F1");
    for (const Vec3& p : support::corners_of(mesh, c)) EXPECT_NEAR(std::abs(p.x - fault_x), 8, 1e-6);  // R27
  }
  EXPECT_EQ(in_fault, 24u * 8);
  for (const char* name : {"H1", "H2", "H3"}) {
    const auto entity = static_cast<std::uint32_t>(name[1] - '1');
    EXPECT_LE(support::furthest_from_entity_m(mesh, space.model, entity), 1e-6) << name;
  }
  EXPECT_NEAR(support::volume_m3(hexes) / (1600.0 * 1200 * 400), 1, 1e-9);
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

/// A model whose faults lean and need not be followed, with a plan that does not know of them.
struct Unfollowed {
  LayeredSpace space;
  QuadMesh plan;
};
Unfollowed unfollowed_listric() {
  const auto columns = listric_fault();
  Unfollowed made;
  Result<UprightModel> model = take_model(support::filled(*columns, 100), {"F1"});
  EXPECT_TRUE(model) << describe(model.failure());
  Result<LayeredSpace> space = build_layered_space(*std::move(model), {3, {}, {}});
  EXPECT_TRUE(space) << describe(space.failure());
  made.space = *std::move(space);
  made.plan = support::plan_of(*columns, 100, 200);
  std::erase_if(made.plan.edges,
                [&](const FeatureEdge& e) { return made.plan.features[e.feature].role == Role::fault; });
  return made;
}

TEST(ExtrudeHexes, bridges_the_levels_that_a_fault_which_is_not_followed_leaps_over) {
  const Unfollowed made = unfollowed_listric();
  const Result<ExtrudedHexes> hexes = extrude_hexes(made.space, made.plan);
  ASSERT_TRUE(hexes) << describe(hexes.failure());
  support::expect_no_inverted_cell(*hexes);
  EXPECT_EQ(hexes->report.dead + hexes->report.degenerate, 0u);
  EXPECT_GT(hexes->report.bridged, 20u);
  EXPECT_GT(hexes->report.largest_bridged_m, 1);
  EXPECT_LT(hexes->report.largest_bridged_m, 125);  // a unit
  // Further from the fault than it displaces, horizons are where they were.
  const LabelledTets& model = made.space.model;
  std::vector<Triangle> fault;
  for (const SheetFacet& facet : model.facets)
    if (facet.kind == SheetKind::fault) fault.push_back(facet.vertices);
  const NearestTriangle nearest_fault(TriangleMesh{model.points, fault});
  std::size_t away = 0;
  for (const MeshFacet& facet : hexes->grid.mesh.facets) {
    if (model.entities[facet.surface].role != Role::horizon) continue;
    const NearestTriangle nearest(TriangleMesh{model.points, support::triangles_of(model, facet.surface)});
    for (const std::uint32_t v : facet.vertices) {
      const Vec3& p = hexes->grid.mesh.points[v];
      if (nearest_fault.nearest(p).squared_m2 < 50 * 50) continue;
      EXPECT_LT(nearest.nearest(p).squared_m2, 1e-18);
      ++away;
    }
  }
  EXPECT_GT(away, 100u);
}

TEST(ExtrudeHexes, bridges_the_same_on_every_schedule) {
  const Unfollowed made = unfollowed_listric();
  const std::vector<Vec3> expected = extrude_hexes(made.space, made.plan)->grid.mesh.points;
  support::on_every_schedule(
      [&](const char* schedule) {
        EXPECT_EQ(extrude_hexes(made.space, made.plan)->grid.mesh.points, expected) << schedule;
      },
      2);
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
