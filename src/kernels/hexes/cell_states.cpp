#include "kernels/hexes/cell_states.h"

#include <functional>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/quality/cell_shape.h"

namespace strataflow {
namespace {

constexpr double closed_ratio = 1e-8;  // of the plan's mean edge

/// Per cell: bit k set when its upright edge from corner k has closed.
std::vector<std::uint8_t> closed_edges(const HexGrid& grid) {
  const double closed_m = closed_ratio * mean_plan_edge_m(grid.plan);
  return parallel_map(
      grid.mesh.cell_count(),
      [&](std::size_t c) {
        const std::array<Vec3, 8> p = hex_corners(grid.mesh, c);
        std::uint8_t closed = 0;
        for (std::size_t k = 0; k < 4; ++k)
          if (length(p[4 + k] - p[k]) <= closed_m) closed = static_cast<std::uint8_t>(closed | 1u << k);
        return closed;
      },
      1024);
}

}  // namespace

std::array<Vec3, 8> hex_corners(const VolumeMesh& mesh, std::size_t cell) {
  std::array<Vec3, 8> p;
  for (std::size_t k = 0; k < 8; ++k) p[k] = mesh.points[mesh.cell_vertices[8 * cell + k]];
  return p;
}

double mean_plan_edge_m(const QuadMesh& plan) {
  const double sum = ordered_reduce(
      plan.quads.size(), 0.0,
      [&](std::size_t q) {
        double around = 0;
        for (std::size_t k = 0; k < 4; ++k)
          around += length(plan.points[plan.quads[q][k]] - plan.points[plan.quads[q][(k + 1) % 4]]);
        return around;
      },
      std::plus<double>());
  return plan.quads.empty() ? 1 : sum / (4.0 * static_cast<double>(plan.quads.size()));
}

std::vector<CellState> cell_states(const HexGrid& grid) {
  const std::vector<std::uint8_t> closed = closed_edges(grid);
  return parallel_map(
      closed.size(),
      [&](std::size_t c) {
        if (closed[c] == 15) return CellState::dead;
        const std::array<Vec3, 8> p = hex_corners(grid.mesh, c);
        for (const CornerFrame& frame : shape_of(CellType::hexahedron).corners) {
          const int sign = orientation_3d(p[frame.corner], p[frame.ends[0]], p[frame.ends[1]], p[frame.ends[2]]);
          // At a closed edge rounding decides the sign.
          if ((closed[c] >> frame.corner % 4 & 1) == 0 && sign <= 0) return CellState::inverted;
        }
        return closed[c] == 0 ? CellState::whole : CellState::wedge;
      },
      256);
}

std::vector<char> vertices_of_closed_edges(const HexGrid& grid) {
  const std::vector<std::uint8_t> closed = closed_edges(grid);
  std::vector<char> is_closed(grid.mesh.points.size(), 0);
  for (std::size_t c = 0; c < closed.size(); ++c)
    for (std::size_t k = 0; k < 8; ++k)
      if (closed[c] >> k % 4 & 1) is_closed[grid.mesh.cell_vertices[8 * c + k]] = 1;
  return is_closed;
}

}  // namespace strataflow
