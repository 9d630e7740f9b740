// The real sealed models of our field: every region filled, volumes exact, surfaces kept.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "io/input/local_origin.h"
#include "io/read_input.h"
#include "kernels/volumes/filled_model.h"

namespace strataflow {
namespace {

struct SealedModel {
  const char* file;
  std::size_t regions;
  friend void PrintTo(const SealedModel& model, std::ostream* stream) { *stream << model.file; }
};

std::filesystem::path shared_data() {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  return folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data";
}

class SealedModels : public testing::TestWithParam<SealedModel> {
 protected:
  void SetUp() override {
    const std::filesystem::path file = shared_data() / GetParam().file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here (set STRATAFLOW_DATA)";
    Result<InputData> input = read_input(file);
    ASSERT_TRUE(input) << describe(input.failure());
    shift_to_local_origin(*input);
    model_ = support::model_of(input->surfaces);
    ASSERT_EQ(model_.regions.size(), GetParam().regions);
  }
  StructuralModel model_;
};

TEST_P(SealedModels, are_filled_with_their_surfaces_kept) {
  const Result<VolumeMesh> mesh = support::tetrahedralized(model_);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  support::expect_valid(*mesh, model_);
  support::expect_model_points_kept(*mesh, model_);
  for (const Change& change : mesh->changes) {
    EXPECT_EQ(change.kind, "repeated_region") << change.what;
    RecordProperty("change", change.what + " after " + change.why);
  }
  EXPECT_EQ(mesh->facets.size(), model_.triangles.size());
}

TEST_P(SealedModels, are_refined_to_a_size_with_their_surfaces_kept) {
  double total_m3 = 0;
  for (const Region& region : model_.regions) total_m3 += region.volume_m3;
  TetrahedralizeOptions options;
  options.max_volume_m3 = total_m3 / 20000;
  options.radius_edge_ratio = 2.0;
  const Result<VolumeMesh> mesh = support::tetrahedralized(model_, options);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  support::expect_valid(*mesh, model_);
  EXPECT_EQ(mesh->facets.size(), model_.triangles.size());
}

INSTANTIATE_TEST_SUITE_P(
    SharedData, SealedModels,
    testing::Values(SealedModel{"ringmesh-tiny/geomodel3d_only.ml", 8}, SealedModel{"ringmesh-tiny/split_cube.ml", 2},
                    SealedModel{"ringmesh-tiny/non_split_cube.ml", 1}, SealedModel{"ringmesh-A1/modelA1.ml", 4},
                    SealedModel{"ringmesh-A2/modelA2.ml", 12}, SealedModel{"ringmesh-A4/modelA4.ml", 8},
                    SealedModel{"cloudspin/CloudSpin_fixed.ml", 7}, SealedModel{"gdsa-cubes/cube_test_01.obj", 4},
                    SealedModel{"gdsa-cubes/cube_test_02.obj", 3}));

}  // namespace
}  // namespace strataflow
