#pragma once
#include <cstdint>
#include <vector>

#include "kernels/topology/building/edge_table.h"
#include "model/structural_model.h"

namespace strataflow {

/// The space between two neighbouring triangles around an edge of a line.
struct ContactWedge {
  std::uint32_t line = 0;
  std::uint32_t edge = 0;    ///< along the line: from its vertex `edge` to the next
  std::uint32_t region = 0;  ///< in between; may be universe
  std::uint32_t surface_0 = 0, surface_1 = 0;
  double angle_deg = 0;  ///< in (0, 360]
  double length_m = 0;   ///< of the edge
};

/// Every wedge around every line, by line and edge. Around a free border there is one, of 360°. Edges with triangles
/// in no known order are left out.
std::vector<ContactWedge> find_contact_wedges(const StructuralModel& model, const EdgeTable& edges);

/// The smallest angle inside a surface between two of its borders at a corner.
struct CornerAngle {
  std::uint32_t surface = 0;
  std::uint32_t corner = 0;
  double angle_deg = 0;
};

/// For every surface and each of its corners, by surface and corner.
std::vector<CornerAngle> find_corner_angles(const StructuralModel& model, const EdgeTable& edges);

/// Per edge of the table: the line it belongs to, or no_index.
std::vector<std::uint32_t> line_of_edges(const StructuralModel& model, const EdgeTable& edges);

}  // namespace strataflow
