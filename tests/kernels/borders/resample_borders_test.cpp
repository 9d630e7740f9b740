#include "kernels/borders/resample_borders.h"

#include <gtest/gtest.h>

#include "base/id.h"
#include "kernels/borders/strips.h"

namespace strataflow {
namespace {

TEST(ResampleBorders, puts_nodes_at_equal_distances_and_contracts_the_others_to_the_nearest) {
  TriangleSoup soup;
  support::add_strip(soup, support::add_patch(soup, "coarse"), 4, 20, {0, 1, 0}, {4, 8, 12, 16});
  support::add_strip(soup, support::add_patch(soup, "fine"), 5, 20, {0, 0, 1}, {5, 10, 15});
  soup = support::weld(soup);
  const BorderNetwork network = find_radial_borders(soup.points, soup.triangles, soup.triangle_patch, 45);
  ASSERT_EQ(network.borders.size(), 1u);
  const ResampledMesh mesh = resample_borders(soup.points, soup.triangles, network, {1});
  ASSERT_EQ(mesh.chains[0].size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(mesh.points[mesh.chains[0][i]], (Vec3{5.0 * static_cast<double>(i), 0, 0}));
  EXPECT_TRUE(mesh.new_points.empty()) << "5, 10 and 15 were there";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t v : mesh.triangles[i])
      if (mesh.points[v].y == 0 && mesh.points[v].z == 0) {
        EXPECT_EQ(std::fmod(mesh.points[v].x, 5), 0) << mesh.points[v].x;
      }
}

TEST(ResampleBorders, splits_all_triangles_of_an_edge_at_the_same_new_node) {
  TriangleSoup soup;
  support::add_strip(soup, support::add_patch(soup, "a"), 4, 12, {0, 1, 0}, {1, 2});
  support::add_strip(soup, support::add_patch(soup, "b"), 4, 12, {0, 0, 1}, {1, 2});
  soup = support::weld(soup);
  BorderNetwork network = find_radial_borders(soup.points, soup.triangles, soup.triangle_patch, 45);
  network.borders[0].representative_count = 6;  // five edges of 2.4
  const ResampledMesh mesh = resample_borders(soup.points, soup.triangles, network, {1});
  ASSERT_EQ(mesh.new_points.size(), 4u);
  EXPECT_DOUBLE_EQ(mesh.points[mesh.chains[0][1]].x, 2.4);
  EXPECT_DOUBLE_EQ(mesh.points[mesh.chains[0][4]].x, 9.6);
  std::size_t users = 0, flat = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    flat += mesh.is_flat[i];
    users += !mesh.is_flat[i] && std::count(mesh.triangles[i].begin(), mesh.triangles[i].end(), mesh.chains[0][3]) > 0;
  }
  EXPECT_GT(flat, 0u);
  EXPECT_GE(users, 4u);
}

TEST(ResampleBorders, leaves_borders_that_are_not_chosen) {
  const TriangleSoup soup = support::weld(support::three_strips());
  const BorderNetwork network = find_radial_borders(soup.points, soup.triangles, soup.triangle_patch, 45);
  const ResampledMesh mesh = resample_borders(soup.points, soup.triangles, network, {0});
  EXPECT_EQ(mesh.triangles, soup.triangles);
  EXPECT_EQ(mesh.points, soup.points);
}

}  // namespace
}  // namespace strataflow
