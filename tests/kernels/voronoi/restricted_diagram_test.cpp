#include "kernels/voronoi/restricted_diagram.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "graph/parallel/schedule.h"
#include "kernels/voronoi/diagram_samples.h"

namespace strataflow {
namespace {

RestrictedDiagram diagram_of(const sample::Mesh& mesh, const std::vector<Vec3>& sites) {
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  return restrict_to_triangles(mesh.points, mesh.triangles, neighbours);
}

TEST(RestrictedDiagram, areas_add_up_triangle_by_triangle) {
  const sample::Mesh mesh = sample::wavy_sheet(12);
  const RestrictedDiagram diagram = diagram_of(mesh, sample::random_sites(80, 11, {0, 0, -0.2}, {1, 1, 0.2}));
  std::vector<double> areas(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < diagram.piece_count(); ++i)
    areas[diagram.piece_triangle[i]] += sample::polygon_area(diagram.piece_points(i));
  for (std::size_t t = 0; t < areas.size(); ++t)
    EXPECT_NEAR(areas[t], sample::triangle_area(mesh, mesh.triangles[t]), 1e-9 * areas[t]);
}

/// Ends of the part of each mesh edge in each cell, as its triangles see it.
using EdgeParts = std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::vector<std::pair<Vec3, Vec3>>>;

EdgeParts edge_parts(const sample::Mesh& mesh, const RestrictedDiagram& diagram) {
  EdgeParts parts;
  for (std::size_t i = 0; i < diagram.piece_count(); ++i) {
    const auto points = diagram.piece_points(i);
    const auto edges = diagram.piece_edges(i);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!edges[k].is_triangle_edge()) continue;
      const Triangle& t = mesh.triangles[diagram.piece_triangle[i]];
      const std::uint32_t a = t[edges[k].triangle_edge()], b = t[(edges[k].triangle_edge() + 1) % 3];
      Vec3 from = points[k], to = points[(k + 1) % points.size()];
      if (a > b) std::swap(from, to);
      parts[{std::min(a, b), std::max(a, b), diagram.piece_site[i]}].push_back({from, to});
    }
  }
  return parts;
}

void expect_triangles_to_agree(const sample::Mesh& mesh, const std::vector<Vec3>& sites) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> valence;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++valence[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}];
  for (const auto& [key, ends] : edge_parts(mesh, diagram_of(mesh, sites))) {
    const std::pair edge{std::get<0>(key), std::get<1>(key)};
    ASSERT_EQ(ends.size(), valence[edge]) << "an edge is cut differently in its triangles";
    for (const auto& end : ends) EXPECT_EQ(end, ends.front());
  }
}

TEST(RestrictedDiagram, triangles_on_an_edge_cut_it_alike_bit_for_bit) {
  expect_triangles_to_agree(sample::wavy_sheet(10), sample::random_sites(150, 12, {0, 0, -0.2}, {1, 1, 0.2}));
}

TEST(RestrictedDiagram, triangles_agree_where_sites_lie_on_a_grid_in_step_with_the_mesh) {
  std::vector<Vec3> sites;  // every mesh vertex is equally near to four sites, every other edge lies in a bisector
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) sites.push_back({(i - 0.5) / 8, (j - 0.5) / 8, 0});
  const sample::Mesh mesh = sample::flat_sheet(8);
  expect_triangles_to_agree(mesh, sites);
  const RestrictedDiagram diagram = diagram_of(mesh, sites);
  double area = 0;
  for (std::size_t i = 0; i < diagram.piece_count(); ++i) area += sample::polygon_area(diagram.piece_points(i));
  EXPECT_NEAR(area, 1, 1e-12);
}

TEST(RestrictedDiagram, is_the_same_on_any_schedule) {
  const sample::Mesh mesh = sample::wavy_sheet(40);
  const auto sites = sample::random_sites(300, 13, {0, 0, -0.2}, {1, 1, 0.2});
  const auto run = [&](ScheduleKind kind, std::uint64_t seed) {
    const ScheduleScope scope(kind, seed);
    return diagram_of(mesh, sites);
  };
  const RestrictedDiagram expected = run(ScheduleKind::serial, 0);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const RestrictedDiagram other = run(seed == 0 ? ScheduleKind::threads : ScheduleKind::shuffled, seed);
    EXPECT_EQ(other.points, expected.points);
    EXPECT_EQ(other.piece_site, expected.piece_site);
    EXPECT_EQ(other.edges, expected.edges);
  }
}

TEST(FindOwners, uses_guesses_only_to_be_fast) {
  const sample::Mesh mesh = sample::wavy_sheet(20);
  SiteNeighbours neighbours;
  neighbours.move_to(sample::random_sites(60, 14, {0, 0, -0.2}, {1, 1, 0.2}));
  std::vector<std::uint32_t> fresh, guessed(mesh.points.size(), 59);
  find_owners(mesh.points, neighbours, fresh);
  find_owners(mesh.points, neighbours, guessed);
  EXPECT_EQ(fresh, guessed);
}

}  // namespace
}  // namespace strataflow
