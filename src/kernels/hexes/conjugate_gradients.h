#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/hexes/multigrid.h"

namespace strataflow {

/// Solves A x = b by conjugate gradients that a multigrid of A guides, from x; until the residual is below
/// `tolerance_ratio` of b's or `most_steps` are done. Returns the steps. The same bits on every schedule.
std::size_t conjugate_gradients(const Multigrid& guide, const std::vector<double>& b, std::vector<double>& x,
                                double tolerance_ratio, std::size_t most_steps);

/// x with A x = b for each b, A symmetric positive definite and given by its lower triangle: factorised once if small,
/// by one multigrid and conjugate gradients otherwise. `starts` (per b; or none) are near x. Fails with geometry_failed
/// where neither works.
Result<std::vector<std::vector<double>>> solve_symmetric(std::uint32_t size, const std::vector<MatrixEntry>& lower,
                                                         const std::vector<std::vector<double>>& right,
                                                         std::vector<std::vector<double>> starts = {});

}  // namespace strataflow
