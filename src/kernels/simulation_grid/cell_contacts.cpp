#include "kernels/simulation_grid/cell_contacts.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {
constexpr std::uint8_t side_vertices[6][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                              {3, 0, 4, 7}, {3, 2, 1, 0}, {4, 5, 6, 7}};
/// Overlaps below this share of the smaller side are rounding.
constexpr double least_overlap_ratio = 1e-9;

std::array<std::uint32_t, 4> side_points(const VolumeMesh& mesh, std::uint32_t cell, std::uint32_t side) {
  std::array<std::uint32_t, 4> points;
  for (int c = 0; c < 4; ++c) points[c] = mesh.cell_vertices[mesh.cell_offsets[cell] + side_vertices[side][c]];
  return points;
}

/// Per cell and plan side: the entity of the fault it lies on.
std::vector<std::uint32_t> faults_of_sides(const VolumeMesh& mesh) {
  std::vector<std::uint32_t> faults(4 * mesh.cell_count(), no_index);
  for (const MeshFacet& facet : mesh.facets) {
    if (facet.surface >= mesh.surface_entity.size() || facet.vertices[3] == no_index) continue;
    const std::int32_t entity = mesh.surface_entity[facet.surface];
    if (entity < 0 || static_cast<std::size_t>(entity) >= mesh.entities.size() ||
        mesh.entities[static_cast<std::size_t>(entity)].role != Role::fault)
      continue;
    auto wanted = facet.vertices;
    std::sort(wanted.begin(), wanted.end());
    for (const std::uint32_t cell : {facet.cell_0, facet.cell_1})
      for (std::uint32_t side = 0; side < 4 && cell < mesh.cell_count(); ++side) {
        auto points = side_points(mesh, cell, side);
        std::sort(points.begin(), points.end());
        if (points == wanted) faults[4 * std::size_t{cell} + side] = static_cast<std::uint32_t>(entity);
      }
  }
  return faults;
}

