#include "kernels/hexes/refine_tets.h"

#include <algorithm>
#include <array>

#include "base/internal_error.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/hexes/level_ranges.h"
#include "kernels/hexes/wall_sheets.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/volumes/tet_faces.h"

namespace strataflow {
namespace {

using Edge = std::array<std::uint32_t, 2>;

constexpr std::array<std::array<std::uint32_t, 2>, 6> tet_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

void sort_unique(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

/// Edges of the original points that are chords on some side of the faults.
std::vector<Edge> find_chords(const LabelledTets& tets, const StratigraphicLevels& levels) {
  const FaultSplit split = split_along_faults(tets);
  const std::vector<LevelRange> ranges = level_ranges(tets, levels, split);
  std::vector<Edge> on_horizons;  // in copies
  for (std::uint32_t face = 0; face < tets.facet_of.size(); ++face) {
    if (tets.facet_of[face] == no_index) continue;
    const SheetKind kind = tets.facets[tets.facet_of[face]].kind;
    if (kind == SheetKind::fault || kind == SheetKind::side) continue;
    const Triangle v = face_vertices(split.tets[face / 4], face % 4);
    for (std::size_t k = 0; k < 3; ++k) on_horizons.push_back(edge_of(v[k], v[(k + 1) % 3]));
  }
  sort_unique(on_horizons);
  std::vector<Edge> chords;
  for (std::uint32_t t = 0; t < split.tets.size(); ++t)
    for (const auto& [i, j] : tet_edges) {
      const std::uint32_t a = split.tets[t][i], b = split.tets[t][j];
      if (ranges[a].is_empty() || ranges[b].is_empty()) continue;
      if (ranges[a].level_in(levels.unit[t]) != ranges[b].level_in(levels.unit[t])) continue;
      if (std::binary_search(on_horizons.begin(), on_horizons.end(), edge_of(a, b))) continue;
      chords.push_back(edge_of(split.original[a], split.original[b]));
    }
  sort_unique(chords);
  return chords;
}

Tet replaced(Tet tet, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t& v : tet)
    if (v == from) v = to;
  return tet;
}

bool is_positive(const std::vector<Vec3>& p, const Tet& tet) {
  return orientation_3d(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) > 0;
}

/// Finds neighbours and facets anew for `changed` tetrahedra, the new ones among them, and for those beside them.
/// Facets from `first_new_facet` on are new.
void reconnect(LabelledTets& tets, const std::vector<std::uint32_t>& changed, std::size_t first_new_facet) {
  const auto old_count = static_cast<std::uint32_t>(tets.neighbour.size() / 4);
  std::vector<char> is_changed(tets.tets.size(), 0);
  std::vector<std::uint32_t> near = changed, facets;
  for (const std::uint32_t t : changed) {
    is_changed[t] = 1;
    for (std::uint32_t face = 4 * t; face < 4 * t + 4 && t < old_count; ++face) {
      if (tets.neighbour[face] != no_index) near.push_back(tets.neighbour[face] / 4);
      if (tets.facet_of[face] != no_index) facets.push_back(tets.facet_of[face]);
    }
  }
  for (std::size_t f = first_new_facet; f < tets.facets.size(); ++f) facets.push_back(static_cast<std::uint32_t>(f));
  near = sorted_unique(std::move(near));
  facets = sorted_unique(std::move(facets));
  std::vector<Tet> corners;
  std::vector<Triangle> triangles;
  for (const std::uint32_t t : near) corners.push_back(tets.tets[t]);
  for (const std::uint32_t f : facets) triangles.push_back(tets.facets[f].vertices);
  tets.neighbour.resize(4 * tets.tets.size(), no_index);
  tets.facet_of.resize(4 * tets.tets.size(), no_index);
  const std::vector<FaceEntry> faces = grouped_faces(triangles, tets.points.size(), corners);
  const auto face_of = [&](const FaceEntry& entry) { return 4 * near[entry.id / 4] + entry.id % 4; };
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    while (end < faces.size() && faces[end].has_same_vertices(faces[i])) ++end;
    const std::size_t first = faces[i].is_facet ? i + 1 : i;
    if (std::none_of(faces.begin() + first, faces.begin() + end,
                     [&](const FaceEntry& entry) { return is_changed[near[entry.id / 4]]; }))
      continue;  // what it touches is not among these
    STRATAFLOW_ASSERT((end - first == 1 && first > i) || (end - first == 2 && !faces[first].is_facet),
                      "refined tetrahedra do not conform");
    for (std::size_t f = first; f < end; ++f) {
      tets.facet_of[face_of(faces[f])] = first > i ? facets[faces[i].id] : no_index;
      tets.neighbour[face_of(faces[f])] = end - first == 2 ? face_of(faces[f == first ? first + 1 : first]) : no_index;
    }
  }
}

/// Splits as many of `edges`, which ascend, as do not share a tet, at their middles. Returns how many.
std::size_t split_edges(LabelledTets& mesh, std::vector<std::uint32_t>& unit, const std::vector<Edge>& edges,
                        std::vector<Vec3>* plan) {
  if (edges.empty()) return 0;
  std::vector<char> is_end(mesh.points.size(), 0);
  for (const Edge& edge : edges) is_end[edge[0]] = is_end[edge[1]] = 1;
  std::vector<std::array<std::uint32_t, 2>> around;  // edge, tet
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
    for (const auto& [i, j] : tet_edges) {
      if (!is_end[mesh.tets[t][i]] || !is_end[mesh.tets[t][j]]) continue;
      const auto found = std::lower_bound(edges.begin(), edges.end(), edge_of(mesh.tets[t][i], mesh.tets[t][j]));
      if (found != edges.end() && *found == edge_of(mesh.tets[t][i], mesh.tets[t][j]))
        around.push_back({static_cast<std::uint32_t>(found - edges.begin()), t});
    }
  std::sort(around.begin(), around.end());
  std::vector<char> is_taken(mesh.tets.size(), 0);
  std::vector<std::uint32_t> changed;
  std::vector<std::uint32_t> middle(edges.size(), no_index);
  std::size_t count = 0;
  for (std::size_t begin = 0, end = 0; begin < around.size(); begin = end) {
    const std::uint32_t e = around[begin][0];
    const auto [a, b] = edges[e];
    while (end < around.size() && around[end][0] == e) ++end;
    const auto at = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
    bool is_good = true;
    for (std::size_t i = begin; i < end && is_good; ++i) {
      const Tet tet = mesh.tets[around[i][1]];
      is_good = is_taken[around[i][1]] == 0 && is_positive(mesh.points, replaced(tet, a, at)) &&
                is_positive(mesh.points, replaced(tet, b, at));
    }
    if (!is_good) {
      mesh.points.pop_back();
      continue;
    }
    ++count;
    middle[e] = at;
    if (plan) plan->push_back(0.5 * ((*plan)[a] + (*plan)[b]));
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t t = around[i][1];
      is_taken[t] = 1;
      changed.insert(changed.end(), {t, static_cast<std::uint32_t>(mesh.tets.size())});
      mesh.tets.push_back(replaced(mesh.tets[t], a, at));
      mesh.region.push_back(mesh.region[t]);
      unit.push_back(unit[t]);
      mesh.tets[t] = replaced(mesh.tets[t], b, at);
    }
  }
  const std::size_t facet_count = mesh.facets.size();
  for (std::size_t f = 0; f < facet_count; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.facets[f].vertices[k], b = mesh.facets[f].vertices[(k + 1) % 3];
      if (a >= is_end.size() || b >= is_end.size() || !is_end[a] || !is_end[b]) continue;
      const auto found = std::lower_bound(edges.begin(), edges.end(), edge_of(a, b));
      if (found == edges.end() || *found != edge_of(a, b) || middle[found - edges.begin()] == no_index) continue;
      SheetFacet second = mesh.facets[f];
      second.vertices[k] = middle[found - edges.begin()];
      mesh.facets[f].vertices[(k + 1) % 3] = second.vertices[k];
      mesh.facets.push_back(second);
      break;  // no other edge of it is split: its tetrahedron is taken
    }
  if (count > 0) reconnect(mesh, changed, facet_count);
  return count;
}

}  // namespace

