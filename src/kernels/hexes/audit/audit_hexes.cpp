#include "kernels/hexes/audit/audit_hexes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/audit/audit_edges.h"
#include "kernels/hexes/audit/audit_surfaces.h"
#include "kernels/hexes/audit/diagnose_cells.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/smooth_hexes.h"
#include "kernels/simulation_grid/cell_contacts.h"
#include "kernels/simulation_grid/plan_blocks.h"
#include "model/box3.h"

namespace strataflow {
namespace {

Failure damaged(std::string what) {
  return {FailureCode::invalid_input, std::move(what), "report this: the hexahedral grid is damaged"};
}

/// What the rest reads without looking: indices and counts.
std::optional<Failure> damage_of(const HexGrid& grid, const LabelledTets& model) {
  const VolumeMesh& mesh = grid.mesh;
  if (!(mesh.local_origin == model.local_origin)) return damaged("the grid and the model have different local origins");
  if (model.points.empty() || model.tets.empty()) return damaged("the model has no tetrahedra");
  for (const auto& quad : grid.plan.quads)
    for (const std::uint32_t p : quad)
      if (p >= grid.plan.points.size()) return damaged("a quad of the plan has a corner that is not there");
  for (const FeatureEdge& edge : grid.plan.edges)
    if (edge.a >= grid.plan.points.size() || edge.b >= grid.plan.points.size())
      return damaged("an edge of the plan has an end that is not there");
  if (mesh.cell_count() > (std::size_t{1} << 28)) return damaged("more than 2^28 cells");
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const MeshFacet& facet = mesh.facets[f];
    const bool is_good = facet.surface < mesh.surface_entity.size() && mesh.surface_entity[facet.surface] >= 0 &&
                         static_cast<std::size_t>(mesh.surface_entity[facet.surface]) < mesh.entities.size() &&
                         facet.cell_0 < mesh.cell_count() &&
                         std::all_of(facet.vertices.begin(), facet.vertices.end(),
                                     [&](std::uint32_t v) { return v < mesh.points.size(); });
    if (!is_good) return damaged("facet " + std::to_string(f) + " is no quadrilateral of a surface");
  }
  if (mesh.entities.size() < model.entities.size()) return damaged("the grid has other entities than the model");
  for (const MeshFacet& facet : mesh.facets)
    if (static_cast<std::size_t>(mesh.surface_entity[facet.surface]) >= model.entities.size())
      return damaged("a facet lies on what is no surface of the model");
  return std::nullopt;
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return std::atan2(length(cross(a, b)), std::abs(dot(a, b))) * 180 / std::numbers::pi;
}

Distribution degrees(const char* name) { return Distribution(name, 0, 90, 30); }

}  // namespace

Result<HexAudit> audit_hexes(const HexGrid& grid, const LabelledTets& model) {
  if (auto damage = damage_of(grid, model)) return std::move(*damage);
  const Result<std::vector<std::uint32_t>> cells = cells_by_column(grid);
  if (!cells) return cells.failure();
  const Result<std::vector<std::uint32_t>> opposite = opposite_half_edges(grid.plan);
  if (!opposite) return opposite.failure();
  const VolumeMesh& mesh = grid.mesh;
  HexAudit audit;
  audit.edge_length_m = mean_plan_edge_m(grid.plan);
  Box3 box;
  for (const Vec3& p : model.points) box.take(p);
  audit.diagonal_m = length(box.high - box.low);

  const std::vector<CellState> states = cell_states(grid);
  audit.cells = states.size();
  for (std::size_t c = 0; c < states.size(); ++c) {
    audit.dead += states[c] == CellState::dead ? 1 : 0;
    audit.wedges += states[c] == CellState::wedge ? 1 : 0;
    audit.inverted += states[c] == CellState::inverted ? 1 : 0;
    audit.misplaced += (states[c] == CellState::dead) != (grid.is_dead[c] != 0) ? 1 : 0;
  }
  const std::vector<double> jacobian = parallel_map(
      states.size(),
      [&](std::size_t c) {
        const bool is_open = states[c] == CellState::whole || states[c] == CellState::inverted;
        return is_open ? scaled_jacobian(hex_corners(mesh, c)) : 2.0;  // none
      },
      512);
  audit.scaled_jacobian = Distribution("scaled_jacobian", -1, 1, 40);
  for (const double value : jacobian)
    if (value <= 1.5) audit.scaled_jacobian.add(value);
  audit.min_scaled_jacobian = audit.scaled_jacobian.minimum;
  audit.mean_scaled_jacobian = audit.scaled_jacobian.mean();

  const std::vector<CellContact> contacts = find_cell_contacts(grid, *cells, *opposite);
  const std::vector<Vec3> middles = parallel_map(
      states.size(),
      [&](std::size_t c) {
        Vec3 middle;
        for (const Vec3& p : hex_corners(mesh, c)) middle = middle + 0.125 * p;
        return middle;
      },
      1024);
  audit.lateral_deg = degrees("lateral_deg");
  audit.vertical_deg = degrees("vertical_deg");
  audit.across_faults_deg = degrees("across_faults_deg");
  for (const CellContact& contact : contacts) {
    const bool is_vertical = contact.side_0 >= 4;
    Distribution& distribution = is_vertical                 ? audit.vertical_deg
                                 : contact.fault != no_index ? audit.across_faults_deg
                                                             : audit.lateral_deg;
    if (length(contact.area) > 0)
      distribution.add(angle_deg(contact.area, middles[contact.cell_1] - middles[contact.cell_0]));
  }

  const LiveCells live = live_cells(grid);
  audit.surfaces = audit_surfaces(grid, live, model);
  for (const SurfaceAudit& surface : audit.surfaces) {
    const std::optional<Role> role = role_from(surface.role);
    if (role == Role::horizon || role == Role::unconformity)
      audit.furthest_from_horizons_m = std::max(audit.furthest_from_horizons_m, surface.furthest_m);
    if (role == Role::fault) audit.furthest_from_faults_m = std::max(audit.furthest_from_faults_m, surface.furthest_m);
  }
  audit.regions = audit_regions(grid, model);
  audit.regions_beyond = static_cast<std::uint64_t>(std::count_if(
      audit.regions.begin(), audit.regions.end(), [](const RegionVolumeAudit& r) { return !r.is_within; }));
  AuditedEdges edges = audit_edges(grid);
  audit.edges = edges.counts;
  audit.singular_lines = std::move(edges.singular_lines);
  audit.diagnosis = diagnose_cells(grid, live);
  return audit;
}

}  // namespace strataflow
