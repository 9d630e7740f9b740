#include "kernels/voronoi/restricted_diagram.h"

#include <algorithm>

#include "graph/parallel/parallel_map.h"
#include "kernels/voronoi/triangle_cells.h"

namespace strataflow {

void find_owners(std::span<const Vec3> points, const SiteNeighbours& neighbours, std::vector<std::uint32_t>& owners) {
  const std::size_t site_count = neighbours.sites().size();
  const bool has_guesses =
      owners.size() == points.size() &&
      std::all_of(owners.begin(), owners.end(), [&](std::uint32_t owner) { return owner < site_count; });
  owners.resize(points.size());
  parallel_ranges(points.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      owners[i] = find_nearest_site(neighbours, points[i],
                                    has_guesses ? owners[i] : neighbours.find_nearest_listed(points[i]));
  });
}

RestrictedDiagram restrict_to_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                        const SiteNeighbours& neighbours) {
  std::vector<std::uint32_t> owners;
  find_owners(points, neighbours, owners);
  constexpr std::size_t grain = 512;
  const std::size_t chunk_count = (triangles.size() + grain - 1) / grain;
  const std::vector<RestrictedDiagram> chunks = parallel_map(chunk_count, [&](std::size_t chunk) {
    RestrictedDiagram part;
    TriangleCells cells(neighbours);
    const std::size_t end = std::min(triangles.size(), (chunk + 1) * grain);
    for (std::size_t t = chunk * grain; t < end; ++t) {
      const Triangle& corners = triangles[t];
      cells.cut({points[corners[0]], points[corners[1]], points[corners[2]]}, owners[corners[0]]);
      for (std::size_t i = 0; i < cells.piece_count(); ++i) {
        const TrianglePiece piece = cells.piece(i);
        part.piece_triangle.push_back(static_cast<std::uint32_t>(t));
        part.piece_site.push_back(piece.site);
        part.piece_begin.push_back(static_cast<std::uint32_t>(part.points.size()));
        part.points.insert(part.points.end(), piece.points.begin(), piece.points.end());
        part.edges.insert(part.edges.end(), piece.edges.begin(), piece.edges.end());
      }
    }
    return part;
  });
  RestrictedDiagram whole;
  for (const RestrictedDiagram& part : chunks) {
    const auto offset = static_cast<std::uint32_t>(whole.points.size());
    for (const std::uint32_t begin : part.piece_begin) whole.piece_begin.push_back(offset + begin);
    whole.piece_triangle.insert(whole.piece_triangle.end(), part.piece_triangle.begin(), part.piece_triangle.end());
    whole.piece_site.insert(whole.piece_site.end(), part.piece_site.begin(), part.piece_site.end());
    whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
    whole.edges.insert(whole.edges.end(), part.edges.begin(), part.edges.end());
  }
  whole.piece_begin.push_back(static_cast<std::uint32_t>(whole.points.size()));
  return whole;
}

}  // namespace strataflow