std::size_t split_level_chords(LabelledTets& tets, StratigraphicLevels& levels, std::vector<Vec3>* plan) {
  constexpr int rounds = 40;
  std::size_t all = 0;
  for (int round = 0; round < rounds; ++round) {
    const std::size_t count = split_edges(tets, levels.unit, find_chords(tets, levels), plan);
    if (count == 0) break;
    all += count;
  }
  return all;
}

std::size_t split_flat_diagonals(LabelledTets& tets, StratigraphicLevels& levels, std::vector<Vec3>& plan,
                                 const StratigraphicTets& layers, const std::vector<std::uint32_t>& flipped) {
  std::vector<Edge> diagonals;
  for (const std::uint32_t t : flipped) {
    if (t >= layers.model_tets) continue;
    // Raising corner k by one adds twice the area of the opposite face in the plan; corners of one sign are opposite
    // to each other in the quadrilateral.
    const Tet& tet = tets.tets[t];
    std::vector<std::uint32_t> rising, falling;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto [a, b, c] = face_vertices(tet, k);
      (cross(plan[b] - plan[a], plan[c] - plan[a]).z < 0 ? rising : falling).push_back(k);
    }
    if (rising.size() != 2) continue;
    for (const auto& pair : {rising, falling}) {
      const std::uint32_t a = layers.tets[t][pair[0]], b = layers.tets[t][pair[1]];
      if (layers.w[a] != layers.w[b]) diagonals.push_back(edge_of(tet[pair[0]], tet[pair[1]]));
    }
  }
  sort_unique(diagonals);
  return split_edges(tets, levels.unit, diagonals, &plan);
}

