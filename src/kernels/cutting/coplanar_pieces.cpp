#include "kernels/cutting/coplanar_pieces.h"

#include <algorithm>
#include <array>

namespace strataflow {

namespace {

using DirectedEdge = std::array<std::uint32_t, 2>;

struct Pocket {
  std::uint32_t rank = 0;               ///< of its owner, among the overlapping
  std::uint32_t owner = 0;              ///< index into pieces
  std::uint32_t number = 0;             ///< its pocket there
  std::vector<std::uint32_t> vertices;  ///< ascending
  std::vector<DirectedEdge> outline;    ///< undirected (ascending) edges, ascending
  DirectedEdge first_edge{};            ///< outline.front() as the pieces run along it
};

Pocket describe(const CutPieces& pieces, std::uint32_t rank, std::uint32_t owner, std::uint32_t number) {
  Pocket pocket{rank, owner, number, {}, {}, {}};
  std::vector<std::array<std::uint32_t, 3>> edges;  // low, high, whether it runs from low to high
  for (std::size_t i = 0; i < pieces.triangles.size(); ++i) {
    if (pieces.pocket[i] != number) continue;
    const Triangle& t = pieces.triangles[i];
    for (int k = 0; k < 3; ++k) {
      pocket.vertices.push_back(t[k]);
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1u : 0u});
    }
  }
  std::sort(pocket.vertices.begin(), pocket.vertices.end());
  pocket.vertices.erase(std::unique(pocket.vertices.begin(), pocket.vertices.end()), pocket.vertices.end());
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool is_inner = i + 1 < edges.size() && edges[i][0] == edges[i + 1][0] && edges[i][1] == edges[i + 1][1];
    if (is_inner) {
      ++i;
      continue;
    }
    if (pocket.outline.empty())
      pocket.first_edge = edges[i][2] ? DirectedEdge{edges[i][0], edges[i][1]} : DirectedEdge{edges[i][1], edges[i][0]};
    pocket.outline.push_back({edges[i][0], edges[i][1]});
  }
  return pocket;
}

}  // namespace

void unify_coplanar_pieces(std::vector<CutPieces>& pieces, const std::vector<std::uint32_t>& overlapping) {
  std::vector<Pocket> pockets;
  for (std::uint32_t rank = 0; rank < overlapping.size(); ++rank) {
    const std::uint32_t owner = overlapping[rank];
    std::vector<std::uint32_t> size;
    for (const std::uint32_t number : pieces[owner].pocket) {
      if (number >= size.size()) size.resize(number + 1, 0);
      ++size[number];
    }
    for (std::uint32_t number = 0; number < size.size(); ++number)
      if (size[number] > 1)
        pockets.push_back(describe(pieces[owner], rank, owner, number));  // one piece is one way only
  }
  std::sort(pockets.begin(), pockets.end(), [](const Pocket& a, const Pocket& b) {
    if (a.vertices != b.vertices) return a.vertices < b.vertices;
    if (a.outline != b.outline) return a.outline < b.outline;
    return a.rank != b.rank ? a.rank < b.rank : a.number < b.number;
  });
  for (std::size_t i = 1, model = 0; i < pockets.size(); ++i) {
    const Pocket &first = pockets[model], &other = pockets[i];
    if (first.vertices != other.vertices || first.outline != other.outline) {
      model = i;
      continue;
    }
    const CutPieces& from = pieces[first.owner];
    CutPieces& to = pieces[other.owner];
    const bool turn = first.first_edge != other.first_edge;
    std::size_t next = 0;
    for (std::size_t k = 0; k < from.triangles.size(); ++k) {
      if (from.pocket[k] != first.number) continue;
      while (to.pocket[next] != other.number) ++next;
      Triangle t = from.triangles[k];
      if (turn) std::swap(t[1], t[2]);
      to.triangles[next++] = t;
    }
  }
}

}  // namespace strataflow
