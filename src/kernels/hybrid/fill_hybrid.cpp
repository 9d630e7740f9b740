#include "kernels/hybrid/fill_hybrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <variant>

#include "graph/parallel/parallel_map.h"
#include "kernels/hybrid/interior_sites.h"
#include "kernels/hybrid/worst_kept_cell.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/volumes/fill_regions.h"
#include "kernels/volumes/refine_interior.h"
#include "kernels/volumes/region_boundary.h"

namespace strataflow {

namespace {

/// What the thin zone of a region leaves to be filled.
struct Cavity {
  RegionBoundary boundary;  ///< triangles: of the model, no_index for the envelope of the zone
  double volume_m3 = 0;
};

/// Between the facets, m³: sides say which way they look.
double volume_inside(const RegionBoundary& boundary) {
  double six_volumes = 0;
  for (std::size_t f = 0; f < boundary.facets.size(); ++f) {
    const Vec3& origin = boundary.coordinates.front();
    const auto corner = [&](std::size_t k) { return boundary.coordinates[boundary.facets[f][k]] - origin; };
    const double cone = dot(corner(0), cross(corner(1), corner(2)));
    six_volumes += ((boundary.sides[f] & 1) - (boundary.sides[f] >> 1)) * cone;
  }
  return six_volumes / 6;
}

Cavity cavity_beside(const StructuralModel& model, std::uint32_t region, const ThinZone& zone) {
  std::vector<std::uint8_t> covered(model.triangles.size(), 0);
  for (const CoveredSide& side : zone.covered) covered[side.triangle] |= static_cast<std::uint8_t>(1u << side.side);
  Cavity cavity;
  RegionBoundary& boundary = cavity.boundary;
  boundary.region = region;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    const int both = (surface.region_minus == region ? 1 : 0) | (surface.region_plus == region ? 2 : 0);
    if (both == 0) continue;
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
      const int open = both & ~covered[t];
      if (open == 0) continue;
      boundary.triangles.push_back(t);
      boundary.sides.push_back(static_cast<std::uint8_t>(open));
      boundary.facets.push_back(model.triangles[t]);
    }
  }
  for (const Triangle& face : zone.envelope) {
    boundary.triangles.push_back(no_index);
    boundary.sides.push_back(2);  // it looks away from the zone
    boundary.facets.push_back(face);
  }
  for (const Triangle& facet : boundary.facets)
    boundary.points.insert(boundary.points.end(), facet.begin(), facet.end());
  std::sort(boundary.points.begin(), boundary.points.end());
  boundary.points.erase(std::unique(boundary.points.begin(), boundary.points.end()), boundary.points.end());
  const std::size_t own = model.points.size();
  for (const std::uint32_t p : boundary.points)
    boundary.coordinates.push_back(p < own ? model.points[p] : zone.points[p - own]);
  for (Triangle& facet : boundary.facets)
    for (std::uint32_t& vertex : facet)
      vertex = static_cast<std::uint32_t>(std::lower_bound(boundary.points.begin(), boundary.points.end(), vertex) -
                                          boundary.points.begin());
  cavity.volume_m3 = volume_inside(boundary);
  return cavity;
}

/// A region filled.
struct Filled {
  ThinZone zone;
  Cavity cavity;
  RegionMesh tets;
  double sites_wanted = 0;  ///< inside, for the spacing of its surfaces
  std::uint64_t sites_asked = 0, sites = 0;
  VertexDuals duals;
  VertexDualCounts duals_before;  ///< the improvement
  CellImprovement improvement;
  std::optional<Failure> failure;
  std::string refusal;         ///< why no tetrahedra fit: the surfaces would have to be split
  std::string prisms_refused;  ///< the same, around prisms
};

