#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/plan/plan_graph.h"

namespace strataflow {

constexpr double size_growth = 0.4;     ///< of edge lengths, per length
constexpr double smallest_size = 0.2;   ///< near close features, in triangle edge lengths
constexpr double acute_angle_deg = 67;  ///< corners sharper than this keep one triangle

/// The segments of a plan cut to the edge lengths that triangles shall have there: shorter where another curve is near.
struct SampledPlan {
  struct Piece {
    std::array<std::uint32_t, 2> ends{};  ///< points, ascending
    std::uint32_t segment = 0;            ///< of the graph
    bool is_locked = false;               ///< a side of the triangle that fills an acute corner
  };
  std::vector<Vec3> points;    ///< those of the graph first
  std::vector<double> size_m;  ///< per point: wanted edge length
  std::vector<Piece> pieces;
  std::size_t node_count = 0;  ///< points of the graph: they stay where they are
};

/// Around an acute corner all sides get a point at one distance, so that one triangle fills it (coudert2024 S28).
/// Fails with invalid_options when the domain is too large for the edge length.
Result<SampledPlan> sample_plan(const PlanGraph& graph, double triangle_edge_m);

}  // namespace strataflow
