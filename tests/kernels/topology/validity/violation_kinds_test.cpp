#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using support::add_patch;
using support::add_quad;
using support::add_triangle;
namespace fs = std::filesystem;

const fs::path root = STRATAFLOW_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> words_in(const std::string& text, const char* pattern) {
  const std::regex word(pattern);
  std::set<std::string> words;
  for (std::sregex_iterator i(text.begin(), text.end(), word), end; i != end; ++i) words.insert((*i)[1].str());
  return words;
}

/// The kinds in the last column of the tables of docs/validity.md, up to a heading or from it on.
std::set<std::string> documented(bool of_meshes) {
  std::ifstream in(root / "docs" / "validity.md");
  std::set<std::string> kinds;
  bool past_heading = false;
  for (std::string line; std::getline(in, line);) {
    past_heading = past_heading || line == "## A mesh against its model";
    if (line.empty() || line[0] != '|' || past_heading != of_meshes) continue;
    const std::string last = line.substr(line.rfind('|', line.size() - 2));
    kinds.merge(words_in(last, "`([a-z_]+)`"));
  }
  return kinds;
}

/// Every literal of lower-case words in a source: the kinds, and nothing else.
std::set<std::string> literals_of(const fs::path& file) { return words_in(text_of(file), "\"([a-z]+(?:_[a-z]+)*)\""); }

struct Shape {
  TriangleSoup soup;
  bool is_volume_wrong = false;
};

/// A shape for every kind of violation.
std::map<std::string, Shape> shapes() {
  std::map<std::string, Shape> all;
  const TriangleSoup layers = support::layered_box({0, 0.5, 1});
  const auto shape = [&](const char* kind, TriangleSoup soup) -> TriangleSoup& {
    return all[kind].soup = std::move(soup);
  };
  add_triangle(shape("degenerate_triangle", support::box()), 0, {5, 0, 0}, {6, 0, 0}, {7, 0, 0});
  support::add_box(shape("pinched_surface", support::box()), 0, {1, 1, 1}, {2, 2, 2});
  TriangleSoup& strip = shape("non_orientable_surface", {});
  add_patch(strip, "strip");
  const auto rim = [](int i, double side) {
    const double turn = 2 * M_PI * (i % 12) / 12, way = i >= 12 ? -side : side, r = 3 + way * std::cos(turn / 2);
    return Vec3{r * std::cos(turn), r * std::sin(turn), way * std::sin(turn / 2)};
  };
  for (int i = 0; i < 12; ++i) add_quad(strip, 0, rim(i, -1), rim(i + 1, -1), rim(i + 1, 1), rim(i, 1));
  TriangleSoup& crossing = shape("improper_intersection", support::box());
  support::add_box(crossing, add_patch(crossing, "other"), {.5, .5, .5}, {2, 2, 2});
  support::add_sheet(shape("duplicate_triangle", layers), 1, {0, 0, 0}, {1, 1, 1}, 0.5);
  TriangleSoup& twice = shape("coincident_surfaces", layers);
  support::add_sheet(twice, add_patch(twice, "again"), {0, 0, 0}, {1, 1, 1}, 0.5);
  TriangleSoup& contact = shape("non_conforming_contact", support::box());
  add_quad(contact, add_patch(contact, "F"), {0, .3, .4}, {1, .3, .4}, {1, .6, .4}, {0, .6, .4});
  for (const char* kind : {"unsorted_contact", "unknown_volume"}) {
    TriangleSoup& flap = shape(kind, support::box());
    add_quad(flap, add_patch(flap, "flap"), {0, 0, 1}, {1, 0, 1}, {1, 2, 1}, {0, 2, 1});
  }
  TriangleSoup& blades = shape("radial_order_changes", {});
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{2, 0, 0}, north{0, 1, 0}, up{0, 0, 1}, south{0, -1, 0};
  for (const auto& [first, second] : {std::pair{north, north}, {up, south}, {south, up}}) {
    const std::uint32_t patch = add_patch(blades, "blade");
    add_triangle(blades, patch, a, b, a + first);
    add_triangle(blades, patch, b, c, c + second);
    add_triangle(blades, patch, b, c + second, a + first);
  }
  all["volume_imbalance"] = {layers, true};
  TriangleSoup& leak = shape("leak", support::box_with_floating_fault());
  leak.regions = {{"east", {{0, 1, {}}, {1, 1, {}}}}, {"west", {{0, 1, {}}, {1, 0, {}}}}};
  TriangleSoup& open = shape("open_shell", support::box());
  open.triangles.pop_back();
  open.triangle_patch.pop_back();
  shape("dangling_surface", support::box_with_floating_fault());
  shape("inconsistent_border", layers).border_stones = {0};
  TriangleSoup& stones = shape("superfluous_border_stone", {});
  add_patch(stones, "sheet");
  add_patch(stones, "other");
  add_triangle(stones, 0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_triangle(stones, 1, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  stones.border_stones = {2};
  TriangleSoup& torn = shape("torn_property", layers);
  torn.properties = {{"porosity", "", 1, {}}};
  for (std::size_t i = 0; i < torn.points.size(); ++i) torn.properties[0].values.push_back(static_cast<double>(i));
  return all;
}

TEST(ViolationKinds, every_documented_kind_is_found_in_a_shape_that_has_it) {
  const std::map<std::string, Shape> all = shapes();
  for (const std::string& kind : documented(false)) EXPECT_TRUE(all.count(kind)) << kind << " has no shape here";
  for (const auto& [kind, shape] : all) {
    Result<BuiltModel> built = build_structural_model(shape.soup);
    ASSERT_TRUE(built) << kind;
    if (shape.is_volume_wrong) built->model.regions.at(0).volume_m3 *= 1 + 1e-6;
    const ValidityReport report = check_validity(*built);
    std::string found;
    for (const Violation& violation : report.violations) found += " " + violation.kind;
    EXPECT_NE((found + " ").find(" " + kind), std::string::npos) << "wanted " << kind << ", found:" << found;
  }
}

TEST(ViolationKinds, no_kind_goes_undocumented) {
  std::set<std::string> said;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "src" / "kernels" / "topology"))
    if (entry.path().extension() == ".cpp") said.merge(literals_of(entry.path()));
  EXPECT_EQ(said, documented(false));
}

TEST(ViolationKinds, the_kinds_of_a_mesh_are_documented_and_tested_where_they_are_found) {
  const std::set<std::string> said = literals_of(root / "src" / "kernels" / "quality" / "check_mesh_against_model.cpp");
  EXPECT_EQ(said, documented(true));
  const std::set<std::string> tested =
      literals_of(root / "tests" / "kernels" / "quality" / "check_mesh_against_model_test.cpp");
  for (const std::string& kind : said) EXPECT_TRUE(tested.count(kind)) << kind;
}

}  // namespace
}  // namespace strataflow
