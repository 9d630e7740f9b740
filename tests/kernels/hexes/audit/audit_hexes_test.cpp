#include "kernels/hexes/audit/audit_hexes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "kernels/hexes/audit/audited_models.h"
#include "kernels/reference_models/reference_plans.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::audited;
using support::FilledGrid;
using support::hexes_of;
using support::surface_named;

TEST(AuditHexes, finds_nothing_wrong_with_layers_of_a_box) {
  const HexAudit audit = audited(hexes_of(*vertical_faults(0, false), 120));
  EXPECT_EQ(audit.dead + audit.wedges + audit.inverted + audit.misplaced, 0u);
  EXPECT_LE(audit.furthest_from_horizons_m, 1e-6 * audit.diagonal_m);
  EXPECT_EQ(audit.regions_beyond, 0u);
  EXPECT_EQ(audit.edges.unbalanced_vertices + audit.edges.singular_edges, 0u);
  EXPECT_EQ(audit.diagnosis.collocated_nodes.on_faults + audit.diagnosis.collocated_nodes.elsewhere, 0u);
  EXPECT_EQ(audit.diagnosis.nonconforming_faces.on_faults + audit.diagnosis.nonconforming_faces.elsewhere, 0u);
  EXPECT_EQ(audit.diagnosis.parts, 1u);
  EXPECT_GT(audit.min_scaled_jacobian, 0.9);
  EXPECT_LT(audit.lateral_deg.maximum, 5);  // upright sides between middles that a fold hardly lifts
  EXPECT_EQ(audit.across_faults_deg.count, 0u);
}

TEST(AuditHexes, allows_an_offset_fault_what_only_it_may_have) {
  const HexAudit audit = audited(hexes_of(*vertical_faults(1, false), 100));
  EXPECT_GT(audit.diagnosis.nonconforming_faces.on_faults, 0u);
  EXPECT_EQ(audit.diagnosis.nonconforming_faces.elsewhere, 0u);
  EXPECT_EQ(audit.diagnosis.collocated_nodes.elsewhere, 0u);
  EXPECT_GT(audit.across_faults_deg.count, 0u);
  const SurfaceAudit& fault = surface_named(audit, "F1");
  EXPECT_LE(fault.furthest_m, 1e-6 * audit.diagonal_m);
  EXPECT_NEAR(fault.grid_area_m2 / fault.model_area_m2, 1, 1e-9);
  EXPECT_EQ(audit.regions_beyond, 0u);
}

TEST(AuditHexes, counts_dead_cells_and_wedges_beside_an_erosion) {
  const FilledGrid model = hexes_of(*unconformity(false), 80);
  const HexAudit audit = audited(model);
  EXPECT_EQ(audit.dead, model.hexes.report.dead);
  EXPECT_EQ(audit.wedges + audit.inverted, model.hexes.report.degenerate + model.hexes.report.inverted);
  EXPECT_EQ(audit.inverted, 0u);
  EXPECT_EQ(audit.diagnosis.repeated_nodes, audit.wedges);
  EXPECT_EQ(audit.diagnosis.nonconforming_faces.elsewhere, 0u);
  EXPECT_EQ(audit.diagnosis.nonpositive_volumes, 0u);
  EXPECT_EQ(audit.regions_beyond, 0u);
  EXPECT_LE(surface_named(audit, "H1").furthest_m, 1e-6 * audit.diagonal_m);
  EXPECT_LE(surface_named(audit, "H3").furthest_m, 1e-6 * audit.diagonal_m);
}

TEST(AuditHexes, measures_how_far_from_upright_a_dipping_fault_makes_cells) {
  const HexAudit audit = audited(hexes_of(*dipping_faults(std::array{0.577}, 15), 100, 2, false));
  EXPECT_EQ(audit.inverted, 0u);
  EXPECT_GT(audit.lateral_deg.maximum + audit.vertical_deg.maximum, 20);  // 60° from the horizontal
  EXPECT_LT(audit.min_scaled_jacobian, 0.95);
}