/// Makes the worst cells of a region better: its tetrahedra, and with them the points at which the zone passes from
/// quadrilaterals to triangles. What cannot be verified afterwards is left as it was.
void improve(const StructuralModel& model, Filled& filled) {
  const RegionBoundary& boundary = filled.cavity.boundary;
  const auto own = static_cast<std::uint32_t>(model.points.size());
  const auto may_move = [&](std::uint32_t p) { return p >= own + filled.zone.layer_points; };
  // Numbers: points of the cavity, those inside it, and beyond both the corners of cells beside a point that may move.
  ImprovableCells cells = improvable_cells(boundary, filled.tets);
  std::transform(boundary.points.begin(), boundary.points.end(), cells.is_free.begin(), may_move);
  std::vector<ThinCell> kept;  // cells that stay, but whose points may move
  std::vector<std::uint32_t> beyond;
  const auto place_in = [](const std::vector<std::uint32_t>& list, std::uint32_t p) {
    const auto found = std::lower_bound(list.begin(), list.end(), p);
    return found != list.end() && *found == p ? static_cast<std::uint32_t>(found - list.begin()) : no_index;
  };
  for (const ThinCell& cell : filled.zone.cells) {
    const auto corners = std::span(cell.vertices).first(static_cast<std::size_t>(vertex_count(cell.type)));
    if (std::none_of(corners.begin(), corners.end(), may_move)) continue;
    kept.push_back(cell);
    for (const std::uint32_t p : corners)
      if (place_in(boundary.points, p) == no_index) beyond.push_back(p);
  }
  beyond = sorted_unique(std::move(beyond));
  const auto first_beyond = static_cast<std::uint32_t>(cells.points.size());
  for (const std::uint32_t p : beyond) {
    cells.points.push_back(p < own ? model.points[p] : filled.zone.points[p - own]);
    cells.is_free.push_back(may_move(p));
  }
  for (ThinCell& cell : kept)
    for (int k = 0; k < vertex_count(cell.type); ++k) {
      const std::uint32_t p = cell.vertices[k], place = place_in(boundary.points, p);
      cell.vertices[k] = place != no_index ? place : first_beyond + place_in(beyond, p);
    }
  cells.worst_kept_at = worst_kept_cell(kept, cells.points.size());
  const CellImprovement improvement = improve_cells(cells);

  Cavity cavity = filled.cavity;
  std::copy_n(cells.points.begin(), cavity.boundary.points.size(), cavity.boundary.coordinates.begin());
  cavity.volume_m3 = volume_inside(cavity.boundary);
  auto verdict = verified_region_mesh(cavity.boundary, cells.points, cells.tets, cavity.volume_m3);
  if (std::holds_alternative<Rejection>(verdict)) return;
  filled.tets = std::move(std::get<RegionMesh>(verdict));
  filled.cavity = std::move(cavity);
  filled.improvement = improvement;
  const auto put_back = [&](std::uint32_t p, const Vec3& at) {
    if (may_move(p)) filled.zone.points[p - own] = at;
  };
  for (std::size_t i = 0; i < boundary.points.size(); ++i) put_back(boundary.points[i], boundary.coordinates[i]);
  for (std::size_t i = 0; i < beyond.size(); ++i) put_back(beyond[i], cells.points[first_beyond + i]);
}

Filled fill_region(const StructuralModel& model, std::uint32_t region, std::span<const FacingPair> pairs,
                   const FillHybridOptions& options, const CancellationToken* cancellation,
                   const std::filesystem::path& worker) {
  Filled filled;
  const std::string& name = model.regions[region].name;
  for (const bool with_pairs : {true, false}) {
    if (!with_pairs) {
      const std::uint64_t pair_count = pairs.size();
      pairs = {};
      filled.zone = {};
      filled.zone.dropped.unfilled = pair_count;
    }
    if (!pairs.empty())
      filled.zone = build_thin_zone(model, region, pairs, static_cast<std::uint32_t>(options.layers_through_thin));
    filled.cavity = cavity_beside(model, region, filled.zone);
    if (filled.cavity.boundary.facets.empty()) return filled;
    TetrahedralizeOptions fill = options.fill;  // sizes come after the sites inside
    fill.max_volume_m3.reset();
    fill.region_max_volume_m3.clear();
    fill.radius_edge_ratio.reset();
    Result<FilledCavity> tets =
        fill_cavity(filled.cavity.boundary, name, filled.cavity.volume_m3, fill, worker, cancellation);
    if (!tets) {
      filled.failure = tets.failure();
      return filled;
    }
    if (tets->mesh) {
      filled.tets = std::move(*tets->mesh);
      filled.refusal.clear();
      filled.sites_wanted = interior_site_count(filled.cavity.boundary, filled.tets);
      return filled;
    }
    filled.refusal = "region '" + name + "' (" + std::to_string(region) + ")";
    for (const std::string& rejected : tets->rejected) filled.refusal += "; " + rejected;
    if (filled.zone.cells.empty()) return filled;
    filled.prisms_refused = filled.refusal;
  }
  return filled;
}

