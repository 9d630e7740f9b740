#include "kernels/hexes/live_cells.h"

#include <algorithm>
#include <numeric>

namespace strataflow {

namespace {

/// Per point, the lowest of those it coincides with along vertical edges.
std::vector<std::uint32_t> merged_points(const HexGrid& hexes) {
  const VolumeMesh& mesh = hexes.mesh;
  std::vector<std::uint32_t> leader(mesh.points.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t point) {
    while (leader[point] != point) point = leader[point] = leader[leader[point]];
    return point;
  };
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t low = mesh.cell_vertices[8 * c + k], high = mesh.cell_vertices[8 * c + 4 + k];
      if (low == high || !(hexes.is_dead[c] || mesh.points[low] == mesh.points[high])) continue;
      const std::uint32_t a = find(low), b = find(high);
      leader[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t point = 0; point < leader.size(); ++point) leader[point] = find(point);
  return leader;
}

/// A facet's corners without repetitions, at least three, or nothing.
bool simplify(MeshFacet& facet) {
  std::array<std::uint32_t, 4> corners{no_index, no_index, no_index, no_index};
  std::size_t count = 0;
  for (const std::uint32_t v : facet.vertices)
    if (v != no_index && std::find(corners.begin(), corners.begin() + count, v) == corners.begin() + count)
      corners[count++] = v;
  facet.vertices = corners;
  return count >= 3;
}

}  // namespace

LiveCells live_cells(const HexGrid& hexes) {
  const VolumeMesh& all = hexes.mesh;
  LiveCells live;
  VolumeMesh& mesh = live.mesh;
  mesh.local_origin = all.local_origin;
  mesh.entities = all.entities;
  mesh.surface_entity = all.surface_entity;
  mesh.region_names = all.region_names;
  mesh.changes = all.changes;
  std::vector<std::uint32_t> point = merged_points(hexes);
  std::vector<std::uint32_t> cell_of(all.cell_count(), no_index);
  std::vector<char> is_used(all.points.size(), 0);
  for (std::uint32_t c = 0; c < all.cell_count(); ++c) {
    if (hexes.is_dead[c]) continue;
    cell_of[c] = static_cast<std::uint32_t>(live.grid_cell.size());
    live.grid_cell.push_back(c);
    for (std::size_t k = 0; k < 8; ++k) is_used[point[all.cell_vertices[8 * c + k]]] = 1;
  }
  std::vector<std::uint32_t> number(all.points.size(), no_index);
  for (std::uint32_t p = 0; p < all.points.size(); ++p)
    if (is_used[p]) {
      number[p] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(all.points[p]);
    }
  for (std::uint32_t& p : point) p = number[p];
  for (const std::uint32_t c : live.grid_cell) {
    std::array<std::uint32_t, 8> corners{};
    for (std::size_t k = 0; k < 8; ++k) corners[k] = point[all.cell_vertices[8 * c + k]];
    mesh.add_cell(all.cell_types[c], corners.data(), all.cell_region[c]);
    if (!all.cell_entity.empty()) mesh.cell_entity.push_back(all.cell_entity[c]);
  }
  // Through cells without thickness: a facet is between the live cells below and above.
  const std::uint32_t layers = hexes.layers;
  const auto live_below = [&](std::uint32_t c) {
    while (c != no_index && hexes.is_dead[c]) c = c % layers == 0 ? no_index : c - 1;
    return c;
  };
  const auto live_above = [&](std::uint32_t c) {
    while (c != no_index && hexes.is_dead[c]) c = (c + 1) % layers == 0 ? no_index : c + 1;
    return c;
  };
  for (MeshFacet facet : all.facets) {
    for (std::uint32_t& v : facet.vertices) v = v == no_index ? no_index : point[v];
    const bool is_level = facet.cell_1 != no_index && facet.cell_0 / layers == facet.cell_1 / layers;
    if (is_level) {
      facet.cell_0 = live_below(facet.cell_0);
      facet.cell_1 = live_above(facet.cell_1);
    } else if (facet.cell_1 == no_index && hexes.is_dead[facet.cell_0]) {
      // The top or bottom of a column that ends with dead cells; their sides have no area and go below.
      facet.cell_0 = facet.cell_0 % layers == 0 ? live_above(facet.cell_0) : live_below(facet.cell_0);
    }
    const auto renumbered = [&](std::uint32_t c) { return c == no_index ? no_index : cell_of[c]; };
    facet.cell_0 = renumbered(facet.cell_0);
    facet.cell_1 = renumbered(facet.cell_1);
    if (facet.cell_0 == no_index) {
      // Seen from the other side.
      std::swap(facet.cell_0, facet.cell_1);
      std::reverse(facet.vertices.begin(), facet.vertices.end());
    }
    if (facet.cell_0 == no_index || std::count(facet.vertices.begin(), facet.vertices.end(), no_index) > 0 ||
        !simplify(facet))
      continue;
    mesh.facets.push_back(facet);
  }
  // The lowest and the highest of levels that coincide named the same face.
  const auto key = [](const MeshFacet& f) { return std::array{f.cell_0, f.cell_1, f.surface, f.vertices[0], f.vertices[1]}; };
  std::stable_sort(mesh.facets.begin(), mesh.facets.end(), [&](const MeshFacet& a, const MeshFacet& b) {
    return std::array{a.surface, a.cell_0, a.cell_1} < std::array{b.surface, b.cell_0, b.cell_1};
  });
  mesh.facets.erase(std::unique(mesh.facets.begin(), mesh.facets.end(),
                                [&](const MeshFacet& a, const MeshFacet& b) { return key(a) == key(b); }),
                    mesh.facets.end());
  return live;
}

}  // namespace strataflow
