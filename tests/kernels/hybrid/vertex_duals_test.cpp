#include "kernels/hybrid/vertex_duals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "filled_block.h"
#include "kernels/adapters/cgal/delaunay_tetrahedra.h"
#include "kernels/hybrid/interior_sites.h"
#include "kernels/volumes/refine_interior.h"

namespace strataflow {
namespace {

/// A block with sites inside, as the product makes it.
support::FilledBlock block_with_sites(std::array<int, 3> size, std::size_t count) {
  support::FilledBlock block(size);
  EXPECT_TRUE(block.take_fan({0.47 * size[0], 0.52 * size[1], 0.51 * size[2]}));
  const std::vector<Vec3> sites = spread_interior_sites(block.boundary, block.mesh, count, 5);
  EXPECT_EQ(insert_interior_points(block.boundary, block.mesh, sites).size(), count);
  return block;
}

/// The sphere through the corners of a tetrahedron.
Vec3 centre_of(const std::vector<Vec3>& points, const Tet& tet) {
  const Vec3 &a = points[tet[0]], u = points[tet[1]] - a, v = points[tet[2]] - a, w = points[tet[3]] - a;
  return a +
         (0.5 / dot(cross(u, v), w)) * (dot(w, w) * cross(u, v) + dot(v, v) * cross(w, u) + dot(u, u) * cross(v, w));
}

TEST(FindVertexDuals, are_the_cells_with_empty_spheres_whose_centres_lie_inside) {
  const support::FilledBlock block = block_with_sites({4, 3, 3}, 20);
  const std::vector<Vec3> points = block.points();
  const VertexDuals duals = find_vertex_duals(block.boundary, block.mesh);
  std::uint64_t found = 0, certain = 0;
  for (std::size_t t = 0; t < block.mesh.tets.size(); ++t) {
    const Vec3 centre = centre_of(points, block.mesh.tets[t]);
    const double radius = length(centre - points[block.mesh.tets[t][0]]);
    double nearest = radius;
    for (const Vec3& p : points) nearest = std::min(nearest, length(centre - p));
    const double depth = std::min({centre.x, centre.y, centre.z, 4 - centre.x, 3 - centre.y, 3 - centre.z});
    if (std::abs(nearest - radius) > 1e-9 * radius || depth < -1e-9) {
      EXPECT_FALSE(duals.is_dual[t]) << t;
    }
    // Cells of more than four points on one sphere, or with the centre on a side, are decided by perturbation.
    std::size_t on_sphere = 0;
    for (const Vec3& p : points) on_sphere += std::abs(length(centre - p) - radius) < 1e-9 * radius;
    if (nearest > radius * (1 - 1e-9) && depth > 1e-9 && on_sphere == 4) {
      EXPECT_TRUE(duals.is_dual[t]) << t;
      ++certain;
    }
    found += duals.is_dual[t];
  }
  EXPECT_EQ(duals.counts.kept, found);
  EXPECT_GT(found, 100u);
  EXPECT_GT(certain, 100u);
}

TEST(FindVertexDuals, tell_what_became_of_every_candidate) {  // H7
  const support::FilledBlock block = block_with_sites({4, 3, 3}, 20);
  const VertexDualCounts counts = find_vertex_duals(block.boundary, block.mesh).counts;
  EXPECT_EQ(counts.flat + counts.crossing + counts.replaced + counts.kept, counts.candidates);
  EXPECT_LE(counts.candidates + counts.unreached, counts.vertices);
  EXPECT_EQ(counts.unreached, 0u);
  EXPECT_EQ(counts.inconsistent_edges, 0u);
  EXPECT_GT(counts.checked_edges, counts.vertices / 2);
  const DelaunayTetrahedra delaunay = delaunay_tetrahedra(block.points());
  std::size_t on_hull = 0;
  for (const auto& beyond : delaunay.beyond)
    on_hull += static_cast<std::size_t>(std::count(beyond.begin(), beyond.end(), no_index));
  EXPECT_EQ(counts.edges, (4 * delaunay.tets.size() + on_hull) / 2);  // one for each face
}

TEST(FindVertexDuals, see_the_fill_go_another_way) {
  // Two tetrahedra over a triangle, where three around the axis would be Delaunay, or the other way round.
  for (const double height : {0.8, 3.0}) {
    RegionBoundary boundary;
    boundary.coordinates = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, height}, {0, 0, -height}};
    std::vector<Tet> two{{0, 1, 2, 3}, {0, 2, 1, 4}}, three;
    for (std::uint32_t i = 0; i < 3; ++i) {
      boundary.facets.push_back({i, (i + 1) % 3, 3});
      boundary.facets.push_back({(i + 1) % 3, i, 4});
      three.push_back({i, (i + 1) % 3, 3, 4});
    }
    for (Tet& tet : three)
      if (dot(cross(boundary.coordinates[tet[1]] - boundary.coordinates[tet[0]],
                    boundary.coordinates[tet[2]] - boundary.coordinates[tet[0]]),
              boundary.coordinates[tet[3]] - boundary.coordinates[tet[0]]) < 0)
        std::swap(tet[2], tet[3]);
    boundary.sides.assign(6, 1);
    boundary.triangles.resize(6);
    boundary.points = {0, 1, 2, 3, 4};
    const double volume = 1.35 * 2 * height / 3;
    for (const auto& tets : {two, three}) {
      auto verdict = verified_region_mesh(boundary, boundary.coordinates, tets, volume);
      ASSERT_TRUE(std::holds_alternative<RegionMesh>(verdict)) << std::get<Rejection>(verdict).reason;
      const VertexDuals duals = find_vertex_duals(boundary, std::get<RegionMesh>(verdict));
      const bool is_delaunay = (tets.size() == 2) == (height > 1);
      EXPECT_EQ(duals.counts.candidates, height > 1 ? 2u : 3u);
      EXPECT_EQ(duals.counts.kept, is_delaunay ? duals.counts.candidates : 0) << height << " " << tets.size();
      EXPECT_EQ(duals.counts.replaced, is_delaunay ? 0 : duals.counts.candidates);
    }
  }
}

TEST(FindVertexDuals, see_a_surface_that_goes_through_them) {
  // A fault hangs between two sites that are nearer to each other than its corners are to them.
  const support::FilledBlock block({3, 3, 3});
  RegionBoundary cut = block.boundary;
  const auto first = static_cast<std::uint32_t>(cut.coordinates.size());
  cut.coordinates.insert(cut.coordinates.end(), {{0.9, 0.9, 1.5}, {2.1, 0.9, 1.5}, {1.5, 2.1, 1.5}});
  cut.facets.push_back({first, first + 1, first + 2});
  cut.sides.push_back(3);
  cut.triangles.push_back(no_index);
  for (std::uint32_t p = first; p < first + 3; ++p) cut.points.push_back(p);
  RegionMesh none;
  none.interior_points = {{1.5, 1.3, 1.35}, {1.5, 1.3, 1.7}};
  const VertexDualCounts across = find_vertex_duals(cut, none).counts;
  EXPECT_GT(across.crossing, 2u);
  EXPECT_EQ(across.inconsistent_edges, 0u);
  EXPECT_EQ(across.flat + across.crossing + across.replaced, across.candidates);
  // Without it there are only those on the sides, whose squares may be cut along the other diagonal.
  EXPECT_GT(across.crossing, find_vertex_duals(block.boundary, none).counts.crossing + 2);
}

}  // namespace
}  // namespace strataflow
