#include "kernels/quads/map/exact_elimination.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

using Term = ExactElimination::Term;
using Outcome = ExactElimination::Outcome;

Outcome add(ExactElimination& system, std::vector<Term> terms, std::int64_t value) { return system.add(terms, value); }

TEST(ExactElimination, expresses_variables_by_the_free_ones) {
  ExactElimination system(4);
  EXPECT_EQ(add(system, {{0, 1}, {1, -1}}, 3), Outcome::used);           // a = b + 3
  EXPECT_EQ(add(system, {{1, 2}, {2, 3}, {3, 1}}, 1), Outcome::used);    // d = 1 − 2b − 3c
  EXPECT_EQ(add(system, {{0, 2}, {2, 3}, {3, 1}}, 7), Outcome::redundant);
  EXPECT_EQ(add(system, {{0, 2}, {2, 3}, {3, 1}}, 8), Outcome::contradiction);
  int free = 0;
  for (std::uint32_t v = 0; v < 4; ++v) free += system.is_free(v);
  EXPECT_EQ(free, 2);
  const auto difference = system.resolve(std::vector<Term>{{0, 1}, {1, -1}});
  EXPECT_TRUE(difference.terms.empty());
  EXPECT_EQ(difference.constant, (Rational{3, 1}));
}

TEST(ExactElimination, keeps_fractions_exact) {
  ExactElimination system(2);
  EXPECT_EQ(add(system, {{0, 3}, {1, 2}}, 1), Outcome::used);
  EXPECT_EQ(add(system, {{0, 3}, {1, -2}}, 0), Outcome::used);
  EXPECT_EQ(system.resolve(0).constant, (Rational{1, 6}));
  EXPECT_EQ(system.resolve(1).constant, (Rational{1, 4}));
}

TEST(ExactElimination, follows_long_chains) {
  constexpr std::uint32_t count = 20000;
  ExactElimination system(count);
  for (std::uint32_t i = 0; i + 1 < count; ++i) EXPECT_EQ(add(system, {{i, 1}, {i + 1, -1}}, 0), Outcome::used);
  EXPECT_EQ(system.resolve(0), system.resolve(count - 1));
  EXPECT_EQ(add(system, {{7, 1}, {count - 9, -1}}, 1), Outcome::contradiction);
}

TEST(ExactElimination, says_when_numbers_grow_too_large) {
  constexpr std::uint32_t count = 80;
  ExactElimination system(count);
  Outcome last = Outcome::used;
  for (std::uint32_t i = 0; i + 1 < count && last == Outcome::used; ++i) last = add(system, {{i, 1}, {i + 1, -7}}, 0);
  if (last == Outcome::used) last = add(system, {{0, 1}}, 1);
  if (last == Outcome::used) {
    for (std::uint32_t v = 0; v < count; ++v) system.resolve(v);
    EXPECT_TRUE(system.overflowed());
  } else {
    EXPECT_EQ(last, Outcome::overflow);
  }
}

}  // namespace
}  // namespace strataflow
