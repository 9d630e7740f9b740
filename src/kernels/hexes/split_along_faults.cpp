#include "kernels/hexes/split_along_faults.h"

#include "kernels/topology/union_find.h"

namespace strataflow {

FaultSplit split_along_faults(const LabelledTets& tets) {
  const auto corner_count = static_cast<std::uint32_t>(4 * tets.tets.size());
  const auto point_of = [&](std::uint32_t corner) { return tets.tets[corner / 4][corner % 4]; };
  // Only where the star of a point has a skin, of faults or of the outside, can it fall into parts.
  enum : char { unused, whole, parted };
  std::vector<char> kind(tets.points.size(), unused);
  for (std::uint32_t c = 0; c < corner_count; ++c) kind[point_of(c)] = whole;
  for (std::uint32_t face = 0; face < corner_count; ++face)
    if (tets.neighbour[face] == no_index || tets.has(face, SheetKind::fault))
      for (std::uint32_t k = 0; k < 4; ++k)
        if (k != face % 4) kind[tets.tets[face / 4][k]] = parted;
  UnionFind corners(corner_count);
  for (std::uint32_t face = 0; face < corner_count; ++face) {
    const std::uint32_t other = tets.neighbour[face];
    if (other == no_index || other < face || tets.has(face, SheetKind::fault)) continue;
    const std::uint32_t t = face / 4, s = other / 4;
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (k == face % 4 || kind[tets.tets[t][k]] != parted) continue;
      for (std::uint32_t l = 0; l < 4; ++l)
        if (tets.tets[t][k] == tets.tets[s][l]) corners.unite(4 * t + k, 4 * s + l);
    }
  }
  // Copies by point, then by their first corner.
  std::vector<std::uint32_t> first(tets.points.size() + 1, 0);
  const auto is_first = [&](std::uint32_t c) { return kind[point_of(c)] == parted && corners.find(c) == c; };
  for (std::uint32_t c = 0; c < corner_count; ++c) first[point_of(c) + 1] += is_first(c) ? 1 : 0;
  FaultSplit split;
  for (std::uint32_t p = 0; p < tets.points.size(); ++p) {
    const std::uint32_t count = kind[p] == whole ? 1 : first[p + 1];
    first[p] = static_cast<std::uint32_t>(split.original.size());
    split.original.insert(split.original.end(), count, p);
  }
  std::vector<std::uint32_t> copy(corner_count, 0), next = first;
  for (std::uint32_t c = 0; c < corner_count; ++c)
    if (is_first(c)) copy[c] = next[point_of(c)]++;
  split.tets.resize(tets.tets.size());
  for (std::uint32_t c = 0; c < corner_count; ++c)
    split.tets[c / 4][c % 4] = kind[point_of(c)] == whole ? first[point_of(c)] : copy[corners.find(c)];
  return split;
}

}  // namespace strataflow
