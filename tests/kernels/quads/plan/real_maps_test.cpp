// Real fault maps: what cleaning does to them, held against the input by code of its own.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "io/read_input.h"
#include "kernels/quads/plan/plan_curves.h"
#include "kernels/quads/plan/plan_samples.h"

namespace strataflow {
namespace {

using namespace plan_samples;

std::filesystem::path data_folder() {
  const char* set = std::getenv("STRATAFLOW_DATA");
  return set ? std::filesystem::path(set) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data";
}

void expect_clean(const FeatureMesh& mesh, const std::vector<Polyline>& lines, double edge_m) {
  EXPECT_TRUE(all_counter_clockwise(mesh));
  for (const Polyline& input : lines)
    EXPECT_LE(furthest_from_feature(mesh, input), 0.1 * edge_m * (1 + 1e-9)) << input.name;
  // And back: no feature where there was no curve.
  for (const FeatureEdge& e : mesh.edges) {
    double least = 1e300;
    const Vec3 middle = 0.5 * (mesh.points[e.a] + mesh.points[e.b]);
    for (const Polyline& input : lines) {
      if (input.name != mesh.features[e.feature].name) continue;
      const std::size_t n = input.points.size();
      for (std::size_t i = 0; i + (input.is_closed ? 0 : 1) < n; ++i) {
        Vec3 a = input.points[i], b = input.points[(i + 1) % n];
        a.z = b.z = 0;
        least = std::min(least, distance_to_segment(middle, a, b));
      }
    }
    EXPECT_LE(least, 0.1 * edge_m * (1 + 1e-9));
  }
  double smallest_deg = 180;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]],
                 v = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      smallest_deg = std::min(smallest_deg, std::atan2(cross(u, v).z, dot(u, v)) * 57.29577951308232);
    }
  EXPECT_GT(smallest_deg, 4);
}

TEST(RealMaps, branets_at_12_ties_up_its_loose_ends_and_lists_them) {
  const auto file = data_folder() / "faultmaps/branets.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no data at " << file;
  const auto input = read_input(file);
  ASSERT_TRUE(input) << describe(input.failure());
  ASSERT_EQ(input->lines.size(), 22u);
  EXPECT_EQ(
      std::count_if(input->lines.begin(), input->lines.end(), [](const Polyline& l) { return l.role == Role::fault; }),
      21);
  const auto mesh = plan_mesh(input->lines, {}, {}, edge(12));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_clean(*mesh, input->lines, 12);
  EXPECT_GE(changes_of_kind(mesh->changes, "snapped") + changes_of_kind(mesh->changes, "trimmed"), 24);
  EXPECT_LT(mesh->triangles.size(), 20000u);
}

TEST(RealMaps, drogon_at_100_m_from_its_sticks_and_outline) {
  const auto folder = data_folder();
  if (!std::filesystem::exists(folder / "faultmaps/drogon-sticks")) GTEST_SKIP() << "no data at " << folder;
  std::vector<Polyline> lines;
  const Vec3 origin{460000, 5930000, 0};
  for (int f = 1; f <= 6; ++f) {
    const std::string name = "F" + std::to_string(f);
    auto sticks = read_input(folder / ("faultmaps/drogon-sticks/" + name + ".pol"));
    ASSERT_TRUE(sticks) << describe(sticks.failure());
    lines.push_back(trace_of_sticks(sticks->lines));
    lines.back().name = name;
    lines.back().role = Role::fault;
    EXPECT_GE(lines.back().points.size(), 10u);
  }
  auto outline = read_input(folder / "drogon/outline.pol");
  ASSERT_TRUE(outline) << describe(outline.failure());
  ASSERT_EQ(outline->lines.size(), 1u);
  EXPECT_TRUE(outline->lines[0].is_closed);
  outline->lines[0].role = Role::outline;
  lines.push_back(outline->lines[0]);
  for (Polyline& l : lines)
    for (Vec3& p : l.points) p = p - origin;
  const auto mesh = plan_mesh(lines, {}, origin, edge(100));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_clean(*mesh, lines, 100);
  EXPECT_EQ(mesh->features.size(), 7u);
}

TEST(RealMaps, spe11_has_all_its_facies) {
  const auto file = data_folder() / "section2d/spe11a.geo";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no data at " << file;
  const auto input = read_input(file);
  ASSERT_TRUE(input) << describe(input.failure());
  const auto mesh = plan_mesh(input->lines, input->point_sets, {}, edge(0.03));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_TRUE(all_counter_clockwise(*mesh));
  EXPECT_NEAR(mesh_area(*mesh), 2.8 * 1.2, 0.05 * 2.8 * 1.2);
  double all = 0;
  for (const Feature& f : mesh->features) all += feature_length(*mesh, f.name);
  EXPECT_GT(all, 20);
  EXPECT_GT(mesh->features.size(), 7u);
}

}  // namespace
}  // namespace strataflow
