#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
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

  /// Per wedge around a point, the first of those it is connected with across edges for which `is_open(edge)`.
  template <typename IsOpen>
  std::vector<std::uint32_t> wedge_groups(std::uint32_t point, const IsOpen& is_open) const {
    const std::uint32_t begin = first_wedge[point], count = wedge_count(point);
    std::vector<std::uint32_t> group(count);
    std::iota(group.begin(), group.end(), 0u);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t quad = wedges[begin + i] / 4, corner = wedges[begin + i] % 4;
      for (const std::uint32_t side : {corner, (corner + 3) % 4}) {
        const std::uint32_t e = edge_of[4 * quad + side];
        const std::uint32_t other = edges[e].quads[edges[e].quads[0] == quad ? 1 : 0];
        for (std::uint32_t j = 0; j < i; ++j) {
          if (wedges[begin + j] / 4 != other || group[j] == group[i] || !is_open(e)) continue;
          const std::uint32_t low = std::min(group[i], group[j]), high = std::max(group[i], group[j]);
          std::replace(group.begin(), group.end(), high, low);
        }
      }
    }
    return group;
  }
};

/// Fails with invalid_input where the plan is no mesh of quads, or follows what the model has not.
Result<PlanEdges> find_plan_edges(const QuadMesh& plan, const LabelledTets& model);

Failure bad_plan(std::string what);

}  // namespace strataflow
