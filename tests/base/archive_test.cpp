#include "base/archive.h"

#include <gtest/gtest.h>

#include "base/warning.h"

namespace strataflow {
namespace {

struct Nested {
  std::string name;
  std::vector<double> values;
  std::optional<std::int32_t> maybe;
  std::vector<std::string> words;
  template <class A>
  void archive(A& a) {
    a(name, values, maybe, words);
  }
  friend bool operator==(const Nested&, const Nested&) = default;
};

const Nested sample{"fault", {1.5, -0.0, 1e300}, 7, {"a", "", "ccc"}};

TEST(Archive, what_was_written_is_read_back) { EXPECT_EQ(unarchived<Nested>(archived(sample)), sample); }

TEST(Archive, an_absent_value_stays_absent) {
  Nested none = sample;
  none.maybe.reset();
  EXPECT_EQ(unarchived<Nested>(archived(none)), none);
}

TEST(Archive, every_truncation_is_noticed) {
  const std::vector<std::byte> bytes = archived(sample);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(unarchived<Nested>(std::span(bytes.data(), size)).has_value()) << size;
}

TEST(Archive, a_damaged_bool_is_noticed) {
  std::vector<std::byte> bytes = archived(true);
  EXPECT_EQ(bytes.size(), 1u);
  EXPECT_EQ(unarchived<bool>(bytes), true);
  EXPECT_EQ(unarchived<bool>(archived(false)), false);
  bytes[0] = std::byte{2};
  EXPECT_FALSE(unarchived<bool>(bytes).has_value());
  bytes = archived(std::optional<bool>(true));
  bytes[0] = std::byte{0xff};
  EXPECT_FALSE(unarchived<std::optional<bool>>(bytes).has_value());
}

TEST(Archive, bytes_left_over_are_noticed) {
  std::vector<std::byte> bytes = archived(sample);
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(unarchived<Nested>(bytes).has_value());
}

TEST(Archive, an_impossible_count_allocates_nothing) {
  const std::vector<std::byte> bytes = archived(std::uint64_t{0x7fffffffffffffff});
  EXPECT_FALSE(unarchived<std::vector<double>>(bytes).has_value());
  EXPECT_FALSE(unarchived<std::vector<Warning>>(bytes).has_value());
}

}  // namespace
}  // namespace strataflow
