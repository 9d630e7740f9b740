#include "kernels/sealing/trim_overshoot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/sealing/welded_soup.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/keep_triangles.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

using Edge = std::array<std::uint32_t, 2>;

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double l = dot(d, d);
  const double share = l > 0 ? std::clamp(dot(p - a, d) / l, 0.0, 1.0) : 0.0;
  return length(a + share * d - p);
}

/// Edges that can be asked for what is near.
class NearEdges {
 public:
  NearEdges(const std::vector<Vec3>& points, std::vector<Edge> edges) : points_(points), edges_(std::move(edges)) {
    std::vector<FloatBox> boxes;
    boxes.reserve(edges_.size());
    for (const Edge& e : edges_) {
      Box3 box;
      box.take(points_[e[0]]);
      box.take(points_[e[1]]);
      boxes.push_back(enclosing(box));
    }
    tree_ = BoundingVolumeTree(boxes);
  }
  bool is_near(const Vec3& p, double distance) const {
    Box3 box;
    const Vec3 room{distance, distance, distance};
    box.take(p - room);
    box.take(p + room);
    bool found = false;
    tree_.visit_items(enclosing(box), [&](std::uint32_t e) {
      found = found || distance_to_segment(p, points_[edges_[e][0]], points_[edges_[e][1]]) <= distance;
    });
    return found;
  }

 private:
  const std::vector<Vec3>& points_;
  std::vector<Edge> edges_;
  BoundingVolumeTree tree_;
};

/// A connected piece of one entity between contacts.
struct Piece {
  std::vector<std::uint32_t> triangles;
  std::vector<Edge> free, contact;
  double area = 0;
};

class Trimmer {
 public:
  Trimmer(const TriangleSoup& soup, double distance, const std::vector<double>& entity_distance)
      : soup_(soup), distances_(entity_distance), mesh_(soup) {
    if (distances_.empty()) distances_.assign(soup.entities.size(), distance);
    is_kept_.assign(soup.triangles.size(), 1);
  }

  TrimmedSurfaces run() {
    TrimmedSurfaces result;
    while (trim_once(result)) {
    }
    result.soup = soup_;
    if (!result.pieces.empty()) keep_triangles(result.soup, is_kept_);
    return result;
  }

 private:
  std::uint32_t entity_of(std::uint32_t t) const { return mesh_.entity[t]; }

  std::vector<Piece> find_pieces() const {
    const EdgeTable table = build_edge_table(mesh_.points.size(), mesh_.triangles);
    const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
    UnionFind sets(count);
    const auto is_inner = [&](std::span<const std::uint32_t> around) {
      return around.size() == 2 && entity_of(around[0] / 3) == entity_of(around[1] / 3);
    };
    for (std::uint32_t e = 0; e < table.edge_count(); ++e)
      if (const auto around = table.around(e); is_inner(around)) sets.unite(around[0] / 3, around[1] / 3);
    std::vector<std::uint32_t> number(count, no_index);
    std::vector<Piece> pieces;
    for (std::uint32_t t = 0; t < count; ++t) {
      std::uint32_t& n = number[sets.find(t)];
      if (n == no_index) {
        n = static_cast<std::uint32_t>(pieces.size());
        pieces.emplace_back();
      }
      pieces[n].triangles.push_back(t);
      const Triangle& v = mesh_.triangles[t];
      pieces[n].area +=
          0.5 * length(cross(mesh_.points[v[1]] - mesh_.points[v[0]], mesh_.points[v[2]] - mesh_.points[v[0]]));
    }
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
      const auto around = table.around(e);
      if (is_inner(around)) continue;
      for (const std::uint32_t h : around) {
        Piece& piece = pieces[number[sets.find(h / 3)]];
        (around.size() == 1 ? piece.free : piece.contact).push_back(table.edges[e]);
      }
    }
    return pieces;
  }

  /// Everything in the piece is near both its free border and what it juts out from.
  bool juts_out(const Piece& piece) const {
    if (piece.free.empty() || piece.contact.empty()) return false;
    const double distance = distances_[entity_of(piece.triangles.front())];
    double free_length = 0;
    for (const Edge& e : piece.free) free_length += length(mesh_.points[e[1]] - mesh_.points[e[0]]);
    if (piece.area > 4 * (free_length + distance) * distance) return false;
    const NearEdges free(mesh_.points, piece.free), contact(mesh_.points, piece.contact);
    for (const std::uint32_t t : piece.triangles)
      for (const std::uint32_t v : mesh_.triangles[t])
        if (!free.is_near(mesh_.points[v], distance) || !contact.is_near(mesh_.points[v], distance)) return false;
    return true;
  }

  bool trim_once(TrimmedSurfaces& result) {
    const std::vector<Piece> pieces = find_pieces();
    const std::vector<char> goes =
        parallel_map(pieces.size(), [&](std::size_t i) { return static_cast<char>(juts_out(pieces[i])); });
    std::vector<char> is_gone(mesh_.triangles.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (!goes[i]) continue;
      any = true;
      const std::uint32_t first = pieces[i].triangles.front();
      result.pieces.push_back(
          {entity_of(first), pieces[i].triangles.size(), pieces[i].area, mesh_.points[mesh_.triangles[first][0]]});
      for (const std::uint32_t t : pieces[i].triangles) is_gone[t] = 1;
    }
    if (!any) return false;
    std::size_t next = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_gone[t]) {
        is_kept_[mesh_.origin[t]] = 0;
        continue;
      }
      mesh_.triangles[next] = mesh_.triangles[t];
      mesh_.entity[next] = mesh_.entity[t];
      mesh_.origin[next++] = mesh_.origin[t];
    }
    mesh_.triangles.resize(next);
    mesh_.entity.resize(next);
    mesh_.origin.resize(next);
    return true;
  }

  const TriangleSoup& soup_;
  std::vector<double> distances_;  ///< per entity
  WeldedSoup mesh_;                ///< what is left
  std::vector<char> is_kept_;      ///< per triangle of the soup
};

}  // namespace

TrimmedSurfaces trim_overshoot(const TriangleSoup& soup, double distance_m,
                               const std::vector<double>& entity_distance_m) {
  return Trimmer(soup, distance_m, entity_distance_m).run();
}

}  // namespace strataflow