/// One thing that is wrong with a grid, and what tells of it.
struct Sabotage {
  const char* name;
  void (*spoil)(FilledGrid&);
  bool (*is_found)(const HexAudit&);
};

/// A vertex over the middle of the plan, at the middle level.
std::uint32_t middle_vertex(const HexGrid& grid) {
  const std::size_t cell = std::size_t{grid.layers} * (grid.plan.quads.size() / 2 + 3) + grid.layers / 2;
  return grid.mesh.cell_vertices[8 * cell];
}

const MeshFacet& facet_on(const FilledGrid& model, std::string_view name) {
  for (const MeshFacet& facet : model.hexes.grid.mesh.facets)
    if (model.hexes.grid.mesh.entities[facet.surface].name == name) return facet;
  ADD_FAILURE() << name;
  return model.hexes.grid.mesh.facets.front();
}

constexpr Sabotage sabotages[] = {
    {"a vertex pulled through its cell",
     [](FilledGrid& m) { m.hexes.grid.mesh.points[middle_vertex(m.hexes.grid)].z += 400; },
     [](const HexAudit& a) { return a.inverted > 0 && a.min_scaled_jacobian < 0 && a.diagnosis.misoriented > 0; }},
    {"a horizon's vertex lifted by a metre",
     [](FilledGrid& m) { m.hexes.grid.mesh.points[facet_on(m, "H2").vertices[2]].z += 1; },
     [](const HexAudit& a) { return a.furthest_from_horizons_m > 0.5; }},
    {"a fault's vertex moved aside",
     [](FilledGrid& m) { m.hexes.grid.mesh.points[facet_on(m, "F1").vertices[0]].x += 3; },
     [](const HexAudit& a) { return a.furthest_from_faults_m > 2.9; }},
    {"a fault's face left out",
     [](FilledGrid& m) {
       auto& facets = m.hexes.grid.mesh.facets;
       facets.erase(facets.begin() + (&facet_on(m, "F1") - facets.data()));
     },
     [](const HexAudit& a) { return a.diagnosis.nonconforming_faces.elsewhere > 0; }},
    {"a column given to the wrong region",
     [](FilledGrid& m) {
       auto& region = m.hexes.grid.mesh.cell_region;
       for (std::size_t c = 0; c < region.size(); ++c)
         if (m.hexes.grid.cell_column[c] < 12) region[c] = 0;
     },
     [](const HexAudit& a) { return a.regions_beyond > 0; }},
    {"a cell marked dead", [](FilledGrid& m) { m.hexes.grid.is_dead[40] = 1; },
     [](const HexAudit& a) { return a.misplaced == 1 && a.diagnosis.repeated_nodes > 0; }},
    {"two sides that no longer share their vertices",
     [](FilledGrid& m) {
       auto& mesh = m.hexes.grid.mesh;
       const std::size_t cell = mesh.cell_count() / 2 + 1;
       for (std::size_t k = 0; k < 8; ++k) {
         mesh.points.push_back(mesh.points[mesh.cell_vertices[8 * cell + k]]);
         mesh.cell_vertices[8 * cell + k] = static_cast<std::uint32_t>(mesh.points.size() - 1);
       }
     },
     [](const HexAudit& a) {
       return a.diagnosis.collocated_nodes.elsewhere > 0 && a.diagnosis.nonconforming_faces.elsewhere > 0 &&
              a.diagnosis.parts == 3;  // the fault makes two
     }},
    {"a cell turned upside down",
     [](FilledGrid& m) {
       auto& v = m.hexes.grid.mesh.cell_vertices;
       for (std::size_t k = 0; k < 4; ++k) std::swap(v[8 * 30 + k], v[8 * 30 + 4 + k]);
     },
     [](const HexAudit& a) { return a.inverted == 1 && a.diagnosis.nonpositive_volumes == 1; }},
    {"cells that swap corners",
     [](FilledGrid& m) {
       auto& v = m.hexes.grid.mesh.cell_vertices;
       std::swap(v[8 * 30 + 1], v[8 * 30 + 2]);
     },
     [](const HexAudit& a) { return a.diagnosis.self_intersecting > 0 && a.inverted > 0; }},
    {"a cell hung on a vertex of another column",
     [](FilledGrid& m) {
       auto& v = m.hexes.grid.mesh.cell_vertices;
       v[8 * (m.hexes.grid.mesh.cell_count() / 2)] = v[0];
     },
     [](const HexAudit& a) { return a.diagnosis.nonconforming_faces.elsewhere > 0; }},
};