/// Spreads sites inside a region, refines what is still too large, and makes the worst better.
void mesh_inside(const StructuralModel& model, const FillHybridOptions& options, const CancellationToken* cancellation,
                 Filled& filled) {
  const RegionBoundary& boundary = filled.cavity.boundary;
  if (filled.tets.tets.empty()) return;
  RegionMesh dense = filled.tets;
  const std::vector<Vec3> sites = spread_interior_sites(
      boundary, dense, filled.sites_asked, static_cast<std::size_t>(options.lloyd_iterations), cancellation);
  const std::size_t set = insert_interior_points(boundary, dense, sites).size();
  const InteriorGoal goal{options.fill.max_volume_in(model.regions[boundary.region].name),
                          options.fill.radius_edge_ratio};
  refine_interior(boundary, dense, goal, cancellation);
  auto verdict = verified_region_mesh(boundary, points_of(boundary, dense), dense.tets, filled.cavity.volume_m3);
  if (RegionMesh* good = std::get_if<RegionMesh>(&verdict)) {
    filled.tets = std::move(*good);
    filled.sites = set;
  }
  filled.duals_before = find_vertex_duals(boundary, filled.tets).counts;
  improve(model, filled);
  filled.duals = find_vertex_duals(filled.cavity.boundary, filled.tets);
}

/// How many sites each region gets inside.
void share_out_sites(const std::optional<std::int64_t>& asked, std::vector<Filled>& regions) {
  double all = 0;
  for (const Filled& filled : regions) all += filled.sites_wanted;
  const double factor = asked && all > 0 ? static_cast<double>(*asked) / all : 1;
  double passed = 0;
  for (Filled& filled : regions) {
    const auto before = static_cast<std::uint64_t>(std::llround(factor * passed));
    passed += filled.sites_wanted;
    filled.sites_asked = static_cast<std::uint64_t>(std::llround(factor * passed)) - before;
  }
}

/// Base edge over height of a prism, from means of both.
double anisotropy(const ThinCell& prism, const std::vector<Vec3>& points) {
  const auto p = [&](std::size_t k) { return points[prism.vertices[k]]; };
  double base = 0, height = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    base += 0.5 * (length(p((k + 1) % 3) - p(k)) + length(p(3 + (k + 1) % 3) - p(3 + k)));
    height += length(p(3 + k) - p(k));
  }
  return base / height;
}

void add(DroppedPairs& sum, const DroppedPairs& part) {
  sum.isolated += part.isolated;
  sum.inverted += part.inverted;
  sum.nonconforming += part.nonconforming;
  sum.crossing += part.crossing;
  sum.unfilled += part.unfilled;
}

void add(VertexDualCounts& sum, const VertexDualCounts& part) {
  sum.vertices += part.vertices;
  sum.candidates += part.candidates;
  sum.unreached += part.unreached;
  sum.edges += part.edges;
  sum.checked_edges += part.checked_edges;
  sum.inconsistent_edges += part.inconsistent_edges;
  sum.flat += part.flat;
  sum.crossing += part.crossing;
  sum.replaced += part.replaced;
  sum.kept += part.kept;
}

void add(CellImprovement& sum, const CellImprovement& part) {
  sum.exchanges += part.exchanges;
  sum.moves += part.moves;
  sum.added_points += part.added_points;
  sum.smallest_before = std::min(sum.smallest_before, part.smallest_before);
  sum.smallest_after = std::min(sum.smallest_after, part.smallest_after);
}

