#include "kernels/quality/measure_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/quality/small_meshes.h"

namespace strataflow {
namespace {

const double root3 = std::sqrt(3.0);

/// The ideal cell of each type, edges of length 1.
std::vector<Vec3> ideal_cell(CellType type) {
  const double h = std::sqrt(2.0 / 3.0);
  switch (type) {
    case CellType::tetrahedron:
      return {{0, 0, 0}, {1, 0, 0}, {0.5, root3 / 2, 0}, {0.5, root3 / 6, h}};
    case CellType::pyramid:
      return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}};
    case CellType::prism:  // VTK: the normal of the first triangle points away from the second
      return {{0, 0, 0}, {0.5, root3 / 2, 0}, {1, 0, 0}, {0, 0, 1}, {0.5, root3 / 2, 1}, {1, 0, 1}};
    case CellType::hexahedron:
      return unit_cube_points();
  }
  return {};
}

double min_dihedral(const CellMeasures& m) {
  return *std::min_element(m.dihedral_deg.begin(), m.dihedral_deg.begin() + m.dihedral_count);
}
double max_dihedral(const CellMeasures& m) {
  return *std::max_element(m.dihedral_deg.begin(), m.dihedral_deg.begin() + m.dihedral_count);
}

constexpr CellType all_types[] = {CellType::tetrahedron, CellType::pyramid, CellType::prism, CellType::hexahedron};

TEST(MeasureCell, the_ideal_cell_of_each_type_has_the_known_volume_and_angles_and_is_best) {
  const double volumes[] = {1 / (6 * std::sqrt(2.0)), std::sqrt(2.0) / 6, root3 / 4, 1};
  const double least[] = {std::acos(1.0 / 3), std::acos(1 / root3), M_PI / 3, M_PI / 2};
  const double most[] = {std::acos(1.0 / 3), std::acos(-1.0 / 3), M_PI / 2, M_PI / 2};
  const std::uint32_t hinges[] = {6, 12, 18, 24};
  for (int i = 0; i < 4; ++i) {
    const auto points = ideal_cell(all_types[i]);
    const CellMeasures m = measure_cell(all_types[i], points);
    EXPECT_NEAR(m.volume_m3, volumes[i], 1e-14);
    EXPECT_EQ(m.dihedral_count, hinges[i]);
    EXPECT_NEAR(min_dihedral(m), least[i] * 180 / M_PI, 1e-9);
    EXPECT_NEAR(max_dihedral(m), most[i] * 180 / M_PI, 1e-9);
    EXPECT_NEAR(m.scaled_jacobian, 1, 1e-14) << i;
    if (m.shape) {
      EXPECT_NEAR(*m.shape, 1, 1e-14) << i;
    }
    EXPECT_FALSE(is_inverted(all_types[i], points));
  }
  EXPECT_NEAR(*measure_cell(CellType::tetrahedron, ideal_cell(CellType::tetrahedron)).radius_ratio, 1, 1e-14);
  EXPECT_NEAR(*measure_cell(CellType::hexahedron, ideal_cell(CellType::hexahedron)).skew, 1, 1e-14);
}

TEST(MeasureCell, every_measure_but_size_ignores_scale_and_rotation) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  for (const CellType type : all_types) {
    auto points = ideal_cell(type);
    for (Vec3& p : points) p = p + Vec3{shift(random), shift(random), shift(random)};
    auto moved = points;
    for (Vec3& p : moved) p = {5 * (c * p.x - s * p.z) + 100, 5 * p.y - 30, 5 * (s * p.x + c * p.z) + 7};
    const CellMeasures a = measure_cell(type, points), b = measure_cell(type, moved);
    EXPECT_NEAR(b.volume_m3, 125 * a.volume_m3, 1e-10);
    EXPECT_NEAR(a.scaled_jacobian, b.scaled_jacobian, 1e-12);
    EXPECT_NEAR(a.shape.value_or(0), b.shape.value_or(0), 1e-12);
    EXPECT_NEAR(a.skew.value_or(0), b.skew.value_or(0), 1e-12);
    EXPECT_NEAR(a.radius_ratio.value_or(0), b.radius_ratio.value_or(0), 1e-12);
    EXPECT_LT(a.scaled_jacobian, 1);
    if (a.shape) {
      EXPECT_LT(*a.shape, 1);
    }
  }
}

