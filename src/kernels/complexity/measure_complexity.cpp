#include "kernels/complexity/measure_complexity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "kernels/complexity/cells/ball_pieces.h"
#include "kernels/complexity/cells/voronoi_pieces.h"
#include "kernels/complexity/cells/voxel_grid.h"
#include "kernels/complexity/cells/voxel_pieces.h"
#include "kernels/voronoi/triangle_cells.h"

namespace strataflow {

namespace {

std::optional<Failure> check(const StructuralModel& model, const ComplexityOptions& options) {
  const auto bad = [](const std::string& what, const std::string& remedy) {
    return Failure{FailureCode::invalid_options, what, remedy};
  };
  if (options.edge_length_m && !(*options.edge_length_m > 0)) return bad("edge_length_m must be > 0", "raise it");
  if (!(options.angle_deg >= 0 && options.angle_deg <= 180))
    return bad("angle_deg must lie between 0 and 180", "for instance 20");
  if (options.neighbourhoods != "voronoi" && options.neighbourhoods != "voxels" && options.neighbourhoods != "balls")
    return bad("unknown neighbourhoods '" + options.neighbourhoods + "'", "voronoi, voxels or balls");
  if (options.count_by != "components" && options.count_by != "elements" && options.count_by != "features")
    return bad("unknown count_by '" + options.count_by + "'", "components, elements or features");
  for (const std::int64_t cells : options.cells)
    if (cells < 1 || cells > 10'000'000) return bad("cells must lie between 1 and 10000000", "for instance 1000");
  const Vec3 extent = model.box.high - model.box.low;
  if (model.triangles.empty() || !(extent.x > 0 && extent.y > 0 && extent.z > 0))
    return Failure{FailureCode::invalid_input, "a model without extent in all three directions has no neighbourhoods",
                   "add the box around it, or further surfaces"};
  return std::nullopt;
}

/// The voxels of a grid as a mesh; cells outside the model are left out, and the counts become its fields. `cell_of`
/// names the neighbourhood of each voxel.
void draw_map(const VoxelGrid& grid, const std::vector<std::uint32_t>& cell_of, const StructuralModel& model,
              const std::vector<CellCount>& counts, ComplexityReport& report) {
  VolumeMesh& mesh = report.map;
  mesh.local_origin = model.local_origin;
  const std::uint32_t nx = grid.count(0) + 1, ny = grid.count(1) + 1, nz = grid.count(2) + 1;
  for (std::uint32_t z = 0; z < nz; ++z)
    for (std::uint32_t y = 0; y < ny; ++y)
      for (std::uint32_t x = 0; x < nx; ++x)
        mesh.points.push_back({grid.planes[0][x], grid.planes[1][y], grid.planes[2][z]});
  report.fields = {{"elements", {}},        {"regions", {}},    {"surfaces", {}},  {"lines", {}},
                   {"corners", {}},         {"area_m2", {}},    {"length_m", {}},  {"roughness_ratio", {}},
                   {"thin_ratio", {}},      {"sharp_ratio", {}}, {"needed_edge_m", {}}, {"cell", {}}};
  for (std::uint32_t voxel = 0; voxel < grid.cell_count(); ++voxel) {
    const CellCount& count = counts[cell_of[voxel]];
    if (count.regions == 0) continue;
    const auto [i, j, k] = grid.index_of(voxel);
    const auto at = [&](std::uint32_t dx, std::uint32_t dy, std::uint32_t dz) {
      return ((k + dz) * ny + j + dy) * nx + i + dx;
    };
    const std::array<std::uint32_t, 8> vertices{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                                                at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
    mesh.add_cell(CellType::hexahedron, vertices.data(), -1);
    const std::array<double, 12> values{static_cast<double>(count.total()),    static_cast<double>(count.regions),
                                        static_cast<double>(count.surfaces),   static_cast<double>(count.lines),
                                        static_cast<double>(count.corners),    count.area_m2,
                                        count.length_m,                        count.roughness_ratio,
                                        count.thin_ratio,                      count.sharp_ratio,
                                        count.needed_edge_m,                   static_cast<double>(cell_of[voxel])};
    for (std::size_t f = 0; f < values.size(); ++f) report.fields[f].values.push_back(values[f]);
  }
}

std::vector<RegionNeed> needs_of(const StructuralModel& model, const BoxElements& box, const GeometricSamples& samples,
                                 const GeometricComplexity& geometric) {
  std::vector<RegionNeed> needs;
  for (const Region& region : model.regions)
    needs.push_back({region.name, region.volume_m3, std::numeric_limits<double>::infinity(),
                     region.volume_m3 > 0 ? std::cbrt(region.volume_m3) : std::numeric_limits<double>::infinity()});
  for (const ThicknessSample& sample : samples.thickness.samples)
    if (sample.is_wedge == 0)
      needs[sample.region].thinnest_m = std::min(needs[sample.region].thinnest_m, sample.thickness_m);
  std::vector<double> line_m(model.lines.size(), std::numeric_limits<double>::infinity());
  for (const ElementComplexity& one : geometric.elements)
    if (one.type == ElementType::line) line_m[one.element] = one.size;
  for (const ElementComplexity& one : geometric.elements) {
    if (one.type != ElementType::surface) continue;
    const Surface& surface = model.surfaces[one.element];
    double least = std::sqrt(one.size);
    for (const std::uint32_t line : surface.lines)
      if (box.lines[line] == 0) least = std::min(least, line_m[line]);
    for (const std::uint32_t region : {surface.region_plus, surface.region_minus})
      if (region != universe) needs[region].needed_edge_m = std::min(needs[region].needed_edge_m, least);
  }
  for (RegionNeed& need : needs) need.needed_edge_m = std::min(need.needed_edge_m, need.thinnest_m);
  return needs;
}

}  // namespace

Result<ComplexityReport> measure_complexity(const StructuralModel& model, const ComplexityOptions& options,
                                            std::uint64_t seed) {
  if (std::optional<Failure> problem = check(model, options)) return *problem;
  const double h = options.edge_length_m.value_or(model.box.diagonal_m() / 200);
  const BoxElements box = find_box_elements(model);
  const GeometricSamples samples = sample_geometry(model, box, h);
  ComplexityReport report;
  report.counts = count_elements(model, box);
  report.geometric = measure_geometric_complexity(model, box, samples, h, options.angle_deg);
  report.size_variation = measure_size_variation(report.geometric);
  report.faults = measure_faults(model, samples.edges);
  report.needs = needs_of(model, box, samples, report.geometric);
  report.neighbourhoods = options.neighbourhoods;
  report.count_by = options.count_by;
  const CountBy by = options.count_by == "elements"   ? CountBy::elements
                     : options.count_by == "features" ? CountBy::features
                                                      : CountBy::components;
  for (std::size_t i = 0; i < options.cells.size(); ++i) {
    const auto cells = static_cast<std::uint32_t>(options.cells[i]);
    VoxelGrid grid = cut_into_voxels(model.box, cells);
    std::vector<std::uint32_t> cell_of;  // per voxel of the map
    CellPieces pieces;
    if (options.neighbourhoods == "voronoi") {
      SiteNeighbours sites(SiteNeighbours::in_volumes);
      sites.move_to(spread_in_box(model.box, cells, seed));
      pieces = cut_by_voronoi(model, samples.edges, sites);
      grid = cut_into_voxels(model.box, std::max(cells, std::min(8 * cells, 1'000'000u)));
      for (std::uint32_t voxel = 0; voxel < grid.cell_count(); ++voxel)
        cell_of.push_back(find_nearest_site(sites, grid.centre(voxel), cell_of.empty() ? 0 : cell_of.back()));
    } else if (options.neighbourhoods == "balls") {
      std::vector<Vec3> centres;
      for (std::uint32_t c = 0; c < grid.cell_count(); ++c) centres.push_back(grid.centre(c));
      pieces = cut_by_balls(model, centres, std::cbrt(0.75 / std::numbers::pi * grid.cell_volume_m3()));
    } else {
      pieces = cut_by_voxels(model, grid);
    }
    const std::vector<CellCount> counts = count_in_cells(model, box, samples, report.geometric, pieces, by);
    report.cells.push_back(statistics_of(counts, pieces.resolution_m));
    if (i + 1 < options.cells.size()) continue;
    if (cell_of.empty()) {
      cell_of.resize(grid.cell_count());
      std::iota(cell_of.begin(), cell_of.end(), 0u);
    }
    draw_map(grid, cell_of, model, counts, report);
  }
  return report;
}

}  // namespace strataflow
