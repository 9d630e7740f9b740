#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/archive.h"
#include "stages/build_model_stage.h"
#include "stages/check_mesh_stage.h"
#include "stages/check_validity_stage.h"
#include "stages/combine_stage.h"
#include "stages/draw_stage.h"
#include "stages/generate_stage.h"
#include "stages/read_stage.h"
#include "stages/tetrahedralize_stage.h"
#include "support/command_line.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using support::write_text;
using testing::HasSubstr;

const std::string triangle =
    "GOCAD TSurf 1\nHEADER {\nname: top\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";

InputData box() {
  InputData data;
  support::add_box(data.surfaces, support::add_patch(data.surfaces, "box", Role::boundary), {0, 0, 0}, {1, 1, 1});
  return data;
}

BuiltModel built(const InputData& data) {
  StageContext context;
  Result<BuiltModel> model = BuildModel{}(data, context);
  EXPECT_TRUE(model) << describe(model.failure());
  return *model;
}

TEST(ReadStage, is_keyed_by_content_and_name_not_by_folder) {
  const support::ScratchFolder scratch;
  write_text(scratch.path() / "a" / "top.ts", triangle);
  write_text(scratch.path() / "b" / "top.ts", triangle);
  write_text(scratch.path() / "b" / "other.ts", triangle);
  write_text(scratch.path() / "c" / "top.ts", triangle + "\n");
  const auto key = [&](const char* file) { return *Read{{}, scratch.path() / file}.external_digest(); };
  EXPECT_EQ(key("a/top.ts"), key("b/top.ts"));
  EXPECT_NE(key("a/top.ts"), key("b/other.ts"));
  EXPECT_NE(key("a/top.ts"), key("c/top.ts"));
  EXPECT_FALSE((Read{{}, scratch.path() / "none.ts"}.external_digest()));
}

TEST(ReadStage, overrides_name_and_role) {
  const support::ScratchFolder scratch;
  write_text(scratch.path() / "top.ts", triangle);
  StageContext context;
  const Result<InputData> data = Read{{"H1", "fault"}, scratch.path() / "top.ts"}(context);
  ASSERT_TRUE(data) << describe(data.failure());
  ASSERT_EQ(data->surfaces.entities.size(), 1u);
  EXPECT_EQ(data->surfaces.entities[0].name, "H1");
  EXPECT_EQ(data->surfaces.entities[0].role, Role::fault);
}

TEST(ReadStage, gives_one_name_to_one_thing_only) {
  InputData data = box();
  support::add_patch(data.surfaces, "second");
  EXPECT_TRUE(rename_input(data, {{}, "horizon"}));
  EXPECT_EQ(data.surfaces.entities[1].role, Role::horizon);
  const Result<void> renamed = rename_input(data, {"H1", {}});
  ASSERT_FALSE(renamed);
  EXPECT_EQ(renamed.failure().code, FailureCode::invalid_options);
}

TEST(ReadStage, takes_the_first_points_of_sticks_as_the_trace_of_their_fault) {
  InputData data;
  data.lines = {{"F1", Role::curve, {{0, 0, 5}, {1, 0, 9}}, false}, {"F1", Role::curve, {{0, 2, 5}, {1, 2, 9}}, false}};
  ASSERT_TRUE(rename_input(data, {{}, "fault", true}));
  ASSERT_EQ(data.lines.size(), 1u);
  EXPECT_EQ(data.lines[0].points, (std::vector<Vec3>{{0, 0, 5}, {0, 2, 5}}));
  EXPECT_EQ(data.lines[0].role, Role::fault);
  InputData surface = box();
  EXPECT_FALSE(rename_input(surface, {{}, {}, true}));
}

TEST(ReadStage, takes_the_upper_borders_of_faults_as_their_traces) {
  InputData data;
  data.surfaces.points = {{0, 0, 9}, {5, 0, 9}, {5, 1, 0}, {0, 1, 0}};
  data.surfaces.triangles = {{0, 1, 2}, {0, 2, 3}};
  data.surfaces.triangle_patch = {0, 0};
  data.surfaces.patch_entity = {0};
  data.surfaces.entities = {{"old", Role::fault}};
  ReadOptions options;
  options.name = "F1";
  options.traces = true;
  ASSERT_TRUE(rename_input(data, options));
  EXPECT_TRUE(data.surfaces.triangles.empty());
  ASSERT_EQ(data.lines.size(), 1u);
  EXPECT_EQ(data.lines[0].name, "F1");
  EXPECT_EQ(data.lines[0].points, (std::vector<Vec3>{{0, 0, 9}, {5, 0, 9}}));
  InputData no_surface;
  EXPECT_FALSE(rename_input(no_surface, options));
}

