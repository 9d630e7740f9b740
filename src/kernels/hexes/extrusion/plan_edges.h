#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/hexes/extrusion/plan_zones.h"
#include "kernels/hexes/labelled_tets.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// An edge of the plan and the quads beside it; side k of a quad runs from its corner k to corner k + 1.
struct PlanEdge {
  std::array<std::uint32_t, 2> points{};
  std::array<std::uint32_t, 2> quads{no_index, no_index};
  std::array<std::uint32_t, 2> sides{};
  std::vector<std::uint32_t> faults;  ///< entities the edge is a trace of
  std::int32_t side_entity = -1;      ///< of the boundary
};

/// How the quads of a plan hang together, and which of their edges are traces of faults.
struct PlanEdges {
  std::vector<PlanEdge> edges;                        ///< by points
  std::vector<std::uint32_t> edge_of;                 ///< per side 4·quad + k
  std::vector<char> is_on_fault;                      ///< per point
  std::vector<char> is_on_outline;                    ///< per point
  std::vector<std::vector<std::uint32_t>> faults_at;  ///< per point: entities, ascending
  std::vector<std::uint32_t> first_wedge;             ///< per point, plus one
  std::vector<std::uint32_t> wedges;                  ///< corners 4·quad + k, by point
  std::vector<double> local_edge_m;                   ///< per point: its shortest edge
  PlanZones zones;

  /// Of a point on the side of a volumetric fault, the corner of a quad outside of it, or no_index.
  std::uint32_t corner_beside_strip(std::uint32_t point) const {
    for (std::uint32_t i = first_wedge[point]; zones.is_on_strip[point] && i < first_wedge[point + 1]; ++i) {
      const std::int32_t zone = zones.zone_of[wedges[i] / 4];
      if (zone < 0 || zones.zones[static_cast<std::size_t>(zone)].role != Role::fault) return wedges[i];
    }
    return no_index;
  }

  std::uint32_t wedge_count(std::uint32_t point) const { return first_wedge[point + 1] - first_wedge[point]; }
};

/// Fails with invalid_input where the plan is no mesh of quads, or follows what the model has not.
Result<PlanEdges> find_plan_edges(const QuadMesh& plan, const LabelledTets& model);

Failure bad_plan(std::string what);

}  // namespace strataflow
