#include "kernels/topology/building/edge_table.h"

#include <algorithm>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {
struct Entry {
  std::uint32_t high;
  std::uint32_t half_edge;
  friend auto operator<=>(const Entry&, const Entry&) = default;
};
}  // namespace

EdgeTable build_edge_table(std::size_t point_count, const std::vector<Triangle>& triangles) {
  // Half-edges are binned by their lower vertex; a bin holds a handful and is sorted on its own.
  std::vector<std::uint32_t> bin(point_count + 1, 0);
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++bin[std::min(t[k], t[(k + 1) % 3]) + 1];
  for (std::size_t v = 0; v < point_count; ++v) bin[v + 1] += bin[v];
  std::vector<Entry> entries(3 * triangles.size());
  {
    std::vector<std::uint32_t> next(bin.begin(), bin.end() - 1);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
        entries[next[std::min(a, b)]++] = {std::max(a, b), 3 * t + k};
      }
  }
  parallel_ranges(point_count, 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) std::sort(entries.begin() + bin[v], entries.begin() + bin[v + 1]);
  });

  EdgeTable table;
  table.half_edges.resize(entries.size());
  table.edge_of.resize(entries.size());
  table.edges.reserve(entries.size() / 2 + 1);
  table.first.reserve(entries.size() / 2 + 2);
  for (std::uint32_t v = 0; v < point_count; ++v)
    for (std::uint32_t i = bin[v]; i < bin[v + 1]; ++i) {
      if (i == bin[v] || entries[i].high != entries[i - 1].high) {
        table.edges.push_back({v, entries[i].high});
        table.first.push_back(i);
      }
      table.half_edges[i] = entries[i].half_edge;
      table.edge_of[entries[i].half_edge] = static_cast<std::uint32_t>(table.edges.size() - 1);
    }
  table.first.push_back(static_cast<std::uint32_t>(entries.size()));
  return table;
}

std::uint32_t find_edge(const EdgeTable& table, std::uint32_t a, std::uint32_t b) {
  const std::array<std::uint32_t, 2> key{std::min(a, b), std::max(a, b)};
  const auto place = std::lower_bound(table.edges.begin(), table.edges.end(), key);
  if (place == table.edges.end() || *place != key) return no_index;
  return static_cast<std::uint32_t>(place - table.edges.begin());
}

}  // namespace strataflow
