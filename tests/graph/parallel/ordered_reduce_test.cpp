#include "graph/parallel/ordered_reduce.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <string>

#include "base/seed.h"
#include "graph/parallel/any_schedule.h"

namespace strataflow {
namespace {

/// Magnitudes from 1e-8 to 1e8: almost any other bracketing has other last bits.
double summand(std::size_t i) {
  RandomStream random(mix64(i));
  return (random.unit() - 0.5) * std::pow(10.0, static_cast<double>(random.below(17)) - 8.0);
}

TEST(OrderedReduce, a_sum_has_the_same_bits_on_every_schedule) {
  const auto sum = [] { return ordered_reduce(100'003, 0.0, summand, std::plus<>{}); };
  const std::uint64_t expected = std::bit_cast<std::uint64_t>(sum());
  support::on_every_schedule([&] { EXPECT_EQ(std::bit_cast<std::uint64_t>(sum()), expected); });
  double backwards = 0;
  for (std::size_t i = 100'003; i-- > 0;) backwards += summand(i);
  EXPECT_NE(std::bit_cast<std::uint64_t>(backwards), expected) << "the summands do not show the order";
}

TEST(OrderedReduce, operands_stay_in_order) {
  support::on_every_schedule([] {
    const std::string text = ordered_reduce(
        3 * reduce_grain, std::string(),
        [](std::size_t i) { return i % reduce_grain == 0 ? std::to_string(i) + " " : ""; }, std::plus<>{});
    EXPECT_EQ(text, "0 4096 8192 ");
  });
}

TEST(OrderedReduce, nothing_gives_the_identity) {
  EXPECT_EQ(ordered_reduce(
                0, 42, [](std::size_t) { return 1; }, std::plus<>{}),
            42);
}

}  // namespace
}  // namespace strataflow
