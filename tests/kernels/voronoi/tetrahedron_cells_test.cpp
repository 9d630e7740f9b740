#include "kernels/voronoi/tetrahedron_cells.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "kernels/voronoi/diagram_samples.h"
#include "kernels/voronoi/triangle_cells.h"

namespace strataflow {
namespace {

double volume_of(const TetrahedronPiece& piece) {
  double volume = 0;
  const Vec3& apex = piece.points[0];
  for (const PieceFace& face : piece.faces) {
    const auto ring = piece.rings.subspan(face.first, face.count);
    for (std::size_t k = 2; k < ring.size(); ++k)
      volume += dot(piece.points[ring[0]] - apex,
                    cross(piece.points[ring[k - 1]] - apex, piece.points[ring[k]] - apex)) / 6;
  }
  return volume;
}

/// The unit cube in six tetrahedra around its diagonal.
std::vector<std::array<Vec3, 4>> cube() {
  const auto corner = [](int bits) { return Vec3{double(bits & 1), double((bits >> 1) & 1), double(bits >> 2)}; };
  std::vector<std::array<Vec3, 4>> tetrahedra;
  for (const auto& [a, b] : {std::pair{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}})
    tetrahedra.push_back({corner(0), corner(a), corner(b), corner(7)});
  return tetrahedra;
}

TEST(TetrahedronCells, pieces_fill_the_tetrahedron_and_hold_what_is_nearest) {
  const auto sites = sample::random_sites(300, 31, {0, 0, 0}, {1, 1, 1});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  TetrahedronCells cells(neighbours);
  double total = 0;
  for (const auto& corners : cube()) {
    ASSERT_GT(dot(corners[1] - corners[0], cross(corners[2] - corners[0], corners[3] - corners[0])), 0);
    cells.cut(corners, find_nearest_site(neighbours, corners[0], 0));
    for (std::size_t i = 0; i < cells.piece_count(); ++i) {
      const TetrahedronPiece piece = cells.piece(i);
      const double volume = volume_of(piece);
      EXPECT_GT(volume, 0);
      total += volume;
      Vec3 middle;
      for (const Vec3& p : piece.points) middle = middle + (1.0 / double(piece.points.size())) * p;
      EXPECT_EQ(piece.site, find_nearest_site(neighbours, middle, 0));
      EXPECT_EQ(piece.points.size() + piece.faces.size(), piece.rings.size() / 2 + 2);  // Euler
    }
  }
  EXPECT_NEAR(total, 1, 1e-12);
}

TEST(TetrahedronCells, faces_between_cells_and_tetrahedra_are_shared_bit_for_bit_on_a_grid_of_sites) {
  std::vector<Vec3> sites;  // corners of the grid's cubes are equally near to eight sites, planes hold whole faces
  for (int i = 0; i < 64; ++i) sites.push_back({(i & 3) / 3.0, ((i >> 2) & 3) / 3.0, (i >> 4) / 3.0});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  TetrahedronCells cells(neighbours);
  using Face = std::pair<std::pair<std::int64_t, std::int64_t>, std::set<std::array<double, 3>>>;
  std::map<Face, int> seen;  // inner faces by the two cells (or the one on both sides of a tetrahedron's face) and points
  double total = 0;
  for (const auto& corners : cube()) {
    cells.cut(corners, find_nearest_site(neighbours, corners[0], 0));
    for (std::size_t i = 0; i < cells.piece_count(); ++i) {
      const TetrahedronPiece piece = cells.piece(i);
      total += volume_of(piece);
      for (const PieceFace& face : piece.faces) {
        std::set<std::array<double, 3>> points;
        std::array<bool, 3> low{true, true, true}, high = low;
        for (const std::uint32_t corner : piece.rings.subspan(face.first, face.count)) {
          const Vec3& p = piece.points[corner];
          points.insert({p.x, p.y, p.z});
          for (int axis = 0; axis < 3; ++axis) {
            low[static_cast<std::size_t>(axis)] &= p[axis] == 0;
            high[static_cast<std::size_t>(axis)] &= p[axis] == 1;
          }
        }
        const bool is_outside = low[0] || low[1] || low[2] || high[0] || high[1] || high[2];
        const std::int64_t site = piece.site, other = face.is_tetrahedron_face() ? -1 : std::int64_t{face.site()};
        if (points.size() >= 3 && !is_outside) ++seen[{std::minmax(site, other), points}];
      }
    }
  }
  EXPECT_NEAR(total, 1, 1e-12);
  EXPECT_GT(seen.size(), 100u);
  // Twice, or four times where two faces without area round to the same points.
  for (const auto& [face, times] : seen) EXPECT_EQ(times % 2, 0) << face.first.first << " " << face.first.second;
}

TEST(TetrahedronCells, a_small_tetrahedron_inside_a_cell_is_one_piece) {
  SiteNeighbours neighbours;
  neighbours.move_to({{0, 0, 0}, {10, 0, 0}});
  TetrahedronCells cells(neighbours);
  cells.cut({Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0);
  ASSERT_EQ(cells.piece_count(), 1u);
  EXPECT_NEAR(volume_of(cells.piece(0)), 1.0 / 6, 1e-15);
}

}  // namespace
}  // namespace strataflow
