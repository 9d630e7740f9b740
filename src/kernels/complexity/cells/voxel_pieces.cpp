#include "kernels/complexity/cells/voxel_pieces.h"

#include <algorithm>
#include <cmath>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 512;  ///< triangles

using Polygon = std::vector<Vec3>;

/// The part of a convex polygon above a plane across an axis (at or above), or below it (strictly).
void clip(const Polygon& polygon, int axis, double plane, bool above, Polygon& part) {
  part.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const bool p_in = (p[axis] >= plane) == above, q_in = (q[axis] >= plane) == above;
    if (p_in) part.push_back(p);
    if (p_in == q_in) continue;
    Vec3 cut = p + ((plane - p[axis]) / (q[axis] - p[axis])) * (q - p);
    cut[axis] = plane;
    part.push_back(cut);
  }
}

double area_m2(const Polygon& polygon) {
  Vec3 twice;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice = twice + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * length(twice);
}

/// Calls visit(cell, length) for the voxels a segment passes, in order. Depends on the order of its ends in rounding
/// only: give the lower vertex first and both triangles of an edge hear the same.
template <class Visit>
void visit_along(const VoxelGrid& grid, const Vec3& from, const Vec3& to, std::vector<double>& stops, Visit&& visit) {
  stops.assign({0, 1});
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::min(from[axis], to[axis]), high = std::max(from[axis], to[axis]);
    for (std::uint32_t i = grid.index_along(axis, low) + 1; i < grid.count(axis) && grid.planes[axis][i] < high; ++i)
      if (grid.planes[axis][i] > low)
        stops.push_back(std::clamp((grid.planes[axis][i] - from[axis]) / (to[axis] - from[axis]), 0.0, 1.0));
  }
  std::sort(stops.begin(), stops.end());
  const Vec3 whole = to - from;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    if (stops[i + 1] > stops[i])
      visit(grid.cell_at(from + (0.5 * (stops[i] + stops[i + 1])) * whole), (stops[i + 1] - stops[i]) * length(whole));
}

struct Scratch {
  std::array<Polygon, 3> rest, slab;  ///< per axis
  Polygon whole;
  std::vector<double> stops;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edge_cells;  ///< voxel, edge of the triangle
};

/// Calls visit(cell, polygon) for the part of the polygon in each voxel.
template <class Visit>
void visit_parts(const VoxelGrid& grid, const Polygon& polygon, int axis, std::array<std::uint32_t, 3> index,
                 Scratch& scratch, Visit&& visit) {
  if (axis == 3) {
    visit(grid.cell(index), polygon);
    return;
  }
  double low = polygon[0][axis], high = low;
  for (const Vec3& p : polygon) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  const std::uint32_t last = grid.index_along(axis, high);
  const auto at = static_cast<std::size_t>(axis);
  scratch.rest[at] = polygon;
  for (index[at] = grid.index_along(axis, low); index[at] < last; ++index[at]) {
    clip(scratch.rest[at], axis, grid.planes[axis][index[at] + 1], false, scratch.slab[at]);
    if (scratch.slab[at].size() > 2) visit_parts(grid, scratch.slab[at], axis + 1, index, scratch, visit);
    clip(Polygon(scratch.rest[at]), axis, grid.planes[axis][index[at] + 1], true, scratch.rest[at]);
    if (scratch.rest[at].size() < 3) return;
  }
  visit_parts(grid, Polygon(scratch.rest[at]), axis + 1, index, scratch, visit);
}

}  // namespace

CellPieces cut_by_voxels(const StructuralModel& model, const VoxelGrid& grid) {
  CellPieces result;
  result.resolution_m = std::cbrt(grid.cell_volume_m3());
  for (std::uint32_t c = 0; c < grid.cell_count(); ++c) result.sites.push_back(grid.centre(c));

  // A triangle that touches a voxel in a corner may leave a trace of rounding there.
  const double smallest_m2 = 1e-12 * result.resolution_m * result.resolution_m;
  using Pair = std::pair<std::uint32_t, SurfacePiece>;
  const std::size_t blocks = (model.triangles.size() + grain - 1) / grain;
  const auto per_block = parallel_map(blocks, [&](std::size_t block) {
    std::vector<Pair> pairs;
    Scratch scratch;
    const std::size_t end = std::min(model.triangles.size(), (block + 1) * grain);
    for (std::size_t t = block * grain; t < end; ++t) {
      const Triangle& triangle = model.triangles[t];
      scratch.edge_cells.clear();
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
        visit_along(grid, model.points[low], model.points[high], scratch.stops,
                    [&](std::uint32_t cell, double) { scratch.edge_cells.emplace_back(cell, k); });
      }
      scratch.whole.clear();
      for (const std::uint32_t v : triangle) scratch.whole.push_back(model.points[v]);
      visit_parts(grid, scratch.whole, 0, {}, scratch, [&](std::uint32_t cell, const Polygon& part) {
        SurfacePiece piece{static_cast<std::uint32_t>(t), 0, area_m2(part)};
        if (!(piece.area_m2 > smallest_m2)) return;
        for (const auto& [edge_cell, edge] : scratch.edge_cells)
          if (edge_cell == cell) piece.edges |= 1u << edge;
        pairs.emplace_back(cell, piece);
      });
    }
    return pairs;
  });
  std::vector<Pair> surface_pairs;
  for (const auto& pairs : per_block) surface_pairs.insert(surface_pairs.end(), pairs.begin(), pairs.end());
  group_by_cell(surface_pairs, grid.cell_count(), result.first_surface, result.surface_pieces);

  std::vector<std::pair<std::uint32_t, LinePiece>> line_pairs;
  std::vector<double> stops;
  for (std::uint32_t l = 0; l < model.lines.size(); ++l) {
    const Line& line = model.lines[l];
    const auto count = static_cast<std::uint32_t>(line.vertices.size());
    for (std::uint32_t i = 0; i < (line.is_closed() ? count : count - 1); ++i) {
      const Vec3 &from = model.points[line.vertices[i]], &to = model.points[line.vertices[(i + 1) % count]];
      visit_along(grid, from, to, stops, [&](std::uint32_t cell, double length_m) {
        const std::uint32_t ends = (grid.cell_at(from) == cell ? 1u : 0u) | (grid.cell_at(to) == cell ? 2u : 0u);
        line_pairs.emplace_back(cell, LinePiece{l, i, ends, 0, length_m});
      });
    }
  }
  group_by_cell(line_pairs, grid.cell_count(), result.first_line, result.line_pieces);

  std::vector<std::pair<std::uint32_t, std::uint32_t>> corner_pairs;
  for (std::uint32_t c = 0; c < model.corners.size(); ++c)
    corner_pairs.emplace_back(grid.cell_at(model.points[model.corners[c].vertex]), c);
  group_by_cell(corner_pairs, grid.cell_count(), result.first_corner, result.corners);
  return result;
}

}  // namespace strataflow
