#include "kernels/hexes/audit/audit_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/nearest_point.h"
#include "kernels/quality/measure_cell.h"
#include "kernels/quality/nearest_triangle.h"
#include "kernels/topology/sorted_unique.h"
#include "model/box3.h"

namespace strataflow {
namespace {

bool is_level(SheetKind kind) {
  return kind == SheetKind::horizon || kind == SheetKind::top || kind == SheetKind::bottom;
}

double area_m2(const LabelledTets& model, const SheetFacet& facet, bool from_above) {
  const auto& [a, b, c] = facet.vertices;
  const Vec3 n = cross(model.points[b] - model.points[a], model.points[c] - model.points[a]);
  return 0.5 * (from_above ? std::abs(n.z) : length(n));
}

/// Vertices over plan points on faults, and those of facets on faults.
std::vector<char> vertices_on_traces(const HexGrid& grid) {
  std::vector<char> is_trace(grid.plan.points.size(), 0);
  for (const FeatureEdge& edge : grid.plan.edges)
    if (edge.feature < grid.plan.features.size() && grid.plan.features[edge.feature].role == Role::fault)
      is_trace[edge.a] = is_trace[edge.b] = 1;
  std::vector<char> is_on = vertices_on_faults(grid.mesh);
  for (std::size_t c = 0; c < grid.mesh.cell_count(); ++c)
    for (std::size_t k = 0; k < 8; ++k)
      if (is_trace[grid.plan.quads[grid.cell_column[c]][k % 4]]) is_on[grid.mesh.cell_vertices[8 * c + k]] = 1;
  return is_on;
}

struct SurfaceEdge {
  std::uint32_t entity = 0, a = 0, b = 0;
};

/// Edges of one facet alone, no other surface touching that is followed: where faults die. Ascending by entity.
std::vector<SurfaceEdge> dying_edges(const LabelledTets& model) {
  std::vector<SurfaceEdge> uses;
  for (const SheetFacet& facet : model.facets)
    for (std::size_t k = 0; k < 3 && facet.is_aligned != 0; ++k) {
      const std::uint32_t a = facet.vertices[k], b = facet.vertices[(k + 1) % 3];
      uses.push_back({facet.entity, std::min(a, b), std::max(a, b)});
    }
  std::sort(uses.begin(), uses.end(), [](const SurfaceEdge& x, const SurfaceEdge& y) {
    return std::array{x.a, x.b, x.entity} < std::array{y.a, y.b, y.entity};
  });
  std::vector<SurfaceEdge> dying;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto same = [&](std::size_t j) { return uses[j].a == uses[i].a && uses[j].b == uses[i].b; };
    if (!(i > 0 && same(i - 1)) && !(i + 1 < uses.size() && same(i + 1))) dying.push_back(uses[i]);
  }
  std::stable_sort(dying.begin(), dying.end(),
                   [](const SurfaceEdge& x, const SurfaceEdge& y) { return x.entity < y.entity; });
  return dying;
}

/// Edges of levels at faults that need not be followed. Ascending by entity.
std::vector<SurfaceEdge> edges_at_dropped(const LabelledTets& model) {
  std::vector<std::array<std::uint32_t, 2>> dropped;
  const auto visit_edges = [&](const auto& is_wanted, const auto& visit) {
    for (const SheetFacet& facet : model.facets)
      for (std::size_t k = 0; k < 3 && is_wanted(facet); ++k)
        visit(facet.entity, std::min(facet.vertices[k], facet.vertices[(k + 1) % 3]),
              std::max(facet.vertices[k], facet.vertices[(k + 1) % 3]));
  };
  visit_edges([](const SheetFacet& facet) { return facet.kind == SheetKind::fault && facet.is_aligned == 0; },
              [&](std::uint32_t, std::uint32_t a, std::uint32_t b) {
                dropped.push_back({a, b});
              });
  dropped = sorted_unique(std::move(dropped));
  std::vector<SurfaceEdge> edges;
  visit_edges([](const SheetFacet& facet) { return is_level(facet.kind); },
              [&](std::uint32_t entity, std::uint32_t a, std::uint32_t b) {
                if (std::binary_search(dropped.begin(), dropped.end(), std::array{a, b}))
                  edges.push_back({entity, a, b});
              });
  std::stable_sort(edges.begin(), edges.end(),
                   [](const SurfaceEdge& x, const SurfaceEdge& y) { return x.entity < y.entity; });
  return edges;
}

/// Whether a point of a surface lies on one of these of its edges.
bool is_on_edge(const LabelledTets& model, const std::vector<SurfaceEdge>& edges, std::uint32_t entity, const Vec3& p,
                double tolerance_m) {
  const auto first = std::lower_bound(edges.begin(), edges.end(), entity,
                                      [](const SurfaceEdge& e, std::uint32_t wanted) { return e.entity < wanted; });
  for (auto edge = first; edge != edges.end() && edge->entity == entity; ++edge) {
    const Vec3 &a = model.points[edge->a], along = model.points[edge->b] - a;
    if (length(p - a - std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0) * along) <= tolerance_m) return true;
  }
  return false;
}

}  // namespace