struct PlanePoint {
  double u = 0, v = 0;
};
double cross(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// A convex polygon of at most eight corners: a quadrilateral cut by four lines.
struct SmallPolygon {
  std::array<PlanePoint, 12> corners;
  int count = 0;
  void add(const PlanePoint& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
  double area() const {
    double twice = 0;
    for (int c = 2; c < count; ++c) twice += cross(corners[0], corners[c - 1], corners[c]);
    return twice / 2;
  }
};

/// What lies left of the line from a to b.
SmallPolygon clip(const SmallPolygon& polygon, const PlanePoint& a, const PlanePoint& b) {
  SmallPolygon kept;
  for (int c = 0; c < polygon.count && kept.count < 10; ++c) {
    const PlanePoint &p = polygon.corners[c], &q = polygon.corners[(c + 1) % polygon.count];
    const double at_p = cross(a, b, p), at_q = cross(a, b, q);
    if (at_p >= 0) kept.add(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const double t = at_p / (at_p - at_q);
      kept.add({p.u + t * (q.u - p.u), p.v + t * (q.v - p.v)});
    }
  }
  return kept;
}
}  // namespace

Result<std::vector<std::uint32_t>> cells_by_column(const HexGrid& grid) {
  const VolumeMesh& mesh = grid.mesh;
  const std::size_t count = mesh.cell_count();
  const auto damaged = [](const std::string& what) {
    return Failure{FailureCode::invalid_input, what, "report this: the hexahedral grid is damaged"};
  };
  if (grid.layers == 0 || grid.cell_column.size() != count || grid.cell_layer.size() != count ||
      grid.is_dead.size() != count || mesh.cell_region.size() != count || mesh.cell_offsets.size() != count + 1 ||
      count != std::uint64_t{grid.layers} * grid.plan.quads.size())
    return damaged("a grid of " + std::to_string(grid.plan.quads.size()) + " columns and " +
                   std::to_string(grid.layers) + " layers has " + std::to_string(count) + " cells");
  std::vector<std::uint32_t> cells(count, no_index);
  for (std::uint32_t cell = 0; cell < count; ++cell) {
    const std::uint32_t column = grid.cell_column[cell], layer = grid.cell_layer[cell];
    const std::string name = "cell " + std::to_string(cell);
    if (mesh.cell_types[cell] != CellType::hexahedron) return damaged(name + " is no hexahedron");
    if (column >= grid.plan.quads.size() || layer >= grid.layers ||
        cells[std::size_t{column} * grid.layers + layer] != no_index)
      return damaged(name + " has no place of its own in its column");
    cells[std::size_t{column} * grid.layers + layer] = cell;
    for (std::uint32_t v = 0; v < 8; ++v) {
      const std::uint32_t point = mesh.cell_vertices[mesh.cell_offsets[cell] + v];
      if (point >= mesh.points.size() || !is_finite(mesh.points[point]))
        return damaged(name + " has a corner that is nowhere");
    }
  }
  return cells;
}

std::array<Vec3, 4> side_corners(const VolumeMesh& mesh, std::uint32_t cell, std::uint32_t side) {
  std::array<Vec3, 4> corners;
  const auto points = side_points(mesh, cell, side);
  for (int c = 0; c < 4; ++c) corners[c] = mesh.points[points[c]];
  return corners;
}

Vec3 vector_area(const std::array<Vec3, 4>& corners) {
  return 0.5 * cross(corners[2] - corners[0], corners[3] - corners[1]);
}

Vec3 overlap_area(const std::array<Vec3, 4>& first, const std::array<Vec3, 4>& second) {
  const Vec3 sum = vector_area(first) - vector_area(second);
  const double size = length(sum);
  if (!(size > 0)) return {};
  const Vec3 normal = (1 / size) * sum;
  Vec3 along = cross(std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, normal);
  along = (1 / length(along)) * along;
  const Vec3 across = cross(normal, along);
  const Vec3 origin = first[0];
  const auto flat = [&](const Vec3& p) { return PlanePoint{dot(p - origin, along), dot(p - origin, across)}; };
  SmallPolygon polygon;
  for (const Vec3& corner : first) polygon.add(flat(corner));
  for (int c = 0; c < 4; ++c) {  // `second` turns clockwise here
    const PlanePoint a = flat(second[(4 - c) % 4]), b = flat(second[3 - c]);
    if (a.u != b.u || a.v != b.v) polygon = clip(polygon, a, b);
  }
  return std::max(0.0, polygon.area()) * normal;
}

std::vector<CellContact> find_cell_contacts(const HexGrid& grid, const std::vector<std::uint32_t>& cells,
                                            const std::vector<std::uint32_t>& opposite) {
  const VolumeMesh& mesh = grid.mesh;
  const std::uint32_t layers = grid.layers;
  const std::vector<std::uint32_t> faults = faults_of_sides(mesh);
  struct Side {
    std::uint32_t cell;
    std::array<Vec3, 4> corners;
    double low, high, area;
  };
  /// The sides of the live cells of a column over one side of its quad, from below.
  const auto sides_of = [&](std::uint32_t half_edge) {
    std::vector<Side> sides;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      const std::uint32_t cell = cells[std::size_t{half_edge / 4} * layers + layer];
      if (grid.is_dead[cell]) continue;
      Side side{cell, side_corners(mesh, cell, half_edge % 4), 0, 0, 0};
      side.low = std::min(side.corners[0].z, side.corners[1].z);
      side.high = std::max(side.corners[2].z, side.corners[3].z);
      side.area = length(vector_area(side.corners));
      if (side.area > 0) sides.push_back(side);
    }
    return sides;
  };
  const auto in_column = [&](std::size_t column) {
    std::vector<CellContact> found;
    std::uint32_t below = no_index;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      const std::uint32_t cell = cells[column * layers + layer];
      if (grid.is_dead[cell]) continue;
      if (below != no_index)
        found.push_back({below, cell, 5, 4, no_index, 1,
                         0.5 * (vector_area(side_corners(mesh, below, 5)) - vector_area(side_corners(mesh, cell, 4)))});
      below = cell;
    }
    return found;
  };
  const auto across_edge = [&](std::size_t h) {
    std::vector<CellContact> found;
    if (opposite[h] == no_index || opposite[h] < h) return found;
    const auto half_edge = static_cast<std::uint32_t>(h);
    const std::uint32_t side_0 = half_edge % 4, side_1 = opposite[h] % 4;
    const auto ours = sides_of(half_edge), theirs = sides_of(opposite[h]);
    std::size_t first = 0;
    for (const Side& our : ours) {
      while (first < theirs.size() && theirs[first].high <= our.low) ++first;
      for (std::size_t n = first; n < theirs.size() && theirs[n].low < our.high; ++n) {
        const Side& their = theirs[n];
        const bool is_whole = our.corners[0] == their.corners[1] && our.corners[1] == their.corners[0] &&
                              our.corners[2] == their.corners[3] && our.corners[3] == their.corners[2];
        const Vec3 area = is_whole ? vector_area(our.corners) : overlap_area(our.corners, their.corners);
        if (length(area) <= least_overlap_ratio * std::min(our.area, their.area)) continue;
        std::uint32_t fault = faults[4 * std::size_t{our.cell} + side_0];
        if (fault == no_index) fault = faults[4 * std::size_t{their.cell} + side_1];
        found.push_back({our.cell, their.cell, side_0, side_1, fault, is_whole, area});
      }
    }
    return found;
  };
  const auto up_and_down = parallel_map(grid.plan.quads.size(), in_column, 64);
  const auto sideways = parallel_map(opposite.size(), across_edge, 64);
  std::vector<CellContact> contacts;
  for (const auto* lists : {&up_and_down, &sideways})
    for (const auto& list : *lists) contacts.insert(contacts.end(), list.begin(), list.end());
  return contacts;
}

}  // namespace strataflow
