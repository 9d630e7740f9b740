// Quads on real inputs and on machine parts, from the file to the mesh, judged without any of the mesher's code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <tuple>

#include "io/input/combine_inputs.h"
#include "io/read_input.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "stages/build_model_stage.h"
#include "stages/combine_stage.h"
#include "stages/extract_quads_stage.h"
#include "stages/plan_surfaces_stage.h"
#include "stages/read_stage.h"
#include "support/quad_chains.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  const char* set = std::getenv("STRATAFLOW_DATA");
  return set ? fs::path(set) : fs::path(STRATAFLOW_SOURCE_DIR) / "../shared/data";
}

struct Made {
  FeatureMesh problem;
  MeshedQuads quads;
};

Result<Made> quads_of(Result<FeatureMesh> problem) {
  if (!problem) return problem.failure();
  StageContext context("test");
  const auto field = ComputeFrameField{}(*problem, context);
  if (!field) return field.failure();
  const auto map = SeamlessMap{}(*problem, *field, context);
  if (!map) return map.failure();
  const auto grid = Quantize{}(*problem, *map, context);
  if (!grid) return grid.failure();
  Result<MeshedQuads> quads = ExtractQuads{}(*problem, *grid, context);
  if (!quads) return quads.failure();
  return Made{std::move(*problem), std::move(*quads)};
}

Result<Made> quads_on(const InputData& input, double edge_m) {
  StageContext context("test");
  return quads_of(PlanProblem{{.plan = {.edge_length_m = edge_m}}}(input, context));
}

Result<InputData> read_all(const std::vector<std::pair<fs::path, ReadOptions>>& files) {
  StageContext context("test");
  std::vector<InputData> parts;
  for (const auto& [path, options] : files) {
    Result<InputData> part = Read{options, path}(context);
    if (!part) return part;
    parts.push_back(std::move(*part));
  }
  std::vector<const InputData*> all;
  for (const InputData& part : parts) all.push_back(&part);
  return Combine{}(all, context);
}

Result<InputData> shape(const std::string& name) {
  Result<TriangleSoup> soup = generate_reference_model(name, {});
  if (!soup) return soup.failure();
  InputData input;
  input.surfaces = std::move(*soup);
  return input;
}

/// All quads, none inverted, every feature a chain with its vertices on it to 1e-9 of the domain, and rule R12: the
/// valences sum up to the Euler characteristic.
void expect_good(const Result<Made>& made) {
  ASSERT_TRUE(made) << describe(made.failure());
  const QuadMesh& quads = made->quads.mesh;
  EXPECT_EQ(made->quads.quality.inverted, 0u);
  EXPECT_GT(made->quads.quality.scaled_jacobian.minimum, 0);
  std::vector<Vec3> points = made->problem.points;
  const auto before = [](const Vec3& p, const Vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); };
  std::sort(points.begin(), points.end(), before);
  // Both sides of a fault without throw lie at one place: a check that sees places only cannot tell whose chain breaks.
  const bool has_twins = std::adjacent_find(points.begin(), points.end()) != points.end();
  for (const std::string& wrong : features_not_held(made->problem, quads))
    if (!has_twins || wrong.find("is no chain") == std::string::npos) ADD_FAILURE() << wrong;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
  std::vector<std::int64_t> edges_at(quads.points.size(), 0);
  std::vector<char> is_border(quads.points.size(), 0);
  for (const auto& q : quads.quads)
    for (std::size_t k = 0; k < 4; ++k) ++faces[std::minmax(q[k], q[(k + 1) % 4])];
  for (const auto& [edge, count] : faces) {
    ASSERT_LE(count, 2);
    ++edges_at[edge.first];
    ++edges_at[edge.second];
    if (count == 1) is_border[edge.first] = is_border[edge.second] = 1;
  }
  std::int64_t sum = 0;
  for (std::size_t p = 0; p < edges_at.size(); ++p) sum += (is_border[p] ? 3 : 4) - edges_at[p];
  const auto euler = static_cast<std::int64_t>(quads.points.size()) - static_cast<std::int64_t>(faces.size()) +
                     static_cast<std::int64_t>(quads.quads.size());
  EXPECT_EQ(sum, 4 * euler);
}

TEST(QuadInputs, the_spe11_sections) {
  const fs::path folder = data_folder() / "section2d";
  if (!fs::exists(folder)) GTEST_SKIP() << "no data at " << folder;
  // A wedge of 4.3° in the first: where only one quad fits along its sides, sin 4.3° = 0.075 is all there is.
  for (const auto& [name, edge_m] : {std::pair("spe11a.geo", 0.05), std::pair("spe11b.geo", 80.0)}) {
    const auto input = read_all({{folder / name, {}}});
    ASSERT_TRUE(input) << describe(input.failure());
    const auto made = quads_on(*input, edge_m);
    expect_good(made);
    if (made) {
      EXPECT_EQ(made->problem.features.size(), 22u) << name;
      EXPECT_GE(made->quads.quality.scaled_jacobian.minimum, 0.15) << name;
    }
  }
}