TEST(AuditHexes, finds_every_sabotage) {
  const FilledGrid good = hexes_of(*vertical_faults(1, false), 100);
  const HexAudit clean = audited(good);
  for (const Sabotage& sabotage : sabotages) {
    FilledGrid spoilt = good;
    sabotage.spoil(spoilt);
    EXPECT_FALSE(sabotage.is_found(clean)) << sabotage.name;
    EXPECT_TRUE(sabotage.is_found(audited(spoilt))) << sabotage.name;
  }
}

TEST(AuditHexes, finds_what_the_thesis_misprints) {
  const auto columns = vertical_faults(1, false);
  FilledGrid model = hexes_of(*columns, 40);
  const QuadMesh plan = support::plan_of(*columns, 80);
  model.hexes = *extrude_hexes(model.space, plan);
  EXPECT_LT(surface_named(audited(model), "H2").furthest_on_traces_m, 1e-6);
  model.hexes = *extrude_hexes(model.space, plan, {0.1, true});  // t_q instead of t
  EXPECT_GT(surface_named(audited(model), "H2").furthest_on_traces_m, 0.1);
}

TEST(AuditHexes, lists_its_fields_and_comes_back_from_the_store) {
  HexAudit audit = audited(hexes_of(*vertical_faults(1, false), 130));
  std::size_t fields = 0;
  audit.visit_fields([&](const char*, auto&) { ++fields; });
  EXPECT_EQ(fields, 20u);
  const std::vector<std::byte> bytes = archived(audit);
  const std::optional<HexAudit> again = unarchived<HexAudit>(bytes);
  ASSERT_TRUE(again);
  EXPECT_EQ(archived(*again), bytes);
}

TEST(AuditHexes, is_the_same_on_every_schedule) {
  const FilledGrid model = hexes_of(*vertical_faults(3, true), 130, 1);
  HexAudit expected = audited(model);
  const std::vector<std::byte> bytes = archived(expected);
  support::on_every_schedule(
      [&](const char* schedule) {
        HexAudit audit = audited(model);
        EXPECT_EQ(archived(audit), bytes) << schedule;
      },
      2);
}

TEST(AuditHexes, refuses_damaged_grids) {
  const FilledGrid good = hexes_of(*vertical_faults(0, false), 200, 1);
  const auto is_refused = [&](auto spoil) {
    FilledGrid model = good;
    spoil(model.hexes.grid);
    return !audit_hexes(model.hexes.grid, model.space.model);
  };
  EXPECT_FALSE(is_refused([](HexGrid&) {}));
  EXPECT_TRUE(is_refused([](HexGrid& g) { g.mesh.cell_vertices[0] = no_index; }));
  EXPECT_TRUE(is_refused([](HexGrid& g) { g.mesh.facets[0].surface = 99; }));
  EXPECT_TRUE(is_refused([](HexGrid& g) { g.mesh.facets[0].vertices[3] = no_index; }));
  EXPECT_TRUE(is_refused([](HexGrid& g) { g.plan.quads[0][0] = no_index; }));
  EXPECT_TRUE(is_refused([](HexGrid& g) { g.mesh.local_origin.x += 1; }));
  EXPECT_TRUE(is_refused([](HexGrid& g) { g.mesh.points[5].z = std::nan(""); }));
  EXPECT_TRUE(is_refused([](HexGrid& g) { g.is_dead.pop_back(); }));
}

}  // namespace
}  // namespace strataflow
