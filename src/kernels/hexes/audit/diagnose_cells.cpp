#include "kernels/hexes/audit/diagnose_cells.h"

#include <algorithm>
#include <cmath>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/hexes/audit/audit_surfaces.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/quality/cell_shape.h"
#include "kernels/quality/match_cell_faces.h"
#include "kernels/quality/measure_cell.h"
#include "kernels/topology/union_find.h"

namespace strataflow {
namespace {

constexpr double warped_ratio = 0.05;      // of the mean edge
constexpr double flat_ratio = 1e-6;        // of the mean edge: what a vertex may lie beyond a plane by rounding
constexpr double collocated_ratio = 1e-9;  // of the mean edge

struct FacePlane {
  Vec3 centre, normal;  // normal: out of the cell, unit length; zero for a face without area
};

FacePlane plane_of(const std::array<Vec3, 8>& p, const LocalFace& face, double edge_m) {
  FacePlane plane;
  for (const std::uint8_t v : face) plane.centre = plane.centre + 0.25 * p[v];
  const Vec3 n = cross(p[face[2]] - p[face[0]], p[face[3]] - p[face[1]]);
  if (length(n) > 1e-9 * edge_m * edge_m) plane.normal = (1 / length(n)) * n;
  return plane;
}

/// Whether the closed segment meets the closed triangle, which shares no corner with it.
bool meet(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q, const Vec3& r) {
  const int from = orientation_3d(p, q, r, a), to = orientation_3d(p, q, r, b);
  if (from == to) return false;
  const int u = orientation_3d(a, b, p, q), v = orientation_3d(a, b, q, r), w = orientation_3d(a, b, r, p);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Whether the segments ab and cd, opposite edges of a face, cross when seen along its normal.
bool cross_in_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal) {
  const int axis = std::abs(normal.x) >= std::abs(normal.y) ? (std::abs(normal.x) >= std::abs(normal.z) ? 0 : 2)
                                                            : (std::abs(normal.y) >= std::abs(normal.z) ? 1 : 2);
  return orientation_2d(a, b, c, axis) * orientation_2d(a, b, d, axis) < 0 &&
         orientation_2d(c, d, a, axis) * orientation_2d(c, d, b, axis) < 0;
}

struct CellFindings {
  char is_flat = 0, is_crossed = 0, is_misoriented = 0, is_hollow = 0, has_repeated = 0;
  std::uint32_t warped = 0;
  double warpage_m = 0;
};

CellFindings find_in_cell(const std::array<Vec3, 8>& p, double edge_m) {
  CellFindings findings;
  const auto faces = shape_of(CellType::hexahedron).faces;
  Vec3 middle;
  for (const Vec3& v : p) middle = middle + 0.125 * v;
  findings.is_flat = !(cell_volume(CellType::hexahedron, p) > 0);
  for (const LocalFace& face : faces) {
    const FacePlane plane = plane_of(p, face, edge_m);
    if (plane.normal == Vec3{}) continue;
    if (!(dot(plane.normal, plane.centre - middle) > 0)) findings.is_misoriented = 1;
    double warpage = 0;
    for (std::uint8_t v = 0; v < 8; ++v) {
      const double beyond = dot(plane.normal, p[v] - plane.centre);
      if (std::find(face.begin(), face.end(), v) != face.end())
        warpage = std::max(warpage, std::abs(beyond));
      else if (beyond > flat_ratio * edge_m)
        findings.is_hollow = 1;
    }
    findings.warpage_m = std::max(findings.warpage_m, warpage);
    if (warpage > warped_ratio * edge_m) ++findings.warped;
  }
  // A cell within all planes of its faces cannot pass through itself.
  if (findings.is_hollow || findings.is_misoriented || findings.is_flat) findings.is_crossed = is_self_intersecting(p);
  return findings;
}

/// Nodes at the place of another one.
PlacedCount count_collocated(const VolumeMesh& mesh, double tolerance_m) {
  const std::vector<char> is_on_fault = vertices_on_faults(mesh);
  const auto box_around = [&](std::size_t v, double reach) {
    Box3 box;
    box.take(mesh.points[v] - Vec3{reach, reach, reach});
    box.take(mesh.points[v] + Vec3{reach, reach, reach});
    return enclosing(box);
  };
  const BoundingVolumeTree tree(parallel_map(
      mesh.points.size(), [&](std::size_t v) { return box_around(v, 0); }, 1024));
  enum : char { alone, on_fault, elsewhere };
  const std::vector<char> found = parallel_map(
      mesh.points.size(),
      [&](std::size_t v) {
        char worst = alone;
        tree.visit_items(box_around(v, tolerance_m), [&](std::uint32_t w) {
          if (v == w || !(length(mesh.points[v] - mesh.points[w]) <= tolerance_m)) return;
          worst = std::max<char>(worst, is_on_fault[v] && is_on_fault[w] ? on_fault : elsewhere);
        });
        return worst;
      },
      256);
  return {static_cast<std::uint64_t>(std::count(found.begin(), found.end(), on_fault)),
          static_cast<std::uint64_t>(std::count(found.begin(), found.end(), elsewhere))};
}

/// Per side 4·quad + k, whether the plan ends there.
std::vector<char> outer_sides(const QuadMesh& plan) {
  struct Side {
    std::uint32_t a, b, side;
  };
  std::vector<Side> sides;
  for (std::uint32_t s = 0; s < 4 * plan.quads.size(); ++s) {
    const std::uint32_t a = plan.quads[s / 4][s % 4], b = plan.quads[s / 4][(s + 1) % 4];
    sides.push_back({std::min(a, b), std::max(a, b), s});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::array{x.a, x.b, x.side} < std::array{y.a, y.b, y.side};
  });
  std::vector<char> is_outer(sides.size(), 1);
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].a == sides[i - 1].a && sides[i].b == sides[i - 1].b)
      is_outer[sides[i].side] = is_outer[sides[i - 1].side] = 0;
  return is_outer;
}

