#include "kernels/hexes/audit/audit_edges.h"

#include <algorithm>
#include <array>
#include <map>

#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/hexes/plan_lines.h"
#include "kernels/quality/match_cell_faces.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {
namespace {

constexpr std::array<std::array<std::uint8_t, 2>, 12> edge_corners{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
constexpr std::uint32_t first_upright = 8;

struct EdgeUse {
  std::uint32_t a = 0, b = 0;
  std::uint32_t cell_edge = 0;  ///< 12·cell + k
};
bool by_ends(const EdgeUse& x, const EdgeUse& y) {
  return std::array{x.a, x.b, x.cell_edge} < std::array{y.a, y.b, y.cell_edge};
}

/// The edges of faces that have a cell on one side alone; ascending.
std::vector<std::array<std::uint32_t, 2>> boundary_edges(const FaceMatching& matching) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const CellFace& face : matching.boundary_faces)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t a = face.vertices[k], b = face.vertices[(k + 1) % 4];
      if (a != no_index && b != no_index) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  sort_total_order(edges, std::less<>());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

AuditedEdges audit_edges(const HexGrid& grid) {
  const VolumeMesh& mesh = grid.mesh;
  std::vector<EdgeUse> uses(12 * mesh.cell_count());
  parallel_ranges(mesh.cell_count(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      for (std::size_t k = 0; k < 12; ++k) {
        const std::uint32_t a = mesh.cell_vertices[8 * c + edge_corners[k][0]];
        const std::uint32_t b = mesh.cell_vertices[8 * c + edge_corners[k][1]];
        uses[12 * c + k] = {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(12 * c + k)};
      }
  });
  sort_total_order(uses, by_ends);
  const FaceMatching matching = match_cell_faces(mesh);
  const std::vector<std::array<std::uint32_t, 2>> outer = boundary_edges(matching);
  std::vector<char> is_inside(mesh.points.size(), 0);
  for (const std::uint32_t v : mesh.cell_vertices) is_inside[v] = 1;
  for (const CellFace& face : matching.boundary_faces)
    for (const std::uint32_t v : face.vertices)
      if (v != no_index) is_inside[v] = 0;
  std::vector<std::uint32_t> plan_valence(grid.plan.points.size(), 0);
  for (const auto& quad : grid.plan.quads)
    for (const std::uint32_t p : quad) ++plan_valence[p];

  AuditedEdges audited;
  EdgeAudit& counts = audited.counts;
  std::vector<std::int32_t> balance(mesh.points.size(), 0);
  std::map<std::array<std::uint32_t, 2>, std::vector<std::array<std::uint32_t, 2>>> singular;  // outer, valence
  std::vector<std::uint32_t> columns;
  std::size_t next_outer = 0;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].a == uses[begin].a && uses[end].b == uses[begin].b) ++end;
    const std::array<std::uint32_t, 2> ends{uses[begin].a, uses[begin].b};
    const auto valence = static_cast<std::uint32_t>(end - begin);
    while (next_outer < outer.size() && outer[next_outer] < ends) ++next_outer;
    if (next_outer < outer.size() && outer[next_outer] == ends) {
      if (valence == 2) continue;
      ++counts.boundary_singular_edges;
      singular[{1, valence}].push_back(ends);
      continue;
    }
    for (const std::uint32_t v : ends) balance[v] += 6 - static_cast<std::int32_t>(valence);
    const std::uint32_t cell = uses[begin].cell_edge / 12, k = uses[begin].cell_edge % 12;
    const std::uint32_t below =
        k < first_upright ? no_index : grid.plan.quads[grid.cell_column[cell]][k - first_upright];
    if (below != no_index && valence != plan_valence[below]) ++counts.foreign_column_edges;
    if (valence == 4) continue;
    ++counts.singular_edges;
    if (below == no_index)
      ++counts.singular_level_edges;
    else
      columns.push_back(below);
    singular[{0, valence}].push_back(ends);
  }
  counts.singular_columns = sorted_unique(std::move(columns)).size();
  for (std::size_t v = 0; v < balance.size(); ++v) {
    if (!is_inside[v]) continue;
    ++counts.interior_vertices;
    if (balance[v] != 12) ++counts.unbalanced_vertices;
  }
  for (auto& [kind, edges] : singular)
    for (const PointChain& chain : chain_edges(std::move(edges))) {
      Polyline line;
      line.name = (kind[0] != 0 ? "boundary valence " : "valence ") + std::to_string(kind[1]);
      line.is_closed = chain.is_closed;
      for (const std::uint32_t v : chain.points) line.points.push_back(mesh.points[v]);
      audited.singular_lines.push_back(std::move(line));
    }
  return audited;
}

}  // namespace strataflow
