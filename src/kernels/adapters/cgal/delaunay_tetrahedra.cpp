#include "kernels/adapters/cgal/delaunay_tetrahedra.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/id.h"

namespace strataflow {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel,
    CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>,
                                         CGAL::Triangulation_cell_base_with_info_3<
                                             std::uint32_t, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>>;

}  // namespace

DelaunayTetrahedra delaunay_tetrahedra(std::span<const Vec3> points) {
  std::vector<std::pair<Delaunay::Point, std::uint32_t>> sites;
  sites.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    sites.push_back({Delaunay::Point(points[i].x, points[i].y, points[i].z), i});
  // Points at one position: only the lowest goes in.
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
              sites.end());
  const Delaunay delaunay(sites.begin(), sites.end());
  DelaunayTetrahedra result;
  if (delaunay.dimension() < 3) return result;

  std::vector<Delaunay::Cell_handle> cells;
  std::vector<std::array<std::uint32_t, 4>> sorted;
  for (const auto cell : delaunay.finite_cell_handles()) {
    auto& corners = sorted.emplace_back();
    for (int k = 0; k < 4; ++k) corners[static_cast<std::size_t>(k)] = cell->vertex(k)->info();
    std::sort(corners.begin(), corners.end());
    cells.push_back(cell);
  }
  std::vector<std::uint32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return sorted[a] < sorted[b]; });
  for (const auto cell : delaunay.all_cell_handles()) cell->info() = no_index;
  for (std::uint32_t t = 0; t < order.size(); ++t) cells[order[t]]->info() = t;
  for (const std::uint32_t c : order) {
    // Corners ascending but for the last two, which give the orientation.
    std::array<std::uint32_t, 4> corners = sorted[c], beyond{};
    bool is_odd = false;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) is_odd ^= cells[c]->vertex(i)->info() > cells[c]->vertex(j)->info();
    if (is_odd) std::swap(corners[2], corners[3]);
    for (int k = 0; k < 4; ++k) {
      const auto place = std::find(corners.begin(), corners.end(), cells[c]->vertex(k)->info()) - corners.begin();
      beyond[static_cast<std::size_t>(place)] = cells[c]->neighbor(k)->info();
    }
    result.tets.push_back(corners);
    result.beyond.push_back(beyond);
  }
  return result;
}

}  // namespace strataflow
