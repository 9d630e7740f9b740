#include "kernels/hexes/extrude_hexes.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/extrusion/fault_surface.h"
#include "kernels/hexes/extrusion/lift_corners.h"
#include "kernels/hexes/extrusion/make_hex_facets.h"
#include "kernels/hexes/extrusion/plan_edges.h"

namespace strataflow {
namespace {

class Extrusion {
 public:
  Extrusion(const LayeredSpace& space, const QuadMesh& plan, const PlanEdges& edges, const ExtrudeOptions& options)
      : space_(space),
        plan_(plan),
        edges_(edges),
        layers_(space.layers.layer_count()),
        lifter_(space, plan, edges, options) {}

  Result<ExtrudedHexes> extrude() {
    if (const auto quad = lifter_.outside_quad()) {
      const Vec3& p = plan_.points[plan_.quads[*quad][0]];
      return bad_plan("the quad around (" + std::to_string(p.x) + ", " + std::to_string(p.y) +
                      ") lies outside the model");
    }
    lift_fault_corners();
    find_fault_faces();
    place_points();
    make_cells();
    judge_cells(result_);
    result_.grid.mesh.facets = make_hex_facets(
        result_.grid,
        {space_, edges_, [&](std::uint32_t edge, std::uint32_t layer) { return is_fault_face(edge, layer); },
         lifter_.edge_m()});
    return std::move(result_);
  }

 private:
  void lift_fault_corners() {
    lifts_of_.assign(4 * plan_.quads.size(), no_index);
    std::vector<std::uint32_t> corners;
    for (std::uint32_t c = 0; c < lifts_of_.size(); ++c) {
      if (!edges_.is_on_fault[plan_.quads[c / 4][c % 4]]) continue;
      lifts_of_[c] = static_cast<std::uint32_t>(corners.size()) * (layers_ + 1);
      corners.push_back(c);
    }
    const std::vector<std::vector<Lift>> columns = parallel_map(
        corners.size(), [&](std::size_t i) { return lifter_.lift_column_on_fault(corners[i]); }, 4);
    for (const std::vector<Lift>& column : columns) lifts_.insert(lifts_.end(), column.begin(), column.end());
  }

  const Lift& lift(std::uint32_t quad, std::uint32_t corner, std::uint32_t level) const {
    return lifts_[lifts_of_[4 * quad + corner % 4] + level];
  }

