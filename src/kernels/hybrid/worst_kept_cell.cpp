#include "kernels/hybrid/worst_kept_cell.h"

#include <algorithm>
#include <span>

#include "kernels/quality/measure_cell.h"

namespace strataflow {

namespace {

double quality_of(const ThinCell& cell, const std::vector<Vec3>& points) {
  std::array<Vec3, 6> corners;
  const auto count = static_cast<std::size_t>(vertex_count(cell.type));
  for (std::size_t k = 0; k < count; ++k) corners[k] = points[cell.vertices[k]];
  if (state_of(cell, points) == ThinCellState::inverted) return 0;
  return measure_cell(cell.type, std::span(corners).first(count)).scaled_jacobian;
}

}  // namespace

std::function<double(std::uint32_t, const std::vector<Vec3>&)> worst_kept_cell(const std::vector<ThinCell>& kept,
                                                                               std::size_t point_count) {
  std::vector<std::vector<std::uint32_t>> cells_of(point_count);
  for (std::uint32_t c = 0; c < kept.size(); ++c)
    for (int k = 0; k < vertex_count(kept[c].type); ++k) cells_of[kept[c].vertices[k]].push_back(c);
  return [&kept, cells_of = std::move(cells_of)](std::uint32_t point, const std::vector<Vec3>& points) {
    double worst = 1;
    if (point < cells_of.size())  // points that were added have no cells that stay
      for (const std::uint32_t c : cells_of[point]) worst = std::min(worst, quality_of(kept[c], points));
    return worst;
  };
}

}  // namespace strataflow
