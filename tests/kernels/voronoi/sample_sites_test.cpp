#include "kernels/voronoi/sample_sites.h"

#include <gtest/gtest.h>

#include "kernels/voronoi/diagram_samples.h"

namespace strataflow {
namespace {

TEST(SampleSites, spreads_sites_by_area) {
  const sample::Mesh mesh = sample::flat_sheet(4);
  const auto sites = sample_sites(mesh.points, mesh.triangles, {}, 1600, 1);
  ASSERT_EQ(sites.size(), 1600u);
  std::size_t left = 0;
  for (const Vec3& s : sites) left += s.x < 0.5 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(left), 800, 40);
}

TEST(SampleSites, spreads_sites_by_density) {
  const sample::Mesh mesh = sample::flat_sheet(8);
  std::vector<double> density;
  for (const Vec3& p : mesh.points) density.push_back(p.x);
  std::size_t left = 0;
  for (const Vec3& s : sample_sites(mesh.points, mesh.triangles, density, 1600, 1)) left += s.x < 0.5 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(left), 400, 40);
}

TEST(SampleSites, depends_on_its_seed_alone) {
  const sample::Mesh mesh = sample::wavy_sheet(4);
  const auto with_seed = [&](std::uint64_t seed) { return sample_sites(mesh.points, mesh.triangles, {}, 50, seed); };
  EXPECT_EQ(with_seed(3), with_seed(3));
  EXPECT_NE(with_seed(3), with_seed(4));
}

TEST(SampleSites, finds_none_where_there_is_no_area) {
  EXPECT_TRUE(sample_sites(std::vector<Vec3>(3), std::vector<Triangle>{{0, 1, 2}}, {}, 5, 1).empty());
}

}  // namespace
}  // namespace strataflow