  /// Per fault edge and layer, whether the fault is there: a ray through the middle of the vertical quad, seen from
  /// either side, meets it (S15). It is shot where faults stand upright, at the height of that middle: in space, the
  /// normal of a quad below a fault that lies flat would meet what lies above.
  void find_fault_faces() {
    is_fault_.assign(edges_.edges.size(), {});
    std::vector<std::uint32_t> candidates;
    upright_points_ = space_.plan;
    for (std::size_t p = 0; p < upright_points_.size(); ++p) upright_points_[p].z = space_.model.points[p].z;
    for (std::uint32_t e = 0; e < edges_.edges.size(); ++e) {
      if (!edges_.edges[e].faults.empty()) candidates.push_back(e);
      for (const std::uint32_t fault : edges_.edges[e].faults)
        if (surface_of_.emplace(fault, surfaces_.size()).second)
          surfaces_.emplace_back(space_.model, fault, upright_points_);
    }
    const std::vector<std::vector<char>> found = parallel_map(candidates.size(), [&](std::size_t i) {
      const PlanEdge& edge = edges_.edges[candidates[i]];
      const Vec3 &begin = plan_.points[edge.points[0]], &end = plan_.points[edge.points[1]];
      const Vec3 across = cross(end - begin, Vec3{0, 0, 1});  // as long as the edge
      std::vector<char> is_there(layers_, 0);
      for (std::uint32_t k = 0; k < layers_; ++k)
        for (std::size_t side = 0; side < 2 && !is_there[k]; ++side) {
          const std::uint32_t q = edge.quads[side], s = edge.sides[side];
          Vec3 middle = 0.5 * (begin + end);
          middle.z = 0.25 * (lift(q, s, k).position.z + lift(q, s + 1, k).position.z +
                             lift(q, s + 1, k + 1).position.z + lift(q, s, k + 1).position.z);
          for (const std::uint32_t fault : edge.faults)
            is_there[k] = is_there[k] || surfaces_[surface_of_.at(fault)].meets(middle - across, middle + across);
        }
      return is_there;
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) is_fault_[candidates[i]] = found[i];
  }

  bool is_fault_face(std::uint32_t edge, std::uint32_t layer) const {
    return !is_fault_[edge].empty() && is_fault_[edge][layer];
  }

  /// Points: column by column, level by level; on faults, one per group of cells that no fault face parts.
  void place_points() {
    struct Column {
      std::vector<Vec3> positions;
      std::vector<std::uint32_t> of;  // per wedge and level; empty: per level alone
      double outside_m = 0;
      std::uint64_t squeezed = 0, bridged = 0;
      double bridged_m = 0;
      void add(const Lift& lift) {
        positions.push_back(lift.position);
        squeezed += lift.is_squeezed ? 1 : 0;
        bridged += lift.is_bridged ? 1 : 0;
        bridged_m = std::max(bridged_m, lift.bridged_m);
        outside_m = std::max(outside_m, lift.outside_m);
      }
    };
    const std::vector<Column> columns = parallel_map(
        plan_.points.size(),
        [&](std::size_t point) {
          Column column;
          const auto p = static_cast<std::uint32_t>(point);
          const std::uint32_t wedge_count = edges_.wedge_count(p);
          if (wedge_count == 0) return column;
          if (!edges_.is_on_fault[p]) {
            for (const Lift& lift : lifter_.lift_column(p)) column.add(lift);
            return column;
          }
          column.of.assign(std::size_t{wedge_count} * (layers_ + 1), 0);
          for (std::uint32_t level = 0; level <= layers_; ++level) {
            const std::vector<std::uint32_t> group = groups_around(p, level);
            for (std::uint32_t i = 0; i < wedge_count; ++i) {
              std::uint32_t& number = column.of[std::size_t{i} * (layers_ + 1) + level];
              if (group[i] != i) {
                number = column.of[std::size_t{group[i]} * (layers_ + 1) + level];
                continue;
              }
              number = static_cast<std::uint32_t>(column.positions.size());
              const Lift* best = nullptr;
              for (std::uint32_t j = i; j < wedge_count; ++j) {
                const Lift& one = lifts_[lifts_of_[edges_.wedges[edges_.first_wedge[p] + j]] + level];
                // Bridged first: beside it, what another wedge holds for the level's place may lie far along it.
                const auto rank = [](const Lift& lift) {
                  return std::pair(!lift.is_bridged, lift.is_bridged ? 0.0 : lift.outside_m);
                };
                if (group[j] == i && (best == nullptr || rank(one) < rank(*best))) best = &one;
              }
              column.add(*best);
            }
          }
          return column;
        },
        8);
    first_point_.assign(1, 0);
    VolumeMesh& mesh = result_.grid.mesh;
    for (const Column& column : columns) {
      mesh.points.insert(mesh.points.end(), column.positions.begin(), column.positions.end());
      first_point_.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      result_.report.largest_outside_m = std::max(result_.report.largest_outside_m, column.outside_m);
      copies_.push_back(column.of);
      result_.report.squeezed += column.squeezed;
      result_.report.bridged += column.bridged;
      result_.report.largest_bridged_m = std::max(result_.report.largest_bridged_m, column.bridged_m);
    }
    for (const Lift& one : lifts_) result_.report.unreached += one.is_unreached ? 1 : 0;
  }

  /// Wedges around a point at a level: each gets the first of those it is connected with, through faces of the layers
  /// below and above that are no fault.
  std::vector<std::uint32_t> groups_around(std::uint32_t p, std::uint32_t level) const {
    return edges_.wedge_groups(p, [&](std::uint32_t e) {
      return (level > 0 && !is_fault_face(e, level - 1)) || (level < layers_ && !is_fault_face(e, level));
    });
  }

  std::uint32_t point_at(std::uint32_t quad, std::uint32_t corner, std::uint32_t level) const {
    const std::uint32_t p = plan_.quads[quad][corner];
    if (copies_[p].empty()) return first_point_[p] + level;
    for (std::uint32_t i = edges_.first_wedge[p];; ++i)
      if (edges_.wedges[i] == 4 * quad + corner)
        return first_point_[p] + copies_[p][std::size_t{i - edges_.first_wedge[p]} * (layers_ + 1) + level];
  }

  void make_cells() {
    HexGrid& grid = result_.grid;
    VolumeMesh& mesh = grid.mesh;
    grid.plan = plan_;
    grid.layers = layers_;
    mesh.local_origin = space_.model.local_origin;
    mesh.entities = space_.model.entities;
    mesh.region_names = space_.model.region_names;
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e)
      mesh.surface_entity.push_back(static_cast<std::int32_t>(e));
    for (std::uint32_t q = 0; q < plan_.quads.size(); ++q)
      for (std::uint32_t k = 0; k < layers_; ++k) {
        std::array<std::uint32_t, 8> corners{};
        for (std::uint32_t c = 0; c < 4; ++c) {
          corners[c] = point_at(q, c, k);
          corners[4 + c] = point_at(q, c, k + 1);
        }
        mesh.add_cell(CellType::hexahedron, corners.data(), region_near(lifter_.tet_of_cell(q, k)));
        grid.cell_column.push_back(q);
        grid.cell_layer.push_back(k);
      }
    label_zones();
    // Where units have no thickness, levels differ by rounding: they take one position, from below.
    for (std::size_t c = 0; c < mesh.cell_count(); ++c)
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& low = mesh.points[mesh.cell_vertices[8 * c + k]];
        Vec3& high = mesh.points[mesh.cell_vertices[8 * c + 4 + k]];
        if (length(high - low) < 1e-9 * lifter_.edge_m()) high = low;
      }
  }

