#include "kernels/quality/analyze_volume_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "base/internal_error.h"
#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/quality/find_hanging_vertices.h"
#include "kernels/quality/match_cell_faces.h"
#include "kernels/quality/measure_cell.h"
#include "model/box3.h"

namespace strataflow {

namespace {

constexpr std::size_t example_limit = 10;
constexpr double contact_ratio = 1e-9;  ///< of the bounding-box diagonal: closer than this is touching

enum Measure {
  dihedral,
  scaled_jacobian,
  tetrahedron_radius_ratio,
  tetrahedron_shape,
  prism_shape,
  hexahedron_shape,
  hexahedron_skew,
  tetrahedron_size,
  hexahedron_size,
  measure_count
};

/// What a block of cells adds to the report.
struct Partial {
  std::vector<Distribution> distributions = {{"dihedral_deg", 0, 180, 36},
                                             {"scaled_jacobian", -1, 1, 40},
                                             {"tetrahedron_radius_ratio", 0, 1, 20},
                                             {"tetrahedron_shape", 0, 1, 20},
                                             {"prism_shape", 0, 1, 20},
                                             {"hexahedron_shape", 0, 1, 20},
                                             {"hexahedron_skew", 0, 1, 20},
                                             {"tetrahedron_relative_size", 0, 1, 20},
                                             {"hexahedron_relative_size", 0, 1, 20}};
  double volume_m3 = 0;
  double tetrahedron_determinants = 0, hexahedron_determinants = 0;  ///< sums of the mean corner determinants
  std::vector<std::uint32_t> inverted;

