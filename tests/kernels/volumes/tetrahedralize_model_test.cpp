#include "kernels/volumes/tetrahedralize_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/archive.h"
#include "base/digest.h"
#include "kernels/volumes/filled_model.h"
#include "support/schedules.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using support::expect_model_points_kept;
using support::expect_valid;
using support::model_of;
using support::tet_worker;
using support::tetrahedralized;
using testing::HasSubstr;

double volume_of_cell(const VolumeMesh& mesh, std::uint32_t cell) {
  const std::uint32_t* v = &mesh.cell_vertices[mesh.cell_offsets[cell]];
  const Vec3& a = mesh.points[v[0]];
  return dot(cross(mesh.points[v[1]] - a, mesh.points[v[2]] - a), mesh.points[v[3]] - a) / 6;
}

TEST(TetrahedralizeModel, fills_a_box_that_keeps_its_eight_corners_and_twelve_triangles) {
  const StructuralModel model = model_of(support::box());
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_valid(*mesh, model);
  expect_model_points_kept(*mesh, model);
  EXPECT_EQ(mesh->facets.size(), 12u);
  for (const MeshFacet& facet : mesh->facets) EXPECT_EQ(facet.cell_1, no_index);
}

TEST(TetrahedralizeModel, layers_share_the_triangles_and_points_of_their_horizon) {
  const StructuralModel model = model_of(support::layered_box({0, 1, 1.5, 4}));
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_valid(*mesh, model);
  std::size_t between = 0;
  for (const MeshFacet& facet : mesh->facets) {
    if (facet.cell_1 == no_index) continue;
    ++between;
    EXPECT_NE(mesh->cell_region[facet.cell_0], mesh->cell_region[facet.cell_1]);
  }
  EXPECT_EQ(between, 4u);
}

TEST(TetrahedralizeModel, facets_turn_counter_clockwise_about_the_normal_that_leaves_cell_0) {
  const StructuralModel model = model_of(support::layered_box({0, 1, 2}));
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  for (const MeshFacet& facet : mesh->facets) {
    const auto& p = mesh->points;
    const Vec3 a = p[facet.vertices[0]];
    const Vec3 normal = cross(p[facet.vertices[1]] - a, p[facet.vertices[2]] - a);
    Vec3 middle;
    for (std::size_t k = 0; k < 4; ++k)
      middle = middle + 0.25 * p[mesh->cell_vertices[mesh->cell_offsets[facet.cell_0] + k]];
    EXPECT_LT(dot(normal, middle - a), 0);
  }
}

TEST(TetrahedralizeModel, a_box_inside_a_box_gives_a_shell_with_a_filled_cavity) {
  const StructuralModel model = model_of(support::nested_boxes());
  ASSERT_EQ(model.regions.size(), 2u);
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_valid(*mesh, model);
}

TEST(TetrahedralizeModel, a_cavity_that_belongs_to_no_region_stays_empty) {
  StructuralModel model = model_of(support::nested_boxes());
  const std::uint32_t inner = model.regions[0].volume_m3 < model.regions[1].volume_m3 ? 0 : 1;
  for (Surface& surface : model.surfaces)
    for (std::uint32_t* side : {&surface.region_minus, &surface.region_plus})
      *side = *side == inner ? universe : *side == universe ? universe : 0;
  model.regions.erase(model.regions.begin() + inner);
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_NEAR(analyze_volume_mesh(*mesh).volume_m3, 26.0, 1e-12);
}

TEST(TetrahedralizeModel, a_floating_fault_becomes_faces_between_cells_of_one_region) {
  const StructuralModel model = model_of(support::box_with_floating_fault());
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_valid(*mesh, model);
  std::size_t on_fault = 0;
  for (const MeshFacet& facet : mesh->facets)
    if (facet.cell_1 != no_index) ++on_fault;
  EXPECT_EQ(on_fault, 2u);
}

TEST(TetrahedralizeModel, a_fault_that_hangs_outside_the_model_is_left_out_and_named) {
  TriangleSoup soup = support::box();
  support::add_quad(soup, support::add_patch(soup, "stray", Role::fault), {1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1});
  const StructuralModel model = model_of(soup);
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_EQ(mesh->facets.size(), 12u);
  ASSERT_EQ(mesh->changes.size(), 1u);
  EXPECT_EQ(mesh->changes[0].kind, "skipped_surface");
  EXPECT_THAT(mesh->changes[0].what, HasSubstr("stray"));
}

TEST(TetrahedralizeModel, far_from_the_origin_the_same_tetrahedra_come_out) {
  const Result<VolumeMesh> near = tetrahedralized(model_of(support::layered_box({0, 1, 3})));
  TriangleSoup soup = support::layered_box({0, 1, 3});
  for (Vec3& p : soup.points) p = p + Vec3{524288, 4194304, -1024};
  const StructuralModel model = model_of(soup);
  const Result<VolumeMesh> far = tetrahedralized(model);
  ASSERT_TRUE(near && far);
  expect_valid(*far, model);
  EXPECT_EQ(far->cell_count(), near->cell_count());
}

TEST(TetrahedralizeModel, a_size_bound_refines_the_inside_and_keeps_every_surface_triangle) {
  const StructuralModel model = model_of(support::layered_box({0, 1, 2}));
  TetrahedralizeOptions options;
  options.radius_edge_ratio = 2.0;
  options.max_volume_m3 = 0.01;
  const Result<VolumeMesh> mesh = tetrahedralized(model, options);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_valid(*mesh, model);
  EXPECT_EQ(mesh->facets.size(), model.triangles.size());
  for (std::uint32_t c = 0; c < mesh->cell_count(); ++c) EXPECT_LE(volume_of_cell(*mesh, c), 0.01);
  expect_model_points_kept(*mesh, model);
}

