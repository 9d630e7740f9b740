#include "kernels/hybrid/fill_hybrid.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <tuple>

#include "base/archive.h"
#include "kernels/quality/analyze_volume_mesh.h"
#include "kernels/quality/check_mesh_against_model.h"
#include "plate.h"
#include "remeshed_model.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::remeshed;
using support::tet_worker;

Result<HybridMesh> filled(const StructuralModel& model, const std::vector<std::uint32_t>& sites,
                          const FillHybridOptions& options = {}) {
  return fill_hybrid(model, sites, options, nullptr, tet_worker());
}

/// Rules H1 to H5 and H7 by kernels that share no code with the mesher.
void expect_valid(const HybridMesh& hybrid, const StructuralModel& model) {
  const VolumeQualityReport quality = analyze_volume_mesh(hybrid.mesh);
  EXPECT_EQ(quality.inverted, 0u);
  EXPECT_EQ(quality.nonconforming_faces, 0u);
  EXPECT_EQ(quality.open_boundary_edges, 0u);
  EXPECT_EQ(quality.hexahedra, 0u);  // H1
  for (const Violation& violation : check_mesh_against_model(hybrid.mesh, model))
    ADD_FAILURE() << violation.kind << ": " << violation.what;
  const HybridReport& report = hybrid.report;
  EXPECT_EQ(report.cells_from_voronoi() + report.cells_from_fill, quality.cells);
  EXPECT_EQ(report.surface_points + report.layer_points + report.centre_points + report.apex_points +
                report.interior_sites + report.fill_points,
            quality.vertices);  // H8: every vertex has its cause
  std::uint64_t tetrahedra = 0, pyramids = 0, prisms = 0;
  for (const HybridRegion& region : report.regions) {
    tetrahedra += region.tetrahedra;
    pyramids += region.pyramids;
    prisms += region.prisms;
  }
  EXPECT_EQ(tetrahedra, quality.tetrahedra);
  EXPECT_EQ(pyramids, quality.pyramids);
  EXPECT_EQ(prisms, quality.prisms);
}

TEST(FillHybrid, a_thin_plate_is_prisms_alone) {  // X11
  const support::Plate plate = support::plate(4, [](double, double) { return 0.2; });
  const Result<HybridMesh> hybrid = filled(plate.model, plate.sites);
  ASSERT_TRUE(hybrid) << hybrid.failure().what;
  expect_valid(*hybrid, plate.model);
  EXPECT_EQ(hybrid->report.regions[0].prisms, 32u);  // the triangles of one side
  EXPECT_EQ(hybrid->mesh.cell_count(), 32u);
  EXPECT_NEAR(hybrid->report.mean_anisotropy_ratio, (2 + std::sqrt(2.0)) / 3 / 0.2, 1e-9);
}

TEST(FillHybrid, a_wedge_closes_with_pyramids_then_tetrahedra) {  // X11
  const support::Plate plate = support::plate(3, [](double x, double) { return 0.3 * (3 - x); });
  for (const std::int64_t layers : {1, 2, 5}) {
    const Result<HybridMesh> hybrid = filled(plate.model, plate.sites, {.layers_through_thin = layers});
    ASSERT_TRUE(hybrid) << hybrid.failure().what;
    expect_valid(*hybrid, plate.model);
    EXPECT_GT(hybrid->report.regions[0].pyramids, 0u);
    EXPECT_GT(hybrid->report.regions[0].tetrahedra, 0u);
    EXPECT_EQ(hybrid->report.cells_from_fill, 0u);
  }
}

TEST(FillHybrid, what_has_no_common_sites_is_filled_with_tetrahedra) {
  support::Plate plate = support::plate(5, [](double, double) { return 0.3; });
  for (std::size_t p = 0; p < plate.sites.size(); ++p)
    if (plate.model.points[p].x > 3.5 && plate.model.points[p].z == 0) plate.sites[p] += 1000;
  for (const std::int64_t layers : {1, 3}) {
    const Result<HybridMesh> hybrid = filled(plate.model, plate.sites, {.layers_through_thin = layers});
    ASSERT_TRUE(hybrid) << hybrid.failure().what;
    expect_valid(*hybrid, plate.model);
    EXPECT_GT(hybrid->report.cells_from_fill, 0u);
    EXPECT_GT(hybrid->report.cells_from_segments, 30u);
  }
  plate.sites.assign(plate.sites.size(), no_index);
  const Result<HybridMesh> alone = filled(plate.model, plate.sites);
  ASSERT_TRUE(alone);
  expect_valid(*alone, plate.model);
  EXPECT_EQ(alone->report.cells_from_segments, 0u);
}

