#include "io/bytes/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/atomic_file.h"
#include "io/input_samples.h"

namespace strataflow {
namespace {

using ::testing::HasSubstr;

TEST(InputFile, unpacks_gzip_whatever_the_name_says) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "strataflow_packed.ts";
  ASSERT_TRUE(write_file_atomically(file, support::gzipped("GOCAD TSurf 1\n")));
  const Result<std::string> text = read_input_text(file);
  ASSERT_TRUE(text) << describe(text.failure());
  EXPECT_EQ(*text, "GOCAD TSurf 1\n");
  std::filesystem::remove(file);
}

TEST(InputFile, unpacks_several_members_and_ignores_padding) {
  const std::string large(1000000, 'x');
  const std::string packed = support::gzipped(large) + support::gzipped("b") + std::string(100, '\0');
  const Result<std::string> text = unpack_gzip(packed, "f.gz");
  ASSERT_TRUE(text) << describe(text.failure());
  EXPECT_EQ(*text, large + "b");
}

TEST(InputFile, damaged_gzip_is_a_named_failure) {
  const std::string packed = support::gzipped(support::text_of(support::own_sample("gocad/two_layers.ml")));
  for (int tenth = 1; tenth < 10; ++tenth) {
    const Result<std::string> cut = unpack_gzip(packed.substr(0, packed.size() * tenth / 10), "f.gz");
    ASSERT_FALSE(cut) << tenth;
    EXPECT_EQ(cut.failure().code, FailureCode::malformed_file);
    EXPECT_THAT(cut.failure().what, HasSubstr("f.gz: gzip: truncated"));
  }
  std::string wrong_checksum = packed;
  wrong_checksum[packed.size() - 6] = static_cast<char>(wrong_checksum[packed.size() - 6] ^ 1);
  ASSERT_FALSE(unpack_gzip(wrong_checksum, "f.gz"));
  EXPECT_THAT(unpack_gzip(wrong_checksum, "f.gz").failure().what, HasSubstr("incorrect data check"));
}

TEST(InputFile, a_small_file_that_unpacks_to_too_much_is_refused) {
  const Result<std::string> text = unpack_gzip(support::gzipped(std::string(1000000, ' ')), "bomb.gz", 10000);
  ASSERT_FALSE(text);
  EXPECT_THAT(text.failure().what, HasSubstr("more than 10000 bytes"));
}

TEST(InputFile, a_folder_and_a_missing_file_are_named) {
  const Result<std::string> folder = read_input_text(::testing::TempDir());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.failure().code, FailureCode::unreadable_file);
  EXPECT_THAT(folder.failure().what, HasSubstr("folder"));
  EXPECT_EQ(read_input_text("/no/such/file.ml").failure().code, FailureCode::unreadable_file);
}

}  // namespace
}  // namespace strataflow
