// The same job gives the same bytes in report.json and every mesh, whatever the schedule, the store and the company.
#include <gtest/gtest.h>

#include "batch/run/run_batch.h"
#include "graph/stage_store.h"
#include "support/command_line.h"
#include "support/sanitized.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<std::pair<std::string, std::string>>;

/// Of the shuffled executor; one takes 0.5 s, under the address sanitizer 7 s.
constexpr std::uint64_t shuffled_schedules = support::sanitized ? 5 : 50;

/// Jobs that share stages, two of them sweeps, one of raw surfaces, and two that remesh.
class JobDeterminism : public testing::Test {
 protected:
  void SetUp() override {
    support::write_text(
        scratch_.path() / "a.toml",
        "[[input]]\nmodel = \"A2\"\nresolution_m = 110.0\n[output]\nproducts = [\"model\", \"tets\"]\n");
    support::write_text(scratch_.path() / "b.toml",
                        "[[input]]\nmodel = \"A2\"\nresolution_m = 110.0\n[output]\nproducts = [\"tets\"]\n"
                        "[sweep]\n\"tetrahedralize.radius_edge_ratio\" = [1.8, 2.5]\n");
    support::write_text(scratch_.path() / "raw.toml",
                        "[[input]]\nmodel = \"A6\"\nresolution_m = 110.0\nraw_ratio = -0.01\n"
                        "[output]\nproducts = [\"model\"]\n[cut]\nmode = \"always\"\n[simplify]\nborders = true\n");
    support::write_text(scratch_.path() / "remesh.toml",
                        "[[input]]\nmodel = \"C\"\nresolution_m = 110.0\n"
                        "[output]\nproducts = [\"voronoi\", \"surfaces\", \"complexity\"]\n"
                        "[remesh]\nsites = 300\niterations = 10\n[complexity]\ncells = [50]\n"
                        "[sweep]\n\"remesh.preserve\" = [\"all\", \"resolution\"]\n");
    for (const char* name : {"a.toml", "b.toml", "raw.toml", "remesh.toml"}) {
      const Result<std::vector<Job>> read = read_jobs(scratch_.path() / name);
      ASSERT_TRUE(read) << describe(read.failure());
      jobs_.insert(jobs_.end(), read->begin(), read->end());
    }
  }

  std::vector<Files> run(const RunOptions& options) {
    BatchOptions batch;
    batch.run = options;
    batch.out = scratch_.path() / "runs";
    const Result<std::vector<JobOutcome>> outcomes = run_batch(jobs_, batch);
    EXPECT_TRUE(outcomes) << describe(outcomes.failure());
    std::vector<Files> files;
    for (const JobOutcome& job : *outcomes) {
      EXPECT_FALSE(job.failure) << describe(*job.failure);
      files.push_back(support::timeless_files(job.run_folder));
    }
    return files;
  }

  support::ScratchFolder scratch_;
  std::vector<Job> jobs_;
};

TEST_F(JobDeterminism, holds_for_every_number_of_threads) {
  RunOptions serial;
  serial.executor = ExecutorKind::serial;
  const std::vector<Files> expected = run(serial);
  ASSERT_EQ(expected.size(), 6u);
  ASSERT_EQ(expected[0].size(), 6u);  // report.json, report.html, job.toml and three meshes
  for (const int threads : {1, 2, 3, 8}) {
    RunOptions options;
    options.threads = threads;
    EXPECT_EQ(run(options), expected) << threads << " threads";
  }
}

TEST_F(JobDeterminism, holds_for_hybrid_meshes_quads_and_hexahedra) {
  support::write_text(scratch_.path() / "hexes.toml",
                      "[[input]]\nmodel = \"dipping-faults\"\nresolution_m = 200.0\n[output]\nproducts = [\"hexes\"]\n"
                      "[hex]\nedge_length_m = 150.0\nlayers = 1\n");
  support::write_text(scratch_.path() / "hybrid.toml",
                      "[[input]]\nmodel = \"slab\"\n[output]\nproducts = [\"hybrid\"]\n[hybrid]\nsites = 60\n");
  support::write_text(scratch_.path() / "quads.toml",
                      "[[input]]\nmodel = \"slab\"\n[output]\nproducts = [\"quads\"]\n[quad]\nedge_length_m = 40.0\n");
  jobs_.clear();
  for (const char* name : {"hexes.toml", "hybrid.toml", "quads.toml"}) {
    const Result<std::vector<Job>> read = read_jobs(scratch_.path() / name);
    ASSERT_TRUE(read) << describe(read.failure());
    jobs_.insert(jobs_.end(), read->begin(), read->end());
  }
  RunOptions options;
  options.executor = ExecutorKind::serial;
  const std::vector<Files> expected = run(options);
  for (const int threads : {1, 2, 3, 8}) {
    RunOptions parallel;
    parallel.threads = threads;
    EXPECT_EQ(run(parallel), expected) << threads << " threads";
  }
  options.executor = ExecutorKind::shuffled;
  for (options.shuffle_seed = 0; options.shuffle_seed < 3; ++options.shuffle_seed)
    EXPECT_EQ(run(options), expected) << "seed " << options.shuffle_seed;
}

TEST_F(JobDeterminism, holds_for_many_shuffled_schedules) {
  jobs_.resize(1);
  RunOptions serial;
  serial.executor = ExecutorKind::serial;
  const std::vector<Files> expected = run(serial);
  for (std::uint64_t seed = 0; seed < shuffled_schedules; ++seed) {
    RunOptions options;
    options.executor = ExecutorKind::shuffled;
    options.shuffle_seed = seed;
    ASSERT_EQ(run(options), expected) << "seed " << seed;
  }
}

TEST_F(JobDeterminism, holds_for_a_cold_a_warm_and_a_damaged_store) {
  const std::vector<Files> expected = run({});
  Result<std::unique_ptr<StageStore>> store = StageStore::open(scratch_.path() / "store");
  ASSERT_TRUE(store);
  RunOptions options;
  options.store = store->get();
  EXPECT_EQ(run(options), expected) << "cold";
  EXPECT_EQ(run(options), expected) << "warm";
  std::size_t damaged = 0;
  for (const auto& entry : fs::recursive_directory_iterator(scratch_.path() / "store")) {
    if (!entry.is_regular_file() || entry.file_size() < 8) continue;
    if (++damaged % 2)
      fs::resize_file(entry.path(), entry.file_size() / 2);
    else
      std::fstream(entry.path(), std::ios::in | std::ios::out | std::ios::binary)
          .seekp(static_cast<std::streamoff>(entry.file_size()) - 3)
          .put('!');
  }
  ASSERT_GT(damaged, 3u);
  EXPECT_EQ(run(options), expected) << "damaged";
}

}  // namespace
}  // namespace strataflow
