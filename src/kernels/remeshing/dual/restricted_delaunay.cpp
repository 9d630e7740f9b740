#include "kernels/remeshing/dual/restricted_delaunay.h"

#include <algorithm>

#include "graph/parallel/sort_total_order.h"

namespace strataflow {

namespace {

void sort_and_unique(std::vector<std::array<std::uint32_t, 2>>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace

RestrictedDelaunay restricted_delaunay(const RestrictedDiagram& diagram, const CellComponents& components) {
  struct Meeting {
    Triangle sorted, turned;
    std::uint32_t slot;
  };
  std::vector<Meeting> meetings;
  RestrictedDelaunay dual;
  for (std::uint32_t piece = 0; piece < diagram.piece_count(); ++piece) {
    const std::uint32_t site = diagram.piece_site[piece];
    for (std::uint32_t slot = diagram.piece_begin[piece]; slot < diagram.piece_begin[piece + 1]; ++slot) {
      const PieceEdge after = diagram.edges[slot], before = diagram.edges[previous_in_piece(diagram, piece, slot)];
      if (after.is_triangle_edge()) continue;
      if (site < after.site()) dual.edges.push_back({site, after.site()});
      if (before.is_triangle_edge() || after.site() < site || before.site() < site) continue;
      Meeting meeting{{site, before.site(), after.site()}, {site, before.site(), after.site()}, slot};
      std::sort(meeting.sorted.begin(), meeting.sorted.end());
      meetings.push_back(meeting);
    }
  }
  sort_total_order(meetings, [](const Meeting& a, const Meeting& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : a.slot < b.slot;
  });
  for (std::size_t k = 0; k < meetings.size(); ++k)
    if (k == 0 || meetings[k].sorted != meetings[k - 1].sorted) dual.triangles.push_back(meetings[k].turned);
  for (std::size_t l = 0; l + 1 < components.line_begin.size(); ++l)
    for (std::uint32_t part = components.line_begin[l] + 1; part < components.line_begin[l + 1]; ++part) {
      const std::uint32_t a = components.parts[part - 1].site, b = components.parts[part].site;
      if (a != b) dual.line_edges.push_back({std::min(a, b), std::max(a, b)});
    }
  sort_and_unique(dual.edges);
  sort_and_unique(dual.line_edges);
  return dual;
}

}  // namespace strataflow