/// The different vertices of a face, ascending; no_index at the end.
std::array<std::uint32_t, 4> vertex_set(std::array<std::uint32_t, 4> face) {
  std::sort(face.begin(), face.end());
  const auto end = std::unique(face.begin(), face.end());
  std::fill(end, face.end(), no_index);
  return face;
}

/// Inner faces with a live cell on one side alone.
PlacedCount count_nonconforming(const HexGrid& grid, const LiveCells& live) {
  const VolumeMesh& mesh = live.mesh;
  const std::vector<char> is_outer_side = outer_sides(grid.plan);
  std::vector<std::uint32_t> first_layer(grid.plan.quads.size(), no_index), last_layer(grid.plan.quads.size(), 0);
  for (const std::uint32_t c : live.grid_cell) {
    const std::uint32_t column = grid.cell_column[c], layer = grid.cell_layer[c];
    first_layer[column] = std::min(first_layer[column], layer);
    last_layer[column] = std::max(last_layer[column], layer);
  }
  std::vector<std::array<std::uint32_t, 4>> fault_faces;
  for (const MeshFacet& facet : mesh.facets)
    if (mesh.entities[static_cast<std::size_t>(mesh.surface_entity[facet.surface])].role == Role::fault)
      fault_faces.push_back(vertex_set(facet.vertices));
  std::sort(fault_faces.begin(), fault_faces.end());
  const auto faces = shape_of(CellType::hexahedron).faces;  // bottom, top, then over the plan's sides 0…3
  const FaceMatching matching = match_cell_faces(mesh);
  PlacedCount count;
  count.elsewhere = matching.nonconforming_faces;
  for (const CellFace& face : matching.boundary_faces) {
    const std::array<std::uint32_t, 4> wanted = vertex_set(face.vertices);
    const std::uint32_t cell = live.grid_cell[face.cell], column = grid.cell_column[cell];
    bool is_outer = false;
    for (std::size_t local = 0; local < 6; ++local) {
      std::array<std::uint32_t, 4> mine{};
      for (std::size_t k = 0; k < 4; ++k) mine[k] = mesh.cell_vertices[8 * std::size_t{face.cell} + faces[local][k]];
      if (vertex_set(mine) != wanted) continue;
      is_outer = is_outer || (local == 0   ? grid.cell_layer[cell] == first_layer[column]
                              : local == 1 ? grid.cell_layer[cell] == last_layer[column]
                                           : is_outer_side[4 * std::size_t{column} + local - 2] != 0);
    }
    if (is_outer) continue;
    if (std::binary_search(fault_faces.begin(), fault_faces.end(), wanted))
      ++count.on_faults;
    else
      ++count.elsewhere;
  }
  return count;
}

}  // namespace

