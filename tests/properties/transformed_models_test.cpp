// Real models say the same whatever order, turn, place or format their triangles come in.
#include "io/input/labelled_triangles.h"
#include "io/surface/write_obj.h"
#include "properties/read_model.h"
#include "properties/rotation.h"

namespace strataflow {
namespace {

using support::checked;
using support::errors_of;
using support::expect_counts;
using support::expect_facts;
using support::TextFile;
using support::volume_of_name;
constexpr Vec3 far_away{5e6, 5e6, 0};

std::string test_name(const testing::TestParamInfo<const char*>& instance) {
  std::string name = std::filesystem::path(instance.param).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

class FromSharedData : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::filesystem::path file = support::shared_data() / GetParam();
    if (!std::filesystem::exists(file))
      GTEST_SKIP() << file << " is not there: set STRATAFLOW_DATA to the folder of the real models";
    text_ = support::read_text(file);
  }
  TextFile as_file(std::string text) const { return {std::filesystem::path(GetParam()).filename(), std::move(text)}; }
  /// The model as OBJ with a group per surface.
  std::string as_obj() const {
    const InputData input = support::read_texts({as_file(text_)});
    return write_obj(labelled_triangles(input.surfaces));
  }
  std::string text_;
};

// ---- every valid model

class ValidModel : public FromSharedData {
 protected:
  void SetUp() override {
    FromSharedData::SetUp();
    if (!IsSkipped()) facts_ = support::expected_facts(GetParam(), true);
  }
  support::ModelFacts facts_;
};

TEST_P(ValidModel, is_what_was_measured_by_others) { expect_facts(checked({as_file(text_)}), facts_); }

TEST_P(ValidModel, is_the_same_with_a_group_of_an_obj_file_per_surface) {
  expect_facts(checked({{"model.obj", as_obj()}}), facts_);
}

TEST_P(ValidModel, is_the_same_when_moved_5000_km) {
  const std::string moved = support::with_moved_points(text_, [](const Vec3& p) { return p + far_away; });
  EXPECT_NE(moved, text_);
  const CheckedModel model = checked({as_file(moved)});
  expect_facts(model, facts_);
  EXPECT_GT(model.built.model.local_origin.x, 4e6) << "far coordinates were not brought near";
}

TEST_P(ValidModel, is_the_same_when_turned) {
  for (const support::Rotation& turn : {support::about_z, support::about_skew_axis})
    expect_facts(checked({as_file(support::with_moved_points(text_, turn))}), facts_);
}

TEST_P(ValidModel, is_the_same_without_any_name_in_any_order) {
  const support::ModelFacts by_geometry = support::expected_facts(GetParam(), false);
  const std::string soup = support::without_groups(as_obj());
  expect_facts(checked({{"model.obj", soup}}), by_geometry);
  expect_facts(checked({{"model.obj", support::with_shuffled_triangles(soup, 7)}}), by_geometry);
}

constexpr const char* gocad_models[] = {"ringmesh-tiny/geomodel3d_only.ml", "ringmesh-tiny/split_cube.ml",
                                        "ringmesh-tiny/non_split_cube.ml",  "ringmesh-A1/modelA1.ml",
                                        "ringmesh-A2/modelA2.ml",           "ringmesh-A4/modelA4.ml",
                                        "cloudspin/CloudSpin_fixed.ml"};
constexpr const char* obj_models[] = {"gdsa-cubes/cube_test_01.obj", "gdsa-cubes/cube_test_02.obj"};
INSTANTIATE_TEST_SUITE_P(Gocad, ValidModel, testing::ValuesIn(gocad_models), test_name);
INSTANTIATE_TEST_SUITE_P(Obj, ValidModel, testing::ValuesIn(obj_models), test_name);

// ---- a model that was sealed, with one point pulled out: whatever its place and turn, that is seen

class PulledModel : public FromSharedData {};
TEST_P(PulledModel, crosses_itself) {
  const TriangleSoup soup = support::read_texts({as_file(text_)}).surfaces;
  Box3 box;
  for (const Vec3& point : soup.points) box.take(point);
  const Vec3 inner = *std::min_element(soup.points.begin(), soup.points.end(), [&](const Vec3& a, const Vec3& b) {
    return length(a - box.centre()) < length(b - box.centre());
  });
  const Vec3 out = inner + Vec3{2 * box.diagonal_m(), 0, 0};
  for (const support::Rotation& turn : {support::about_z, support::about_skew_axis})
    for (const Vec3& shift : {Vec3{}, far_away}) {
      TriangleSoup pulled = soup;
      for (Vec3& point : pulled.points) point = turn(point == inner ? out : point) + shift;
      const CheckedModel model = checked(pulled);
      EXPECT_GT(model.validity.intersecting_triangle_pairs, 0u);
      EXPECT_FALSE(is_sealed(model.built.model, model.validity));
      EXPECT_TRUE(errors_of(model).contains("improper_intersection"));
    }
}
INSTANTIATE_TEST_SUITE_P(Real, PulledModel,
                         testing::Values("ringmesh-tiny/geomodel3d_only.ml", "ringmesh-A1/modelA1.ml",
                                         "ringmesh-A2/modelA2.ml", "ringmesh-A4/modelA4.ml",
                                         "cloudspin/CloudSpin_fixed.ml", "gdsa-cubes/cube_test_01.obj",
                                         "gdsa-cubes/cube_test_02.obj"),
                         test_name);

// ---- valid models in GOCAD's own format

class ValidGocadModel : public ValidModel {
 protected:
  /// Same facts, and every region keeps its name.
  void expect_same_model(const std::string& text) {
    const CheckedModel model = checked({as_file(text)});
    expect_facts(model, facts_);
    const auto named = volume_of_name(checked({as_file(text_)}).built.model);
    const auto now = volume_of_name(model.built.model);
    ASSERT_EQ(now.size(), named.size());
    for (const auto& [name, volume_m3] : named) {
      ASSERT_TRUE(now.contains(name)) << name;
      EXPECT_NEAR(now.at(name) / volume_m3, 1.0, support::volume_tolerance_ratio) << name;
    }
  }
};

TEST_P(ValidGocadModel, is_the_same_with_its_surfaces_in_any_order) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) expect_same_model(support::with_shuffled_surfaces(text_, seed));
}

