#include "kernels/remeshing/dual/dual_polygons.h"

#include "graph/parallel/schedule.h"
#include "kernels/remeshing/dual/dual_samples.h"
#include "kernels/voronoi/optimise_sites.h"
#include "kernels/voronoi/sample_sites.h"

namespace strataflow {
namespace {

using sample::Dual;
using sample::dual_of;
using sample::expect_conforming;
using sample::Patches;

TEST(DualPolygons, two_close_spheres_stay_two_spheres_of_100_points) {
  const StructuralModel model = Patches()
                                    .add("in", Role::horizon, sample::sphere(3, 1))
                                    .add("out", Role::horizon, sample::sphere(3, 1.04))
                                    .model();
  const CvtDomain domain{model.points, model.triangles, {}, {}};
  const auto sites =
      optimise_sites(domain, sample_sites(model.points, model.triangles, {}, 100, 3), {}, {.iterations = 30}).sites;
  const Dual dual = dual_of(model, sites);
  EXPECT_EQ(dual.components.surfaces.size(), 200u);
  EXPECT_EQ(dual.points.points.size(), 200u);
  for (const std::uint32_t surface : {0u, 1u})
    EXPECT_EQ(std::count(dual.mesh.triangle_surface.begin(), dual.mesh.triangle_surface.end(), surface), 196);
  expect_conforming(model, dual.mesh);
  EXPECT_TRUE(dual.mesh.flaws.empty());
}

TEST(DualPolygons, three_sites_between_two_sheets_give_two_triangles) {
  const auto sheet = [](double z) { return sample::rectangle({-1, -1, z}, {2, 0, 0}, {0, 2, 0}, 3, 3); };
  const Dual dual = dual_of(Patches().add("H1", Role::horizon, sheet(0)).add("H2", Role::horizon, sheet(0.1)).model(),
                            {{0.5, 0, 0.05}, {-0.3, 0.5, 0.05}, {-0.3, -0.5, 0.05}});
  ASSERT_EQ(dual.mesh.triangles.size(), 2u);
  EXPECT_NE(dual.mesh.triangle_surface[0], dual.mesh.triangle_surface[1]);
}

TEST(DualPolygons, triangles_face_as_their_surface_does) {
  const StructuralModel model = Patches().add("S", Role::horizon, sample::wavy_sheet(12)).model();
  const CvtDomain domain{model.points, model.triangles, {}, {}};
  const auto sites =
      optimise_sites(domain, sample_sites(model.points, model.triangles, {}, 80, 2), {}, {.iterations = 20}).sites;
  const Dual dual = dual_of(model, sites);
  const auto at = [&](std::uint32_t p) { return dual.mesh.points[p].position; };
  EXPECT_GT(dual.mesh.triangles.size(), 100u);
  for (const auto& [a, b, c] : dual.mesh.triangles) EXPECT_GT(cross(at(b) - at(a), at(c) - at(a)).z, -1e-12);
}

TEST(DualPolygons, a_star_whose_cells_cross_the_border_twice_is_meshed_as_a_disc) {
  const StructuralModel model = Patches().add("S", Role::horizon, sample::star(7, 0.3)).model();
  std::vector<Vec3> sites{{0.01, 0.02, 0}};
  for (int k = 0; k < 7; ++k)
    for (const double r : {0.35, 0.6, 0.85})
      if (sites.size() < 21) sites.push_back({r * std::cos(0.8975979 * k), r * std::sin(0.8975979 * k), 0});
  const Dual dual = dual_of(model, sites);
  expect_conforming(model, dual.mesh);
  EXPECT_EQ(sample::euler_of(dual.mesh), 1);
  EXPECT_GT(dual.points.points.size(), sites.size()) << "cells that cross the border twice own two points";
}

TEST(DualPolygons, random_stars_are_meshed_as_discs_merged_or_not) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const StructuralModel model = Patches().add("S", Role::horizon, sample::random_star(seed)).model();
    const auto sites = sample::random_sites(6 + seed % 35, seed, {-1, -1, 0}, {1, 1, 0});
    for (const MergeOptions& options : {MergeOptions{}, sample::no_merging()}) {
      const Dual dual = dual_of(model, sites, options);
      expect_conforming(model, dual.mesh);
      EXPECT_EQ(sample::euler_of(dual.mesh), 1) << seed;
    }
  }
}

