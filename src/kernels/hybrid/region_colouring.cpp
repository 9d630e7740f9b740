#include "kernels/hybrid/region_colouring.h"

#include <algorithm>

namespace strataflow {

RegionColouring colour_regions(const PiercedEdges& graph) {
  const std::size_t edge_count = graph.edges.size();
  RegionColouring colouring;
  colouring.vertex_region.assign(graph.vertex_count, RegionColouring::unreached);
  colouring.piece_region.assign(graph.crossings.size() + edge_count, RegionColouring::unreached);
  std::vector<std::uint32_t> begin(graph.vertex_count + 1, 0), around;
  const auto ends_at = [&](std::size_t e, std::size_t end) { return graph.edges[e][end] != PiercedEdges::at_infinity; };
  for (std::size_t e = 0; e < edge_count; ++e)
    for (std::size_t end = 0; end < 2; ++end)
      if (ends_at(e, end)) ++begin[graph.edges[e][end] + 1];
  for (std::size_t v = 0; v < graph.vertex_count; ++v) begin[v + 1] += begin[v];
  around.resize(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t e = 0; e < edge_count; ++e)
    for (std::size_t end = 0; end < 2; ++end)
      if (ends_at(e, end)) around[next[graph.edges[e][end]]++] = e;

  std::vector<char> is_inconsistent(edge_count, 0);
  std::vector<std::uint32_t> front;
  const auto tell = [&](std::uint32_t e, std::size_t end, std::uint32_t region) {  // whether it was news
    if (!ends_at(e, end)) {
      if (region != universe) is_inconsistent[e] = 1;
      return false;
    }
    std::uint32_t& known = colouring.vertex_region[graph.edges[e][end]];
    if (known != RegionColouring::unreached) {
      if (known != region) is_inconsistent[e] = 1;
      return false;
    }
    known = region;
    front.push_back(graph.edges[e][end]);
    return true;
  };
  // What the crossings of an edge say needs no way there.
  for (std::uint32_t e = 0; e < edge_count; ++e) {
    const std::uint32_t first = graph.crossing_begin[e], last = graph.crossing_begin[e + 1];
    std::uint32_t* const pieces = &colouring.piece_region[first + e];
    for (std::uint32_t c = first; c < last; ++c) {
      const EdgeCrossing& crossing = graph.crossings[c];
      if (c > first && pieces[c - first] != crossing.from_region) is_inconsistent[e] = 1;
      if (c == first) pieces[0] = crossing.from_region;
      pieces[c - first + 1] = crossing.to_region;
    }
    if (first == last) continue;
    tell(e, 0, pieces[0]);
    tell(e, 1, pieces[last - first]);
  }
  for (std::uint32_t e = 0; e < edge_count; ++e)  // an edge to infinity without crossings lies outside
    if (!ends_at(e, 1) && graph.crossing_begin[e] == graph.crossing_begin[e + 1]) {
      colouring.piece_region[graph.crossing_begin[e] + e] = universe;
      tell(e, 0, universe);
    }
  std::vector<char> was_needed(edge_count, 0);
  while (!front.empty()) {
    const std::uint32_t v = front.back();
    front.pop_back();
    for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i) {
      const std::uint32_t e = around[i];
      if (graph.crossing_begin[e] != graph.crossing_begin[e + 1]) continue;  // told already
      const std::uint32_t region = colouring.vertex_region[v];
      std::uint32_t& piece = colouring.piece_region[graph.crossing_begin[e] + e];
      if (piece == RegionColouring::unreached) {
        piece = region;
        if (tell(e, graph.edges[e][0] == v ? 1 : 0, region)) was_needed[e] = 1;
      } else if (piece != region) {
        is_inconsistent[e] = 1;
      }
    }
  }
  for (std::uint32_t e = 0; e < edge_count; ++e) {
    if (is_inconsistent[e])
      colouring.inconsistent_edges.push_back(e);
    else if (!was_needed[e])
      ++colouring.checked_edges;
  }
  return colouring;
}

}  // namespace strataflow