/// Region by region: points, cells, and per triangle of the model the cells beside it.
HybridMesh assembled(const StructuralModel& model, const std::vector<Filled>& regions) {
  HybridMesh hybrid;
  VolumeMesh& mesh = hybrid.mesh;
  HybridReport& report = hybrid.report;
  mesh.local_origin = model.local_origin;
  mesh.entities = model.entities;
  for (const Surface& surface : model.surfaces)
    mesh.surface_entity.push_back(static_cast<std::int32_t>(surface.entity));
  for (const Region& region : model.regions) mesh.region_names.push_back(region.name);
  mesh.points = model.points;
  report.surface_points = model.points.size();
  std::vector<std::array<std::uint32_t, 2>> beside(model.triangles.size(), {no_index, no_index});
  std::vector<char> is_in_quad(model.triangles.size(), 0);
  std::vector<MeshFacet> quads;
  double anisotropy_sum = 0, anisotropy_low = std::numeric_limits<double>::infinity();
  std::uint64_t prisms = 0;
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    const Filled& filled = regions[r];
    HybridRegion& counted = report.regions.emplace_back();
    add(report.dropped, filled.zone.dropped);
    add(report.improvement, filled.improvement);
    add(report.vertex_duals, filled.duals_before);
    report.interior_sites_asked += filled.sites_asked;
    report.interior_sites += filled.sites;
    const auto own_points = static_cast<std::uint32_t>(model.points.size());
    const auto first_point = static_cast<std::uint32_t>(mesh.points.size());
    auto first_cell = static_cast<std::uint32_t>(mesh.cell_count());
    mesh.points.insert(mesh.points.end(), filled.zone.points.begin(), filled.zone.points.end());
    report.layer_points += filled.zone.layer_points;
    report.centre_points += filled.zone.centre_points;
    report.apex_points += filled.zone.apex_points;
    report.cells_from_segments += filled.zone.cells.size();
    const auto renumbered = [&](std::uint32_t p) { return p < own_points ? p : first_point + (p - own_points); };
    for (ThinCell cell : filled.zone.cells) {
      for (int k = 0; k < vertex_count(cell.type); ++k) cell.vertices[k] = renumbered(cell.vertices[k]);
      mesh.add_cell(cell.type, cell.vertices.data(), static_cast<std::int32_t>(r));
      const double volume_m3 = volume_of(cell, mesh.points);
      counted.volume_m3 += volume_m3;
      if (cell.type == CellType::tetrahedron) ++counted.tetrahedra;
      if (cell.type == CellType::pyramid) ++counted.pyramids;
      if (cell.type != CellType::prism) continue;
      ++counted.prisms;
      counted.prism_volume_m3 += volume_m3;
      const double ratio = anisotropy(cell, mesh.points);
      anisotropy_sum += ratio;
      anisotropy_low = std::min(anisotropy_low, ratio);
      report.max_anisotropy_ratio = std::max(report.max_anisotropy_ratio, ratio);
      ++prisms;
    }
    for (const CoveredSide& side : filled.zone.covered) beside[side.triangle][side.side] = first_cell + side.cell;
    for (const WallQuad& quad : filled.zone.wall_quads) {
      for (const std::uint32_t t : quad.triangles) is_in_quad[t] = 1;
      quads.push_back({quad.vertices, quad.surface, first_cell + quad.cell, no_index});
    }

    const RegionBoundary& boundary = filled.cavity.boundary;
    first_cell = static_cast<std::uint32_t>(mesh.cell_count());
    const auto first_fill_point = static_cast<std::uint32_t>(mesh.points.size());
    const auto boundary_points = static_cast<std::uint32_t>(boundary.points.size());
    mesh.points.insert(mesh.points.end(), filled.tets.interior_points.begin(), filled.tets.interior_points.end());
    report.fill_points += filled.tets.interior_points.size() - filled.sites;
    report.cells_from_vertices += filled.duals.counts.kept;
    report.cells_from_fill += filled.tets.tets.size() - filled.duals.counts.kept;
    counted.tetrahedra += filled.tets.tets.size();
    counted.volume_m3 += boundary.facets.empty() ? 0 : filled.cavity.volume_m3;
    for (const Tet& tet : filled.tets.tets) {
      Tet vertices{};
      for (std::size_t k = 0; k < 4; ++k)
        vertices[k] = tet[k] < boundary_points ? renumbered(boundary.points[tet[k]])
                                               : first_fill_point + (tet[k] - boundary_points);
      mesh.add_cell(CellType::tetrahedron, vertices.data(), static_cast<std::int32_t>(r));
    }
    for (std::size_t f = 0; f < boundary.triangles.size(); ++f)
      for (std::size_t side = 0; side < 2 && boundary.triangles[f] != no_index; ++side)
        if (filled.tets.facet_tets[f][side] != no_index)
          beside[boundary.triangles[f]][side] = first_cell + filled.tets.facet_tets[f][side];
  }
  mesh.point_line = model.point_line;
  mesh.point_corner = model.point_corner;
  mesh.point_line.resize(mesh.points.size(), -1);
  mesh.point_corner.resize(mesh.points.size(), -1);
  for (std::size_t t = 0; t < beside.size(); ++t) {
    if (is_in_quad[t] || (beside[t][0] == no_index && beside[t][1] == no_index)) continue;
    const Triangle& v = model.triangles[t];
    if (beside[t][0] != no_index)
      mesh.facets.push_back({{v[0], v[1], v[2], no_index}, model.triangle_surface[t], beside[t][0], beside[t][1]});
    else
      mesh.facets.push_back({{v[0], v[2], v[1], no_index}, model.triangle_surface[t], beside[t][1], no_index});
  }
  mesh.facets.insert(mesh.facets.end(), quads.begin(), quads.end());
  if (prisms > 0) {
    report.min_anisotropy_ratio = anisotropy_low;
    report.mean_anisotropy_ratio = anisotropy_sum / static_cast<double>(prisms);
  }
  return hybrid;
}