TEST(TetrahedralizeModel, a_region_of_its_own_size_is_refined_alone) {
  StructuralModel model = model_of(support::layered_box({0, 1, 2}));
  model.regions[0].name = "reservoir";
  model.regions[1].name = "seal";
  TetrahedralizeOptions options;
  options.region_max_volume_m3 = {{"reservoir", 0.01}};
  const Result<VolumeMesh> mesh = tetrahedralized(model, options);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_valid(*mesh, model);
  for (std::uint32_t c = 0; c < mesh->cell_count(); ++c) {
    if (mesh->cell_region[c] == 0) {
      EXPECT_LE(volume_of_cell(*mesh, c), 0.01);
    }
  }
  EXPECT_LT(std::count(mesh->cell_region.begin(), mesh->cell_region.end(), 1), 20);
}

TEST(TetrahedralizeModel, a_ratio_bound_improves_the_inside_of_a_flat_box_without_touching_its_surfaces) {
  const StructuralModel model = model_of(support::box({0, 0, 0}, {8, 1, 1}));
  TetrahedralizeOptions options;
  options.max_volume_m3 = 0.02;
  const Result<VolumeMesh> plain = tetrahedralized(model, options);
  options.radius_edge_ratio = 1.4;
  const Result<VolumeMesh> good = tetrahedralized(model, options);
  ASSERT_TRUE(plain && good);
  expect_valid(*good, model);
  EXPECT_GT(good->cell_count(), plain->cell_count());
  EXPECT_EQ(good->facets.size(), 12u);
}

TEST(TetrahedralizeModel, aims_at_a_dihedral_angle) {
  const StructuralModel model = model_of(support::nested_boxes());
  TetrahedralizeOptions options;
  options.min_dihedral_deg = 10;
  const Result<VolumeMesh> mesh = tetrahedralized(model, options);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  expect_valid(*mesh, model);
}

TEST(TetrahedralizeModel, is_the_same_on_every_schedule) {
  const StructuralModel model = model_of(support::layered_box({0, 1, 1.5, 2, 5, 6}));
  std::set<std::string> digests;
  support::on_every_schedule(
      [&](const char* schedule) {
        const Result<VolumeMesh> mesh = tetrahedralized(model);
        ASSERT_TRUE(mesh) << schedule;
        digests.insert(digest_of(archived(*mesh)).hex());
      },
      2);
  EXPECT_EQ(digests.size(), 1u);
}

TEST(TetrahedralizeModel, names_the_known_regions_when_a_size_is_for_none_of_them) {
  StructuralModel model = model_of(support::box());
  model.regions[0].name = "reservoir";
  TetrahedralizeOptions options;
  options.region_max_volume_m3 = {{"resevoir", 1.0}};
  const Result<VolumeMesh> mesh = tetrahedralized(model, options);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.failure().code, FailureCode::invalid_options);
  EXPECT_THAT(mesh.failure().what, HasSubstr("resevoir"));
  EXPECT_THAT(mesh.failure().remedy, HasSubstr("reservoir"));
}

TEST(TetrahedralizeModel, refuses_options_out_of_their_domain) {
  const StructuralModel model = model_of(support::box());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<TetrahedralizeOptions> bad(8);
  bad[0].radius_edge_ratio = 1.0;
  bad[1].radius_edge_ratio = nan;
  bad[2].min_dihedral_deg = 40;
  bad[3].max_volume_m3 = 0;
  bad[4].timeout_s = nan;
  bad[5].memory_limit_mb = 1;
  bad[6].split_surfaces = "sometimes";
  bad[7].max_volume_m3 = 1e-12;  // more cells than any machine holds
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const Result<VolumeMesh> mesh = tetrahedralized(model, bad[i]);
    ASSERT_FALSE(mesh) << i;
    EXPECT_EQ(mesh.failure().code, FailureCode::invalid_options) << i;
  }
}

TEST(TetrahedralizeModel, refuses_a_model_without_regions) {
  TriangleSoup soup;
  support::add_sheet(soup, support::add_patch(soup, "H1"), {0, 0, 0}, {1, 1, 1}, 0.5);
  const Result<VolumeMesh> mesh = tetrahedralized(model_of(soup));
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.failure().code, FailureCode::invalid_input);
}

TEST(TetrahedralizeModel, surfaces_that_cross_fail_and_name_the_region) {
  StructuralModel model = model_of(support::box());
  const auto first = static_cast<std::uint32_t>(model.points.size());
  for (const Vec3& p : {Vec3{0.25, 0.25, 0.5}, Vec3{0.75, 0.3, 0.5}, Vec3{0.5, 0.75, 0.5}, Vec3{0.5, 0.5, 0.25},
                        Vec3{0.55, 0.45, 0.8}, Vec3{2, 2, 0.6}})
    model.points.push_back(p);
  for (const std::uint32_t corner : {first, first + 3}) {
    model.triangles.push_back({corner, corner + 1, corner + 2});
    model.triangle_surface.push_back(static_cast<std::uint32_t>(model.surfaces.size()));
  }
  Surface& crossing = model.surfaces.emplace_back();
  crossing.region_minus = crossing.region_plus = 0;
  model.regions[0].name = "reservoir";
  const Result<VolumeMesh> mesh = tetrahedralized(model);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.failure().code, FailureCode::geometry_failed);
  EXPECT_THAT(mesh.failure().what, HasSubstr("reservoir"));
}

TEST(TetrahedralizeModel, stops_when_cancelled) {
  CancellationToken token;
  token.cancel();
  const Result<VolumeMesh> mesh = tetrahedralize_model(model_of(support::box()), {}, &token, tet_worker());
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.failure().code, FailureCode::cancelled);
}

}  // namespace
}  // namespace strataflow
