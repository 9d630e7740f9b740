// What a user sees of a real model after every kind of transformation: `strataflow check --json`.
#include "io/input/labelled_triangles.h"
#include "io/surface/write_obj.h"
#include "properties/read_model.h"
#include "properties/rotation.h"

namespace strataflow {
namespace {

using support::TextFile;

struct Check {
  int exit_code;
  nlohmann::json model;
};

Check check_as_user(const std::vector<TextFile>& files) {
  const support::ScratchFolder scratch;
  std::vector<std::string> arguments{"check", "--json"};
  for (const TextFile& file : files) {
    support::write_text(scratch.path() / file.name, file.text);
    arguments.push_back((scratch.path() / file.name).string());
  }
  const support::CommandOutcome outcome = support::strataflow(arguments);
  return {outcome.exit_code, nlohmann::json::parse(outcome.out, nullptr, /*allow_exceptions=*/false)};
}

void expect_valid(const std::vector<TextFile>& files, const support::ModelFacts& facts) {
  const auto [exit_code, model] = check_as_user(files);
  EXPECT_EQ(exit_code, 0);
  ASSERT_FALSE(model.is_discarded());
  EXPECT_EQ(model.at("corners"), facts.corners);
  EXPECT_EQ(model.at("lines"), facts.lines);
  EXPECT_EQ(model.at("surfaces"), facts.surfaces);
  EXPECT_EQ(model.at("regions"), facts.regions);
  EXPECT_EQ(model.at("sealed"), true);
  EXPECT_EQ(model.at("intersecting_triangle_pairs"), 0);
  support::expect_volumes(model.at("volumes_m3").get<std::vector<double>>(), facts);
}

bool names_violation(const nlohmann::json& model, const std::string& kind) {
  return model.at("violations").dump().find('"' + kind + '"') != std::string::npos;
}

class CheckCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(support::shared_data()))
      GTEST_SKIP() << support::shared_data() << " is not there: set STRATAFLOW_DATA to the folder of the real models";
    text_ = support::read_text(support::shared_data() / file_);
    facts_ = support::expected_facts(file_, true);
  }
  std::string as_obj() const { return write_obj(labelled_triangles(support::read_texts({{"a.ml", text_}}).surfaces)); }

  const std::string file_ = "ringmesh-tiny/geomodel3d_only.ml";
  std::string text_;
  support::ModelFacts facts_;
};

TEST_F(CheckCommand, accepts_the_model_as_it_is) { expect_valid({{"a.ml", text_}}, facts_); }

TEST_F(CheckCommand, accepts_surfaces_in_another_order) {
  expect_valid({{"a.ml", support::with_shuffled_surfaces(text_, 5)}}, facts_);
}

TEST_F(CheckCommand, accepts_flipped_facets) {
  expect_valid({{"a.ml", support::with_flipped_facets(text_, 5)}}, facts_);
}

TEST_F(CheckCommand, accepts_one_file_per_surface) { expect_valid(support::file_per_surface(text_), facts_); }

TEST_F(CheckCommand, accepts_one_file_per_face) { expect_valid(support::file_per_face(text_), facts_); }

TEST_F(CheckCommand, accepts_an_obj_group_per_surface) { expect_valid({{"a.obj", as_obj()}}, facts_); }

TEST_F(CheckCommand, accepts_a_soup_without_groups) {
  expect_valid({{"a.obj", support::without_groups(as_obj())}}, support::expected_facts(file_, false));
}

TEST_F(CheckCommand, accepts_a_turned_model) {
  expect_valid({{"a.ml", support::with_moved_points(text_, support::about_skew_axis)}}, facts_);
}

TEST_F(CheckCommand, accepts_a_model_far_from_the_origin) {
  expect_valid({{"a.ml", support::with_moved_points(text_,
                                                    [](const Vec3& p) {
                                                      return p + Vec3{5e6, 5e6, 0};
                                                    })}},
               facts_);
}

TEST_F(CheckCommand, names_what_is_wrong_with_turned_and_flipped_models) {
  const auto check = [](const std::string& file) {
    const std::string text = support::read_text(support::shared_data() / file);
    return check_as_user(
        {{"a.ml", support::with_flipped_facets(support::with_moved_points(text, support::about_skew_axis), 6)}});
  };
  const Check open = check("ringmesh-tiny/not_sealed_cube.ml");
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_TRUE(names_violation(open.model, "open_shell"));
  EXPECT_EQ(open.model.at("regions"), 0);
  const Check wrong_borders = check("cloudspin/CloudSpin.ml");
  EXPECT_EQ(wrong_borders.exit_code, 1);
  EXPECT_TRUE(names_violation(wrong_borders.model, "inconsistent_border"));
  EXPECT_EQ(wrong_borders.model.at("regions"), 7);
  const Check dangling = check("ringmesh-tiny/non_split_cube.ml");
  EXPECT_EQ(dangling.exit_code, 0);
  EXPECT_TRUE(names_violation(dangling.model, "dangling_surface")) << dangling.model.at("violations");
  EXPECT_EQ(dangling.model.at("regions"), 1);
}

}  // namespace
}  // namespace strataflow
