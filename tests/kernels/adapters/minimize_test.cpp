#include "kernels/adapters/lbfgs/minimize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace strataflow {
namespace {

double rosenbrock(const std::vector<double>& x, std::vector<double>& gradient) {
  const double a = 1 - x[0], b = x[1] - x[0] * x[0];
  gradient[0] = -2 * a - 400 * x[0] * b;
  gradient[1] = 200 * b;
  return a * a + 100 * b * b;
}

TEST(Minimize, finds_the_bottom_of_a_curved_valley) {
  std::vector<double> x{-1.2, 1};
  const Minimized result = minimize(x, rosenbrock, {.iterations = 100});
  EXPECT_NEAR(x[0], 1, 1e-5);
  EXPECT_NEAR(x[1], 1, 1e-5);
  EXPECT_GE(result.evaluations, result.steps.size());
}

TEST(Minimize, never_accepts_a_worse_value) {
  std::vector<double> x{-1.2, 1};
  const Minimized result = minimize(x, rosenbrock, {.iterations = 60});
  for (std::size_t i = 1; i < result.steps.size(); ++i) EXPECT_LE(result.steps[i].value, result.steps[i - 1].value);
}

TEST(Minimize, stops_when_its_iterations_are_used_up) {
  std::vector<double> x{-1.2, 1};
  const Minimized result = minimize(x, rosenbrock, {.iterations = 3});
  EXPECT_EQ(result.steps.size(), 3u);
  EXPECT_EQ(result.stopped_by, "iterations used up");
}

TEST(Minimize, lets_an_exception_of_the_objective_through) {
  std::vector<double> x{1};
  const Objective failing = [](const std::vector<double>&, std::vector<double>&) -> double {
    throw std::runtime_error("no value here");
  };
  EXPECT_THROW(minimize(x, failing), std::runtime_error);
}

TEST(Minimize, stops_when_cancelled) {
  std::vector<double> x{-1.2, 1};
  std::size_t steps = 0;
  const Minimized result = minimize(x, rosenbrock, {.iterations = 60, .is_cancelled = [&] { return ++steps > 4; }});
  EXPECT_EQ(result.steps.size(), 4u);
}

TEST(Minimize, has_nothing_to_do_without_variables) {
  std::vector<double> x;
  EXPECT_TRUE(minimize(x, rosenbrock).steps.empty());
}

}  // namespace
}  // namespace strataflow
