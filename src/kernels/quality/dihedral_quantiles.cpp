#include "kernels/quality/dihedral_quantiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/quality/measure_cell.h"

namespace strataflow {
namespace {

using Edge = std::array<std::uint32_t, 2>;
using Face = std::array<std::uint32_t, 3>;

/// A tetrahedron at an edge of a surface: its angle there, and the faces that lead to its neighbours around the edge.
struct Spoke {
  Edge edge{};
  std::uint32_t cell = 0;
  double angle_deg = 0;
  std::array<Face, 2> faces{};
};

Face sorted(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

/// The dihedral angles of one cell, each once, in the order of measure_cell.
CellMeasures measures_of(const VolumeMesh& mesh, std::size_t cell) {
  std::array<Vec3, 8> points;
  const int count = vertex_count(mesh.cell_types[cell]);
  for (int i = 0; i < count; ++i) points[i] = mesh.points[mesh.cell_vertices[mesh.cell_offsets[cell] + i]];
  return measure_cell(mesh.cell_types[cell], std::span<const Vec3>(points).first(count));
}

std::vector<Spoke> spokes_of(const VolumeMesh& mesh, const std::vector<Edge>& edges) {
  std::vector<char> is_on_surface(mesh.points.size(), 0);
  for (const Edge& edge : edges) is_on_surface[edge[0]] = is_on_surface[edge[1]] = 1;
  std::vector<Spoke> spokes;
  for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
    if (mesh.cell_types[cell] != CellType::tetrahedron) continue;
    const std::uint32_t* v = &mesh.cell_vertices[mesh.cell_offsets[cell]];
    if (is_on_surface[v[0]] + is_on_surface[v[1]] + is_on_surface[v[2]] + is_on_surface[v[3]] < 2) continue;
    const CellMeasures measures = measures_of(mesh, cell);
    std::uint32_t next = 0;
    for (const CornerFrame& frame : shape_of(CellType::tetrahedron).corners)
      for (const std::uint8_t end : frame.ends) {
        if (end < frame.corner) continue;
        const double angle_deg = measures.dihedral_deg[next++];
        const Edge edge{std::min(v[frame.corner], v[end]), std::max(v[frame.corner], v[end])};
        if (!std::binary_search(edges.begin(), edges.end(), edge)) continue;
        Spoke spoke{edge, cell, angle_deg, {}};
        std::size_t face = 0;
        for (std::uint8_t other = 0; other < 4; ++other)
          if (other != frame.corner && other != end) spoke.faces[face++] = sorted({edge[0], edge[1], v[other]});
        spokes.push_back(spoke);
      }
  }
  sort_total_order(spokes,
                   [](const Spoke& a, const Spoke& b) { return a.edge != b.edge ? a.edge < b.edge : a.cell < b.cell; });
  return spokes;
}

/// Per cell 1 if it lies in a wedge; and the sharpest wedge, 0 if there is none.
double mark_wedges(const VolumeMesh& mesh, std::vector<char>& is_in_wedge) {
  std::vector<Face> facets;
  std::vector<Edge> edges;
  for (const MeshFacet& facet : mesh.facets) {
    if (facet.vertices[3] != no_index) continue;
    facets.push_back(sorted({facet.vertices[0], facet.vertices[1], facet.vertices[2]}));
    for (const Edge& e : {Edge{0, 1}, Edge{0, 2}, Edge{1, 2}})
      edges.push_back({facets.back()[e[0]], facets.back()[e[1]]});
  }
  std::sort(facets.begin(), facets.end());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const std::vector<Spoke> spokes = spokes_of(mesh, edges);
  double sharpest = 0;
  std::vector<std::size_t> sector;  // per spoke of an edge: the first spoke of its sector, between two surfaces
  for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
    while (end < spokes.size() && spokes[end].edge == spokes[begin].edge) ++end;
    sector.resize(end - begin);
    std::iota(sector.begin(), sector.end(), std::size_t{0});
    for (std::size_t i = 0; i < sector.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (const Face& mine : spokes[begin + i].faces)
          for (const Face& its : spokes[begin + j].faces) {
            if (mine != its || sector[i] == sector[j] || std::binary_search(facets.begin(), facets.end(), mine))
              continue;
            const std::size_t from = std::max(sector[i], sector[j]), to = std::min(sector[i], sector[j]);
            std::replace(sector.begin(), sector.end(), from, to);
          }
    for (std::size_t i = 0; i < sector.size(); ++i) {
      if (sector[i] != i) continue;
      double sum_deg = 0;
      for (std::size_t j = i; j < sector.size(); ++j)
        if (sector[j] == i) sum_deg += spokes[begin + j].angle_deg;
      if (!(sum_deg < DihedralQuantiles::wedge_deg)) continue;
      sharpest = sharpest > 0 ? std::min(sharpest, sum_deg) : sum_deg;
      for (std::size_t j = i; j < sector.size(); ++j)
        if (sector[j] == i) is_in_wedge[spokes[begin + j].cell] = 1;
    }
  }
  return sharpest;
}

std::vector<AngleQuantile> quantiles_of(std::vector<double>& angles_deg) {
  std::vector<AngleQuantile> quantiles;
  if (angles_deg.empty()) return quantiles;
  auto first = angles_deg.begin();
  for (const double share : {0.0001, 0.001, 0.01, 0.05, 0.5}) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(angles_deg.size())));
    const auto at = angles_deg.begin() + std::max<std::ptrdiff_t>(rank - 1, 0);
    std::nth_element(first, at, angles_deg.end());
    quantiles.push_back({share, *at});
    first = at;
  }
  return quantiles;
}

}  // namespace

DihedralQuantiles dihedral_quantiles(const VolumeMesh& mesh) {
  DihedralQuantiles report;
  std::vector<char> is_in_wedge(mesh.cell_count(), 0);
  report.sharpest_wedge_deg = mark_wedges(mesh, is_in_wedge);
  report.cells_in_wedges = static_cast<std::uint64_t>(std::count(is_in_wedge.begin(), is_in_wedge.end(), 1));
  constexpr std::size_t block = 4096;
  const auto parts = parallel_map((mesh.cell_count() + block - 1) / block, [&](std::size_t index) {
    std::array<std::vector<double>, 2> angles_deg;  // outside wedges, in them
    for (std::size_t cell = index * block; cell < std::min(mesh.cell_count(), (index + 1) * block); ++cell) {
      const CellMeasures measures = measures_of(mesh, cell);
      std::vector<double>& list = angles_deg[static_cast<std::size_t>(is_in_wedge[cell])];
      list.insert(list.end(), measures.dihedral_deg.begin(), measures.dihedral_deg.begin() + measures.dihedral_count);
    }
    return angles_deg;
  });
  std::vector<double> outside, all;
  for (const auto& part : parts) outside.insert(outside.end(), part[0].begin(), part[0].end());
  all = outside;
  for (const auto& part : parts) all.insert(all.end(), part[1].begin(), part[1].end());
  report.all = quantiles_of(all);
  if (!outside.empty()) report.min_outside_wedges_deg = *std::min_element(outside.begin(), outside.end());
  report.outside_wedges = quantiles_of(outside);
  return report;
}

}  // namespace strataflow