TEST_P(ValidGocadModel, is_the_same_with_facets_flipped_at_random) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) expect_same_model(support::with_flipped_facets(text_, seed));
}

TEST_P(ValidGocadModel, keeps_its_region_names_when_moved_and_turned) {
  expect_same_model(support::with_moved_points(text_, [](const Vec3& p) { return p + far_away; }));
  expect_same_model(support::with_moved_points(text_, support::about_z));
}

TEST_P(ValidGocadModel, is_the_same_from_one_file_per_surface) {
  const std::vector<TextFile> files = support::file_per_surface(text_);
  EXPECT_GT(files.size(), 1u);
  expect_facts(checked(files), facts_);
  expect_facts(checked({files.rbegin(), files.rend()}), facts_);
}

TEST_P(ValidGocadModel, is_the_same_from_one_file_per_face) {
  const std::vector<TextFile> files = support::file_per_face(text_);
  expect_facts(checked(files), facts_);
}

INSTANTIATE_TEST_SUITE_P(Gocad, ValidGocadModel, testing::ValuesIn(gocad_models), test_name);

// ---- models that are not valid, whatever is done to them

class InvalidModel : public FromSharedData {
 protected:
  /// The same .ml after everything that leaves its records in place.
  std::vector<std::string> variants() const {
    return {text_,
            support::with_shuffled_surfaces(text_, 1),
            support::with_flipped_facets(text_, 1),
            support::with_moved_points(text_, [](const Vec3& p) { return p + far_away; }),
            support::with_moved_points(text_, support::about_z),
            support::with_moved_points(text_, support::about_skew_axis)};
  }
};

class OpenModel : public InvalidModel {};
TEST_P(OpenModel, has_an_open_shell_and_no_region) {
  std::vector<std::vector<TextFile>> ways;
  for (std::string& text : variants()) ways.push_back({as_file(std::move(text))});
  ways.push_back(support::file_per_surface(text_));
  ways.push_back(support::file_per_face(text_));
  ways.push_back({{"model.obj", as_obj()}});
  ways.push_back({{"model.obj", support::without_groups(as_obj())}});
  for (const std::vector<TextFile>& files : ways) {
    const CheckedModel model = checked(files);
    EXPECT_TRUE(errors_of(model).contains("open_shell"));
    EXPECT_EQ(model.built.model.regions.size(), 0u);
    EXPECT_FALSE(is_sealed(model.built.model, model.validity));
  }
}
INSTANTIATE_TEST_SUITE_P(Gocad, OpenModel, testing::Values("ringmesh-tiny/not_sealed_cube.ml"), test_name);

class ModelWithWrongBorders : public InvalidModel {};
TEST_P(ModelWithWrongBorders, has_the_geometry_of_the_repaired_one_and_inconsistent_borders) {
  const support::ModelFacts facts = support::expected_facts("cloudspin/CloudSpin_fixed.ml", true);
  std::vector<std::vector<TextFile>> ways;
  for (std::string& text : variants()) ways.push_back({as_file(std::move(text))});
  ways.push_back(support::file_per_surface(text_));
  for (const std::vector<TextFile>& files : ways) {
    const CheckedModel model = checked(files);
    expect_counts(model.built.model, facts);
    EXPECT_EQ(errors_of(model), std::set<std::string>{"inconsistent_border"});
    EXPECT_EQ(model.validity.intersecting_triangle_pairs, 0u);
  }
}
TEST_P(ModelWithWrongBorders, is_valid_without_its_border_records) {
  const support::ModelFacts facts = support::expected_facts("cloudspin/CloudSpin_fixed.ml", true);
  expect_facts(checked(support::file_per_face(text_)), facts);
  expect_facts(checked({{"model.obj", as_obj()}}), facts);
}
INSTANTIATE_TEST_SUITE_P(Gocad, ModelWithWrongBorders, testing::Values("cloudspin/CloudSpin.ml"), test_name);

}  // namespace
}  // namespace strataflow
