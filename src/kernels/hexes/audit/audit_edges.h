#pragma once
#include "kernels/hexes/audit/hex_audit.h"
#include "model/hex_grid.h"

namespace strataflow {

struct AuditedEdges {
  EdgeAudit counts;
  /// Chains of singular edges in space: "valence 3" inside, "boundary valence 1" on the boundary; by valence, inner
  /// ones first.
  std::vector<Polyline> singular_lines;
};

/// Counts the cells around every edge (coudert2024 S1): the balance (1.1) of inner vertices, singular edges, and
/// whether upright edges have the valence of the plan's vertex below them (R21).
AuditedEdges audit_edges(const HexGrid& grid);

}  // namespace strataflow