TEST(FillHybrid, layers_that_pinch_out_and_fold_stay_valid) {
  const support::Plate plate =
      support::plate(6, [](double x, double y) { return 0.1 + 0.06 * (x - 3) * (x - 3) + 0.02 * y * x; });
  for (const std::int64_t layers : {1, 4}) {
    const Result<HybridMesh> hybrid = filled(plate.model, plate.sites, {.layers_through_thin = layers});
    ASSERT_TRUE(hybrid) << hybrid.failure().what;
    expect_valid(*hybrid, plate.model);
  }
}

TEST(FillHybrid, prisms_grow_as_sites_fall) {  // X15, of a wedge
  double last = -1;
  for (const auto& [count, edge] : {std::pair{1300, 39.0}, std::pair{400, 70.0}, std::pair{150, 115.0}}) {
    const StructuralModel model = remeshed("wedge", count, edge);
    const Result<HybridMesh> hybrid = filled(model, sites_of_points(model));
    ASSERT_TRUE(hybrid) << hybrid.failure().what;
    expect_valid(*hybrid, model);
    double prisms = 0, all = 0;
    for (const HybridRegion& region : hybrid->report.regions) {
      prisms += region.prism_volume_m3;
      all += region.volume_m3;
    }
    EXPECT_GT(prisms / all, last);
    last = prisms / all;
  }
  EXPECT_GT(last, 0.6);
}

TEST(FillHybrid, shells_thinner_than_a_cell_are_prisms_alone_and_others_tetrahedra) {  // X15
  const StructuralModel model = remeshed("nested-spheres", 500, 25.5);
  const Result<HybridMesh> hybrid = filled(model, sites_of_points(model));
  ASSERT_TRUE(hybrid) << hybrid.failure().what;
  expect_valid(*hybrid, model);
  std::size_t only_prisms = 0, only_tetrahedra = 0;
  for (const HybridRegion& region : hybrid->report.regions) {
    only_prisms += region.tetrahedra == 0 && region.pyramids == 0;
    only_tetrahedra += region.prisms == 0 && region.pyramids == 0;
  }
  EXPECT_EQ(only_prisms, 1u);
  EXPECT_EQ(only_tetrahedra, 2u);
}

TEST(FillHybrid, smooth_surfaces_layers_and_angular_shapes_are_valid_and_say_what_was_no_cell) {  // X16, H7
  for (const auto& [name, count, edge] : {std::tuple{"smooth-closed", 400, 19.0},
                                          {"variable-layers", 300, 270.0},
                                          {"bracket", 300, 23.0},
                                          {"impeller", 300, 23.0}}) {
    const StructuralModel model = remeshed(name, static_cast<std::size_t>(count), edge);
    const Result<HybridMesh> hybrid = filled(model, sites_of_points(model));
    ASSERT_TRUE(hybrid) << name << ": " << hybrid.failure().what;
    expect_valid(*hybrid, model);
    const FacingCounts& facing = hybrid->report.facing;
    const DroppedPairs& dropped = hybrid->report.dropped;
    if (std::string_view(name) ==
        "smooth-closed") {  // about as many sites as the thesis has, on the surface and inside
      EXPECT_NEAR(static_cast<double>(hybrid->report.surface_points + hybrid->report.interior_sites), 1010, 101);
    }
    RecordProperty(std::string(name) + "_inverted_before_repair", static_cast<int>(facing.turned + facing.inverted));
    RecordProperty(std::string(name) + "_flat_before_repair", static_cast<int>(facing.flat));
    EXPECT_LE(dropped.isolated + dropped.inverted + dropped.nonconforming + dropped.crossing + dropped.unfilled,
              facing.pairs)
        << name;
    EXPECT_GE(hybrid->report.improvement.smallest_after, hybrid->report.improvement.smallest_before) << name;
  }
}