std::vector<char> vertices_on_faults(const VolumeMesh& mesh) {
  std::vector<char> is_on(mesh.points.size(), 0);
  for (const MeshFacet& facet : mesh.facets) {
    const auto entity = static_cast<std::size_t>(mesh.surface_entity[facet.surface]);
    if (mesh.entities[entity].role != Role::fault) continue;
    for (const std::uint32_t v : facet.vertices)
      if (v != no_index) is_on[v] = 1;
  }
  return is_on;
}

std::vector<SurfaceAudit> audit_surfaces(const HexGrid& grid, const LiveCells& live, const LabelledTets& model) {
  const VolumeMesh& mesh = grid.mesh;
  const std::vector<char> is_trace = vertices_on_traces(grid), is_closed = vertices_of_closed_edges(grid);
  std::vector<std::vector<Triangle>> triangles(model.entities.size());
  std::vector<std::optional<SheetKind>> kind(model.entities.size());
  std::vector<double> area(model.entities.size(), 0);
  std::vector<char> is_followed(model.entities.size(), 1);
  std::vector<Triangle> level_triangles, dropped_triangles;
  for (const SheetFacet& facet : model.facets) {
    triangles[facet.entity].push_back(facet.vertices);
    if (!kind[facet.entity]) kind[facet.entity] = facet.kind;
    area[facet.entity] += area_m2(model, facet, is_level(facet.kind));
    if (facet.kind == SheetKind::fault && facet.is_aligned == 0) {
      is_followed[facet.entity] = 0;
      dropped_triangles.push_back(facet.vertices);
    }
    if (is_level(facet.kind)) level_triangles.push_back(facet.vertices);
  }
  const std::vector<SurfaceEdge> dying = dying_edges(model), at_dropped = edges_at_dropped(model);
  Box3 box;
  for (const Vec3& p : model.points) box.take(p);
  std::vector<std::vector<std::uint32_t>> facets(model.entities.size());
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f)
    facets[static_cast<std::size_t>(mesh.surface_entity[mesh.facets[f].surface])].push_back(f);
  std::vector<double> live_area(model.entities.size(), 0);
  for (const MeshFacet& facet : live.mesh.facets) {
    const auto e = static_cast<std::size_t>(live.mesh.surface_entity[facet.surface]);
    const auto at = [&](std::size_t k) { return live.mesh.points[facet.vertices[k]]; };
    const Vec3 n = 0.5 * (facet.vertices[3] == no_index ? cross(at(1) - at(0), at(2) - at(0))
                                                        : cross(at(2) - at(0), at(3) - at(1)));
    const bool is_one_of_two = model.entities[e].role == Role::fault && facet.cell_1 == no_index;
    live_area[e] += (is_one_of_two ? 0.5 : 1.0) * (kind[e] && is_level(*kind[e]) ? std::abs(n.z) : length(n));
  }
  const NearestTriangle nearest_level(TriangleMesh{model.points, level_triangles});
  const NearestTriangle nearest_dropped(TriangleMesh{model.points, dropped_triangles});
  const double near_dropped_m = 0.5 * mean_plan_edge_m(grid.plan);
  std::vector<SurfaceAudit> audits;
  for (std::uint32_t e = 0; e < model.entities.size(); ++e) {
    if (triangles[e].empty() && facets[e].empty()) continue;
    SurfaceAudit audit;
    audit.name = model.entities[e].name;
    audit.role = std::string(to_string(model.entities[e].role));
    audit.facets = facets[e].size();
    audit.model_area_m2 = area[e];
    audit.is_followed = is_followed[e] != 0;
    const bool from_above = kind[e] && is_level(*kind[e]);
    const NearestTriangle nearest(TriangleMesh{model.points, triangles[e]});
    std::vector<std::uint32_t> vertices;
    std::vector<Vec3> centres;
    for (const std::uint32_t f : facets[e]) {
      const MeshFacet& facet = mesh.facets[f];
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) {
        vertices.push_back(facet.vertices[k]);
        p[k] = mesh.points[facet.vertices[k]];
      }
      centres.push_back(0.25 * (p[0] + p[1] + p[2] + p[3]));
    }
    audit.grid_area_m2 = live_area[e];
    vertices = sorted_unique(std::move(vertices));
    audit.vertices = vertices.size();
    struct Away {
      double m = 0;
      bool is_beyond = false, is_bridged = false;
    };
    const std::vector<Away> away = parallel_map(
        vertices.size(),
        [&](std::size_t i) {
          const Vec3& p = mesh.points[vertices[i]];
          const bool is_at_level = from_above && is_closed[vertices[i]];
          const NearestTriangle::Hit hit = (is_at_level ? nearest_level : nearest).nearest(p);
          Away one{std::sqrt(hit.squared_m2)};
          if (is_at_level || hit.triangle == no_index || !(one.m > 1e-9 * box.diagonal_m())) return one;
          const auto& [a, b, c] = triangles[e][hit.triangle];
          const Vec3 at = nearest_point(p, model.points[a], model.points[b], model.points[c]);
          (from_above ? one.is_bridged : one.is_beyond) =
              is_on_edge(model, from_above ? at_dropped : dying, e, at, 1e-9 * box.diagonal_m()) ||
              (from_above && nearest_dropped.nearest(p).squared_m2 <= near_dropped_m * near_dropped_m);
          return one;
        },
        64);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const bool is_apart =
          (from_above && (is_closed[vertices[i]] || is_trace[vertices[i]])) || away[i].is_beyond || away[i].is_bridged;
      double& furthest = away[i].is_beyond                      ? audit.furthest_beyond_m
                         : away[i].is_bridged                   ? audit.furthest_bridged_m
                         : from_above && is_closed[vertices[i]] ? audit.furthest_closed_m
                         : from_above && is_trace[vertices[i]]  ? audit.furthest_on_traces_m
                                                                : audit.furthest_m;
      furthest = std::max(furthest, away[i].m);
      sum += is_apart ? 0 : away[i].m;
      count += is_apart ? 0 : 1;
    }
    audit.mean_m = count > 0 ? sum / static_cast<double>(count) : 0;
    audit.furthest_centre_m = std::sqrt(ordered_reduce(
        centres.size(), 0.0, [&](std::size_t i) { return nearest.nearest(centres[i]).squared_m2; },
        [](double a, double b) { return std::max(a, b); }));
    audits.push_back(std::move(audit));
  }
  return audits;
}

