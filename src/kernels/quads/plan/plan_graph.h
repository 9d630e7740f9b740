#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/plan/plan_curves.h"

namespace strataflow {

/// A plane graph without crossings: what must become edges of the triangulation.
struct PlanGraph {
  struct Segment {
    std::uint32_t a = 0, b = 0;           ///< points
    std::vector<std::uint32_t> features;  ///< ascending
    double short_below_m = 0;
    std::vector<Vec3> trace;  ///< points of the input that it stands for, besides those of its ends
  };
  std::vector<Vec3> points;
  std::vector<char> is_required;              ///< per point: a point that was asked for
  std::vector<std::vector<Vec3>> stands_for;  ///< per point: points of the input it has taken up
  std::vector<Segment> segments;              ///< no two with the same ends
  std::vector<Feature> features;
  std::vector<Change> changes;
  double edge_length_m = 0;

  /// Segments around each point, ascending.
  std::vector<std::vector<std::uint32_t>> incident() const;
};

/// Cuts curves at everything they share, exactly, until rounding the crossings makes no new ones.
Result<PlanGraph> arrange_curves(PlanCurves plan);

/// Contracts short edges, shortest first (coudert2024 S10 with its details a–f): points between two edges of a curve
/// are dropped, junctions and ends closer than `limit_m` are merged. Kept are ends, junctions and points where other
/// curves begin; no curve gets further than `limit_m` from the input; no step makes a crossing (decided exactly).
void contract_short_edges(PlanGraph& graph, double limit_m);

}  // namespace strataflow
