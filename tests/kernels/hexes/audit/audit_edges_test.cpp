#include "kernels/hexes/audit/audit_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strataflow {
namespace {

/// `sectors` rhombs of quads around one point, extruded: each `n` quads wide, in `layers` layers.
HexGrid fan(std::uint32_t sectors, std::uint32_t layers) {
  HexGrid grid;
  const auto direction = [&](std::uint32_t s) {
    const double angle = 2 * std::numbers::pi * (s % sectors) / sectors;
    return Vec3{std::cos(angle), std::sin(angle), 0};
  };
  grid.plan.points.push_back({});
  for (std::uint32_t s = 0; s < sectors; ++s) {
    grid.plan.points.push_back(direction(s));
    grid.plan.points.push_back(direction(s) + direction(s + 1));
  }
  for (std::uint32_t s = 0; s < sectors; ++s)
    grid.plan.quads.push_back({0, 1 + 2 * s, 2 + 2 * s, 1 + 2 * ((s + 1) % sectors)});
  grid.layers = layers;
  const auto count = static_cast<std::uint32_t>(grid.plan.points.size());
  for (std::uint32_t level = 0; level <= layers; ++level)
    for (const Vec3& p : grid.plan.points) grid.mesh.points.push_back(p + Vec3{0, 0, double(level)});
  for (std::uint32_t q = 0; q < sectors; ++q)
    for (std::uint32_t k = 0; k < layers; ++k) {
      std::array<std::uint32_t, 8> v{};
      for (std::uint32_t c = 0; c < 4; ++c) {
        v[c] = grid.plan.quads[q][c] + k * count;
        v[4 + c] = v[c] + count;
      }
      grid.mesh.add_cell(CellType::hexahedron, v.data(), 0);
      grid.cell_column.push_back(q);
      grid.cell_layer.push_back(k);
      grid.is_dead.push_back(0);
    }
  return grid;
}

TEST(AuditEdges, balances_twelve_around_a_singular_edge_of_any_valence) {
  for (const std::uint32_t sectors : {3u, 4u, 5u, 6u}) {
    const AuditedEdges audited = audit_edges(fan(sectors, 3));
    EXPECT_EQ(audited.counts.interior_vertices, 2u) << sectors;
    EXPECT_EQ(audited.counts.unbalanced_vertices, 0u) << sectors;
    EXPECT_EQ(audited.counts.foreign_column_edges, 0u) << sectors;
    EXPECT_EQ(audited.counts.singular_level_edges, 0u) << sectors;
    EXPECT_EQ(audited.counts.singular_edges, sectors == 4 ? 0u : 3u) << sectors;
    EXPECT_EQ(audited.counts.singular_columns, sectors == 4 ? 0u : 1u) << sectors;
  }
}

TEST(AuditEdges, draws_singular_edges_as_one_line_from_bottom_to_top) {
  const AuditedEdges audited = audit_edges(fan(5, 3));
  ASSERT_FALSE(audited.singular_lines.empty());
  EXPECT_EQ(audited.singular_lines.front().name, "valence 5");
  EXPECT_EQ(audited.singular_lines.front().points, (std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}}));
  EXPECT_EQ(audited.singular_lines.back().name.rfind("boundary", 0), 0u);  // the corners of the box
}

TEST(AuditEdges, finds_a_vertex_that_a_cell_lets_go_of) {
  HexGrid grid = fan(4, 4);
  // The cell takes another vertex for the one in the middle, far away.
  grid.mesh.points.push_back({0, 0, 1.5});
  grid.mesh.cell_vertices[8 * 1 + 4] = static_cast<std::uint32_t>(grid.mesh.points.size() - 1);
  const EdgeAudit counts = audit_edges(grid).counts;
  EXPECT_LT(counts.interior_vertices, 3u);
  EXPECT_GT(counts.boundary_singular_edges, audit_edges(fan(4, 4)).counts.boundary_singular_edges);
}

TEST(AuditEdges, finds_columns_that_are_not_those_of_the_plan) {
  HexGrid grid = fan(5, 2);
  grid.plan.quads.push_back(grid.plan.quads.front());  // a sixth quad that has no cells
  EXPECT_EQ(audit_edges(grid).counts.foreign_column_edges, 2u);
}

}  // namespace
}  // namespace strataflow
