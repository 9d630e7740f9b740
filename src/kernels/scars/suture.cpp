#include "kernels/scars/suture.h"

#include <algorithm>

#include "base/id.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

/// Corners linked across an edge: those of h against those of its mate, which coincides with it.
void link_corners(const TriangleSoup& soup, std::uint32_t h, std::uint32_t mate, UnionFind& corners) {
  const auto corner = [](std::uint32_t half_edge, std::uint32_t end) {
    return half_edge / 3 * 3 + (half_edge % 3 + end) % 3;
  };
  const auto position = [&](std::uint32_t c) { return soup.points[soup.triangles[c / 3][c % 3]]; };
  const std::uint32_t same_way = position(corner(h, 0)) == position(corner(mate, 0)) ? 1 : 0;
  corners.unite(corner(h, 0), corner(mate, 1 - same_way));
  corners.unite(corner(h, 1), corner(mate, same_way));
}

/// Edges of the sewn mesh that carry several edges of one entity which no pair joins: per such edge, one half-edge.
std::vector<std::uint32_t> find_glued(const TriangleSoup& soup, const SewnSoup& sewn) {
  std::vector<std::uint32_t> glued;
  const EdgeTable edges = build_edge_table(soup.points.size(), sewn.triangles);
  const auto ends = [&](std::uint32_t h) {
    const std::uint32_t a = soup.triangles[h / 3][h % 3], b = soup.triangles[h / 3][(h % 3 + 1) % 3];
    return std::pair(std::min(a, b), std::max(a, b));
  };
  const auto entity = [&](std::uint32_t h) { return soup.patch_entity[soup.triangle_patch[h / 3]]; };
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e) {
    const auto around = edges.around(e);
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = i + 1; j < around.size(); ++j)
        if (sewn.mates[around[i]] != around[j] && entity(around[i]) == entity(around[j]) &&
            ends(around[i]) != ends(around[j])) {
          glued.push_back(around[i]);
          i = j = around.size();
        }
  }
  return glued;
}

}  // namespace

SewnSoup suture(const TriangleSoup& soup, const std::vector<std::uint32_t>& mates, std::vector<LipPair> pairs) {
  SewnSoup sewn;
  sewn.pairs = std::move(pairs);
  for (;;) {
    sewn.mates = mates;
    for (const LipPair& pair : sewn.pairs) {
      sewn.mates[pair.first] = pair.second;
      sewn.mates[pair.second] = pair.first;
    }
    UnionFind corners(3 * soup.triangles.size());
    for (std::uint32_t h = 0; h < sewn.mates.size(); ++h)
      if (sewn.mates[h] != no_index && h < sewn.mates[h]) link_corners(soup, h, sewn.mates[h], corners);
    std::vector<std::uint32_t> lowest(3 * soup.triangles.size(), no_index);
    for (std::uint32_t c = 0; c < lowest.size(); ++c) {
      std::uint32_t& low = lowest[corners.find(c)];
      low = std::min(low, soup.triangles[c / 3][c % 3]);
    }
    sewn.triangles.resize(soup.triangles.size());
    for (std::uint32_t c = 0; c < lowest.size(); ++c) sewn.triangles[c / 3][c % 3] = lowest[corners.find(c)];

    // An edge that was to stay open may have had both its ends sewn by its neighbours: open the worst of those again.
    std::vector<char> dropped(sewn.pairs.size(), 0);
    for (const std::uint32_t h : find_glued(soup, sewn)) {
      const std::uint32_t a = sewn.triangles[h / 3][h % 3], b = sewn.triangles[h / 3][(h % 3 + 1) % 3];
      std::size_t worst = sewn.pairs.size();
      for (std::size_t i = 0; i < sewn.pairs.size(); ++i) {
        const std::uint32_t p = sewn.pairs[i].first;
        const std::uint32_t c = sewn.triangles[p / 3][p % 3], d = sewn.triangles[p / 3][(p % 3 + 1) % 3];
        if ((a == c || a == d || b == c || b == d) &&
            (worst == sewn.pairs.size() || sewn.pairs[i].deviation_rad > sewn.pairs[worst].deviation_rad))
          worst = i;
      }
      if (worst < sewn.pairs.size()) dropped[worst] = 1;
    }
    std::vector<LipPair> kept;
    for (std::size_t i = 0; i < sewn.pairs.size(); ++i) {
      if (!dropped[i]) {
        kept.push_back(sewn.pairs[i]);
        continue;
      }
      for (const std::uint32_t h : {sewn.pairs[i].first, sewn.pairs[i].second})
        sewn.refused.push_back({h, LipRefusal::pinch});
    }
    if (kept.size() == sewn.pairs.size()) break;
    sewn.pairs = std::move(kept);
  }
  UnionFind patches(soup.patch_entity.size());
  for (const LipPair& pair : sewn.pairs) {
    const std::uint32_t a = soup.triangle_patch[pair.first / 3], b = soup.triangle_patch[pair.second / 3];
    if (soup.entities_of(a) == soup.entities_of(b)) patches.unite(a, b);
  }
  sewn.triangle_patch.resize(soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) sewn.triangle_patch[t] = patches.find(soup.triangle_patch[t]);
  return sewn;
}

}  // namespace strataflow
