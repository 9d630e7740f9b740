#include "kernels/cutting/suspected_repeats.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/seed.h"

namespace strataflow {
namespace {

bool is_same(Triangle a, Triangle b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

TEST(SuspectedRepeats, names_every_repeated_triangle_and_few_others) {
  RandomStream random(3);
  std::vector<Triangle> triangles;
  while (triangles.size() < 3000) {
    const auto v = [&] { return static_cast<std::uint32_t>(random.below(1500)); };
    const Triangle t{v(), v(), v()};
    triangles.push_back(t);
    if (random.below(20) == 0) triangles.push_back({t[2], t[0], t[1]});
    if (random.below(20) == 0) triangles.push_back({t[1], t[0], t[2]});
  }
  const std::vector<std::uint32_t> suspects = suspected_repeats(1500, triangles);
  EXPECT_TRUE(std::is_sorted(suspects.begin(), suspects.end()));
  std::size_t repeated = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    bool repeats = false;
    for (std::uint32_t u = 0; u < triangles.size() && !repeats; ++u)
      repeats = u != t && is_same(triangles[t], triangles[u]);
    repeated += repeats;
    EXPECT_TRUE(!repeats || std::binary_search(suspects.begin(), suspects.end(), t)) << t;
  }
  EXPECT_GT(repeated, 400u);
  EXPECT_LT(suspects.size(), repeated + 500);
}

TEST(SuspectedRepeats, leaves_out_what_is_marked) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {2, 1, 0}, {1, 2, 0}};
  EXPECT_EQ(suspected_repeats(6, triangles), (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(suspected_repeats(6, triangles, {1, 0, 0, 0}), (std::vector<std::uint32_t>{2, 3}));
  EXPECT_TRUE(suspected_repeats(6, triangles, {1, 0, 1, 0}).empty());
}

}  // namespace
}  // namespace strataflow
