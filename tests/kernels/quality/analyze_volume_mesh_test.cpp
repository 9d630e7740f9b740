#include "kernels/quality/analyze_volume_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "base/digest.h"
#include "graph/parallel/schedule.h"
#include "kernels/quality/small_meshes.h"

namespace strataflow {
namespace {

TEST(AnalyzeVolumeMesh, a_box_of_cubes_is_perfect) {
  VolumeMesh mesh = box_mesh(3, 2, 2, 1, false);
  mesh.region_names = {"lower", "upper"};
  const VolumeQualityReport report = analyze_volume_mesh(mesh);
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.hexahedra, 12u);
  EXPECT_EQ(report.tetrahedra, 0u);
  EXPECT_DOUBLE_EQ(report.volume_m3, 12);
  EXPECT_NEAR(report.min_dihedral_deg, 90, 1e-12);
  EXPECT_NEAR(report.max_dihedral_deg, 90, 1e-12);
  EXPECT_DOUBLE_EQ(report.min_scaled_jacobian, 1);
  EXPECT_DOUBLE_EQ(report.mean_scaled_jacobian, 1);
  ASSERT_EQ(report.per_region.size(), 2u);
  EXPECT_EQ(report.per_region[1].name, "upper");
  EXPECT_EQ(report.per_region[1].cells, 6u);
  EXPECT_DOUBLE_EQ(report.per_region[1].volume_m3, 6);
  EXPECT_EQ(report.coincident_boundary_vertices, 0u);
  for (const Distribution& d : report.distributions) {
    std::uint64_t in_bins = 0;
    for (const std::uint64_t n : d.bins) in_bins += n;
    EXPECT_EQ(in_bins, d.count) << d.name;
  }
}

TEST(AnalyzeVolumeMesh, kuhn_tetrahedra_fill_the_box_with_angles_of_45_to_90_degrees) {
  const VolumeQualityReport report = analyze_volume_mesh(box_mesh(4, 4, 4, 2, true));
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.tetrahedra, 384u);
  EXPECT_NEAR(report.volume_m3, 64, 1e-12);
  EXPECT_NEAR(report.min_dihedral_deg, 45, 1e-9);
  EXPECT_NEAR(report.max_dihedral_deg, 90, 1e-9);
  EXPECT_EQ(report.boundary_faces, 6u * 16 * 2);
}

TEST(AnalyzeVolumeMesh, turning_one_tetrahedron_inside_out_is_seen_as_inverted_and_nonconforming) {
  VolumeMesh mesh = box_mesh(3, 3, 3, 1, true);
  const std::uint32_t cell = 13 * 6;  // in the middle cube
  std::swap(mesh.cell_vertices[mesh.cell_offsets[cell]], mesh.cell_vertices[mesh.cell_offsets[cell] + 1]);
  const VolumeQualityReport report = analyze_volume_mesh(mesh);
  EXPECT_EQ(report.inverted, 1u);
  EXPECT_EQ(report.inverted_examples, std::vector<std::uint32_t>{cell});
  EXPECT_EQ(report.nonconforming_faces, 4u);
  EXPECT_FALSE(report.is_valid());
}

TEST(AnalyzeVolumeMesh, a_hanging_vertex_on_the_face_of_a_neighbour_is_nonconforming) {
  // One cube beside two half cubes: their common edge hangs in its face.
  VolumeMesh mesh;
  mesh.points = unit_cube_points();
  for (const Vec3& p : std::vector<Vec3>{
           {1, 0, 0.5}, {1, 1, 0.5}, {2, 0, 0}, {2, 1, 0}, {2, 0, 0.5}, {2, 1, 0.5}, {2, 0, 1}, {2, 1, 1}})
    mesh.points.push_back(p);
  add_cell(mesh, CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  add_cell(mesh, CellType::hexahedron, std::array<std::uint32_t, 8>{1, 10, 11, 2, 8, 12, 13, 9});
  add_cell(mesh, CellType::hexahedron, std::array<std::uint32_t, 8>{8, 12, 13, 9, 5, 14, 15, 6});
  const VolumeQualityReport report = analyze_volume_mesh(mesh);
  EXPECT_EQ(report.inverted, 0u);
  EXPECT_EQ(report.faces_with_hanging_vertex, 3u);  // the one between, and two whose edges carry its ends
  EXPECT_EQ(report.nonconforming_faces, 3u);
  EXPECT_FALSE(report.is_valid());
}

TEST(AnalyzeVolumeMesh, two_boxes_that_touch_without_being_welded_are_counted_as_a_seam) {
  VolumeMesh mesh = box_mesh(1, 1, 1, 1, false);
  const VolumeMesh other = box_mesh(1, 1, 1, 1, false);
  std::array<std::uint32_t, 8> shifted{};
  for (std::uint32_t i = 0; i < 8; ++i) shifted[i] = other.cell_vertices[i] + 8;
  for (const Vec3& p : other.points) mesh.points.push_back({p.x + 1, p.y, p.z});
  add_cell(mesh, CellType::hexahedron, shifted);
  const VolumeQualityReport report = analyze_volume_mesh(mesh);
  EXPECT_EQ(report.coincident_boundary_vertices, 4u);
  EXPECT_EQ(report.nonconforming_faces, 0u);
  EXPECT_EQ(report.boundary_faces, 12u);
}

TEST(AnalyzeVolumeMesh, an_empty_mesh_gives_zeros) {
  const VolumeQualityReport report = analyze_volume_mesh({});
  EXPECT_EQ(report.cells, 0u);
  EXPECT_EQ(report.min_scaled_jacobian, 0);
  EXPECT_TRUE(report.distributions.empty());
}

TEST(AnalyzeVolumeMesh, the_report_is_the_same_on_every_schedule) {
  VolumeMesh mesh = box_mesh(14, 13, 12, 5, true);
  for (Vec3& p : mesh.points) p = p + 0.1 * Vec3{std::sin(p.y * 3 + p.z), std::cos(p.x * 2), std::sin(p.x + p.y)};
  const auto digest = [&] { return digest_of(archived(analyze_volume_mesh(mesh))); };
  const Digest expected = digest();
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ScheduleScope scope(ScheduleKind::shuffled, seed);
    EXPECT_EQ(digest(), expected);
  }
  const ScheduleScope scope(ScheduleKind::serial);
  EXPECT_EQ(digest(), expected);
}

}  // namespace
}  // namespace strataflow
