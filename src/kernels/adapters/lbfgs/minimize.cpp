#include "kernels/adapters/lbfgs/minimize.h"

#include <lbfgs.h>

#include <exception>

namespace strataflow {

namespace {

struct Run {
  const Objective& objective;
  const std::function<bool()>& is_cancelled;
  std::vector<double> x, gradient;
  Minimized result;
  std::exception_ptr thrown;  // exceptions must not pass through the C library
};

lbfgsfloatval_t evaluate(void* instance, const lbfgsfloatval_t* x, lbfgsfloatval_t* gradient, int count,
                         lbfgsfloatval_t) {
  Run& run = *static_cast<Run*>(instance);
  if (run.thrown) return 0;
  run.x.assign(x, x + count);
  run.gradient.assign(static_cast<std::size_t>(count), 0.0);
  ++run.result.evaluations;
  double value = 0;
  try {
    value = run.objective(run.x, run.gradient);
  } catch (...) {
    run.thrown = std::current_exception();
  }
  std::copy(run.gradient.begin(), run.gradient.end(), gradient);
  return value;
}

int accept(void* instance, const lbfgsfloatval_t*, const lbfgsfloatval_t*, const lbfgsfloatval_t value,
           const lbfgsfloatval_t, const lbfgsfloatval_t gradient_norm, const lbfgsfloatval_t, int, int, int) {
  Run& run = *static_cast<Run*>(instance);
  if (run.thrown || (run.is_cancelled && run.is_cancelled())) return 1;
  run.result.steps.push_back({value, gradient_norm});
  return 0;
}

const char* words_for(int status) {
  switch (status) {
    case LBFGS_SUCCESS:
    case LBFGS_ALREADY_MINIMIZED:
      return "gradient vanished";
    case LBFGS_STOP:
      return "cancelled";
    case LBFGSERR_MAXIMUMITERATION:
      return "iterations used up";
    default:
      return "no better point along the search direction";
  }
}

}  // namespace

Minimized minimize(std::vector<double>& x, const Objective& objective, const MinimizeOptions& options) {
  Run run{objective, options.is_cancelled, {}, {}, {}, nullptr};
  if (x.empty() || options.iterations == 0) {
    run.result.stopped_by = "nothing to move";
    return run.result;
  }
  lbfgs_parameter_t parameter;
  lbfgs_parameter_init(&parameter);
  parameter.m = static_cast<int>(options.memory);
  parameter.epsilon = options.gradient_ratio;
  parameter.max_iterations = static_cast<int>(options.iterations);
  // Its own buffer: the library's vector instructions want memory it aligned itself.
  const int count = static_cast<int>(x.size());
  lbfgsfloatval_t* buffer = lbfgs_malloc(count);
  std::copy(x.begin(), x.end(), buffer);
  const int status = lbfgs(count, buffer, nullptr, evaluate, accept, &run, &parameter);
  std::copy(buffer, buffer + count, x.begin());
  lbfgs_free(buffer);
  if (run.thrown) std::rethrow_exception(run.thrown);
  run.result.stopped_by = words_for(status);
  return run.result;
}

}  // namespace strataflow
