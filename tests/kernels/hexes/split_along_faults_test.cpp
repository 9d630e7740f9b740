#include "kernels/hexes/split_along_faults.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

/// Copies of each point of the model that fulfils a condition, smallest and largest.
template <class Condition>
std::pair<int, int> copies_where(const LabelledTets& tets, const FaultSplit& split, Condition condition) {
  std::vector<int> count(tets.points.size(), 0);
  for (const std::uint32_t p : split.original) ++count[p];
  int least = 99, most = 0;
  for (std::size_t p = 0; p < count.size(); ++p)
    if (condition(tets.points[p])) {
      least = std::min(least, count[p]);
      most = std::max(most, count[p]);
    }
  return {least, most};
}

TEST(SplitAlongFaults, gives_as_many_copies_as_sides_and_one_at_tips) {  // R7
  const Result<LabelledTets> tets = label_tets(support::filled(*vertical_faults(2, false), 80));
  ASSERT_TRUE(tets);
  const FaultSplit split = split_along_faults(*tets);
  const double f1 = 1600 * 5.0 / 12, f2 = 1200 * 7.0 / 12, west = 1600 * 2.0 / 12, east = 1600 * 10.0 / 12;
  const auto is = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  using Copies = std::pair<int, int>;
  EXPECT_EQ(copies_where(*tets, split, [&](const Vec3& p) { return is(p.x, f1) && !is(p.y, f2); }), Copies(2, 2));
  EXPECT_EQ(copies_where(*tets, split, [&](const Vec3& p) { return is(p.x, f1) && is(p.y, f2); }), Copies(4, 4));
  EXPECT_EQ(copies_where(*tets, split, [&](const Vec3& p) { return is(p.y, f2) && (is(p.x, west) || is(p.x, east)); }),
            Copies(1, 1));
  EXPECT_EQ(copies_where(*tets, split, [&](const Vec3& p) { return !is(p.x, f1) && !is(p.y, f2); }), Copies(1, 1));
}

TEST(SplitAlongFaults, leaves_cells_where_they_are) {
  const Result<LabelledTets> tets = label_tets(support::filled(*vertical_faults(2, true), 150));
  ASSERT_TRUE(tets);
  const FaultSplit split = split_along_faults(*tets);
  ASSERT_EQ(split.tets.size(), tets->tets.size());
  for (std::size_t t = 0; t < split.tets.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(split.original[split.tets[t][k]], tets->tets[t][k]);
}

}  // namespace
}  // namespace strataflow
