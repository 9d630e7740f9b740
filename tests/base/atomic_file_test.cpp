#include "base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/scratch_folder.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, writes_reads_and_replaces) {
  const support::ScratchFolder scratch;
  const fs::path file = scratch.path() / "a" / "b.txt";
  ASSERT_TRUE(write_file_atomically(file, std::string_view("one")));
  ASSERT_TRUE(write_file_atomically(file, std::string_view("two")));
  const auto text = read_file(file);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), fs::directory_iterator{}), 1) << "no scratch file left";
}

TEST(AtomicFile, a_folder_and_a_missing_file_are_named) {
  const support::ScratchFolder scratch;
  const auto folder = read_file(scratch.path());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.failure().code, FailureCode::unreadable_file);
  EXPECT_NE(folder.failure().what.find("folder"), std::string::npos);
  const auto missing = read_file(scratch.path() / "none");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.failure().what.find("none"), std::string::npos);
}

TEST(AtomicFile, a_pipe_and_an_endless_device_are_refused_at_once) {
  const support::ScratchFolder scratch;
  const fs::path pipe = scratch.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);  // nobody will ever write to it
  for (const fs::path& file : {pipe, fs::path("/dev/zero")}) {
    const auto read = read_file(file);
    ASSERT_FALSE(read) << file;
    EXPECT_EQ(read.failure().code, FailureCode::unreadable_file);
    EXPECT_NE(read.failure().what.find(file.string() + ": is a pipe or a device"), std::string::npos);
    EXPECT_FALSE(read.failure().remedy.empty());
  }
}

TEST(AtomicFile, a_file_that_does_not_know_its_size_is_read_whole) {
  const auto text = read_file("/proc/self/status");
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("Name:"), std::string::npos);
}

TEST(AtomicFile, a_place_that_cannot_be_written_fails_and_leaves_nothing) {
  const auto result = write_file_atomically("/proc/strataflow/none", std::string_view("x"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.failure().code, FailureCode::write_failed);
}

TEST(AtomicFile, scratch_names_do_not_repeat) {
  EXPECT_NE(scratch_name_beside("x/report"), scratch_name_beside("x/report"));
  EXPECT_EQ(scratch_name_beside("x/report/").parent_path(), "x");
}

}  // namespace
}  // namespace strataflow
