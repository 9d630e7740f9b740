#include "kernels/hybrid/vertex_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/internal_error.h"

namespace strataflow {

namespace {

/// The sites of triple t, turning outward seen from site t where the four are positively oriented.
constexpr std::array<std::array<std::size_t, 3>, 4> triple_sites{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

using Cycle = std::vector<std::uint32_t>;

void append(Cycle& cycle, std::uint32_t point) {
  if (cycle.empty() || cycle.back() != point) cycle.push_back(point);
}

void close(Cycle& cycle) {
  while (cycle.size() > 1 && cycle.front() == cycle.back()) cycle.pop_back();
}

/// The polygon of a triple: from site to site, along the link of a site where the two facets leave it at different
/// points.
Cycle facet_of_triple(const VertexNeighbourhood& around, std::size_t t) {
  Cycle cycle;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = triple_sites[t][k], j = triple_sites[t][(k + 1) % 3];
    append(cycle, around.links[t][i][j]);
    append(cycle, around.links[t][j][i]);
  }
  close(cycle);
  return cycle;
}

double smallest_angle(const Cycle& cycle, const std::vector<Vec3>& points) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < cycle.size(); ++k) {
    const Vec3& p = points[cycle[k]];
    const Vec3 a = points[cycle[(k + 1) % cycle.size()]] - p;
    const Vec3 b = points[cycle[(k + cycle.size() - 1) % cycle.size()]] - p;
    smallest = std::min(smallest, std::atan2(length(cross(a, b)), dot(a, b)));
  }
  return smallest;
}

std::size_t shared_points(const Cycle& a, const Cycle& b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&](std::uint32_t p) { return std::find(b.begin(), b.end(), p) != b.end(); }));
}

/// Numbers and kind from the facets.
void count_and_classify(VertexCell& cell) {
  Cycle vertices;
  cell.edges.clear();
  std::size_t triangles = 0, quads = 0;
  for (const Cycle& facet : cell.facets) {
    triangles += facet.size() == 3;
    quads += facet.size() == 4;
    for (std::size_t k = 0; k < facet.size(); ++k) {
      const std::uint32_t a = facet[k], b = facet[(k + 1) % facet.size()];
      cell.edges.push_back({std::min(a, b), std::max(a, b)});
      vertices.push_back(a);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::sort(cell.edges.begin(), cell.edges.end());
  cell.edges.erase(std::unique(cell.edges.begin(), cell.edges.end()), cell.edges.end());
  cell.vertex_count = static_cast<std::uint32_t>(vertices.size());

  const std::size_t v = vertices.size(), e = cell.edges.size(), f = cell.facets.size();
  bool is_invalid = 2 * e < 3 * v || 2 * e < 3 * f;
  for (std::size_t a = 0; a < f && !is_invalid; ++a) {
    const Cycle& facet = cell.facets[a];
    for (std::size_t i = 0; i < facet.size(); ++i)  // an edge of the cell that is a diagonal here
      for (std::size_t j = i + 2; j < facet.size() - (i == 0 ? 1 : 0); ++j)
        is_invalid = is_invalid || std::binary_search(cell.edges.begin(), cell.edges.end(),
                                                      std::array<std::uint32_t, 2>{std::min(facet[i], facet[j]),
                                                                                   std::max(facet[i], facet[j])});
    for (std::size_t b = a + 1; b < f; ++b) is_invalid = is_invalid || shared_points(facet, cell.facets[b]) > 2;
  }
  if (is_invalid)
    cell.kind = VertexCellKind::invalid;
  else if (v == 4 && e == 6 && f == 4)
    cell.kind = VertexCellKind::tetrahedron;
  else if (v == 5 && e == 8 && f == 5 && quads == 1)
    cell.kind = VertexCellKind::pyramid;
  else if (v == 6 && e == 9 && f == 5 && triangles == 2 && quads == 3)
    cell.kind = VertexCellKind::prism;
  else
    cell.kind = v >= 7 ? VertexCellKind::to_subdivide : VertexCellKind::other;
}

}  // namespace

VertexNeighbourhood VertexNeighbourhood::with_points(const std::array<std::array<std::uint32_t, 2>, 4>& points) {
  VertexNeighbourhood around;
  around.points = points;
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) around.links[t][i][j] = points[i][0];
  return around;
}

std::uint32_t decide_links(VertexNeighbourhood& around, const std::vector<Vec3>& points) {
  std::uint32_t decided = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      std::vector<std::size_t> triples;  // both round the facet of i and j: it has one edge
      for (std::size_t t = 0; t < 4 && i != j; ++t)
        if (t != i && t != j && around.links[t][i][j] == no_index) triples.push_back(t);
      if (triples.empty()) continue;
      ++decided;
      double best_angle = -1;
      std::uint32_t best = around.points[i][0];
      for (const std::uint32_t candidate : around.points[i]) {
        if (candidate == no_index) continue;
        VertexNeighbourhood tried = around;
        double angle = std::numeric_limits<double>::infinity();
        for (const std::size_t t : triples) {
          tried.links[t][i][j] = candidate;
          Cycle facet = facet_of_triple(tried, t);
          std::erase(facet, no_index);  // other links are still open
          if (facet.size() > 2) angle = std::min(angle, smallest_angle(facet, points));
        }
        if (angle > best_angle) {
          best_angle = angle;
          best = candidate;
        }
      }
      for (const std::size_t t : triples) around.links[t][i][j] = best;
    }
  return decided;
}