TEST(CombineStage, keeps_the_order_and_moves_near_the_origin) {
  InputData far = box();
  for (Vec3& p : far.surfaces.points) p = p + Vec3{5e6, 5e6, 0};
  StageContext context;
  const InputData first = far, second = far;
  const Result<InputData> both = Combine{}({&first, &second}, context);
  ASSERT_TRUE(both);
  EXPECT_EQ(both->surfaces.triangles.size(), 2 * first.surfaces.triangles.size());
  for (std::size_t i = 0; i < first.surfaces.points.size(); ++i) {
    EXPECT_LT(length(both->surfaces.points[i]), 1e4);
    EXPECT_EQ(both->surfaces.points[i] + both->surfaces.local_origin, first.surfaces.points[i]);
  }
}

TEST(CheckValidityStage, passes_a_closed_box_and_fails_an_open_one_by_name) {
  StageContext context;
  EXPECT_TRUE((CheckValidity{{true}}(built(box()), context)));
  InputData open = box();
  open.surfaces.triangles.resize(open.surfaces.triangles.size() - 2);
  open.surfaces.triangle_patch.resize(open.surfaces.triangles.size());
  const Result<ValidityReport> refused = CheckValidity{{true}}(built(open), context);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.failure().code, FailureCode::invalid_input);
  EXPECT_THAT(refused.failure().what, HasSubstr("open_shell"));
  const Result<ValidityReport> described = CheckValidity{{false}}(built(open), context);
  ASSERT_TRUE(described);
  EXPECT_FALSE(described->is_valid());
  EXPECT_FALSE(context.warnings().empty());
}

TEST(TetrahedralizeStage, fills_a_box_and_the_mesh_is_checked) {
  StageContext context;
  const BuiltModel model = built(box());
  const ValidityReport validity = *CheckValidity{{true}}(model, context);
  const Result<VolumeMesh> mesh = Tetrahedralize{}(model, validity, context);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  const Result<VolumeQualityReport> quality = CheckMesh{}(model, *mesh, context);
  ASSERT_TRUE(quality) << describe(quality.failure());
  EXPECT_NEAR(quality->volume_m3, 1.0, 1e-12);
  EXPECT_EQ(DrawMesh{}(*mesh, context)->pictures.size(), 1u);
}

TEST(TetrahedralizeStage, refuses_a_model_that_leaks) {
  StageContext context;
  InputData open = box();
  open.surfaces.triangles.resize(open.surfaces.triangles.size() - 2);
  open.surfaces.triangle_patch.resize(open.surfaces.triangles.size());
  const BuiltModel model = built(open);
  const Result<VolumeMesh> mesh = Tetrahedralize{}(model, *CheckValidity{{false}}(model, context), context);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.failure().code, FailureCode::invalid_input);
}

TEST(CheckMeshStage, refuses_a_mesh_that_misses_a_cell_or_turns_one_over) {
  StageContext context;
  const BuiltModel model = built(box());
  const VolumeMesh mesh = *Tetrahedralize{}(model, *CheckValidity{{true}}(model, context), context);
  VolumeMesh turned = mesh;
  std::swap(turned.cell_vertices[0], turned.cell_vertices[1]);
  const Result<VolumeQualityReport> inverted = CheckMesh{}(model, turned, context);
  ASSERT_FALSE(inverted);
  EXPECT_THAT(inverted.failure().what, HasSubstr("1 inverted cells"));
  VolumeMesh hollow = mesh;
  hollow.cell_types.pop_back();
  hollow.cell_offsets.pop_back();
  hollow.cell_vertices.resize(hollow.cell_offsets.back());
  hollow.cell_region.pop_back();
  if (!hollow.cell_entity.empty()) hollow.cell_entity.pop_back();
  hollow.facets.clear();
  const Result<VolumeQualityReport> missing = CheckMesh{}(model, hollow, context);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.failure().what, HasSubstr("region_volume_mismatch"));
}

TEST(GenerateStage, makes_a_model_that_is_sealed) {
  StageContext context;
  const Result<InputData> data = Generate{{"A1", 110.0, {}}}(context);
  ASSERT_TRUE(data) << describe(data.failure());
  EXPECT_TRUE((CheckValidity{{true}}(built(*data), context)));
  EXPECT_FALSE((Generate{{"Z9", {}, {}}}(context)));
}

TEST(DrawStage, shows_a_model_three_times_and_survives_the_store) {
  StageContext context;
  const Result<Pictures> pictures = DrawModel{}(built(box()), context);
  ASSERT_TRUE(pictures);
  EXPECT_EQ(pictures->pictures.size(), 3u);
  const std::optional<Pictures> again = unarchived<Pictures>(archived(*pictures));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->pictures[2].png, pictures->pictures[2].png);
}

}  // namespace
}  // namespace strataflow