TEST(QuadInputs, branets_and_drogon_with_every_node_on_its_curve) {
  const fs::path folder = data_folder() / "faultmaps";
  if (!fs::exists(folder)) GTEST_SKIP() << "no data at " << folder;
  const auto branets = read_all({{folder / "branets.txt", {}}});
  ASSERT_TRUE(branets);
  const auto at_12 = quads_on(*branets, 12);
  expect_good(at_12);
  ASSERT_TRUE(at_12);
  EXPECT_LE(at_12->quads.quality.interior_irregular, 60u);
  EXPECT_GE(at_12->quads.quality.scaled_jacobian.minimum, 0.2);
  std::vector<std::pair<fs::path, ReadOptions>> files{{data_folder() / "drogon/outline.pol", {{}, "outline"}}};
  for (int f = 1; f <= 6; ++f) {
    const std::string name = "F" + std::to_string(f);
    files.push_back({folder / "drogon-sticks" / (name + ".pol"), {name, "fault", true}});
  }
  const auto drogon = read_all(files);
  ASSERT_TRUE(drogon) << describe(drogon.failure());
  const auto at_100 = quads_on(*drogon, 100);
  expect_good(at_100);
  ASSERT_TRUE(at_100);
  EXPECT_LE(at_100->quads.quality.interior_irregular, 25u);
  EXPECT_GE(at_100->quads.quality.scaled_jacobian.minimum, 0.2);
}

/// Two sides of an acute corner of one curve (F2) were once taken for a straight piece of it.
TEST(QuadInputs, drogon_along_the_traces_of_its_fault_surfaces) {
  const fs::path folder = data_folder() / "drogon";
  if (!fs::exists(folder)) GTEST_SKIP() << "no data at " << folder;
  const auto input =
      read_all({{folder / "outline.pol", {{}, "outline"}}, {folder / "faults_F1-F6.ts", {{}, "fault", false, true}}});
  ASSERT_TRUE(input) << describe(input.failure());
  const auto made = quads_on(*input, 100);
  expect_good(made);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->problem.features.size(), 7u);
  EXPECT_GE(made->quads.quality.scaled_jacobian.minimum, 0.2);
}

TEST(QuadInputs, the_traces_of_the_eastern_transverse_ranges) {
  const fs::path folder = data_folder() / "scec-cfm61/native_ETRA";
  if (!fs::exists(folder)) GTEST_SKIP() << "no data at " << folder;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::pair<fs::path, ReadOptions>> files;
  for (const fs::path& path : paths) files.push_back({path, {{}, "fault", false, true}});
  const auto input = read_all(files);
  ASSERT_TRUE(input) << describe(input.failure());
  EXPECT_TRUE(input->surfaces.triangles.empty());
  const auto made = quads_on(*input, 4000);
  expect_good(made);
  if (made) {
    EXPECT_EQ(made->problem.features.size(), 18u) << "17 faults and the box around them";
  }
}

TEST(QuadInputs, the_horizons_of_cloudspin_along_their_faults) {
  const fs::path path = data_folder() / "cloudspin/CloudSpin_fixed.ml";
  if (!fs::exists(path)) GTEST_SKIP() << "no data at " << path;
  const auto input = read_all({{path, {}}});
  ASSERT_TRUE(input) << describe(input.failure());
  StageContext context("test");
  const Result<BuiltModel> model = BuildModel{}(*input, context);
  ASSERT_TRUE(model) << describe(model.failure());
  PlanSurfacesOptions options;
  options.problem.plan.edge_length_m = 500;
  for (const auto& [horizon, features] :
       {std::pair("KOBE", 15u), std::pair("HOUSTON", 16u), std::pair("CARACAS", 9u)}) {
    options.surfaces = {horizon};
    const auto made = quads_of(PlanSurfaces{options}(*model, context));
    expect_good(made);
    if (made) {
      EXPECT_EQ(made->problem.features.size(), features) << horizon;
    }
  }
  options.surfaces = {"KOBI"};
  const auto unknown = PlanSurfaces{options}(*model, context);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.failure().what.find("'KOBI'"), std::string::npos);
  EXPECT_NE(unknown.failure().remedy.find("KOBE"), std::string::npos);
}