TEST(MeasureCell, knupps_skew_is_best_for_any_box_and_shape_only_for_a_cube) {
  auto box = unit_cube_points();
  for (Vec3& p : box) p = {4 * p.x, p.y, p.z};
  const CellMeasures m = measure_cell(CellType::hexahedron, box);
  EXPECT_NEAR(*m.skew, 1, 1e-14);
  EXPECT_NEAR(*m.shape, 3 * std::pow(4, 2.0 / 3) / (16 + 1 + 1), 1e-14);
  EXPECT_NEAR(m.mean_corner_determinant, 4, 1e-14);
}

TEST(MeasureCell, a_sheared_box_has_the_sine_of_its_angle_as_scaled_jacobian) {
  auto sheared = unit_cube_points();
  for (Vec3& p : sheared) p.x += p.y / root3;  // 60° between the first two edges
  const CellMeasures m = measure_cell(CellType::hexahedron, sheared);
  EXPECT_NEAR(m.scaled_jacobian, root3 / 2, 1e-14);
  EXPECT_NEAR(*m.skew, std::pow(root3 / 2, 2.0 / 3), 1e-14);
  EXPECT_NEAR(min_dihedral(m), 60, 1e-9);
  EXPECT_NEAR(max_dihedral(m), 120, 1e-9);
}

TEST(MeasureCell, the_corner_tetrahedron_of_a_cube_has_the_textbook_radius_ratio) {
  const std::vector<Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double inner = 1 / (3 + root3), outer = root3 / 2;
  EXPECT_NEAR(*measure_cell(CellType::tetrahedron, corner).radius_ratio, 3 * inner / outer, 1e-14);
}

TEST(MeasureCell, volumes_of_warped_neighbours_add_up_because_they_share_the_bilinear_face) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  VolumeMesh mesh = box_mesh(2, 1, 1, 1, false);
  double before = 0, after = 0;
  const auto total = [&] {
    double sum = 0;
    for (std::size_t cell = 0; cell < 2; ++cell) {
      std::vector<Vec3> p;
      for (std::uint32_t i = 0; i < 8; ++i) p.push_back(mesh.points[mesh.cell_vertices[mesh.cell_offsets[cell] + i]]);
      sum += cell_volume(CellType::hexahedron, p);
    }
    return sum;
  };
  before = total();
  for (Vec3& p : mesh.points)
    if (p.x == 1) p.x += shift(random);  // only along the boundary's own planes
  after = total();
  EXPECT_NEAR(before, 2, 1e-14);
  EXPECT_NEAR(after, 2, 1e-14);
}

TEST(MeasureCell, relative_size_follows_the_spec_and_is_zero_for_negative_cells) {
  EXPECT_EQ(relative_size(2, 2), 1);
  EXPECT_EQ(relative_size(4, 2), 0.5);
  EXPECT_EQ(relative_size(1, 2), 0.5);
  EXPECT_EQ(relative_size(-1, 2), 0);
}

TEST(IsInverted, mirrored_cells_of_every_type_are_inverted) {
  for (const CellType type : all_types) {
    auto points = ideal_cell(type);
    for (Vec3& p : points) p.z = -p.z;
    EXPECT_TRUE(is_inverted(type, points));
    const CellMeasures m = measure_cell(type, points);
    EXPECT_LT(m.volume_m3, 0);
    EXPECT_LT(m.scaled_jacobian, 0);
    if (m.shape) {
      EXPECT_EQ(*m.shape, 0);
    }
  }
}

TEST(IsInverted, a_flat_cell_is_inverted_and_one_ulp_of_height_makes_it_good) {
  const double x = 1.0 / 3;
  std::vector<Vec3> tet = {{x, x, x}, {1 + x, x, x}, {x, 1 + x, x}, {0.4, 0.4, x}};
  EXPECT_TRUE(is_inverted(CellType::tetrahedron, tet));
  tet[3].z = std::nextafter(x, 1.0);
  EXPECT_FALSE(is_inverted(CellType::tetrahedron, tet));
}

TEST(IsInverted, one_bad_corner_of_a_hexahedron_is_enough) {
  auto points = unit_cube_points();
  points[6] = {0.2, 0.2, 0.2};  // pushed through: the corner's determinant turns negative, the volume does not
  EXPECT_GT(cell_volume(CellType::hexahedron, points), 0);
  EXPECT_TRUE(is_inverted(CellType::hexahedron, points));
}

}  // namespace
}  // namespace strataflow
