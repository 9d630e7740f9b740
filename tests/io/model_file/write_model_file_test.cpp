#include "io/model_file/write_model_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/archive.h"
#include "base/atomic_file.h"
#include "io/model_file/read_model_file.h"
#include "io/two_tetrahedra.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;

fs::path scratch(const char* name) {
  return fs::temp_directory_path() / ("strataflow_" + std::to_string(::getpid()) + "_" + name);
}

TEST(WriteModelFile, a_model_comes_back_bit_by_bit) {
  const fs::path file = scratch("round_trip.sfm");
  const StructuralModel model = support::two_tetrahedra();
  ASSERT_TRUE(write_model_file(file, model));
  const auto read = read_model_file(file);
  ASSERT_TRUE(read) << describe(read.failure());
  EXPECT_EQ(archived(*read), archived(model));
  fs::remove(file);
}

TEST(WriteModelFile, a_model_of_several_point_blocks_comes_back_bit_by_bit) {
  StructuralModel model;  // one long strip of triangles
  for (std::uint32_t i = 0; i < 150'000; ++i)
    model.points.push_back({i * 0.5, static_cast<double>(i % 2), 1.0 / (i + 1)});
  for (std::uint32_t i = 0; i + 2 < model.points.size(); ++i) model.triangles.push_back({i, i + 1, i + 2});
  model.triangle_surface.assign(model.triangles.size(), 0);
  model.entities = {{"strip", Role::horizon}};
  model.surfaces = {{0, {0}, 0, static_cast<std::uint32_t>(model.triangles.size()), {}, universe, universe}};
  model.point_line.assign(model.points.size(), -1);
  model.point_corner = model.point_line;
  const fs::path file = scratch("blocks.sfm");
  ASSERT_TRUE(write_model_file(file, model));
  const auto read = read_model_file(file);
  ASSERT_TRUE(read) << describe(read.failure());
  EXPECT_EQ(archived(*read), archived(model));
  fs::remove(file);
}

TEST(WriteModelFile, an_empty_model_is_a_model) {
  const fs::path file = scratch("empty.sfm");
  ASSERT_TRUE(write_model_file(file, {}));
  const auto read = read_model_file(file);
  ASSERT_TRUE(read) << describe(read.failure());
  EXPECT_EQ(archived(*read), archived(StructuralModel{}));
  fs::remove(file);
}

TEST(WriteModelFile, the_same_model_gives_the_same_bytes) {
  const fs::path a = scratch("a.sfm");
  const fs::path b = scratch("b.sfm");
  ASSERT_TRUE(write_model_file(a, support::two_tetrahedra()));
  ASSERT_TRUE(write_model_file(b, support::two_tetrahedra()));
  EXPECT_EQ(*read_file(a), *read_file(b));
  fs::remove(a);
  fs::remove(b);
}

TEST(WriteModelFile, a_model_that_contradicts_itself_is_refused) {
  const auto refused = [](auto spoil) {
    StructuralModel model = support::two_tetrahedra();
    spoil(model);
    const auto written = write_model_file(scratch("refused.sfm"), model);
    return !written && written.failure().code == FailureCode::invalid_input;
  };
  EXPECT_TRUE(refused([](StructuralModel& model) { model.triangles[3][1] = 5; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.surfaces[1].first_triangle = 2; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.triangles.push_back({0, 1, 2}); }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.surfaces[1].entity = 2; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.lines[0].corners[1] = universe; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.regions[1].external_frontier = 3; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.frontiers[0].sides[0].surface = 3; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.layers[0].regions[0] = 2; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.corners[0].vertex = 5; }));
  EXPECT_TRUE(refused([](StructuralModel& model) { model.properties[1].values.pop_back(); }));
}

}  // namespace
}  // namespace strataflow
