#include "graph/parallel/sort_total_order.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/seed.h"
#include "graph/parallel/any_schedule.h"

namespace strataflow {
namespace {

struct Entry {
  std::uint64_t key;
  std::uint32_t id;
  friend bool operator==(const Entry&, const Entry&) = default;
};
bool by_key_then_id(const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.id < b.id; }

std::vector<Entry> entries_with_ties(std::size_t count) {
  std::vector<Entry> entries(count);
  for (std::uint32_t i = 0; i < count; ++i) entries[i] = {mix64(i) % 50, i};
  return entries;
}

TEST(SortTotalOrder, is_what_std_sort_gives_on_every_schedule_at_every_size) {
  for (const std::size_t count : {0u, 1u, 2u, 16383u, 16384u, 16385u, 50000u, 70001u}) {
    auto expected = entries_with_ties(count);
    std::sort(expected.begin(), expected.end(), by_key_then_id);
    const auto input = entries_with_ties(count);
    int schedules = 0;
    support::on_every_schedule([&] {
      if (++schedules > 8 && count > 20000) return;  // a few shuffles of the large ones are enough
      auto entries = input;
      sort_total_order(entries, by_key_then_id);
      EXPECT_TRUE(entries == expected) << count << " entries";
    });
  }
}

}  // namespace
}  // namespace strataflow
