#include "kernels/hybrid/thin_zone.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/quality/match_cell_faces.h"
#include "plate.h"

namespace strataflow {
namespace {

std::vector<FacingPair> pairs_of(const support::Plate& plate) {
  FacingCounts counts;
  return find_facing_triangles(plate.model, plate.sites, counts);
}

std::uint64_t count_of(const ThinZone& zone, CellType type) {
  std::uint64_t count = 0;
  for (const ThinCell& cell : zone.cells) count += cell.type == type;
  return count;
}

VolumeMesh mesh_of(const support::Plate& plate, const ThinZone& zone) {
  VolumeMesh mesh;
  mesh.points = plate.model.points;
  mesh.points.insert(mesh.points.end(), zone.points.begin(), zone.points.end());
  for (const ThinCell& cell : zone.cells) mesh.add_cell(cell.type, cell.vertices.data(), 0);
  return mesh;
}

void expect_sound(const support::Plate& plate, const ThinZone& zone) {
  const VolumeMesh mesh = mesh_of(plate, zone);
  EXPECT_EQ(match_cell_faces(mesh).nonconforming_faces, 0u);
  for (const ThinCell& cell : zone.cells) EXPECT_EQ(state_of(cell, mesh.points), ThinCellState::sound);
}

TEST(BuildThinZone, fills_a_plate_with_prisms_alone) {  // X11
  const support::Plate plate = support::plate(3, [](double, double) { return 0.2; });
  const ThinZone zone = build_thin_zone(plate.model, 0, pairs_of(plate), 1);
  expect_sound(plate, zone);
  EXPECT_EQ(zone.cells.size(), 18u);
  EXPECT_EQ(count_of(zone, CellType::prism), 18u);
  EXPECT_EQ(zone.wall_quads.size(), 12u);  // the walls are plane: two triangles each make a quadrilateral
  EXPECT_TRUE(zone.envelope.empty());
  EXPECT_TRUE(zone.points.empty());
  EXPECT_NEAR(zone.volume_m3, 9 * 0.2, 1e-12);
}

TEST(BuildThinZone, a_wedge_closes_with_pyramids_and_tetrahedra) {  // X11
  const support::Plate plate = support::plate(3, [](double x, double) { return 0.3 * (3 - x); });
  const ThinZone zone = build_thin_zone(plate.model, 0, pairs_of(plate), 1);
  expect_sound(plate, zone);
  EXPECT_EQ(count_of(zone, CellType::prism), 12u);
  EXPECT_EQ(count_of(zone, CellType::pyramid), 3u);      // one point on the closing line
  EXPECT_EQ(count_of(zone, CellType::tetrahedron), 3u);  // two
  EXPECT_TRUE(zone.envelope.empty());
  EXPECT_NEAR(zone.volume_m3, 0.5 * 3 * 0.9 * 3, 1e-12);
}

TEST(BuildThinZone, layers_end_one_cell_before_the_walls) {
  const support::Plate plate = support::plate(6, [](double, double) { return 0.3; });
  const ThinZone zone = build_thin_zone(plate.model, 0, pairs_of(plate), 3);
  expect_sound(plate, zone);
  EXPECT_TRUE(zone.envelope.empty());
  EXPECT_NEAR(zone.volume_m3, 36 * 0.3, 1e-12);
  EXPECT_EQ(zone.layer_points, 2u * 25);                // two on each link that is on no wall
  EXPECT_GE(count_of(zone, CellType::prism), 3u * 32);  // 4 × 4 squares lie inside
}

TEST(BuildThinZone, what_lies_open_gets_pyramids_and_an_envelope_of_triangles) {
  support::Plate plate = support::plate(5, [](double, double) { return 0.3; });
  for (std::size_t p = 0; p < plate.sites.size(); ++p)
    if (plate.model.points[p].x > 3.5 && plate.model.points[p].z == 0) plate.sites[p] += 1000;
  const ThinZone zone = build_thin_zone(plate.model, 0, pairs_of(plate), 1);
  expect_sound(plate, zone);
  EXPECT_EQ(count_of(zone, CellType::prism), 30u);
  EXPECT_EQ(zone.apex_points, 5u);
  EXPECT_EQ(count_of(zone, CellType::pyramid), 5u);
  EXPECT_EQ(zone.envelope.size(), 4u * 5);
}

TEST(BuildThinZone, without_room_for_pyramids_prisms_pass_to_triangles_themselves) {  // X12's split, X13's place
  // A wall inside the region, just beyond the open sides: pyramids would pierce it.
  TriangleSoup soup;
  const support::Plate plain = support::plate(5, [](double, double) { return 0.3; });
  soup.points = plain.model.points;
  soup.triangles = plain.model.triangles;
  soup.triangle_patch.assign(soup.triangles.size(), 0);
  soup.entities = {{"plate", Role::boundary}, {"curtain", Role::fault}};
  soup.patch_entity = {0, 1};
  support::add_quad(soup, 1, {3.02, 0.1, 0.05}, {3.02, 4.9, 0.05}, {3.02, 4.9, 0.25}, {3.02, 0.1, 0.25});
  support::Plate plate{build_structural_model(soup)->model, {}};
  for (const Vec3& p : plate.model.points) {
    const bool is_grid = p.x != 3.02;
    plate.sites.push_back(is_grid ? static_cast<std::uint32_t>(p.x * 6 + p.y + (p.x > 3.5 && p.z == 0 ? 1000 : 0))
                                  : no_index);
  }
  const ThinZone zone = build_thin_zone(plate.model, 0, pairs_of(plate), 1);
  expect_sound(plate, zone);
  EXPECT_EQ(zone.apex_points, 0u);
  EXPECT_EQ(zone.envelope.size(), 2u * 5);  // each open side as two triangles
  EXPECT_EQ(count_of(zone, CellType::prism), 25u);
  EXPECT_EQ(zone.centre_points, 5u);
  EXPECT_NEAR(zone.volume_m3, 15 * 0.3, 1e-12);
}

TEST(BuildThinZone, drops_what_a_surface_crosses) {
  TriangleSoup soup;
  const support::Plate plain = support::plate(5, [](double, double) { return 0.3; });
  soup.points = plain.model.points;
  soup.triangles = plain.model.triangles;
  soup.triangle_patch.assign(soup.triangles.size(), 0);
  soup.entities = {{"plate", Role::boundary}, {"curtain", Role::fault}};
  soup.patch_entity = {0, 1};
  // It passes through the open sides of the squares at x = 3.
  support::add_quad(soup, 1, {2.5, 2.5, 0.1}, {3.5, 2.5, 0.1}, {3.5, 2.5, 0.2}, {2.5, 2.5, 0.2});
  support::Plate plate{build_structural_model(soup)->model, {}};
  for (const Vec3& p : plate.model.points)
    plate.sites.push_back(p.y == 2.5 ? no_index
                                     : static_cast<std::uint32_t>(p.x * 6 + p.y + (p.x > 3.5 && p.z == 0 ? 1000 : 0)));
  const ThinZone zone = build_thin_zone(plate.model, 0, pairs_of(plate), 1);
  expect_sound(plate, zone);
  EXPECT_GT(zone.dropped.crossing, 0u);
  EXPECT_LT(count_of(zone, CellType::prism), 29u);
  EXPECT_GT(count_of(zone, CellType::prism), 20u);
}

TEST(BuildThinZone, a_fault_that_ends_inside_stays_between_the_cells) {
  TriangleSoup soup;
  const support::Plate plain = support::plate(5, [](double, double) { return 0.3; });
  soup.points = plain.model.points;
  soup.triangles = plain.model.triangles;
  soup.triangle_patch.assign(soup.triangles.size(), 0);
  soup.entities = {{"plate", Role::boundary}, {"F", Role::fault}};
  soup.patch_entity = {0, 1};
  // From below to above along the sides at x = 2, between y = 1 and 3; the second half of the last side is missing.
  support::add_quad(soup, 1, {2, 1, 0}, {2, 2, 0}, {2, 2, 0.3}, {2, 1, 0.3});
  support::add_triangle(soup, 1, {2, 2, 0}, {2, 3, 0}, {2, 2, 0.3});
  support::Plate plate{build_structural_model(soup)->model, {}};
  for (const Vec3& p : plate.model.points) plate.sites.push_back(static_cast<std::uint32_t>(p.x * 6 + p.y));
  for (const std::uint32_t layers : {1u, 3u}) {
    const ThinZone zone = build_thin_zone(plate.model, 0, pairs_of(plate), layers);
    expect_sound(plate, zone);
    EXPECT_TRUE(zone.envelope.empty());
    EXPECT_NEAR(zone.volume_m3, 25 * 0.3, 1e-12);
    std::vector<int> sides(plate.model.triangles.size(), 0);
    for (const CoveredSide& side : zone.covered) ++sides[side.triangle];
    for (const Surface& surface : plate.model.surfaces)
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t)
        EXPECT_EQ(sides[t], surface.is_dangling() ? 2 : 1) << t;
  }
}

}  // namespace
}  // namespace strataflow
