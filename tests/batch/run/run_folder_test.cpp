#include "batch/run/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/command_line.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;
using support::read_text;
using support::write_text;

std::vector<std::byte> bytes(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(RunFolder, is_made_with_its_parents) {
  const support::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "out" / "job";
  ASSERT_TRUE(replace_run_folder(folder, {{"report.json", bytes("{}")}}));
  EXPECT_EQ(read_text(folder / "report.json"), "{}");
  EXPECT_THAT(names_in(folder.parent_path()), testing::ElementsAre("job"));
}

TEST(RunFolder, replaces_the_old_one_as_a_whole) {
  const support::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "job";
  ASSERT_TRUE(replace_run_folder(folder, {{"report.json", bytes("old")}, {"tets.vtu", bytes("old")}}));
  ASSERT_TRUE(replace_run_folder(folder, {{"report.json", bytes("new")}}));
  EXPECT_EQ(read_text(folder / "report.json"), "new");
  EXPECT_FALSE(fs::exists(folder / "tets.vtu"));
  EXPECT_THAT(names_in(scratch.path()), testing::ElementsAre("job"));
}

TEST(RunFolder, carries_over_what_a_person_left_in_it) {
  const support::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "job";
  ASSERT_TRUE(replace_run_folder(folder, {{"report.json", bytes("old")}}));
  write_text(folder / "notes.txt", "mine");
  write_text(folder / "out" / "deeper" / "report.json", "mine too");
  ASSERT_TRUE(replace_run_folder(folder, {{"report.json", bytes("new")}}));
  EXPECT_EQ(read_text(folder / "notes.txt"), "mine");
  EXPECT_EQ(read_text(folder / "out" / "deeper" / "report.json"), "mine too");
}

TEST(RunFolder, stays_as_it_was_when_a_file_cannot_be_written) {
  const support::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "job";
  ASSERT_TRUE(replace_run_folder(folder, {{"report.json", bytes("old")}}));
  const Result<void> written =
      replace_run_folder(folder, {{"report.json", bytes("new")}, {"no/such/folder", bytes("x")}});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.failure().code, FailureCode::write_failed);
  EXPECT_EQ(read_text(folder / "report.json"), "old");
  EXPECT_THAT(names_in(scratch.path()), testing::ElementsAre("job"));
}

TEST(RunFolder, clears_away_what_killed_runs_left) {
  const support::ScratchFolder scratch;
  write_text(scratch.path() / ".job.part-abc123" / "report.json", "half");
  write_text(scratch.path() / ".other.part-abc123" / "report.json", "of another job");
  ASSERT_TRUE(replace_run_folder(scratch.path() / "job", {{"report.json", bytes("new")}}));
  EXPECT_THAT(names_in(scratch.path()), testing::ElementsAre(".other.part-abc123", "job"));
}

TEST(RunFolder, changes_place_by_renames_where_the_file_system_cannot_exchange) {
  const support::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "job", part = scratch.path() / ".job.part-abc123";
  write_text(folder / "report.json", "old");
  write_text(part / "report.json", "new");
  ASSERT_TRUE(replace_by_renames(part, folder));
  EXPECT_EQ(read_text(folder / "report.json"), "new");
  EXPECT_EQ(read_text(part / "report.json"), "old");
  EXPECT_THAT(names_in(scratch.path()), testing::ElementsAre(".job.part-abc123", "job"));
}

TEST(RunFolder, goes_back_when_the_new_one_cannot_take_its_place) {
  const support::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "job";
  write_text(folder / "report.json", "old");
  const Result<void> replaced = replace_by_renames(scratch.path() / ".job.part-gone", folder);
  ASSERT_FALSE(replaced);
  EXPECT_EQ(replaced.failure().code, FailureCode::write_failed);
  EXPECT_EQ(read_text(folder / "report.json"), "old");
  EXPECT_THAT(names_in(scratch.path()), testing::ElementsAre("job"));
}

TEST(RunFolder, set_aside_by_a_killed_run_is_put_back_before_the_next_one_replaces_it) {
  const support::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "job";
  write_text(scratch.path() / ".job.part-abc123.old" / "report.json", "old");
  write_text(scratch.path() / ".job.part-abc123.old" / "notes.txt", "mine");
  ASSERT_FALSE(replace_run_folder(folder, {{"no/such/folder", bytes("x")}}));
  EXPECT_EQ(read_text(folder / "report.json"), "old");
  ASSERT_TRUE(replace_run_folder(folder, {{"report.json", bytes("new")}}));
  EXPECT_EQ(read_text(folder / "report.json"), "new");
  EXPECT_EQ(read_text(folder / "notes.txt"), "mine");
  EXPECT_THAT(names_in(scratch.path()), testing::ElementsAre("job"));
}

TEST(RunFolder, has_the_permissions_of_any_new_folder) {
  const support::ScratchFolder scratch;
  ASSERT_TRUE(replace_run_folder(scratch.path() / "job", {{"report.json", bytes("x")}}));
  fs::create_directory(scratch.path() / "plain");
  EXPECT_EQ(fs::status(scratch.path() / "job").permissions(), fs::status(scratch.path() / "plain").permissions());
}

TEST(RunFolder, is_refused_where_it_would_replace_something_else) {
  const support::ScratchFolder scratch;
  write_text(scratch.path() / "home" / "thesis.tex", "years of work");
  write_text(scratch.path() / "file", "x");
  for (const char* name : {"home", "file"}) {
    const Result<void> checked = check_run_folder(scratch.path() / name);
    ASSERT_FALSE(checked) << name;
    EXPECT_EQ(checked.failure().code, FailureCode::invalid_usage);
  }
  EXPECT_TRUE(check_run_folder(scratch.path() / "new" / "deeper"));
  fs::create_directory(scratch.path() / "empty");
  EXPECT_TRUE(check_run_folder(scratch.path() / "empty"));
  write_text(scratch.path() / "run" / "report.json", "{}");
  EXPECT_TRUE(check_run_folder(scratch.path() / "run"));
}

TEST(RunFolder, cannot_lie_below_a_file) {
  const support::ScratchFolder scratch;
  write_text(scratch.path() / "file", "x");
  const Result<void> checked = check_run_folder(scratch.path() / "file" / "job");
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.failure().code, FailureCode::write_failed);
}

TEST(RunFolder, knows_its_own_files) {
  for (const char* name : {"report.json", "log.txt", "job.toml", "tets.vtu", "tets_facets.vtp", "model.ml"})
    EXPECT_TRUE(is_run_file(name)) << name;
  for (const char* name : {"notes.txt", "model", "models.ml", "model_2.vtp", "report.json.bak", "out", ".git"})
    EXPECT_FALSE(is_run_file(name)) << name;
}

}  // namespace
}  // namespace strataflow
