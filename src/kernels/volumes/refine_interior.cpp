#include "kernels/volumes/refine_interior.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/internal_error.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/volumes/tet_faces.h"
#include "model/volume_mesh.h"

namespace strataflow {

namespace {

double volume_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(cross(b - a, c - a), d - a) / 6.0;
}

/// Squared volume over the sixth power of the edges (root mean square): 0 for a flat tetrahedron.
double shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double squares = 0;
  for (const Vec3& edge : {b - a, c - a, d - a, c - b, d - b, d - c}) squares += dot(edge, edge);
  const double volume = volume_of(a, b, c, d);
  return volume * std::abs(volume) / (squares * squares * squares);
}

/// The sphere through the corners of a tetrahedron; not finite for one that is nearly flat.
struct Sphere {
  Vec3 centre;
  double squared_radius = 0;
};

Sphere circumsphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double scale = 0.5 / dot(cross(u, v), w);
  const Vec3 offset = scale * (dot(w, w) * cross(u, v) + dot(v, v) * cross(w, u) + dot(u, u) * cross(v, w));
  return {a + offset, dot(offset, offset)};
}

/// A mesh of tetrahedra under insertion of points. Slots of tetrahedra that were replaced are used again.
class GrowingMesh {
 public:
  GrowingMesh(const RegionBoundary& boundary, const RegionMesh& mesh, const InteriorGoal& goal)
      : goal_(goal), points_(points_of(boundary, mesh)), tets_(mesh.tets), facet_tets_(mesh.facet_tets) {
    neighbours_ = tet_neighbours(boundary.facets, points_.size(), tets_);
    is_alive_.assign(tets_.size(), 1);
    generation_.assign(tets_.size(), 0);
    is_in_cavity_.assign(tets_.size(), 0);
    is_banned_.assign(tets_.size(), 0);
    for (std::uint32_t t = 0; t < tets_.size(); ++t) queue_.push_back({t, 0});
  }

  void refine(const CancellationToken* cancellation) {
    double total_m3 = 0;
    for (const Tet& tet : tets_) total_m3 += volume(tet);
    // Enough for any sensible refinement; beyond it centroids alone, which certainly come to an end.
    const double expected = goal_.max_volume_m3 ? total_m3 / *goal_.max_volume_m3 : 0;
    const std::size_t start = points_.size();
    const double budget = 10.0 * static_cast<double>(start) + 20.0 * expected + 1000;
    for (std::size_t head = 0; head < queue_.size(); ++head) {
      if (cancellation && head % 1024 == 0 && cancellation->is_cancelled()) return;
      const auto [tet, generation] = queue_[head];
      if (!is_alive_[tet] || generation_[tet] != generation) continue;
      const bool is_too_large = goal_.max_volume_m3 && volume(tets_[tet]) > *goal_.max_volume_m3;
      if (!is_too_large && !has_bad_ratio(tets_[tet])) continue;
      const bool is_within_budget = static_cast<double>(points_.size() - start) < budget;
      if (is_within_budget && insert_circumcentre(tet)) continue;
      if (is_too_large) insert_centroid(tet, is_within_budget);
    }
  }

