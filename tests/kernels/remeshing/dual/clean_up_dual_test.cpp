#include "kernels/remeshing/dual/clean_up_dual.h"

#include "kernels/remeshing/dual/dual_samples.h"

namespace strataflow {
namespace {

using sample::Dual;
using sample::dual_of;
using sample::expect_conforming;
using sample::Patches;

/// Three sites in a triangle round the middle of the unit square, others round them.
std::vector<Vec3> ring_of_sites() {
  std::vector<Vec3> sites;
  for (int k = 0; k < 3; ++k)
    sites.push_back({0.5 + 0.2 * std::cos(2.0943951 * k), 0.5 + 0.2 * std::sin(2.0943951 * k), 0});
  for (int k = 0; k < 8; ++k)
    sites.push_back({0.5 + 0.45 * std::cos(0.785398 * k), 0.5 + 0.45 * std::sin(0.785398 * k), 0});
  return sites;
}

TEST(CleanUpDual, a_tiny_component_inside_a_surface_is_replaced_by_one_triangle) {
  auto sites = ring_of_sites();
  sites.push_back({0.5, 0.5, 0.19});  // reaches the sheet in a small triangle only
  Dual dual = dual_of(Patches().add("H", Role::horizon, sample::flat_sheet(6)).model(), sites);
  const std::size_t before = dual.mesh.triangles.size();
  const CleanUpReport report = clean_up_dual(dual.model, dual.mesh);
  ASSERT_EQ(report.done.size(), 1u);
  EXPECT_EQ(report.done[0].kind, CleanUpKind::valence_3);
  EXPECT_EQ(report.done[0].site, sites.size() - 1);
  EXPECT_EQ(dual.mesh.triangles.size(), before - 2);
  expect_conforming(dual.model, dual.mesh);
  EXPECT_EQ(sample::euler_of(dual.mesh), 1);
}

TEST(CleanUpDual, a_flat_triangle_on_a_free_border_is_dropped) {
  auto sites = std::vector<Vec3>{{0.3, 0.1, 0}, {0.7, 0.1, 0}, {0.5, 0, std::sqrt(0.045)},
                                 {0.5, 0.6, 0}, {0.1, 0.6, 0}, {0.9, 0.6, 0}};
  Dual dual = dual_of(Patches().add("H", Role::horizon, sample::flat_sheet(6)).model(), sites);
  const std::size_t before = dual.mesh.triangles.size();
  const CleanUpReport report = clean_up_dual(dual.model, dual.mesh);
  ASSERT_EQ(report.done.size(), 1u);
  EXPECT_EQ(report.done[0].kind, CleanUpKind::free_border);
  EXPECT_EQ(report.done[0].site, 2u);
  EXPECT_EQ(dual.mesh.triangles.size(), before - 1);
  expect_conforming(dual.model, dual.mesh);
  EXPECT_EQ(sample::euler_of(dual.mesh), 1);
}

/// Three sheets along the x axis; cells on both sides of one whose part of the first sheet is tiny.
Dual tiny_on_contact() {
  const Vec3 x{1, 0, 0};
  Patches patches;
  patches.add("H", Role::horizon, sample::rectangle({0, 0, 0}, x, {0, 1, 0}, 6, 6));
  patches.add("G", Role::horizon, sample::rectangle({0, 0, 0}, x, {0, -1, 0}, 6, 6));
  patches.add("F", Role::fault, sample::rectangle({0, 0, 0}, x, {0, 0, -1}, 6, 6));
  const std::vector<Vec3> sites{{0.3, 0.1, 0},  {0.7, 0.1, 0},   {0.5, -0.2, 0},    {0.5, -0.7, 0}, {0.1, -0.5, 0},
                                {0.9, -0.5, 0}, {0.5, 0.6, 0},   {0.1, 0.5, 0},     {0.9, 0.5, 0},  {0.2, 0, -0.5},
                                {0.8, 0, -0.5}, {0.02, 0, 0.02}, {0.98, 0.01, 0.02}};
  return dual_of(patches.model(), sites);
}

std::size_t contact_of(const StructuralModel& model) {
  std::size_t line = 0;
  while (model.lines[line].surfaces.size() != 3) ++line;
  return line;
}

TEST(CleanUpDual, a_flat_triangle_on_a_contact_is_collapsed_in_all_surfaces_there) {
  Dual dual = tiny_on_contact();
  const CleanUpReport report = clean_up_dual(dual.model, dual.mesh);
  ASSERT_FALSE(report.done.empty());
  EXPECT_EQ(report.done[0].kind, CleanUpKind::contact);
  EXPECT_TRUE(report.refused.empty());
  expect_conforming(dual.model, dual.mesh);
  // No triangle is left with three points of the contact in a row (rule S3).
  for (const Triangle& t : dual.mesh.triangles)
    for (const auto& along : {dual.mesh.line_points[contact_of(dual.model)]})
      for (std::size_t i = 2; i < along.size(); ++i)
        for (int k = 0; k < 3; ++k)
          EXPECT_FALSE(t[k] == along[i - 1] && ((t[(k + 1) % 3] == along[i] && t[(k + 2) % 3] == along[i - 2]) ||
                                                (t[(k + 2) % 3] == along[i] && t[(k + 1) % 3] == along[i - 2])));
}

TEST(CleanUpDual, corners_stay_and_contacts_conform_whatever_the_sites) {
  for (const char* name : {"A1", "A4"}) {
    const StructuralModel model = sample::reference(name, 160);
    for (unsigned seed = 0; seed < 4; ++seed) {
      Dual dual = dual_of(model, sample::sites_in_box(model, 60 + 100 * seed, seed), sample::no_merging());
      const auto positions_before = dual.mesh.points;
      const CleanUpReport report = clean_up_dual(model, dual.mesh);
      EXPECT_GT(report.done.size(), 0u);
      expect_conforming(model, dual.mesh);
      for (const std::uint32_t corner : dual.mesh.corner_point)
        EXPECT_EQ(dual.mesh.points[corner].position, positions_before[corner].position);
    }
  }
}

TEST(CleanUpDual, a_flat_triangle_at_a_corner_is_flipped_and_the_corner_stays) {
  // The corner (0.5, 0, 0) of a sheet that ends on another's border lies between two cells' points on a straight line.
  Patches patches;
  patches.add("H", Role::horizon, sample::rectangle({0, 0, 0}, {0.5, 0, 0}, {0, -1, 0}, 4, 8));
  patches.add("G", Role::horizon, sample::rectangle({0.5, 0, 0}, {0.5, 0, 0}, {0, -1, 0}, 4, 8));
  patches.add("K", Role::horizon, sample::rectangle({0, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, 4, 8));
  patches.add("K", Role::horizon, sample::rectangle({0.5, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, 4, 8));
  TriangleSoup soup = patches.soup();
  for (std::uint32_t& patch : soup.triangle_patch) patch = std::min(patch, 2u);  // K is one patch
  const std::vector<Vec3> sites{{0.3, 0.1, 0},  {0.7, 0.1, 0}, {0.5, -0.2, 0}, {0.5, -0.7, 0}, {0.1, -0.5, 0},
                                {0.9, -0.5, 0}, {0.5, 0.6, 0}, {0.1, 0.5, 0},  {0.9, 0.5, 0}};
  Dual dual = dual_of(build_structural_model(soup)->model, sites);
  const CleanUpReport report = clean_up_dual(dual.model, dual.mesh);
  ASSERT_EQ(std::count_if(report.done.begin(), report.done.end(),
                          [](const CleanUp& c) { return c.kind == CleanUpKind::flip; }),
            1);
  EXPECT_TRUE(report.refused.empty());
  expect_conforming(dual.model, dual.mesh);
  for (std::size_t c = 0; c < dual.model.corners.size(); ++c) {
    const Vec3& corner = dual.model.points[dual.model.corners[c].vertex];
    if (length(corner - Vec3{0.5, 0, 0}) > 0) continue;
    EXPECT_EQ(dual.mesh.points[dual.mesh.corner_point[c]].position, corner);
  }
  for (const auto& [a, b, c] : dual.mesh.triangles) {
    const auto at = [&](std::uint32_t p) { return dual.mesh.points[p].position; };
    EXPECT_GT(std::abs(cross(at(b) - at(a), at(c) - at(a)).z), 1e-6);
  }
}

TEST(CleanUpDual, ends_where_each_of_two_flips_takes_the_other_back) {
  // A trapezoid between four corners of the model: at both ends of its short side the border hardly bends, and either
  // diagonal leaves a triangle with one of them in its middle.
  DualMesh mesh;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{10, 0, 0}, Vec3{7, 0.5, 0}, Vec3{3, 0.5, 0}})
    mesh.points.push_back({p, static_cast<std::uint32_t>(mesh.points.size()), PointKind::corner, 0});
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
  mesh.triangle_surface = {0, 0};
  mesh.corner_point = {0, 1, 2, 3};
  mesh.line_points = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const CleanUpReport report = clean_up_dual(StructuralModel{}, mesh);
  EXPECT_EQ(report.done.size(), 8u);
  for (const CleanUp& done : report.done) EXPECT_EQ(done.kind, CleanUpKind::flip);
  EXPECT_EQ(report.refused.size(), 1u);
  double area = 0;
  for (const auto& [x, y, z] : mesh.triangles)
    area +=
        0.5 *
        cross(mesh.points[y].position - mesh.points[x].position, mesh.points[z].position - mesh.points[x].position).z;
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(area, 3.5);
}

TEST(CleanUpDual, a_second_time_changes_nothing) {
  Dual dual = tiny_on_contact();
  clean_up_dual(dual.model, dual.mesh);
  const auto triangles = dual.mesh.triangles;
  EXPECT_TRUE(clean_up_dual(dual.model, dual.mesh).done.empty());
  EXPECT_EQ(dual.mesh.triangles, triangles);
}

}  // namespace
}  // namespace strataflow
