#include "kernels/hybrid/vertex_duals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/adapters/cgal/delaunay_tetrahedra.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/hybrid/region_colouring.h"
#include "kernels/hybrid/vertex_cell.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/volumes/tet_faces.h"

namespace strataflow {

namespace {

/// Where straight lines pierce the facets of a boundary.
class PiercedBoundary {
 public:
  explicit PiercedBoundary(const RegionBoundary& boundary) : boundary_(boundary) {
    std::vector<FloatBox> boxes;
    boxes.reserve(boundary.facets.size());
    for (const Triangle& facet : boundary.facets) {
      Box3 box;
      for (const std::uint32_t p : facet) box.take(at(p));
      boxes.push_back(enclosing(box));
    }
    tree_ = BoundingVolumeTree(boxes);
  }

  /// Appends the crossings from p to q, in order. An end on a facet counts as lying on its positive side, an edge of
  /// facets as lying beside the line on the same side for both: each facet decides with the same signs. Two crossings
  /// nearer to each other than can be told, one of which undoes the other, are none, whichever comes first.
  void find(const Vec3& p, const Vec3& q, std::vector<EdgeCrossing>& crossings) {
    hits_.clear();
    tree_.visit_items(box_of(p, q), [&](std::uint32_t f) {
      const auto& [a, b, c] = boundary_.facets[f];
      const bool p_above = orientation_3d(at(a), at(b), at(c), p) >= 0;
      const bool q_above = orientation_3d(at(a), at(b), at(c), q) >= 0;
      if (p_above == q_above) return;
      const bool left = is_left(p, q, a, b);
      if (left != is_left(p, q, b, c) || left != is_left(p, q, c, a)) return;
      const Vec3 normal = cross(at(b) - at(a), at(c) - at(a));
      const double from = dot(normal, at(a) - p), all = dot(normal, q - p);
      hits_.push_back({all != 0 ? from / all : 0, f, p_above});
    });
    std::sort(hits_.begin(), hits_.end(),
              [](const Hit& x, const Hit& y) { return x.place != y.place ? x.place < y.place : x.facet < y.facet; });
    constexpr double same_place = 1e-9;  // of the way from p to q
    const std::size_t first = crossings.size();
    places_.clear();
    for (const Hit& hit : hits_) {
      const auto region_on = [&](int side) { return (boundary_.sides[hit.facet] >> side & 1) != 0 ? 0u : universe; };
      const EdgeCrossing crossing{region_on(hit.from_above ? 1 : 0), region_on(hit.from_above ? 0 : 1)};
      if (crossings.size() > first && hit.place - places_.back() < same_place &&
          crossing.from_region == crossings.back().to_region && crossing.to_region == crossings.back().from_region) {
        crossings.pop_back();
        places_.pop_back();
        continue;
      }
      crossings.push_back(crossing);
      places_.push_back(hit.place);
    }
  }

  /// Whether an edge goes through a facet, neither of whose corners it has, or in whose plane it lies.
  bool crosses(std::uint32_t e, std::uint32_t d, const std::vector<Vec3>& points) const {
    bool does = false;
    tree_.visit_items(box_of(points[e], points[d]), [&](std::uint32_t f) {
      const Triangle& facet = boundary_.facets[f];
      for (const std::uint32_t v : facet)
        if (v == e || v == d) return;
      does = does || goes_through(points[e], points[d], at(facet[0]), at(facet[1]), at(facet[2]));
    });
    return does;
  }
  /// Whether an edge of a facet goes through the triangle.
  bool pierces(const Triangle& face, const std::vector<Vec3>& points) const {
    bool does = false;
    Box3 box;
    for (const std::uint32_t v : face) box.take(points[v]);
    tree_.visit_items(enclosing(box), [&](std::uint32_t f) {
      const Triangle& facet = boundary_.facets[f];
      for (std::size_t k = 0; k < 3 && !does; ++k) {
        const std::uint32_t a = facet[k], b = facet[(k + 1) % 3];
        const bool is_corner = std::any_of(face.begin(), face.end(), [&](std::uint32_t v) { return v == a || v == b; });
        does = !is_corner && goes_through(at(a), at(b), points[face[0]], points[face[1]], points[face[2]]);
      }
    });
    return does;
  }

