#include "kernels/voronoi/optimise_sites.h"

#include <gtest/gtest.h>

#include <cmath>

#include "graph/parallel/schedule.h"
#include "kernels/voronoi/diagram_samples.h"
#include "kernels/voronoi/sample_sites.h"
#include "kernels/voronoi/triangle_cells.h"

namespace strataflow {
namespace {

TEST(OptimiseSites, two_sites_in_a_square_end_in_the_middle_of_its_halves) {
  const sample::Mesh mesh = sample::flat_sheet(6);
  const OptimisedSites optimised =
      optimise_sites({mesh.points, mesh.triangles, {}, {}}, {{0.2, 0.45, 0}, {0.6, 0.5, 0}}, {}, {.iterations = 60});
  EXPECT_NEAR(length(optimised.sites[0] - Vec3{0.25, 0.5, 0}), 0, 1e-5);
  EXPECT_NEAR(length(optimised.sites[1] - Vec3{0.75, 0.5, 0}), 0, 1e-5);
}

TEST(OptimiseSites, energy_never_grows_and_sites_reach_their_centroids) {
  const sample::Mesh mesh = sample::wavy_sheet(20);
  const CvtDomain domain{mesh.points, mesh.triangles, {}, {}};
  const OptimisedSites optimised = optimise_sites(domain, sample_sites(mesh.points, mesh.triangles, {}, 60, 1), {},
                                                  {.lloyd_iterations = 5, .iterations = 300});
  std::vector<double> energies;
  for (const CvtStep& step : optimised.lloyd_steps) energies.push_back(step.energy);
  for (const CvtStep& step : optimised.newton_steps) energies.push_back(step.energy);
  for (std::size_t i = 1; i < energies.size(); ++i) EXPECT_LE(energies[i], energies[i - 1] * (1 + 1e-12));
  const double cell_size = std::sqrt(1.0 / 60);
  for (std::size_t i = 0; i < optimised.sites.size(); ++i)
    EXPECT_LT(length(optimised.sites[i] - optimised.terms.centroid[i]), 1e-3 * cell_size);
}

TEST(OptimiseSites, quasi_newton_gets_lower_than_lloyd_in_as_many_evaluations) {
  const sample::Mesh mesh = sample::wavy_sheet(20);
  const CvtDomain domain{mesh.points, mesh.triangles, {}, {}};
  const auto start = sample_sites(mesh.points, mesh.triangles, {}, 100, 2);
  const OptimisedSites newton = optimise_sites(domain, start, {}, {.lloyd_iterations = 5, .iterations = 40});
  const OptimisedSites lloyd = optimise_sites(domain, start, {}, {.lloyd_iterations = newton.evaluations, .iterations = 0});
  EXPECT_LT(newton.terms.quantization, lloyd.terms.quantization);
}

TEST(OptimiseSites, attraction_draws_sites_onto_the_line) {
  const sample::Mesh mesh = sample::flat_sheet(12);
  std::vector<LineEdge> line;  // the border y = 0
  for (std::uint32_t i = 0; i < 12; ++i) line.push_back({2 * i, 0});
  const CvtDomain domain{mesh.points, mesh.triangles, {}, line};
  const auto start = sample_sites(mesh.points, mesh.triangles, {}, 40, 3);
  const auto distance_to_line = [&](std::optional<double> attraction) {
    const OptimisedSites result =
        optimise_sites(domain, start, {}, {.iterations = 60, .line_attraction = attraction});
    SiteNeighbours neighbours;
    neighbours.move_to(result.sites);
    double sum = 0;  // over the line, of the distance of the site whose cell is there
    for (int i = 0; i <= 1000; ++i) {
      const double y = result.sites[find_nearest_site(neighbours, {i / 1000.0, 0, 0}, 0)].y;
      sum += y * y;
    }
    return std::sqrt(sum / 1001);
  };
  const double without = distance_to_line(0.0);
  EXPECT_LT(distance_to_line(0.9), 0.2 * without);
  EXPECT_LT(distance_to_line(std::nullopt), 0.9 * without);  // both pull alike
}

TEST(OptimiseSites, fixed_sites_stay_and_lost_sites_are_replanted) {
  const sample::Mesh mesh = sample::flat_sheet(10);
  std::vector<Vec3> start = sample_sites(mesh.points, mesh.triangles, {}, 20, 4);
  start[0] = {0, 0, 0};
  start[7] = {100, 100, 100};
  std::vector<char> fixed(20, 0);
  fixed[0] = 1;
  const OptimisedSites result = optimise_sites({mesh.points, mesh.triangles, {}, {}}, start, fixed);
  EXPECT_EQ(result.sites[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(result.replanted_sites, 1u);
  for (const double mass : result.terms.mass) EXPECT_GT(mass, 0);
}

TEST(OptimiseSites, is_the_same_to_the_bit_on_any_schedule) {
  const sample::Mesh mesh = sample::wavy_sheet(50);
  const auto start = sample_sites(mesh.points, mesh.triangles, {}, 150, 5);
  const auto run = [&](ScheduleKind kind, std::uint64_t seed) {
    const ScheduleScope scope(kind, seed);
    return optimise_sites({mesh.points, mesh.triangles, {}, {}}, start, {}, {.iterations = 30}).sites;
  };
  const auto expected = run(ScheduleKind::serial, 0);
  EXPECT_EQ(run(ScheduleKind::threads, 0), expected);
  EXPECT_EQ(run(ScheduleKind::shuffled, 1), expected);
  EXPECT_EQ(run(ScheduleKind::shuffled, 2), expected);
}

}  // namespace
}  // namespace strataflow
