#include "kernels/quality/topology_invariants.h"

#include <algorithm>

#include "graph/parallel/parallel_map.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

/// Rank mod 2 of rows given as ascending column numbers (a number that comes twice cancels).
std::uint64_t rank_mod_2(std::vector<std::vector<std::uint32_t>> rows, std::size_t columns) {
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::vector<std::vector<std::uint32_t>> with_lead(columns);  // the reduced row that starts with this column
  std::uint64_t rank = 0;
  std::vector<std::uint32_t> sum;
  for (std::vector<std::uint32_t>& row : rows) {
    while (!row.empty() && !with_lead[row.front()].empty()) {
      const std::vector<std::uint32_t>& other = with_lead[row.front()];
      sum.clear();
      std::set_symmetric_difference(row.begin(), row.end(), other.begin(), other.end(), std::back_inserter(sum));
      row.swap(sum);
    }
    if (row.empty()) continue;
    ++rank;
    const std::uint32_t lead = row.front();
    with_lead[lead] = std::move(row);
  }
  return rank;
}

}  // namespace

TopologyInvariants topology_invariants(std::span<const Triangle> given) {
  // Vertices are renumbered, so that a small surface of a large model costs what it is.
  std::vector<std::uint32_t> used;
  used.reserve(3 * given.size());
  for (const Triangle& t : given) used.insert(used.end(), t.begin(), t.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Triangle> triangles(given.begin(), given.end());
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t)
      v = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
  const EdgeTable table = build_edge_table(used.size(), triangles);

  UnionFind of_vertices(used.size()), on_borders(used.size()), of_triangles(triangles.size());
  std::vector<char> is_on_border(used.size(), 0);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    const auto [a, b] = table.edges[e];
    const auto around = table.around(e);
    of_vertices.unite(a, b);
    if (around.size() == 2) of_triangles.unite(around[0] / 3, around[1] / 3);
    if (around.size() != 1) continue;
    on_borders.unite(a, b);
    is_on_border[a] = is_on_border[b] = 1;
  }
  TopologyInvariants result;
  result.vertices = used.size();
  result.edges = table.edge_count();
  result.triangles = triangles.size();
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    result.components += of_vertices.find(v) == v;
    result.borders += is_on_border[v] != 0 && on_borders.find(v) == v;
  }
  // A cycle mod 2 holds, across an edge of two triangles, both or neither: so a sheet of triangles joined across such
  // edges counts as one unknown, and every other edge is an equation: the sheets around it add up to 0.
  std::vector<std::uint32_t> sheet_of(triangles.size());
  std::uint32_t sheets = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    sheet_of[t] = of_triangles.find(t) == t ? sheets++ : sheet_of[of_triangles.find(t)];
  std::vector<std::vector<std::uint32_t>> equations;
  std::vector<std::uint32_t> around_edge, equation;
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    if (table.around(e).size() == 2) continue;
    around_edge.clear();
    equation.clear();
    for (const std::uint32_t h : table.around(e)) around_edge.push_back(sheet_of[h / 3]);
    std::sort(around_edge.begin(), around_edge.end());
    for (std::size_t i = 0; i < around_edge.size();) {
      const std::size_t begin = i;
      while (i < around_edge.size() && around_edge[i] == around_edge[begin]) ++i;
      if ((i - begin) % 2 == 1) equation.push_back(around_edge[begin]);
    }
    if (!equation.empty() && (equations.empty() || equations.back() != equation)) equations.push_back(equation);
  }
  result.cavities = sheets - rank_mod_2(std::move(equations), sheets);
  result.independent_loops = static_cast<std::int64_t>(result.components + result.cavities) - result.euler();
  return result;
}

ModelTopology topology_of(const StructuralModel& model) {
  return {topology_invariants(model.triangles), parallel_map(model.surfaces.size(), [&](std::size_t s) {
            const Surface& surface = model.surfaces[s];
            return topology_invariants(std::span(model.triangles)
                                           .subspan(surface.first_triangle, surface.end_triangle - surface.first_triangle));
          })};
}

}  // namespace strataflow