  std::vector<std::uint32_t> insert(std::span<const Vec3> points) {
    std::vector<std::uint32_t> set;
    max_cavity_ = no_index;  // points on a sphere give one sphere to all: to be Delaunay they go together
    std::uint32_t near = 0;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      const std::uint32_t holder = holder_of(points[p], near);
      if (holder == no_index || !open_cavity(holder, points[p], true)) continue;
      near = cavity_.front();  // a slot that is used again
      fill_cavity(points[p]);
      set.push_back(p);
    }
    return set;
  }

  void write_to(std::size_t boundary_points, RegionMesh& mesh) const {
    std::vector<std::uint32_t> number(tets_.size(), no_index);
    mesh.tets.clear();
    for (std::uint32_t t = 0; t < tets_.size(); ++t) {
      if (!is_alive_[t]) continue;
      number[t] = static_cast<std::uint32_t>(mesh.tets.size());
      mesh.tets.push_back(tets_[t]);
    }
    mesh.facet_tets = facet_tets_;
    for (auto& sides : mesh.facet_tets)
      for (std::uint32_t& tet : sides)
        if (tet != no_index) tet = number[tet];
    mesh.interior_points.assign(points_.begin() + static_cast<std::ptrdiff_t>(boundary_points), points_.end());
  }

 private:
  /// A face of the cavity, seen from outside: counter-clockwise (a, b, c), and what lies behind it.
  struct CavityFace {
    std::uint32_t a, b, c;
    std::uint32_t owner;   ///< tetrahedron of the cavity
    std::uint32_t behind;  ///< neighbour code
  };
  struct OpenEdge {
    std::uint32_t low, high;
    std::uint32_t face_code;
  };
  struct QueueEntry {
    std::uint32_t tet, generation;
  };

  double volume(const Tet& t) const { return volume_of(points_, t); }
  Sphere sphere(const Tet& t) const { return circumsphere(points_[t[0]], points_[t[1]], points_[t[2]], points_[t[3]]); }
  double squared_shortest_edge(const Tet& t) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3 edge = points_[t[i]] - points_[t[j]];
        shortest = std::min(shortest, dot(edge, edge));
      }
    return shortest;
  }
  bool has_bad_ratio(const Tet& t) const {
    return goal_.radius_edge_ratio &&
           sphere(t).squared_radius > *goal_.radius_edge_ratio * *goal_.radius_edge_ratio * squared_shortest_edge(t);
  }

  /// The tetrahedron that holds `target`, reached from `tet` without crossing a facet; no_index if there is none.
  std::uint32_t seen_from(std::uint32_t tet, const Vec3& target) const {
    constexpr int max_steps = 100;
    std::uint32_t previous = no_index;
    for (int step = 0; step < max_steps; ++step) {
      std::uint32_t next = tet;
      for (std::uint32_t k = 0; k < 4 && next == tet; ++k) {
        const std::uint32_t behind = neighbours_[4 * tet + k];
        if (!is_facet_code(behind) && behind / 4 == previous) continue;
        const auto& corner = face_corners[k];
        if (orientation_3d(points_[tets_[tet][corner[0]]], points_[tets_[tet][corner[1]]],
                           points_[tets_[tet][corner[2]]], target) <= 0)
          continue;
        if (is_facet_code(behind)) return no_index;
        next = behind / 4;
      }
      if (next == tet) return tet;
      previous = tet;
      tet = next;
    }
    return no_index;
  }

  /// The tetrahedron that holds `target`, looked for from `near` on first.
  std::uint32_t holder_of(const Vec3& target, std::uint32_t near) const {
    if (const std::uint32_t seen = seen_from(near, target); seen != no_index) return seen;
    for (std::uint32_t t = 0; t < tets_.size(); ++t) {
      bool holds = is_alive_[t] != 0;
      for (std::size_t k = 0; k < 4 && holds; ++k) {
        const auto& corner = face_corners[k];
        holds = orientation_3d(points_[tets_[t][corner[0]]], points_[tets_[t][corner[1]]], points_[tets_[t][corner[2]]],
                               target) <= 0;
      }
      if (holds) return t;
    }
    return no_index;
  }

  bool insert_circumcentre(std::uint32_t tet) {
    const Vec3 centre = sphere(tets_[tet]).centre;
    if (!is_finite(centre)) return false;
    const std::uint32_t holder = seen_from(tet, centre);
    if (holder == no_index || !open_cavity(holder, centre, true)) return false;
    // It must remove the bad tetrahedron, leave none worse than the worst there was, and no point may come closer than
    // the points there already are.
    bool is_useful = false;
    double nearest = std::numeric_limits<double>::infinity(), worst = nearest;
    for (const std::uint32_t t : cavity_) {
      is_useful |= t == tet;
      worst = std::min(worst,
                       shape(points_[tets_[t][0]], points_[tets_[t][1]], points_[tets_[t][2]], points_[tets_[t][3]]));
      for (const std::uint32_t vertex : tets_[t]) {
        const Vec3 way = points_[vertex] - centre;
        nearest = std::min(nearest, dot(way, way));
      }
    }
    for (const CavityFace& face : faces_)
      is_useful = is_useful && shape(points_[face.a], points_[face.c], points_[face.b], centre) >= worst;
    if (!is_useful || nearest < squared_shortest_edge(tets_[tet])) {
      close_cavity();
      return false;
    }
    fill_cavity(centre);
    return true;
  }

  void insert_centroid(std::uint32_t tet, bool may_grow) {
    const Tet& t = tets_[tet];
    const Vec3 centroid = 0.25 * (points_[t[0]] + points_[t[1]] + points_[t[2]] + points_[t[3]]);
    if (open_cavity(tet, centroid, may_grow)) fill_cavity(centroid);
  }

  void close_cavity() {
    for (const std::uint32_t t : cavity_) is_in_cavity_[t] = 0;
    cavity_.clear();
    faces_.clear();
  }

  /// Collects the tetrahedra around `point`, from `holder` on, that it replaces, and their outer faces. False when even
  /// `holder` alone does not see it.
  bool open_cavity(std::uint32_t holder, const Vec3& point, bool may_grow) {
    std::vector<std::uint32_t> banned;
    bool is_good = false, is_possible = true;
    while (!is_good && is_possible) {
      close_cavity();
      cavity_.push_back(holder);
      is_in_cavity_[holder] = 1;
      for (std::size_t i = 0; i < cavity_.size() && cavity_.size() < max_cavity_ && may_grow; ++i)
        for (std::uint32_t k = 0; k < 4; ++k) {
          const std::uint32_t behind = neighbours_[4 * cavity_[i] + k];
          if (is_facet_code(behind)) continue;
          const std::uint32_t next = behind / 4;
          if (is_in_cavity_[next] || is_banned_[next]) continue;
          const Sphere around = sphere(tets_[next]);
          const Vec3 way = point - around.centre;
          if (!(dot(way, way) < around.squared_radius)) continue;
          is_in_cavity_[next] = 1;
          cavity_.push_back(next);
        }
      is_good = true;
      for (const std::uint32_t t : cavity_)
        for (std::uint32_t k = 0; k < 4 && !is_banned_[t]; ++k) {
          const std::uint32_t behind = neighbours_[4 * t + k];
          if (!is_facet_code(behind) && is_in_cavity_[behind / 4]) continue;
          const auto& corner = face_corners[k];
          const CavityFace face{tets_[t][corner[0]], tets_[t][corner[1]], tets_[t][corner[2]], t, behind};
          if (orientation_3d(points_[face.a], points_[face.c], points_[face.b], point) > 0) {
            faces_.push_back(face);
            continue;
          }
          is_good = false;
          if (t == holder) {
            is_possible = false;
          } else {
            is_banned_[t] = 1;
            banned.push_back(t);
          }
        }
      if (is_good && swallows_a_vertex()) {
        may_grow = false;
        is_good = false;
      }
    }
    for (const std::uint32_t t : banned) is_banned_[t] = 0;
    if (!is_possible) close_cavity();
    return is_possible;
  }

  bool swallows_a_vertex() {
    inner_.clear();
    outer_.clear();
    for (const std::uint32_t t : cavity_) inner_.insert(inner_.end(), tets_[t].begin(), tets_[t].end());
    for (const CavityFace& face : faces_) outer_.insert(outer_.end(), {face.a, face.b, face.c});
    for (std::vector<std::uint32_t>* vertices : {&inner_, &outer_}) {
      std::sort(vertices->begin(), vertices->end());
      vertices->erase(std::unique(vertices->begin(), vertices->end()), vertices->end());
    }
    return inner_.size() != outer_.size();
  }

  /// Replaces the cavity by one tetrahedron per outer face, with `point` as apex.
  void fill_cavity(const Vec3& point) {
    const auto apex = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    edges_.clear();
    std::size_t reused = 0;
    for (const std::uint32_t t : cavity_) is_alive_[t] = 0;
    for (const CavityFace& face : faces_) {
      std::uint32_t t;
      if (reused < cavity_.size()) {
        t = cavity_[reused++];
      } else {
        t = static_cast<std::uint32_t>(tets_.size());
        tets_.emplace_back();
        neighbours_.resize(neighbours_.size() + 4);
        is_alive_.push_back(0);
        generation_.push_back(0);
        is_in_cavity_.push_back(0);
        is_banned_.push_back(0);
      }
      tets_[t] = {face.a, face.c, face.b, apex};
      is_alive_[t] = 1;
      queue_.push_back({t, ++generation_[t]});
      neighbours_[4 * t + 3] = face.behind;
      if (is_facet_code(face.behind))
        facet_tets_[facet_of_code(face.behind)][side_of_code(face.behind)] = t;
      else
        neighbours_[face.behind] = 4 * t + 3;
      for (std::uint32_t k = 0; k < 3; ++k) {  // face k is opposite to vertex k: its edge is the other two of three
        const std::uint32_t u = tets_[t][(k + 1) % 3], v = tets_[t][(k + 2) % 3];
        edges_.push_back({std::min(u, v), std::max(u, v), 4 * t + k});
      }
    }
    std::sort(edges_.begin(), edges_.end(), [](const OpenEdge& x, const OpenEdge& y) {
      if (x.low != y.low) return x.low < y.low;
      if (x.high != y.high) return x.high < y.high;
      return x.face_code < y.face_code;
    });
    for (std::size_t i = 0; i + 1 < edges_.size(); i += 2) {
      STRATAFLOW_ASSERT(edges_[i].low == edges_[i + 1].low && edges_[i].high == edges_[i + 1].high, "open cavity");
      neighbours_[edges_[i].face_code] = edges_[i + 1].face_code;
      neighbours_[edges_[i + 1].face_code] = edges_[i].face_code;
    }
    close_cavity();
  }

  InteriorGoal goal_;
  std::size_t max_cavity_ = 200;  ///< flat tetrahedra have huge spheres; a cavity need not take all that they reach
  std::vector<Vec3> points_;
  std::vector<Tet> tets_;
  std::vector<std::uint32_t> neighbours_;  ///< per face: code of the face behind, see tet_faces.h
  std::vector<std::array<std::uint32_t, 2>> facet_tets_;
  std::vector<std::uint8_t> is_alive_, is_in_cavity_, is_banned_;
  std::vector<std::uint32_t> generation_;  ///< counts what was in a slot
  std::vector<QueueEntry> queue_;
  std::vector<std::uint32_t> cavity_, inner_, outer_;
  std::vector<CavityFace> faces_;
  std::vector<OpenEdge> edges_;
};

}  // namespace

void refine_interior(const RegionBoundary& boundary, RegionMesh& mesh, const InteriorGoal& goal,
                     const CancellationToken* cancellation) {
  if (goal.is_empty() || mesh.tets.empty()) return;
  GrowingMesh growing(boundary, mesh, goal);
  growing.refine(cancellation);
  growing.write_to(boundary.points.size(), mesh);
}

std::vector<std::uint32_t> insert_interior_points(const RegionBoundary& boundary, RegionMesh& mesh,
                                                  std::span<const Vec3> points) {
  if (points.empty() || mesh.tets.empty()) return {};
  GrowingMesh growing(boundary, mesh, {});
  std::vector<std::uint32_t> set = growing.insert(points);
  growing.write_to(boundary.points.size(), mesh);
  return set;
}

}  // namespace strataflow