TEST(DualPolygons, contacts_conform_whatever_the_sites) {
  const StructuralModel model = sample::junction();
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const MergeOptions& options : {MergeOptions{}, sample::no_merging(), MergeOptions{.resolution_m = 0.1}})
      expect_conforming(model, dual_of(model, sample::sites_in_box(model, 4 + seed * 2, seed), options).mesh);
}

TEST(DualPolygons, reference_models_conform_whatever_the_sites) {
  for (const char* name : {"A1", "A4"}) {
    const StructuralModel model = sample::reference(name, 160);
    for (unsigned seed = 0; seed < 4; ++seed)
      for (const MergeOptions& options : {MergeOptions{}, sample::no_merging()})
        expect_conforming(model, dual_of(model, sample::sites_in_box(model, 50 + 150 * seed, seed), options).mesh);
  }
}

TEST(DualPolygons, cospherical_sites_are_no_special_case) {
  const StructuralModel model = sample::junction();
  std::vector<Vec3> sites;
  for (int i = 0; i <= 4; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 0; ++k) sites.push_back({0.25 * i, 0.25 * j, 0.25 * k});
  const Dual dual = dual_of(model, sites, sample::no_merging());
  expect_conforming(model, dual.mesh);
  for (std::size_t c = 0; c < model.corners.size(); ++c) EXPECT_NE(dual.mesh.corner_point[c], no_index);
}

TEST(DualPolygons, a_contact_that_ends_inside_a_surface_within_one_cell_stays_a_contact) {
  const StructuralModel model =
      Patches()
          .add("H", Role::horizon, sample::rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8, 8))
          .add("F", Role::fault, sample::rectangle({0.5, 0.5, 0}, {0.25, 0, 0}, {0, 0, 0.5}, 2, 4))
          .model();
  const Dual dual = dual_of(model,
                            {{0.6, 0.52, 0},
                             {0.1, 0.1, 0},
                             {0.9, 0.1, 0},
                             {0.5, 0.9, 0},
                             {0.5, 0.1, 0},
                             {0.2, 0.6, 0},
                             {0.9, 0.7, 0},
                             {0.6, 0.5, 0.4}},
                            sample::no_merging());
  expect_conforming(model, dual.mesh);
  std::size_t contact = 0;
  while (model.lines[contact].surfaces.size() != 3) ++contact;
  ASSERT_EQ(dual.mesh.line_points[contact].size(), 2u);
  const std::uint32_t a = dual.mesh.line_points[contact][0], b = dual.mesh.line_points[contact][1];
  std::array<int, 2> uses{};
  for (std::size_t t = 0; t < dual.mesh.triangles.size(); ++t) {
    const Triangle& corners = dual.mesh.triangles[t];
    if (std::count(corners.begin(), corners.end(), a) + std::count(corners.begin(), corners.end(), b) == 2)
      ++uses[dual.mesh.triangle_surface[t]];
  }
  EXPECT_EQ(uses, (std::array<int, 2>{2, 1}));
}

TEST(DualPolygons, a_closed_chain_is_told) {
  const Dual dual = dual_of(Patches().add("S", Role::horizon, sample::flat_sheet(6)).model(),
                            {{0.5, 0.5, 0.1}, {0.5, 0.5, -0.101}, {0.5, 0.5, 9}});
  EXPECT_TRUE(dual.mesh.triangles.empty());
  const Dual bulge = dual_of(Patches().add("S", Role::horizon, sample::sphere(3)).model(), {{0, 0, 2}, {0, 0, -2.1}});
  ASSERT_FALSE(bulge.mesh.flaws.empty());
  EXPECT_EQ(bulge.mesh.flaws[0].kind, DualFlawKind::closed_chain);
}

TEST(DualPolygons, are_the_same_under_every_schedule) {
  const StructuralModel model = sample::reference("A4", 100);
  const auto sites = sample::sites_in_box(model, 400, 9);
  const auto made = [&](ScheduleKind kind) {
    const ScheduleScope scope(kind, 77);
    const Dual dual = dual_of(model, sites, {.resolution_m = 20});
    std::vector<Vec3> positions;
    for (const DualPoint& p : dual.points.points) positions.push_back(p.position);
    return std::tuple(dual.mesh.triangles, dual.mesh.triangle_surface, dual.mesh.line_points, positions);
  };
  const auto serial = made(ScheduleKind::serial);
  EXPECT_EQ(made(ScheduleKind::threads), serial);
  EXPECT_EQ(made(ScheduleKind::shuffled), serial);
}

}  // namespace
}  // namespace strataflow
