// A run that is killed or told to stop leaves the old run folder as it was, and the next one gives the same bytes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "base/seed.h"
#include "support/command_line.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;
using support::read_text;
using support::write_text;

/// Starts `strataflow run JOB --cache store` in the background.
pid_t start(const fs::path& job, const fs::path& store) {
  const std::string program = support::program().string(), job_text = job.string(), store_text = store.string();
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    ::dup2(nowhere, 1);
    ::dup2(nowhere, 2);
    ::execl(program.c_str(), program.c_str(), "run", job_text.c_str(), "--cache", store_text.c_str(),
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  return child;
}

/// Waits for the end of `child`; its wait status.
int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

/// Waits until the store of a run holds an output; false when the run ends before.
bool waits_for_an_entry(const fs::path& store, pid_t run) {
  const auto is_entry = [](const fs::directory_entry& entry) {
    std::error_code gone;
    return entry.path().filename().string().size() == 28 && entry.is_regular_file(gone);
  };
  while (::waitpid(run, nullptr, WNOHANG) == 0) {
    std::error_code error;
    for (fs::recursive_directory_iterator it(store, error), end; !error && it != end; it.increment(error))
      if (is_entry(*it)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

TEST(InterruptedRun, killed_at_any_moment_resumes_with_the_same_bytes) {
  const support::ScratchFolder scratch;
  const std::string job =
      "[[input]]\nmodel = \"A2\"\nresolution_m = 60.0\n[output]\nproducts = [\"model\", \"tets\"]\n";
  write_text(scratch.path() / "clean" / "a.toml", job);
  const auto began = std::chrono::steady_clock::now();
  ASSERT_EQ(wait_for(start(scratch.path() / "clean" / "a.toml", scratch.path() / "clean-store")), 0);
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const auto expected = support::timeless_files(scratch.path() / "clean" / "out" / "a");

  // Kills spread over a whole run, each with what the earlier ones left in the store.
  write_text(scratch.path() / "a.toml", job);
  const fs::path folder = scratch.path() / "out" / "a";
  RandomStream random(7);
  int killed = 0;
  for (int round = 0; round < 12; ++round) {
    fs::remove_all(folder);
    write_text(folder / "report.json", "old");
    if (round % 4 == 0) fs::remove_all(scratch.path() / "store");
    const pid_t child = start(scratch.path() / "a.toml", scratch.path() / "store");
    std::this_thread::sleep_for(std::chrono::duration<double>(random.unit() * whole_s));
    ::kill(child, SIGKILL);
    const int status = wait_for(child);
    killed += WIFSIGNALED(status);
    if (read_text(folder / "report.json") == "old") {
      EXPECT_EQ(support::timeless_files(folder).size(), 1u);
    } else {
      EXPECT_EQ(support::timeless_files(folder), expected);
    }
  }
  EXPECT_GT(killed, 0) << "no run was caught: the job is too short for this machine";
  ASSERT_EQ(wait_for(start(scratch.path() / "a.toml", scratch.path() / "store")), 0);
  EXPECT_EQ(support::timeless_files(folder), expected);
  for (const auto& entry : fs::directory_iterator(folder.parent_path()))
    EXPECT_EQ(entry.path(), folder) << "a leftover";
}

TEST(InterruptedRun, told_to_stop_exits_1_and_writes_nothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const support::ScratchFolder scratch;
    write_text(scratch.path() / "a.toml",
               "[[input]]\nmodel = \"A6\"\nresolution_m = 8.0\n[output]\nproducts = [\"model\", \"tets\"]\n");
    const pid_t child = start(scratch.path() / "a.toml", scratch.path() / "store");
    // The first stage is through: the run is at work, and the long stages are still to come.
    ASSERT_TRUE(waits_for_an_entry(scratch.path() / "store", child));
    ASSERT_EQ(::kill(child, signal), 0);
    const int status = wait_for(child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_FALSE(fs::exists(scratch.path() / "out"));
  }
}

TEST(InterruptedRun, two_at_once_on_one_store_agree) {
  const support::ScratchFolder scratch;
  const std::string job =
      "[[input]]\nmodel = \"A2\"\nresolution_m = 60.0\n[output]\nproducts = [\"model\", \"tets\"]\n";
  std::vector<pid_t> children;
  for (const char* name : {"p", "q", "r"}) {
    write_text(scratch.path() / name / "a.toml", job);
    children.push_back(start(scratch.path() / name / "a.toml", scratch.path() / "store"));
  }
  for (const pid_t child : children) EXPECT_EQ(wait_for(child), 0);
  const auto expected = support::timeless_files(scratch.path() / "p" / "out" / "a");
  EXPECT_EQ(support::timeless_files(scratch.path() / "q" / "out" / "a"), expected);
  EXPECT_EQ(support::timeless_files(scratch.path() / "r" / "out" / "a"), expected);
}

TEST(InterruptedRun, two_at_once_in_one_folder_leave_a_whole_one) {
  const support::ScratchFolder scratch;
  write_text(scratch.path() / "a.toml",
             "[[input]]\nmodel = \"A1\"\nresolution_m = 110.0\n[output]\nproducts = [\"model\"]\n");
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i) children.push_back(start(scratch.path() / "a.toml", scratch.path() / "store"));
  for (const pid_t child : children) EXPECT_EQ(wait_for(child), 0);
  EXPECT_EQ(support::timeless_files(scratch.path() / "out" / "a").size(),
            4u);  // report.json, report.html, job.toml, model.vtp
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(scratch.path() / "out")) ++entries;
  EXPECT_EQ(entries, 1u);
}

}  // namespace
}  // namespace strataflow