 private:
  struct Hit {
    double place;
    std::uint32_t facet;
    bool from_above;
  };
  const Vec3& at(std::uint32_t p) const { return boundary_.coordinates[p]; }
  static FloatBox box_of(const Vec3& p, const Vec3& q) {
    Box3 box;
    box.take(p);
    box.take(q);
    return enclosing(box);
  }
  bool is_left(const Vec3& p, const Vec3& q, std::uint32_t a, std::uint32_t b) const {
    const bool is_up = a < b;
    return (orientation_3d(p, q, at(is_up ? a : b), at(is_up ? b : a)) >= 0) == is_up;
  }
  static bool goes_through(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    if (orientation_3d(a, b, c, p) * orientation_3d(a, b, c, q) >= 0) return false;
    const int ab = orientation_3d(p, q, a, b), bc = orientation_3d(p, q, b, c), ca = orientation_3d(p, q, c, a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  }

  const RegionBoundary& boundary_;
  BoundingVolumeTree tree_;
  std::vector<Hit> hits_;
  std::vector<double> places_;  ///< of the crossings kept
};

/// The centre of the sphere through four points; of a nearly flat one, whose centre is lost or far beyond everything,
/// a point in its direction, or in its middle.
Vec3 circumcentre(const std::array<Vec3, 4>& p, double farthest) {
  const Vec3 u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
  const Vec3 scaled = dot(w, w) * cross(u, v) + dot(v, v) * cross(w, u) + dot(u, u) * cross(v, w);
  const double twice = 2 * dot(cross(u, v), w), reach = length(scaled);
  if (std::abs(twice) * farthest >= reach && twice != 0) return p[0] + (1 / twice) * scaled;
  if (reach > 0 && std::isfinite(reach)) return p[0] + ((twice < 0 ? -farthest : farthest) / reach) * scaled;
  return 0.25 * (p[0] + p[1] + p[2] + p[3]);
}

Tet sorted(Tet tet) {
  std::sort(tet.begin(), tet.end());
  return tet;
}

}  // namespace

VertexDuals find_vertex_duals(const RegionBoundary& boundary, const RegionMesh& mesh) {
  VertexDuals duals;
  duals.is_dual.assign(mesh.tets.size(), 0);
  VertexDualCounts& counts = duals.counts;
  const std::vector<Vec3> points = points_of(boundary, mesh);
  const DelaunayTetrahedra delaunay = delaunay_tetrahedra(points);
  Box3 box;
  for (const Vec3& p : points) box.take(p);
  const double diagonal = length(box.high - box.low);
  const Vec3 middle = 0.5 * (box.low + box.high);
  const auto count = static_cast<std::uint32_t>(delaunay.tets.size());
  std::vector<Vec3> centres;
  centres.reserve(count);
  const double outside_m = 3 * diagonal;  // farther away rounding would disturb the order of crossings
  for (const Tet& tet : delaunay.tets)
    centres.push_back(circumcentre({points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]}, outside_m));

  PiercedEdges edges;
  edges.vertex_count = count;
  edges.crossing_begin.push_back(0);
  PiercedBoundary pierced(boundary);
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t beyond = delaunay.beyond[t][k];
      if (beyond != no_index && beyond < t) continue;
      Vec3 end;
      if (beyond != no_index) {
        end = centres[beyond];
      } else {  // away from the face on the convex hull, until all is behind
        const auto corner = [&](std::size_t i) { return points[delaunay.tets[t][face_corners[k][i]]]; };
        const Vec3 out = cross(corner(1) - corner(0), corner(2) - corner(0));
        end = centres[t] + (2 * (length(centres[t] - middle) + diagonal) / length(out)) * out;
      }
      pierced.find(centres[t], end, edges.crossings);
      edges.edges.push_back({t, beyond != no_index ? beyond : PiercedEdges::at_infinity});
      edges.crossing_begin.push_back(static_cast<std::uint32_t>(edges.crossings.size()));
    }
  const RegionColouring colours = colour_regions(edges);
  counts.vertices = count;
  counts.edges = edges.edges.size();
  counts.checked_edges = colours.checked_edges;
  counts.inconsistent_edges = colours.inconsistent_edges.size();

  struct MeshCell {
    Tet corners;
    std::uint32_t tet;
  };
  std::vector<MeshCell> cells;
  cells.reserve(mesh.tets.size());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) cells.push_back({sorted(mesh.tets[t]), t});
  std::sort(cells.begin(), cells.end(), [](const MeshCell& a, const MeshCell& b) { return a.corners < b.corners; });
  for (std::uint32_t t = 0; t < count; ++t) {
    counts.unreached += colours.vertex_region[t] == RegionColouring::unreached;
    if (colours.vertex_region[t] != 0) continue;
    ++counts.candidates;
    const Tet& tet = delaunay.tets[t];
    const VertexCell cell = build_vertex_cell(VertexNeighbourhood::with_points(
        {{{tet[0], no_index}, {tet[1], no_index}, {tet[2], no_index}, {tet[3], no_index}}}));
    if (cell.kind != VertexCellKind::tetrahedron || !cells_of(cell, no_index, points)) {
      ++counts.flat;
      continue;
    }
    const Tet corners = sorted(tet);
    const auto found = std::lower_bound(cells.begin(), cells.end(), corners,
                                        [](const MeshCell& a, const Tet& b) { return a.corners < b; });
    if (found != cells.end() && found->corners == corners) {
      duals.is_dual[found->tet] = 1;
      ++counts.kept;
      continue;
    }
    bool is_crossing = false;
    for (std::size_t i = 0; i < 4 && !is_crossing; ++i)
      for (std::size_t j = i + 1; j < 4 && !is_crossing; ++j) is_crossing = pierced.crosses(tet[i], tet[j], points);
    for (std::size_t k = 0; k < 4 && !is_crossing; ++k) {
      const auto& face = face_corners[k];
      is_crossing = pierced.pierces({tet[face[0]], tet[face[1]], tet[face[2]]}, points);
    }
    ++(is_crossing ? counts.crossing : counts.replaced);
  }
  return duals;
}

}  // namespace strataflow
