#include "kernels/hexes/split_along_faults.h"

#include <algorithm>

#include "kernels/topology/union_find.h"

namespace strataflow {

FaultSplit split_along_faults(const LabelledTets& tets) {
  const auto corner_count = static_cast<std::uint32_t>(4 * tets.tets.size());
  UnionFind corners(corner_count);
  for (std::uint32_t face = 0; face < corner_count; ++face) {
    const std::uint32_t other = tets.neighbour[face];
    if (other == no_index || other < face || tets.has(face, SheetKind::fault)) continue;
    const std::uint32_t t = face / 4, s = other / 4;
    for (std::uint32_t k = 0; k < 4; ++k)
      for (std::uint32_t l = 0; l < 4; ++l)
        if (k != face % 4 && tets.tets[t][k] == tets.tets[s][l]) corners.unite(4 * t + k, 4 * s + l);
  }
  std::vector<std::uint32_t> roots;
  for (std::uint32_t c = 0; c < corner_count; ++c)
    if (corners.find(c) == c) roots.push_back(c);
  const auto point_of = [&](std::uint32_t corner) { return tets.tets[corner / 4][corner % 4]; };
  std::sort(roots.begin(), roots.end(), [&](std::uint32_t a, std::uint32_t b) {
    return point_of(a) != point_of(b) ? point_of(a) < point_of(b) : a < b;
  });
  FaultSplit split;
  std::vector<std::uint32_t> copy(corner_count, 0);
  for (const std::uint32_t root : roots) {
    copy[root] = static_cast<std::uint32_t>(split.original.size());
    split.original.push_back(point_of(root));
  }
  split.tets.resize(tets.tets.size());
  for (std::uint32_t c = 0; c < corner_count; ++c) split.tets[c / 4][c % 4] = copy[corners.find(c)];
  return split;
}

}  // namespace strataflow