TEST(FillHybrid, no_flat_cells_stand_on_a_plane_fault) {  // traces on it have points with other triangles between
  const StructuralModel model = remeshed("A2", 150, 420);
  const Result<HybridMesh> hybrid = filled(model, sites_of_points(model));
  ASSERT_TRUE(hybrid) << hybrid.failure().what;
  expect_valid(*hybrid, model);
  EXPECT_GT(hybrid->report.improvement.exchanges, 0u);
  EXPECT_GT(analyze_volume_mesh(hybrid->mesh).min_scaled_jacobian, 1e-4);
}

TEST(FillHybrid, sites_inside_make_the_tetrahedra_duals_of_voronoi_vertices_and_better) {
  const StructuralModel model = remeshed("smooth-closed", 150, 31);
  const std::vector<std::uint32_t> none = sites_of_points(model);
  double last_mean = 0;
  for (const std::int64_t asked : {0, 20, 100}) {
    const Result<HybridMesh> hybrid = filled(model, none, {.interior_sites = asked});
    ASSERT_TRUE(hybrid) << hybrid.failure().what;
    expect_valid(*hybrid, model);
    const HybridReport& report = hybrid->report;
    EXPECT_EQ(report.interior_sites_asked, static_cast<std::uint64_t>(asked));
    EXPECT_EQ(report.interior_sites, report.interior_sites_asked);
    const double mean = analyze_volume_mesh(hybrid->mesh).mean_scaled_jacobian;
    EXPECT_GT(mean, last_mean);
    last_mean = mean;
    if (asked == 0) continue;
    EXPECT_GT(report.cells_from_vertices, 9 * report.cells_from_fill);
    EXPECT_EQ(report.vertex_duals.kept, report.vertex_duals.candidates);  // convex, and nothing thin
  }
  EXPECT_GT(last_mean, 0.6);
}

TEST(FillHybrid, shares_the_sites_inside_out_by_what_the_surfaces_ask_for) {
  const StructuralModel model = remeshed("nested-spheres", 500, 25.5);
  const Result<HybridMesh> wanted = filled(model, sites_of_points(model));
  const Result<HybridMesh> twice =
      filled(model, sites_of_points(model),
             {.interior_sites = 2 * static_cast<std::int64_t>(wanted->report.interior_sites_asked)});
  ASSERT_TRUE(twice) << twice.failure().what;
  expect_valid(*twice, model);
  EXPECT_EQ(twice->report.interior_sites_asked, 2 * wanted->report.interior_sites_asked);
  EXPECT_GT(twice->mesh.cell_count(), wanted->mesh.cell_count());
}

TEST(FillHybrid, keeps_the_sizes_asked_for_with_sites_inside) {
  const StructuralModel model = remeshed("smooth-closed", 150, 31);
  FillHybridOptions options;
  options.fill.max_volume_m3 = 2000;
  const Result<HybridMesh> hybrid = filled(model, sites_of_points(model), options);
  ASSERT_TRUE(hybrid) << hybrid.failure().what;
  expect_valid(*hybrid, model);
  EXPECT_GT(hybrid->report.interior_sites, 0u);
  EXPECT_GE(static_cast<double>(hybrid->mesh.cell_count()), hybrid->report.regions[0].volume_m3 / 2000);
}

TEST(FillHybrid, is_the_same_on_every_schedule) {
  for (const auto& [name, count, edge] : {std::tuple{"wedge", 150, 120.0}, {"smooth-closed", 60, 49.0}}) {
    const StructuralModel model = remeshed(name, static_cast<std::size_t>(count), edge);
    const std::vector<std::uint32_t> sites = sites_of_points(model);
    const Result<HybridMesh> wanted = filled(model, sites, {.layers_through_thin = 2});
    ASSERT_TRUE(wanted) << wanted.failure().what;
    expect_valid(*wanted, model);
    support::on_every_schedule(
        [&](const char* schedule) {
          EXPECT_EQ(archived(*filled(model, sites, {.layers_through_thin = 2})), archived(*wanted)) << schedule;
        },
        1);
  }
}

TEST(FillHybrid, refuses_no_layers_and_no_region) {
  const support::Plate plate = support::plate(1, [](double, double) { return 0.2; });
  EXPECT_EQ(filled(plate.model, plate.sites, {.layers_through_thin = 0}).failure().code, FailureCode::invalid_options);
  EXPECT_EQ(filled({}, {}).failure().code, FailureCode::invalid_input);
}

}  // namespace
}  // namespace strataflow
