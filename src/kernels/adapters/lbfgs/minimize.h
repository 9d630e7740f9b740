#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace strataflow {

struct MinimizeOptions {
  std::size_t iterations = 100;      ///< at most
  std::size_t memory = 7;            ///< pairs of steps and gradient changes kept
  double gradient_ratio = 1e-7;      ///< stop when |gradient| < ratio · max(1, |x|)
  std::function<bool()> is_cancelled = {};  ///< asked after every step
};

/// One accepted step.
struct MinimizeStep {
  double value = 0;
  double gradient_norm = 0;
  static constexpr bool is_flat = true;
};

struct Minimized {
  std::vector<MinimizeStep> steps;
  std::size_t evaluations = 0;
  std::string stopped_by;  ///< in words
};

/// Value of the objective at x, its gradient into `gradient` (same size). May throw: the exception passes through.
using Objective = std::function<double(const std::vector<double>& x, std::vector<double>& gradient)>;

/// Limited-memory BFGS with a line search that satisfies the strong Wolfe conditions (Nocedal 1980, Moré and Thuente
/// 1994; Okazaki's library). Starts from x and leaves the best point found in it. A line search that finds nothing
/// better is the end, not an error. The result depends on nothing but the arguments.
Minimized minimize(std::vector<double>& x, const Objective& objective, const MinimizeOptions& options = {});

}  // namespace strataflow