  /// Cells in volumetric faults and well footprints carry their entity; wells come after those of the model.
  void label_zones() {
    const PlanZones& zones = edges_.zones;
    VolumeMesh& mesh = result_.grid.mesh;
    if (zones.zones.empty()) return;
    std::vector<std::int32_t> entity_of;
    for (const Entity& zone : zones.zones) {
      const auto known = std::find_if(mesh.entities.begin(), mesh.entities.end(),
                                      [&](const Entity& e) { return e.name == zone.name && e.role == zone.role; });
      entity_of.push_back(static_cast<std::int32_t>(known - mesh.entities.begin()));
      if (known == mesh.entities.end()) mesh.entities.push_back(zone);
    }
    for (const std::uint32_t q : result_.grid.cell_column)
      mesh.cell_entity.push_back(zones.zone_of[q] < 0 ? -1 : entity_of[static_cast<std::size_t>(zones.zone_of[q])]);
  }

  /// The region of a tetrahedron; of one without volume, that of the nearest of the model.
  std::int32_t region_near(std::uint32_t tet) const {
    std::vector<std::uint32_t> front{tet};
    for (std::size_t i = 0; i < front.size() && i < 64; ++i) {
      if (front[i] < space_.layers.model_tets) return space_.model.region[front[i]];
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t other = space_.layers.neighbour[4 * front[i] + k];
        if (other != no_index) front.push_back(other / 4);
      }
    }
    return 0;
  }

  const LayeredSpace& space_;
  const QuadMesh& plan_;
  const PlanEdges& edges_;
  std::uint32_t layers_ = 0;
  CornerLifter lifter_;
  std::unordered_map<std::uint32_t, std::size_t> surface_of_;  // fault entity to surfaces_; looked up
  std::vector<FaultSurface> surfaces_;
  std::vector<Vec3> upright_points_;     // of the model: u, v, z
  std::vector<std::uint32_t> lifts_of_;  // per corner of a quad: first of lifts_, or no_index
  std::vector<Lift> lifts_;
  std::vector<std::vector<char>> is_fault_;  // per edge: per layer, or empty
  std::vector<std::uint32_t> first_point_;   // per plan point
  std::vector<std::vector<std::uint32_t>> copies_;
  ExtrudedHexes result_;
};

}  // namespace

void judge_cells(ExtrudedHexes& hexes) {
  const std::vector<CellState> states = cell_states(hexes.grid);
  ExtrusionReport& report = hexes.report;
  report.dead = report.degenerate = report.inverted = 0;
  hexes.grid.is_dead.assign(states.size(), 0);
  for (std::size_t c = 0; c < states.size(); ++c) {
    report.dead += states[c] == CellState::dead ? 1 : 0;
    report.degenerate += states[c] == CellState::wedge ? 1 : 0;
    report.inverted += states[c] == CellState::inverted ? 1 : 0;
    hexes.grid.is_dead[c] = states[c] == CellState::dead ? 1 : 0;
  }
}

Result<ExtrudedHexes> extrude_hexes(const LayeredSpace& space, const QuadMesh& plan, const ExtrudeOptions& options) {
  if (!(options.ball_ratio >= 0 && options.ball_ratio <= 0.5))
    return Failure{FailureCode::invalid_options, "ball_ratio must lie in [0, 0.5]", "use 0.1"};
  if (plan.quads.empty()) return bad_plan("the plan has no quads");
  for (const Vec3& p : plan.points)
    if (!is_finite(p)) return bad_plan("the plan has a point that is not finite");
  if (static_cast<double>(plan.quads.size()) * (space.layers.layer_count() + 1.0) * 2 > double(1 << 30))
    return Failure{FailureCode::geometry_failed, "more than 2^30 vertices", "coarsen the plan or take fewer layers"};
  const Result<PlanEdges> edges = find_plan_edges(plan, space.model);
  if (!edges) return edges.failure();
  return Extrusion(space, plan, *edges, options).extrude();
}

}  // namespace strataflow
