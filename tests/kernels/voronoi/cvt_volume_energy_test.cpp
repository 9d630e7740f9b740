#include "kernels/voronoi/cvt_volume_energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "graph/parallel/schedule.h"
#include "kernels/voronoi/diagram_samples.h"
#include "kernels/voronoi/optimise_sites.h"

namespace strataflow {
namespace {

TEST(TetrahedralBox, fills_the_box_exactly) {
  const TetrahedralBox box = tetrahedral_box({1, 2, 3}, {5, 4, 4}, 4);
  EXPECT_EQ(box.tetrahedra.size(), 6u * 4 * 2 * 1);
  double volume = 0;
  for (const auto& [a, b, c, d] : box.tetrahedra) {
    const Vec3& o = box.points[a];
    const double one = dot(box.points[b] - o, cross(box.points[c] - o, box.points[d] - o)) / 6;
    EXPECT_GT(one, 0);
    volume += one;
  }
  EXPECT_NEAR(volume, 8, 1e-12);
}

TEST(CvtVolumeEnergy, of_one_site_in_the_middle_of_a_cube_is_known) {
  const TetrahedralBox box = tetrahedral_box({0, 0, 0}, {1, 1, 1}, 2);
  CvtTerms terms;
  CvtVolumeEnergy(box.points, box.tetrahedra).evaluate({{0.5, 0.5, 0.5}}, false, terms);
  EXPECT_NEAR(terms.quantization, 0.25, 1e-14);  // ∫ x² + y² + z² about the centre
  EXPECT_NEAR(terms.mass[0], 1, 1e-14);
}

TEST(CvtVolumeEnergy, gradient_agrees_with_differences_of_the_energy) {
  const TetrahedralBox box = tetrahedral_box({0, 0, 0}, {1, 1, 0.5}, 3);
  auto sites = sample::random_sites(30, 41, {0, 0, 0}, {1, 1, 0.5});
  CvtVolumeEnergy energy(box.points, box.tetrahedra);
  CvtTerms terms, above, below;
  energy.evaluate(sites, false, terms);
  EXPECT_NEAR(std::accumulate(terms.mass.begin(), terms.mass.end(), 0.0), 0.5, 1e-12);
  double largest = 0;
  for (const Vec3& g : terms.quantization_gradient) largest = std::max(largest, length(g));
  const double step = 1e-6;
  for (std::uint32_t i = 0; i < sites.size(); i += 4)
    for (int axis = 0; axis < 3; ++axis) {
      const double at = sites[i][axis];
      sites[i][axis] = at + step;
      energy.evaluate(sites, false, above);
      sites[i][axis] = at - step;
      energy.evaluate(sites, false, below);
      sites[i][axis] = at;
      EXPECT_NEAR((above.quantization - below.quantization) / (2 * step), terms.quantization_gradient[i][axis],
                  1e-6 * largest);
    }
}

TEST(CvtVolumeEnergy, is_drawn_to_where_tetrahedra_are_dense) {
  const TetrahedralBox box = tetrahedral_box({0, 0, 0}, {2, 1, 1}, 2);  // two cubes of six tetrahedra each
  std::vector<double> density(box.tetrahedra.size(), 1);
  std::fill_n(density.begin(), 6, 3.0);
  CvtTerms terms, even;
  CvtVolumeEnergy(box.points, box.tetrahedra, density).evaluate({{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, false, terms);
  CvtVolumeEnergy(box.points, box.tetrahedra).evaluate({{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, false, even);
  EXPECT_NEAR(terms.mass[0], 3, 1e-14);
  EXPECT_NEAR(terms.mass[1], 1, 1e-14);
  EXPECT_NEAR(terms.quantization, 2 * even.quantization, 1e-14);
  CvtVolumeEnergy(box.points, box.tetrahedra, density).evaluate({{1, 0.5, 0.5}}, false, terms);
  EXPECT_NEAR(terms.centroid[0].x, (3 * 0.5 + 1.5) / 4, 1e-14);
}

TEST(CvtVolumeEnergy, eight_sites_in_a_cube_end_in_the_middle_of_its_octants) {
  const TetrahedralBox box = tetrahedral_box({0, 0, 0}, {1, 1, 1}, 1);
  std::vector<Vec3> start;
  for (int i = 0; i < 8; ++i)
    start.push_back({0.3 + 0.35 * (i & 1), 0.28 + 0.4 * ((i >> 1) & 1), 0.3 + 0.45 * (i >> 2)});
  CvtVolumeEnergy energy(box.points, box.tetrahedra);
  const OptimisedSites result = optimise_sites(energy, start, {}, {.iterations = 60});
  for (int i = 0; i < 8; ++i) {
    const Vec3 octant{0.25 + 0.5 * (i & 1), 0.25 + 0.5 * ((i >> 1) & 1), 0.25 + 0.5 * (i >> 2)};
    EXPECT_NEAR(length(result.sites[static_cast<std::size_t>(i)] - octant), 0, 1e-4);
  }
}

TEST(CvtVolumeEnergy, is_the_same_to_the_bit_on_any_schedule) {
  const TetrahedralBox box = tetrahedral_box({0, 0, 0}, {1, 1, 1}, 4);
  const auto sites = sample::random_sites(100, 42, {0, 0, 0}, {1, 1, 1});
  const auto run = [&](ScheduleKind kind, std::uint64_t seed) {
    const ScheduleScope scope(kind, seed);
    CvtTerms terms;
    CvtVolumeEnergy(box.points, box.tetrahedra).evaluate(sites, false, terms);
    return terms.quantization_gradient;
  };
  const auto expected = run(ScheduleKind::serial, 0);
  EXPECT_EQ(run(ScheduleKind::threads, 0), expected);
  EXPECT_EQ(run(ScheduleKind::shuffled, 3), expected);
}

}  // namespace
}  // namespace strataflow
