#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kernels/hybrid/thin_cell.h"

namespace strataflow {

/// What improve_cells asks of cells that stay: the smallest scaled Jacobian of `kept` at a point, 0 where a cell is
/// inverted, 1 where the point has none. `kept` must outlive it; `point_count`: beyond every corner of `kept`.
std::function<double(std::uint32_t point, const std::vector<Vec3>& points)> worst_kept_cell(
    const std::vector<ThinCell>& kept, std::size_t point_count);

}  // namespace strataflow