std::size_t split_wall_chords(LabelledTets& tets, StratigraphicLevels& levels) {
  constexpr int rounds = 20;
  std::size_t all = 0;
  for (int round = 0; round < rounds; ++round) {
    const WallSheets sheets = find_wall_sheets(tets);
    std::vector<std::vector<std::uint32_t>> around(tets.points.size());
    for (std::uint32_t p = 0; p < around.size(); ++p) around[p] = sheets.sheets_at(p);
    const auto edge_between = [&](const Edge& ends) {
      for (const std::uint32_t e : sheets.point_edges[ends[0]])
        if (sheets.edges[e].points == ends) return e;
      return no_index;
    };
    std::vector<Edge> chords;
    for (const Tet& tet : tets.tets)
      for (const auto& [i, j] : tet_edges) {
        const Edge ends = edge_of(tet[i], tet[j]);
        if (around[ends[0]].empty() || around[ends[1]].empty()) continue;
        const std::uint32_t edge = edge_between(ends);
        bool is_chord = edge == no_index;
        for (const std::uint32_t sheet : around[ends[0]])
          is_chord = is_chord || (std::binary_search(around[ends[1]].begin(), around[ends[1]].end(), sheet) &&
                                  !sheets.is_in_sheet(edge, sheet));
        if (is_chord) chords.push_back(ends);
      }
    sort_unique(chords);
    const std::size_t count = split_edges(tets, levels.unit, chords, nullptr);
    if (count == 0) break;
    all += count;
  }
  return all;
}

std::size_t separate_walls(LabelledTets& tets, StratigraphicLevels& levels) {
  const auto tet_count = static_cast<std::uint32_t>(tets.tets.size());
  std::size_t all = 0;
  std::vector<std::uint32_t> changed;
  for (std::uint32_t t = 0; t < tet_count; ++t) {
    std::uint32_t walls = 0;
    for (std::uint32_t k = 0; k < 4; ++k) walls += tets.is_wall(4 * t + k) ? 1 : 0;
    if (walls < 2) continue;
    const Tet tet = tets.tets[t];
    const auto centre = static_cast<std::uint32_t>(tets.points.size());
    tets.points.push_back(0.25 * (tets.points[tet[0]] + tets.points[tet[1]] + tets.points[tet[2]] + tets.points[tet[3]]));
    bool is_good = true;
    for (const std::uint32_t v : tet) is_good = is_good && is_positive(tets.points, replaced(tet, v, centre));
    if (!is_good) {
      tets.points.pop_back();
      continue;
    }
    ++all;
    changed.push_back(t);
    for (std::size_t k = 1; k < 4; ++k) {
      changed.push_back(static_cast<std::uint32_t>(tets.tets.size()));
      tets.tets.push_back(replaced(tet, tet[k], centre));
      tets.region.push_back(tets.region[t]);
      levels.unit.push_back(levels.unit[t]);
    }
    tets.tets[t] = replaced(tet, tet[0], centre);
  }
  if (all > 0) reconnect(tets, changed, tets.facets.size());
  return all;
}

}  // namespace strataflow