/// Tetrahedra alone, on surfaces that had to be split.
Result<HybridMesh> tetrahedra_alone(const StructuralModel& model, const FillHybridOptions& options,
                                    const std::string& refusal, const CancellationToken* cancellation,
                                    const std::filesystem::path& worker) {
  Result<VolumeMesh> mesh = tetrahedralize_model(model, options.fill, cancellation, worker);
  if (!mesh) return mesh.failure();
  HybridMesh hybrid;
  hybrid.mesh = std::move(*mesh);
  HybridReport& report = hybrid.report;
  report.cells_from_fill = hybrid.mesh.cell_count();
  report.surface_points = model.points.size();
  report.fill_points = hybrid.mesh.points.size() - model.points.size();
  report.regions.resize(model.regions.size());
  for (std::size_t c = 0; c < hybrid.mesh.cell_count(); ++c) {
    HybridRegion& counted = report.regions[static_cast<std::size_t>(hybrid.mesh.cell_region[c])];
    ThinCell cell;
    std::copy_n(&hybrid.mesh.cell_vertices[hybrid.mesh.cell_offsets[c]], 4, cell.vertices.begin());
    ++counted.tetrahedra;
    counted.volume_m3 += volume_of(cell, hybrid.mesh.points);
  }
  hybrid.mesh.changes.push_back({"without_prisms", "the whole model has tetrahedra only", refusal});
  return hybrid;
}

}  // namespace

Result<HybridMesh> fill_hybrid(const StructuralModel& model, const std::vector<std::uint32_t>& point_site,
                               const FillHybridOptions& options, const CancellationToken* cancellation,
                               const std::filesystem::path& worker) {
  if (options.layers_through_thin < 1)
    return Failure{FailureCode::invalid_options, "layers_through_thin must be at least 1", "raise it"};
  if (model.regions.empty())
    return Failure{FailureCode::invalid_input, "the model encloses no region",
                   "close its surfaces: strataflow check names the leaks"};
  FacingCounts facing;
  const std::vector<FacingPair> pairs = find_facing_triangles(model, point_site, facing);
  std::vector<std::size_t> first_pair(model.regions.size() + 1, 0);
  for (const FacingPair& pair : pairs) ++first_pair[pair.region + 1];
  for (std::size_t r = 0; r < model.regions.size(); ++r) first_pair[r + 1] += first_pair[r];
  std::vector<Filled> regions = parallel_map(model.regions.size(), [&](std::size_t r) {
    return fill_region(model, static_cast<std::uint32_t>(r),
                       std::span(pairs).subspan(first_pair[r], first_pair[r + 1] - first_pair[r]), options,
                       cancellation, worker);
  });
  std::string refusal;
  for (const Filled& filled : regions) {
    if (filled.failure) return *filled.failure;
    if (refusal.empty()) refusal = filled.refusal;
  }
  if (!refusal.empty()) {
    if (options.fill.split_surfaces == "never")
      return Failure{FailureCode::geometry_failed, "could not be filled with tetrahedra: " + refusal,
                     "ask for another number of sites"};
    Result<HybridMesh> alone = tetrahedra_alone(model, options, refusal, cancellation, worker);
    if (alone) {
      alone->report.facing = facing;
      alone->report.dropped.unfilled = facing.pairs;
    }
    return alone;
  }
  share_out_sites(options.interior_sites, regions);
  parallel_ranges(regions.size(), 1,
                  [&](std::size_t r, std::size_t) { mesh_inside(model, options, cancellation, regions[r]); });
  if (cancellation && cancellation->is_cancelled())
    return Failure{FailureCode::cancelled, "meshing was stopped", "run it again"};
  HybridMesh hybrid = assembled(model, regions);
  hybrid.report.facing = facing;
  for (std::size_t r = 0; r < regions.size(); ++r)
    if (regions[r].zone.dropped.unfilled > 0)
      hybrid.mesh.changes.push_back({"without_prisms",
                                     "region '" + model.regions[r].name + "' (" + std::to_string(r) + ")",
                                     "it could not be filled around its prisms: " + regions[r].prisms_refused});
  return hybrid;
}

}  // namespace strataflow
