#include "kernels/complexity/cells/voronoi_pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/id.h"
#include "base/seed.h"
#include "kernels/voronoi/cvt_volume_energy.h"
#include "kernels/voronoi/optimise_sites.h"
#include "kernels/voronoi/restricted_diagram.h"

namespace strataflow {

std::vector<Vec3> spread_in_box(const Box3& box, std::uint32_t cells, std::uint64_t seed) {
  const Vec3 extent = box.high - box.low;
  RandomStream random(seed);
  std::vector<Vec3> sites;
  for (std::uint32_t i = 0; i < cells; ++i) {
    const double u = random.unit(), v = random.unit(), w = random.unit();
    sites.push_back(box.low + Vec3{u * extent.x, v * extent.y, w * extent.z});
  }
  const double width_m = std::cbrt(extent.x * extent.y * extent.z / cells);
  const double longest_m = std::max({extent.x, extent.y, extent.z});
  const auto blocks = static_cast<std::size_t>(std::ceil(longest_m / (5 * width_m)));  // few tetrahedra cut a cell
  const TetrahedralBox domain = tetrahedral_box(box.low, box.high, blocks);
  CvtVolumeEnergy energy(domain.points, domain.tetrahedra);
  return optimise_sites(energy, std::move(sites), {}, {.lloyd_iterations = 5, .iterations = 30}).sites;
}

CellPieces cut_by_voronoi(const StructuralModel& model, const EdgeTable& edges, const SiteNeighbours& sites) {
  CellPieces result;
  result.sites = sites.sites();
  const std::size_t cells = result.sites.size();
  const Vec3 extent = model.box.high - model.box.low;
  result.resolution_m = std::cbrt(extent.x * extent.y * extent.z / static_cast<double>(cells));
  const RestrictedDiagram diagram = restrict_to_triangles(model.points, model.triangles, sites);
  std::vector<std::uint32_t> owners;
  find_owners(model.points, sites, owners);

  std::vector<std::pair<std::uint32_t, SurfacePiece>> surface_pairs;
  std::vector<std::uint32_t> first_piece(model.triangles.size() + 1, 0);
  for (std::uint32_t i = 0; i < diagram.piece_count(); ++i) {
    const auto points = diagram.piece_points(i);
    SurfacePiece piece{diagram.piece_triangle[i], 0, 0};
    Vec3 twice;
    for (std::size_t k = 2; k < points.size(); ++k)
      twice = twice + cross(points[k - 1] - points[0], points[k] - points[0]);
    piece.area_m2 = 0.5 * length(twice);
    for (const PieceEdge& edge : diagram.piece_edges(i))
      if (edge.is_triangle_edge()) piece.edges |= 1u << edge.triangle_edge();
    surface_pairs.emplace_back(diagram.piece_site[i], piece);
    first_piece[piece.triangle + 1] = i + 1;
  }
  for (std::size_t t = 0; t < model.triangles.size(); ++t) first_piece[t + 1] = std::max(first_piece[t], first_piece[t + 1]);
  group_by_cell(surface_pairs, cells, result.first_surface, result.surface_pieces);

  // An edge of a line is cut as the triangles beside it are; they agree, so one of them will do.
  std::vector<std::pair<std::uint32_t, LinePiece>> line_pairs;
  for (std::uint32_t l = 0; l < model.lines.size(); ++l) {
    const Line& line = model.lines[l];
    const auto count = static_cast<std::uint32_t>(line.vertices.size());
    for (std::uint32_t i = 0; i < (line.is_closed() ? count : count - 1); ++i) {
      const std::uint32_t from = line.vertices[i], to = line.vertices[(i + 1) % count];
      const std::uint32_t e = find_edge(edges, from, to);
      if (e == no_index) continue;
      const std::uint32_t h = edges.around(e)[0];
      for (std::uint32_t piece = first_piece[h / 3]; piece < first_piece[h / 3 + 1]; ++piece) {
        const auto points = diagram.piece_points(piece);
        const auto labels = diagram.piece_edges(piece);
        const std::uint32_t cell = diagram.piece_site[piece];
        for (std::size_t k = 0; k < labels.size(); ++k) {
          if (!labels[k].is_triangle_edge() || labels[k].triangle_edge() != h % 3) continue;
          const std::uint32_t ends = (owners[from] == cell ? 1u : 0u) | (owners[to] == cell ? 2u : 0u);
          line_pairs.emplace_back(cell, LinePiece{l, i, ends, 0, length(points[(k + 1) % points.size()] - points[k])});
        }
      }
    }
  }
  group_by_cell(line_pairs, cells, result.first_line, result.line_pieces);

  std::vector<std::pair<std::uint32_t, std::uint32_t>> corner_pairs;
  for (std::uint32_t c = 0; c < model.corners.size(); ++c) corner_pairs.emplace_back(owners[model.corners[c].vertex], c);
  group_by_cell(corner_pairs, cells, result.first_corner, result.corners);
  return result;
}

}  // namespace strataflow