/// T25, T29: closed surfaces, smooth and with sharp edges, at several sizes of quads; seamless and quantized every
/// time.
TEST(QuadInputs, machine_parts_and_smooth_shapes) {
  struct Part {
    const char* name;
    double edge_m;
    std::uint64_t least_irregular;
  };
  for (const Part& part : {Part{"torus", 8, 0}, Part{"torus", 20, 0}, Part{"bracket", 14, 30}, Part{"bracket", 20, 30},
                           Part{"smooth-closed", 10, 8}, Part{"slab", 60, 8}, Part{"impeller", 6, 16}}) {
    SCOPED_TRACE(std::string(part.name) + " at " + std::to_string(part.edge_m));
    const auto input = shape(part.name);
    ASSERT_TRUE(input) << describe(input.failure());
    const auto made = quads_on(*input, part.edge_m);
    expect_good(made);
    if (!made) continue;
    EXPECT_GE(made->quads.quality.interior_irregular, part.least_irregular);
    if (part.least_irregular == 0) {
      EXPECT_EQ(made->quads.quality.interior_irregular, 0u);
    }
  }
}

TEST(QuadInputs, faces_of_flat_and_of_pointed_bodies_alone_and_together) {
  for (const std::string body : {"slab", "wedge"}) {
    const auto input = shape(body);
    ASSERT_TRUE(input) << describe(input.failure());
    StageContext context("test");
    const Result<BuiltModel> model = BuildModel{}(*input, context);
    ASSERT_TRUE(model) << describe(model.failure());
    PlanSurfacesOptions options;
    for (const double edge_m : {80.0, 40.0})
      for (const std::vector<std::string>& faces :
           {std::vector<std::string>{"Top"}, std::vector<std::string>{"Top", "Bottom", "North", "South", "West"}}) {
        SCOPED_TRACE(body + " at " + std::to_string(edge_m) + ", faces " + std::to_string(faces.size()));
        options.problem.plan.edge_length_m = edge_m;
        options.surfaces = faces;
        expect_good(quads_of(PlanSurfaces{options}(*model, context)));
      }
  }
}

/// R27: a fault with thickness is one row of quads, each with a side on both of its offset curves.
TEST(QuadInputs, a_thick_fault_is_one_row_of_quads) {
  InputData input;
  input.lines = {{"outline", Role::outline, {{0, 0, 0}, {200, 0, 0}, {200, 150, 0}, {0, 150, 0}}, true},
                 {"F1", Role::fault, {{30, 60, 0}, {90, 72, 0}, {160, 66, 0}}, false},
                 {"F2", Role::fault, {{100, 150, 0}, {112, 110, 0}}, false}};
  for (const std::int64_t rows : {1, 2}) {
    StageContext context("test");
    PlanProblemOptions options;
    options.plan.edge_length_m = 10;
    options.plan.fault_thickness_m = {{"F1", 5}};
    options.plan.strip_quads = rows;
    const auto made = quads_of(PlanProblem{options}(input, context));
    expect_good(made);
    ASSERT_TRUE(made);
    const QuadMesh& quads = made->quads.mesh;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> name_of;
    for (const FeatureEdge& e : quads.edges) name_of[{e.a, e.b}] = quads.features[e.feature].name;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> beside;
    for (std::size_t q = 0; q < quads.quads.size(); ++q)
      for (std::size_t k = 0; k < 4; ++k)
        beside[std::minmax(quads.quads[q][k], quads.quads[q][(k + 1) % 4])].push_back(q);
    std::size_t columns = 0;
    for (const auto& [edge, name] : name_of) {
      if (name != "F1 left") continue;
      // Straight across from each side: on one of them the other curve comes after exactly `rows` quads.
      bool is_found = false;
      for (std::size_t q : beside[edge]) {
        auto at = edge;
        for (std::int64_t row = 1; row <= rows; ++row) {
          const auto& c = quads.quads[q];
          std::size_t k = 0;
          while (std::pair<std::uint32_t, std::uint32_t>(std::minmax(c[k], c[(k + 1) % 4])) != at) ++k;
          at = std::minmax(c[(k + 2) % 4], c[(k + 3) % 4]);
          const auto found = name_of.find(at);
          if (found != name_of.end() && found->second == "F1 right") is_found = row == rows;
          if (found != name_of.end() || beside[at].size() != 2) break;
          q = beside[at][beside[at][0] == q ? 1 : 0];
        }
      }
      EXPECT_TRUE(is_found) << rows << " rows at column " << columns;
      ++columns;
    }
    EXPECT_GE(columns, 10u);
  }
}

}  // namespace
}  // namespace strataflow