std::vector<RegionVolumeAudit> audit_regions(const HexGrid& grid, const LabelledTets& model) {
  std::size_t count = model.region_names.size();
  for (const std::int32_t region : model.region) count = std::max(count, static_cast<std::size_t>(region + 1));
  std::vector<RegionVolumeAudit> audits(count);
  for (std::size_t r = 0; r < count; ++r)
    audits[r].name = r < model.region_names.size() ? model.region_names[r] : "region " + std::to_string(r);
  const auto of = [&](std::int32_t region) -> RegionVolumeAudit* {
    return region >= 0 && static_cast<std::size_t>(region) < count ? &audits[static_cast<std::size_t>(region)]
                                                                   : nullptr;
  };
  for (std::size_t t = 0; t < model.tets.size(); ++t) {
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = model.points[model.tets[t][k]];
    if (RegionVolumeAudit* audit = of(model.region[t])) audit->model_m3 += cell_volume(CellType::tetrahedron, p);
  }
  const std::vector<double> volumes = parallel_map(
      grid.mesh.cell_count(),
      [&](std::size_t c) { return cell_volume(CellType::hexahedron, hex_corners(grid.mesh, c)); }, 1024);
  for (std::size_t c = 0; c < volumes.size(); ++c)
    if (RegionVolumeAudit* audit = of(grid.mesh.cell_region[c])) audit->grid_m3 += volumes[c];
  std::vector<char> is_dying(model.entities.size(), 0);
  for (const SurfaceEdge& edge : dying_edges(model)) is_dying[edge.entity] = 1;
  for (const std::int32_t zone : grid.mesh.cell_entity)  // volumetric faults take from both sides
    if (zone >= 0 && static_cast<std::size_t>(zone) < is_dying.size()) is_dying[static_cast<std::size_t>(zone)] = 1;
  for (std::uint32_t face = 0; face < model.facet_of.size(); ++face) {
    if (model.facet_of[face] == no_index || model.neighbour[face] == no_index) continue;
    const SheetFacet& facet = model.facets[model.facet_of[face]];
    const bool is_stepped = (facet.kind == SheetKind::fault && (is_dying[facet.entity] || facet.is_aligned == 0)) ||
                            model.entities[facet.entity].role == Role::unconformity;
    if (RegionVolumeAudit* audit = of(model.region[face / 4]); is_stepped && audit != nullptr)
      audit->stepped_area_m2 += area_m2(model, facet, false);
  }
  const double edge_m = mean_plan_edge_m(grid.plan);
  for (RegionVolumeAudit& audit : audits) {
    audit.allowed_m3 = std::max(0.005 * audit.model_m3, 0.5 * edge_m * audit.stepped_area_m2);
    audit.is_within = std::abs(audit.grid_m3 - audit.model_m3) <= audit.allowed_m3;
  }
  return audits;
}

}  // namespace strataflow