VertexCell build_vertex_cell(const VertexNeighbourhood& around) {
  VertexCell cell;
  for (const auto& points : around.points) cell.two_point_cells += points[1] != no_index;
  bool is_ill_defined = false;
  for (std::size_t t = 0; t < 4; ++t) {
    cell.facets.push_back(facet_of_triple(around, t));
    for (const std::size_t i : triple_sites[t])
      for (const std::size_t j : triple_sites[t])
        is_ill_defined = is_ill_defined || (i != j && around.links[t][i][j] == no_index);
  }
  if (is_ill_defined) {
    cell.kind = VertexCellKind::ill_defined;
    return cell;
  }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      // The two triples around the facet of i and j; the first sees it run from i to j.
      std::size_t first = 0, second = 0;
      for (std::size_t t = 0; t < 4; ++t) {
        if (t == i || t == j) continue;
        for (std::size_t k = 0; k < 3; ++k)
          if (triple_sites[t][k] == i) (triple_sites[t][(k + 1) % 3] == j ? first : second) = t;
      }
      const auto& a = around.links[first];
      const auto& b = around.links[second];
      if (a[i][j] == b[i][j] && a[j][i] == b[j][i]) continue;
      Cycle facet;  // against the first triple, along the second's way back
      append(facet, a[j][i]);
      append(facet, a[i][j]);
      append(facet, b[i][j]);
      append(facet, b[j][i]);
      close(facet);
      ++cell.doubled_facets;
      cell.facets.push_back(std::move(facet));
    }
  count_and_classify(cell);
  const std::uint32_t c2 = cell.two_point_cells, d = cell.doubled_facets;
  // A point of a two-point cell that no facet takes leaves the cell with its link: it is no cell of these numbers.
  if (cell.vertex_count == 4 + c2)
    STRATAFLOW_ASSERT(cell.edges.size() == 6 + c2 + d && cell.facets.size() == 4 + d,
                      "a cell dual to a Voronoi vertex breaks the counting law");
  return cell;
}

std::uint32_t split_shared_facets(VertexCell& cell) {
  std::uint32_t taken = 0;
  const auto find_pair = [&](std::size_t& a, std::size_t& b) {
    for (a = 0; a < cell.facets.size(); ++a)
      for (b = a + 1; b < cell.facets.size(); ++b)
        if (cell.facets[a].size() == 4 && cell.facets[b].size() == 4 &&
            shared_points(cell.facets[a], cell.facets[b]) == 3)
          return true;
    return false;
  };
  for (std::size_t a = 0, b = 0; find_pair(a, b);) {
    Cycle first = cell.facets[a], second = cell.facets[b];
    // Turn both so that the point of their own comes first: its neighbours are the diagonal's ends in that facet.
    const auto own_first = [](Cycle& facet, const Cycle& other) {
      std::rotate(
          facet.begin(),
          std::find_if(facet.begin(), facet.end(),
                       [&](std::uint32_t p) { return std::find(other.begin(), other.end(), p) == other.end(); }),
          facet.end());
    };
    own_first(first, second);
    own_first(second, first);
    const auto same_ends = [](const Cycle& p, const Cycle& q) {
      return std::minmax(p[1], p[3]) == std::minmax(q[1], q[3]);
    };
    if (!same_ends(first, second)) break;  // no diagonal leaves the same triangle in both
    cell.facets[a] = {first[0], first[1], first[3]};
    cell.facets[b] = {second[0], second[1], second[3]};
    ++taken;
  }
  count_and_classify(cell);
  return taken;
}

std::optional<std::vector<ThinCell>> cells_of(const VertexCell& cell, std::uint32_t middle,
                                              const std::vector<Vec3>& points) {
  std::vector<ThinCell> cells;
  if (cell.kind == VertexCellKind::tetrahedron || cell.kind == VertexCellKind::pyramid) {
    // The cone from a vertex over the one facet without it.
    const auto base = std::max_element(cell.facets.begin(), cell.facets.end(),
                                       [](const Cycle& a, const Cycle& b) { return a.size() < b.size(); });
    std::uint32_t apex = no_index;
    for (const Cycle& facet : cell.facets)
      for (const std::uint32_t p : facet)
        if (std::find(base->begin(), base->end(), p) == base->end()) apex = p;
    cells.push_back(cone_over({(*base)[0], (*base)[1], (*base)[2], base->size() == 4 ? (*base)[3] : no_index}, apex));
  } else if (cell.kind == VertexCellKind::prism) {
    const auto bottom =
        std::find_if(cell.facets.begin(), cell.facets.end(), [](const Cycle& f) { return f.size() == 3; });
    Triangle low{(*bottom)[0], (*bottom)[2], (*bottom)[1]}, high{};  // turned to look inside
    for (const auto& edge : cell.edges)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t end = 0; end < 2; ++end)
          if (edge[end] == low[k] && std::find(bottom->begin(), bottom->end(), edge[1 - end]) == bottom->end())
            high[k] = edge[1 - end];
    cells.push_back(cell_between(low, high));
  } else if (cell.kind == VertexCellKind::to_subdivide || cell.kind == VertexCellKind::other) {
    for (const Cycle& facet : cell.facets) {
      if (facet.size() <= 4) {
        cells.push_back(cone_over({facet[0], facet[1], facet[2], facet.size() == 4 ? facet[3] : no_index}, middle));
        continue;
      }
      for (std::size_t k = 1; k + 1 < facet.size(); ++k)
        cells.push_back(cone_over({facet[0], facet[k], facet[k + 1], no_index}, middle));
    }
  } else {
    return std::nullopt;
  }
  for (const ThinCell& made : cells)
    if (state_of(made, points) != ThinCellState::sound) return std::nullopt;
  return cells;
}

}  // namespace strataflow
