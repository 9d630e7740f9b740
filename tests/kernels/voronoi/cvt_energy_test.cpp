#include "kernels/voronoi/cvt_energy.h"

#include <gtest/gtest.h>

#include <numeric>

#include "graph/parallel/schedule.h"
#include "kernels/voronoi/diagram_samples.h"

namespace strataflow {
namespace {

CvtTerms terms_of(const CvtDomain& domain, const std::vector<Vec3>& sites) {
  CvtTerms terms;
  CvtEnergy(domain).evaluate(sites, true, terms);
  return terms;
}

/// Border of a sheet of n × n squares, each edge once.
std::vector<LineEdge> border_of_sheet(std::uint32_t n) {
  std::vector<LineEdge> edges;
  for (std::uint32_t i = 0; i < n; ++i) {
    edges.push_back({2 * i, 0});
    edges.push_back({2 * ((n - 1) * n + i) + 1, 1});
    edges.push_back({2 * (i * n) + 1, 2});
    edges.push_back({2 * (i * n + n - 1), 1});
  }
  return edges;
}

TEST(CvtEnergy, masses_add_up_to_the_area) {
  const sample::Mesh mesh = sample::wavy_sheet(15);
  const CvtTerms terms = terms_of({mesh.points, mesh.triangles, {}, {}},
                                  sample::random_sites(50, 21, {0, 0, -0.2}, {1, 1, 0.2}));
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += sample::triangle_area(mesh, t);
  EXPECT_NEAR(std::accumulate(terms.mass.begin(), terms.mass.end(), 0.0), area, 1e-12);
}

TEST(CvtEnergy, of_one_site_in_the_middle_of_a_square_is_known) {
  const sample::Mesh mesh = sample::flat_sheet(3);
  const CvtTerms terms = terms_of({mesh.points, mesh.triangles, {}, {}}, {{0.5, 0.5, 0}});
  EXPECT_NEAR(terms.quantization, 1.0 / 6, 1e-14);  // ∫∫ x² + y² about the centre
  EXPECT_NEAR(length(terms.centroid[0] - Vec3{0.5, 0.5, 0}), 0, 1e-14);
}

TEST(CvtEnergy, a_linear_density_moves_the_centroid_as_known) {
  const sample::Mesh mesh = sample::flat_sheet(3);
  std::vector<double> density;
  for (const Vec3& p : mesh.points) density.push_back(p.x);
  const CvtTerms terms = terms_of({mesh.points, mesh.triangles, density, {}}, {{0.5, 0.5, 0}});
  EXPECT_NEAR(terms.mass[0], 0.5, 1e-14);
  EXPECT_NEAR(terms.centroid[0].x, 2.0 / 3, 1e-14);
  EXPECT_NEAR(terms.centroid[0].y, 0.5, 1e-14);
}

class CvtGradient : public testing::TestWithParam<bool> {};

TEST_P(CvtGradient, agrees_with_differences_of_the_energy) {
  const sample::Mesh mesh = sample::wavy_sheet(9);
  std::vector<double> density;
  if (GetParam())
    for (const Vec3& p : mesh.points) density.push_back(1 + 3 * p.x + p.y);
  const std::vector<LineEdge> border = border_of_sheet(9);
  const CvtDomain domain{mesh.points, mesh.triangles, density, border};
  auto sites = sample::random_sites(40, 22, {0, 0, -0.1}, {1, 1, 0.1});
  const CvtTerms terms = terms_of(domain, sites);
  const double step = 1e-6;
  double largest = 0, largest_attraction = 0;
  for (const Vec3& g : terms.quantization_gradient) largest = std::max(largest, length(g));
  for (const Vec3& g : terms.attraction_gradient) largest_attraction = std::max(largest_attraction, length(g));
  ASSERT_GT(largest_attraction, 0);
  for (std::uint32_t i = 0; i < sites.size(); i += 3)
    for (int axis = 0; axis < 3; ++axis) {
      const double at = sites[i][axis];
      sites[i][axis] = at + step;
      const CvtTerms above = terms_of(domain, sites);
      sites[i][axis] = at - step;
      const CvtTerms below = terms_of(domain, sites);
      sites[i][axis] = at;
      EXPECT_NEAR((above.quantization - below.quantization) / (2 * step), terms.quantization_gradient[i][axis],
                  1e-6 * largest);
      EXPECT_NEAR((above.attraction - below.attraction) / (2 * step), terms.attraction_gradient[i][axis],
                  1e-5 * largest_attraction);
    }
}

INSTANTIATE_TEST_SUITE_P(UniformAndLinearDensity, CvtGradient, testing::Bool());

TEST(CvtEnergy, is_the_same_to_the_bit_on_any_schedule_and_after_any_history) {
  const sample::Mesh mesh = sample::wavy_sheet(60);
  const auto sites = sample::random_sites(200, 23, {0, 0, -0.2}, {1, 1, 0.2});
  const CvtDomain domain{mesh.points, mesh.triangles, {}, {}};
  const auto run = [&](ScheduleKind kind, std::uint64_t seed) {
    const ScheduleScope scope(kind, seed);
    return terms_of(domain, sites);
  };
  const CvtTerms expected = run(ScheduleKind::serial, 0);
  EXPECT_EQ(run(ScheduleKind::threads, 0).quantization_gradient, expected.quantization_gradient);
  EXPECT_EQ(run(ScheduleKind::shuffled, 5).quantization, expected.quantization);
}

TEST(CvtEnergy, a_site_far_from_everything_has_no_cell_and_stays) {
  const sample::Mesh mesh = sample::flat_sheet(2);
  const CvtTerms terms = terms_of({mesh.points, mesh.triangles, {}, {}}, {{0.3, 0.5, 0}, {0.7, 0.5, 0}, {50, 50, 50}});
  EXPECT_EQ(terms.mass[2], 0);
  EXPECT_EQ(terms.centroid[2], (Vec3{50, 50, 50}));
  EXPECT_EQ(length(terms.quantization_gradient[2]), 0);
}

}  // namespace
}  // namespace strataflow