bool is_self_intersecting(const std::array<Vec3, 8>& p) {
  const auto faces = shape_of(CellType::hexahedron).faces;
  for (const LocalFace& face : faces) {
    const Vec3 n = cross(p[face[2]] - p[face[0]], p[face[3]] - p[face[1]]);
    if (cross_in_plane(p[face[0]], p[face[1]], p[face[2]], p[face[3]], n) ||
        cross_in_plane(p[face[1]], p[face[2]], p[face[3]], p[face[0]], n))
      return true;
    for (const LocalFace& other : faces)
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint8_t a = other[k], b = other[(k + 1) % 4];
        if (std::any_of(face.begin(), face.end(), [&](std::uint8_t v) { return p[v] == p[a] || p[v] == p[b]; }))
          continue;
        if (meet(p[a], p[b], p[face[0]], p[face[1]], p[face[2]]) ||
            meet(p[a], p[b], p[face[0]], p[face[2]], p[face[3]]))
          return true;
      }
  }
  return false;
}

CellDiagnosis diagnose_cells(const HexGrid& grid, const LiveCells& live) {
  const VolumeMesh& mesh = live.mesh;
  const double edge_m = mean_plan_edge_m(grid.plan);
  const std::vector<CellFindings> findings = parallel_map(
      mesh.cell_count(),
      [&](std::size_t c) {
        CellFindings one = find_in_cell(hex_corners(mesh, c), edge_m);
        std::array<std::uint32_t, 8> nodes{};
        std::copy_n(mesh.cell_vertices.begin() + static_cast<std::ptrdiff_t>(8 * c), 8, nodes.begin());
        std::sort(nodes.begin(), nodes.end());
        one.has_repeated = std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end();
        return one;
      },
      256);
  CellDiagnosis diagnosis;
  double warpage = 0;
  UnionFind parts(mesh.points.size());
  for (std::size_t c = 0; c < findings.size(); ++c) {
    diagnosis.unsupported_types += mesh.cell_types[c] != CellType::hexahedron ? 1 : 0;
    diagnosis.repeated_nodes += findings[c].has_repeated ? 1 : 0;
    diagnosis.nonpositive_volumes += findings[c].is_flat ? 1 : 0;
    diagnosis.self_intersecting += findings[c].is_crossed ? 1 : 0;
    diagnosis.misoriented += findings[c].is_misoriented ? 1 : 0;
    diagnosis.non_convex += findings[c].is_hollow ? 1 : 0;
    diagnosis.warped_faces += findings[c].warped;
    warpage = std::max(warpage, findings[c].warpage_m);
    for (std::size_t k = 1; k < 8; ++k) parts.unite(mesh.cell_vertices[8 * c], mesh.cell_vertices[8 * c + k]);
  }
  diagnosis.largest_warpage_ratio = warpage / edge_m;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) diagnosis.parts += parts.find(v) == v ? 1 : 0;
  diagnosis.collocated_nodes = count_collocated(mesh, collocated_ratio * edge_m);
  diagnosis.nonconforming_faces = count_nonconforming(grid, live);
  return diagnosis;
}

}  // namespace strataflow
