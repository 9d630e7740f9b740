#include "graph/parallel/parallel_map.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "graph/parallel/any_schedule.h"

namespace strataflow {
namespace {

TEST(ParallelMap, results_are_in_index_order_on_every_schedule) {
  for (const std::size_t grain : {1u, 7u, 1000u})
    support::on_every_schedule([grain] {
      const auto squares = parallel_map(
          100, [](std::size_t i) { return i * i; }, grain);
      ASSERT_EQ(squares.size(), 100u);
      for (std::size_t i = 0; i < 100; ++i) ASSERT_EQ(squares[i], i * i);
    });
}

TEST(ParallelMap, the_lowest_failing_item_is_the_one_reported) {
  support::on_every_schedule([] {
    const auto fail_often = [](std::size_t i) -> int {
      if (i % 20 == 13) throw std::runtime_error(std::to_string(i));
      return 0;
    };
    try {
      parallel_map(200, fail_often);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "13");
    }
  });
}

TEST(ParallelRanges, ranges_are_cut_by_count_and_grain_alone) {
  support::on_every_schedule([] {
    std::vector<std::size_t> ends(4);
    parallel_ranges(10, 3, [&](std::size_t begin, std::size_t end) { ends[begin / 3] = end; });
    EXPECT_EQ(ends, (std::vector<std::size_t>{3, 6, 9, 10}));
  });
}

TEST(ParallelMap, loops_nest) {
  support::on_every_schedule([] {
    const auto sums = parallel_map(20, [](std::size_t i) {
      const auto inner = parallel_map(30, [i](std::size_t j) { return i * j; });
      std::size_t sum = 0;
      for (const std::size_t value : inner) sum += value;
      return sum;
    });
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(sums[i], i * 435);
  });
}

TEST(ParallelMap, nothing_maps_to_nothing) {
  EXPECT_TRUE(parallel_map(0, [](std::size_t) { return 1; }).empty());
}

}  // namespace
}  // namespace strataflow
