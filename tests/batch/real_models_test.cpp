// Real sealed models, from file to validated tetrahedra: the true regions and volumes, conforming, no inverted cell.
// Real raw ones: the true number of intersections.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "batch/check_model.h"
#include "batch/run/run_batch.h"
#include "support/command_line.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  return folder ? fs::path(folder) : fs::path(STRATAFLOW_SOURCE_DIR) / ".." / "shared" / "data";
}

class RealModel : public testing::TestWithParam<const char*> {};

TEST_P(RealModel, becomes_valid_tetrahedra_with_the_true_regions_and_volumes) {
  const fs::path file = fs::absolute(data_folder() / GetParam()).lexically_normal();
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there: set STRATAFLOW_DATA to the folder of the real models";
  const nlohmann::json expected =
      nlohmann::json::parse(support::read_text(data_folder() / "expected.json"))[GetParam()];

  const support::ScratchFolder scratch;
  const Result<std::vector<Job>> jobs =
      read_jobs_from_text("[[input]]\nfile = \"" + file.string() + "\"\n[output]\nproducts = [\"model\", \"tets\"]\n",
                          "a.toml", scratch.path());
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  const Result<std::vector<JobOutcome>> outcomes = run_batch(*jobs, {});
  ASSERT_TRUE(outcomes) << describe(outcomes.failure());
  ASSERT_FALSE(outcomes->front().failure) << describe(*outcomes->front().failure);
  const nlohmann::json report = nlohmann::json::parse(support::read_text(outcomes->front().run_folder / "report.json"));

  std::vector<double> wanted;
  if (expected.contains("region_volumes")) {
    wanted = expected["region_volumes"].get<std::vector<double>>();
  } else {  // told as shells: the outer one is negative
    for (const auto& shell : expected["shells"])
      if (shell["signed_volume"].get<double>() > 0) wanted.push_back(shell["signed_volume"].get<double>());
  }
  std::vector<double> built = report["model"]["volumes_m3"].get<std::vector<double>>();
  std::vector<double> filled;
  for (const auto& region : report["tets"]["per_region"]) filled.push_back(region["volume_m3"].get<double>());
  for (std::vector<double>* volumes : {&wanted, &built, &filled}) std::sort(volumes->begin(), volumes->end());
  ASSERT_EQ(built.size(), wanted.size());
  ASSERT_EQ(filled.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(built[i] / wanted[i], 1.0, 1e-9);
    EXPECT_NEAR(filled[i] / wanted[i], 1.0, 1e-9);
  }
  EXPECT_EQ(report["model"]["sealed"], true);
  EXPECT_EQ(report["model"]["intersecting_triangle_pairs"], 0);
  EXPECT_EQ(report["tets"]["inverted"], 0);
  EXPECT_EQ(report["tets"]["nonconforming_faces"], 0);
}

INSTANTIATE_TEST_SUITE_P(Sealed, RealModel,
                         testing::Values("ringmesh-tiny/geomodel3d_only.ml", "ringmesh-tiny/split_cube.ml",
                                         "gdsa-cubes/cube_test_01.obj", "gdsa-cubes/cube_test_02.obj",
                                         "ringmesh-A1/modelA1.ml", "ringmesh-A2/modelA2.ml", "ringmesh-A4/modelA4.ml",
                                         "cloudspin/CloudSpin_fixed.ml"),
                         [](const auto& instance) {
                           std::string name = fs::path(instance.param).stem().string();
                           std::replace_if(
                               name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

TEST(RawModel, drogon_meets_itself_as_often_as_counted_elsewhere_coincident_horizons_included) {
  const fs::path folder = data_folder() / "drogon";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there: set STRATAFLOW_DATA to the real models";
  const nlohmann::json expected = nlohmann::json::parse(support::read_text(data_folder() / "expected.json"))["drogon"];
  std::vector<fs::path> files = {folder / "faults_F1-F6.ts"};
  for (const char* horizon : {"01_topvolantis", "02_toptherys", "03_topvolon", "04_basevolantis"})
    files.push_back(folder / (std::string(horizon) + ".ply.gz"));
  const Result<CheckedModel> checked = check_model(files);
  ASSERT_TRUE(checked) << describe(checked.failure());
  const ValidityReport& validity = checked->validity;
  EXPECT_EQ(validity.intersecting_triangle_pairs - validity.self_intersecting_pairs,
            expected["intersecting_triangle_pairs"].get<std::uint64_t>());  // told across surfaces
  EXPECT_EQ(validity.identical_triangle_pairs, expected["coincident_duplicate_triangles"].get<std::uint64_t>());
  for (const Violation& violation : validity.violations) EXPECT_NE(violation.kind, "volume_imbalance");
}

}  // namespace
}  // namespace strataflow
