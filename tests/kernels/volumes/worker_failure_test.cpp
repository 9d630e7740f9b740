// What becomes of a region when the worker program misbehaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "kernels/adapters/tetgen/run_tetgen.h"
#include "kernels/volumes/filled_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

class WorkerFailure : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("worker_failure_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Fills a box with the help of a shell script instead of TetGen.
  Failure failure_with(const std::string& script, double timeout_s = 60) {
    const std::filesystem::path program = folder_ / "fake_worker";
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return failure_of(program, timeout_s);
  }
  Failure failure_of(const std::filesystem::path& program, double timeout_s = 60) {
    StructuralModel model = support::model_of(support::box());
    model.regions[0].name = "reservoir";
    TetrahedralizeOptions options;
    options.timeout_s = timeout_s;
    const Result<VolumeMesh> mesh = tetrahedralize_model(model, options, nullptr, program);
    EXPECT_FALSE(mesh);
    return mesh ? Failure{} : mesh.failure();
  }
  std::filesystem::path folder_;
};

TEST_F(WorkerFailure, a_crash_is_a_failure_of_the_region_that_names_the_signal) {
  const Failure failure = failure_with("kill -ABRT $$");
  EXPECT_EQ(failure.code, FailureCode::geometry_failed);
  EXPECT_THAT(failure.what, HasSubstr("region 'reservoir' (0)"));
  EXPECT_THAT(failure.what, HasSubstr("Aborted"));
  EXPECT_FALSE(failure.remedy.empty());
}

TEST_F(WorkerFailure, a_worker_killed_from_outside_is_no_reason_for_another_attempt) {
  const Failure failure = failure_with("echo x >> \"$0.calls\"; kill -KILL $$");
  EXPECT_EQ(failure.code, FailureCode::geometry_failed);
  EXPECT_THAT(failure.what, HasSubstr("killed from outside"));
  EXPECT_EQ(std::filesystem::file_size(folder_ / "fake_worker.calls"), 2u);  // one line: it was called once
}

TEST_F(WorkerFailure, a_hang_is_ended_by_the_time_out) {
  const Failure failure = failure_with("exec sleep 600", 0.2);
  EXPECT_EQ(failure.code, FailureCode::timed_out);
  EXPECT_THAT(failure.what, HasSubstr("region 'reservoir' (0)"));
  EXPECT_THAT(failure.remedy, HasSubstr("timeout_s"));
}

TEST_F(WorkerFailure, garbage_is_not_believed) {
  EXPECT_THAT(failure_with("head -c 4096 /dev/zero | tr '\\0' 'x'").what, HasSubstr("no usable answer"));
}

TEST_F(WorkerFailure, an_empty_mesh_is_not_believed) {
  const Failure failure = failure_with("head -c 36 /dev/zero");
  EXPECT_EQ(failure.code, FailureCode::geometry_failed);
  EXPECT_THAT(failure.what, HasSubstr("no usable answer"));
}

TEST_F(WorkerFailure, a_missing_program_says_where_it_belongs) {
  const Failure failure = failure_of(folder_ / "no_such_worker");
  EXPECT_EQ(failure.code, FailureCode::geometry_failed);
  EXPECT_THAT(failure.what, HasSubstr("no_such_worker"));
  EXPECT_THAT(failure.remedy, HasSubstr("beside the main program"));
}

TEST_F(WorkerFailure, too_little_memory_fails_one_call_and_not_the_program) {
  TetgenRequest request;
  request.switches = "Q";
  for (int i = 0; i < 300000; ++i)
    request.points.push_back({i % 67 * 1.0, i / 67 % 67 * 1.1, i / 4489 * 1.3 + i % 7 * 0.01});
  request.memory_limit_mb = 64;
  const Result<TetgenOutcome> outcome = run_tetgen(support::tet_worker(), request, 60, nullptr);
  ASSERT_TRUE(outcome) << describe(outcome.failure());
  EXPECT_NE(outcome->end, TetgenOutcome::End::finished);
  EXPECT_FALSE(outcome->reason.empty());
}

TEST_F(WorkerFailure, facets_that_cross_end_the_call_with_a_reason) {
  const TetgenRequest request{
      "pYQ",
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, -1}, {0.2, 0.1, 1}, {0.1, 0.2, 1}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 5, 6}},
      0};
  const Result<TetgenOutcome> outcome = run_tetgen(support::tet_worker(), request, 60, nullptr);
  ASSERT_TRUE(outcome) << describe(outcome.failure());
  EXPECT_NE(outcome->end, TetgenOutcome::End::finished);
  EXPECT_FALSE(outcome->reason.empty());
}

}  // namespace
}  // namespace strataflow