  void add(const Partial& later) {
    for (int i = 0; i < measure_count; ++i) distributions[i].add(later.distributions[i]);
    volume_m3 += later.volume_m3;
    tetrahedron_determinants += later.tetrahedron_determinants;
    hexahedron_determinants += later.hexahedron_determinants;
    inverted.insert(inverted.end(), later.inverted.begin(), later.inverted.end());
  }
};

std::span<const Vec3> gather_vertices(const VolumeMesh& mesh, std::size_t cell, std::array<Vec3, 8>& storage) {
  const std::uint32_t begin = mesh.cell_offsets[cell];
  const int count = vertex_count(mesh.cell_types[cell]);
  for (int i = 0; i < count; ++i) storage[i] = mesh.points[mesh.cell_vertices[begin + i]];
  return std::span<const Vec3>(storage).first(count);
}

/// Runs work(cell, partial) over all cells in blocks and folds the blocks in order, as ordered_reduce does; its
/// cell-wise combine would copy the histograms for every cell.
template <class Work>
Partial sum_over_cells(std::size_t cell_count, Work&& work) {
  const auto parts = parallel_map((cell_count + reduce_grain - 1) / reduce_grain, [&](std::size_t block) {
    Partial part;
    const std::size_t end = std::min(cell_count, (block + 1) * reduce_grain);
    for (std::size_t cell = block * reduce_grain; cell < end; ++cell) work(cell, part);
    return part;
  });
  Partial total;
  for (const Partial& part : parts) total.add(part);
  return total;
}

void add_measures(CellType type, const CellMeasures& measures, Partial& part) {
  for (std::uint32_t i = 0; i < measures.dihedral_count; ++i)
    part.distributions[dihedral].add(measures.dihedral_deg[i]);
  part.distributions[scaled_jacobian].add(measures.scaled_jacobian);
  part.volume_m3 += measures.volume_m3;
  if (type == CellType::tetrahedron) {
    part.distributions[tetrahedron_radius_ratio].add(*measures.radius_ratio);
    part.distributions[tetrahedron_shape].add(*measures.shape);
    part.tetrahedron_determinants += measures.mean_corner_determinant;
  } else if (type == CellType::prism) {
    part.distributions[prism_shape].add(*measures.shape);
  } else if (type == CellType::hexahedron) {
    part.distributions[hexahedron_shape].add(*measures.shape);
    part.distributions[hexahedron_skew].add(*measures.skew);
    part.hexahedron_determinants += measures.mean_corner_determinant;
  }
}

/// Cells and volume by region, ascending by number.
std::vector<RegionQuality> sum_by_region(const VolumeMesh& mesh, const std::vector<double>& volumes) {
  std::map<std::int32_t, std::vector<std::uint32_t>> cells_of;  // few regions, so few nodes
  std::int32_t last_region = 0;
  std::vector<std::uint32_t>* list = nullptr;  // neighbours in the list mostly share a region
  for (std::uint32_t cell = 0; cell < mesh.cell_region.size(); ++cell) {
    if (!list || mesh.cell_region[cell] != last_region) list = &cells_of[last_region = mesh.cell_region[cell]];
    list->push_back(cell);
  }
  std::vector<RegionQuality> regions;
  for (const auto& [region, cells] : cells_of) {
    RegionQuality sum{region, "", cells.size(), 0};
    if (region >= 0 && static_cast<std::size_t>(region) < mesh.region_names.size())
      sum.name = mesh.region_names[static_cast<std::size_t>(region)];
    sum.volume_m3 = ordered_reduce(
        cells.size(), 0.0, [&](std::size_t i) { return volumes[cells[i]]; }, [](double a, double b) { return a + b; });
    regions.push_back(std::move(sum));
  }
  return regions;
}

struct BoundaryEdge {
  std::uint32_t low, high;
  std::int32_t direction;  ///< +1 from low to high
  friend auto operator<=>(const BoundaryEdge&, const BoundaryEdge&) = default;
};

/// Edges that the boundary faces do not run along equally often in both directions.
std::uint64_t count_open_edges(const std::vector<CellFace>& faces) {
  std::vector<BoundaryEdge> edges;
  edges.reserve(faces.size() * 3);
  for (const CellFace& face : faces) {
    const std::size_t corners = face.is_triangle() ? 3 : 4;
    for (std::size_t i = 0; i < corners; ++i) {
      const std::uint32_t from = face.vertices[i], to = face.vertices[(i + 1) % corners];
      edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  sort_total_order(edges, std::less<>());
  std::uint64_t open = 0;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    std::int64_t balance = 0;
    for (; end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high; ++end)
      balance += edges[end].direction;
    open += balance != 0;
  }
  return open;
}

void check_faces(const VolumeMesh& mesh, VolumeQualityReport& report) {
  const FaceMatching matching = match_cell_faces(mesh);
  report.inner_faces = matching.inner_faces;
  report.boundary_faces = matching.boundary_faces.size();
  report.open_boundary_edges = count_open_edges(matching.boundary_faces);
  Box3 box;
  for (const Vec3& point : mesh.points) box.take(point);
  const BoundaryContacts contacts =
      find_hanging_vertices(mesh.points, matching.boundary_faces, contact_ratio * box.diagonal_m());
  report.faces_with_hanging_vertex = contacts.faces_with_hanging_vertex.size();
  report.coincident_boundary_vertices = contacts.coincident_vertices;
  report.nonconforming_faces = matching.nonconforming_faces + report.faces_with_hanging_vertex;
}

}  // namespace

VolumeQualityReport analyze_volume_mesh(const VolumeMesh& mesh) {
  const std::size_t cell_count = mesh.cell_count();
  STRATAFLOW_ASSERT(mesh.cell_offsets.size() == cell_count + 1, "one offset per cell and one more");
  VolumeQualityReport report;
  report.vertices = mesh.points.size();
  report.cells = cell_count;
  for (const CellType type : mesh.cell_types) {
    report.tetrahedra += type == CellType::tetrahedron;
    report.pyramids += type == CellType::pyramid;
    report.prisms += type == CellType::prism;
    report.hexahedra += type == CellType::hexahedron;
  }

  std::vector<double> volumes(cell_count), determinants(cell_count);
  Partial total = sum_over_cells(cell_count, [&](std::size_t cell, Partial& part) {
    std::array<Vec3, 8> storage;
    const CellType type = mesh.cell_types[cell];
    const auto vertices = gather_vertices(mesh, cell, storage);
    const CellMeasures measures = measure_cell(type, vertices);
    volumes[cell] = measures.volume_m3;
    determinants[cell] = measures.mean_corner_determinant;
    add_measures(type, measures, part);
    if (is_inverted(type, vertices)) part.inverted.push_back(static_cast<std::uint32_t>(cell));
  });
  const double mean_tetrahedron =
      total.tetrahedron_determinants / static_cast<double>(std::max<std::uint64_t>(report.tetrahedra, 1));
  const double mean_hexahedron =
      total.hexahedron_determinants / static_cast<double>(std::max<std::uint64_t>(report.hexahedra, 1));
  const Partial sizes = sum_over_cells(cell_count, [&](std::size_t cell, Partial& part) {
    if (mesh.cell_types[cell] == CellType::tetrahedron)
      part.distributions[tetrahedron_size].add(relative_size(determinants[cell], mean_tetrahedron));
    else if (mesh.cell_types[cell] == CellType::hexahedron)
      part.distributions[hexahedron_size].add(relative_size(determinants[cell], mean_hexahedron));
  });
  for (const Measure measure : {tetrahedron_size, hexahedron_size})
    total.distributions[measure] = sizes.distributions[measure];

  report.volume_m3 = total.volume_m3;
  report.inverted = total.inverted.size();
  total.inverted.resize(std::min(total.inverted.size(), example_limit));
  report.inverted_examples = std::move(total.inverted);
  report.min_dihedral_deg = total.distributions[dihedral].minimum;
  report.max_dihedral_deg = total.distributions[dihedral].maximum;
  report.dihedral_quantiles = dihedral_quantiles(mesh);
  report.min_scaled_jacobian = total.distributions[scaled_jacobian].minimum;
  report.mean_scaled_jacobian = total.distributions[scaled_jacobian].mean();
  for (Distribution& distribution : total.distributions)
    if (distribution.count > 0) report.distributions.push_back(std::move(distribution));
  report.per_region = sum_by_region(mesh, volumes);
  check_faces(mesh, report);
  return report;
}

}  // namespace strataflow
