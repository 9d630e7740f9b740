#include "kernels/quads/extraction/check_features.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/plan/plane_geometry.h"
#include "kernels/topology/building/edge_table.h"
#include "model/box3.h"

namespace strataflow {

namespace {

/// A vertex of the quads on a chain.
struct Station {
  std::uint32_t chain;
  double arc_m;
  std::uint32_t vertex;
};

FloatBox box_of(const Vec3& a, const Vec3& b) {
  Box3 box;
  box.take(a);
  box.take(b);
  return enclosing(box);
}

/// Per point: whether it lies on a boundary edge that is no feature.
std::vector<char> free_points(const FeatureMesh& mesh) {
  std::vector<char> is_free(mesh.points.size(), 0);
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    if (table.around(e).size() != 1) continue;
    const auto [a, b] = table.edges[e];
    const auto found = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), FeatureEdge{a, b, 0},
                                        [](const FeatureEdge& x, const FeatureEdge& y) {
                                          return x.a != y.a ? x.a < y.a : x.b < y.b;
                                        });
    if (found == mesh.edges.end() || found->a != a || found->b != b) is_free[a] = is_free[b] = 1;
  }
  return is_free;
}

class FeatureWalk {
 public:
  FeatureWalk(const FeatureMesh& mesh, const QuadMesh& quads) : mesh_(mesh), quads_(quads), is_free_(free_points(mesh)) {
    Box3 box;
    for (const Vec3& p : mesh.points) box.take(p);
    near_ = 1e-9 * box.diagonal_m();
  }

  /// What is wrong with a feature; empty if nothing is.
  std::string problem(std::uint32_t feature) {
    const auto chains = feature_chains(mesh_.edges, mesh_.corners, feature);
    ways_.clear();
    std::vector<std::uint32_t> vertices;
    for (const FeatureEdge& e : quads_.edges) {
      if (e.feature != feature) continue;
      ways_.insert(ways_.end(), {{e.a, e.b}, {e.b, e.a}});
      vertices.insert(vertices.end(), {e.a, e.b});
    }
    if (chains.empty()) return {};
    if (ways_.empty()) return "has no edge";
    std::sort(ways_.begin(), ways_.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (!place(chains, vertices)) return "has a vertex beside it";
    auto from = stations_.begin();
    for (std::uint32_t c = 0; c < chains.size(); ++c) {
      const auto to = std::find_if(from, stations_.end(), [&](const Station& s) { return s.chain != c; });
      if (from == to || !is_whole({from, to}, chains[c], lengths_m_[c])) return "is not followed over its whole length";
      from = to;
    }
    return {};
  }

 private:
  bool place(const std::vector<std::vector<std::uint32_t>>& chains, const std::vector<std::uint32_t>& vertices) {
    struct Segment {
      std::uint32_t chain;
      double arc_m;
      Vec3 a, b;
    };
    std::vector<Segment> segments;
    std::vector<FloatBox> boxes;
    lengths_m_.clear();
    for (std::uint32_t c = 0; c < chains.size(); ++c) {
      double arc = 0;
      for (std::size_t i = 0; i + 1 < chains[c].size(); ++i) {
        const Vec3 &a = mesh_.points[chains[c][i]], &b = mesh_.points[chains[c][i + 1]];
        segments.push_back({c, arc, a, b});
        boxes.push_back(box_of(a, b));
        arc += length(b - a);
      }
      lengths_m_.push_back(arc);
    }
    const BoundingVolumeTree tree(boxes);
    stations_.clear();
    bool all_on = true;
    for (const std::uint32_t v : vertices) {
      const std::size_t before = stations_.size();
      const Vec3& x = quads_.points[v];
      const double reach = near_ * near_;
      tree.visit_nearest(x, reach, [&](std::uint32_t place) {
        const Segment& s = segments[tree.item_at(place)];
        if (distance_to_segment(x, s.a, s.b) <= near_)
          stations_.push_back({s.chain, s.arc_m + nearest_parameter(x, s.a, s.b) * length(s.b - s.a), v});
        return reach;
      });
      all_on = all_on && stations_.size() > before;
    }
    std::sort(stations_.begin(), stations_.end(), [](const Station& a, const Station& b) {
      if (a.chain != b.chain) return a.chain < b.chain;
      return a.arc_m != b.arc_m ? a.arc_m < b.arc_m : a.vertex < b.vertex;
    });
    // A vertex where two segments meet was found on both.
    stations_.erase(std::unique(stations_.begin(), stations_.end(),
                                [&](const Station& a, const Station& b) {
                                  return a.chain == b.chain && a.vertex == b.vertex && b.arc_m - a.arc_m <= 4 * near_;
                                }),
                    stations_.end());
    return all_on;
  }

  /// Whether labelled edges lead from one end of the chain to the other, always forwards. Vertices between that they
  /// pass by belong to another chain at the same place (both sides of a fault without throw).
  bool is_whole(std::span<const Station> row, const std::vector<std::uint32_t>& chain, double length_m) const {
    const auto slack_at = [&](std::uint32_t p) { return is_free_[p] ? 2 * mesh_.edge_length_m : 4 * near_; };
    std::vector<char> starts(row.size(), 0);
    for (std::size_t i = 0; i < row.size(); ++i) starts[i] = row[i].arc_m <= slack_at(chain.front());
    const std::vector<char> is_reached = reached(row, starts);
    for (std::size_t i = 0; i < row.size(); ++i)
      if (is_reached[i] && length_m - row[i].arc_m <= slack_at(chain.back())) return true;
    if (chain.front() != chain.back()) return false;
    constexpr std::size_t tries = 8;  // round a closed chain, from one of its first vertices to itself
    for (std::size_t from = 0; from < std::min(row.size(), tries); ++from) {
      std::fill(starts.begin(), starts.end(), 0);
      starts[from] = 1;
      const std::vector<char> around = reached(row, starts);
      for (std::size_t i = from + 2; i < row.size(); ++i)
        if (around[i] && are_joined(row[i].vertex, row[from].vertex) && row[i].arc_m - row[from].arc_m > length_m / 2)
          return true;
    }
    return false;
  }

  std::vector<char> reached(std::span<const Station> row, std::vector<char> is_reached) const {
    std::vector<std::pair<std::uint32_t, std::size_t>> places;
    for (std::size_t i = 0; i < row.size(); ++i) places.emplace_back(row[i].vertex, i);
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!is_reached[i]) continue;
      for (auto edge = std::lower_bound(ways_.begin(), ways_.end(), std::pair(row[i].vertex, 0u));
           edge != ways_.end() && edge->first == row[i].vertex; ++edge)
        for (auto at = std::lower_bound(places.begin(), places.end(), std::pair(edge->second, i + 1));
             at != places.end() && at->first == edge->second; ++at)
          is_reached[at->second] = 1;
    }
    return is_reached;
  }

  bool are_joined(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(ways_.begin(), ways_.end(), std::pair(a, b));
  }

  const FeatureMesh& mesh_;
  const QuadMesh& quads_;
  std::vector<char> is_free_;
  double near_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ways_;  ///< labelled edges, both ways, ascending
  std::vector<double> lengths_m_;
  std::vector<Station> stations_;
};

}  // namespace

std::vector<std::string> features_not_followed(const FeatureMesh& mesh, const QuadMesh& quads) {
  FeatureWalk walk(mesh, quads);
  std::vector<std::string> wrong;
  for (std::uint32_t f = 0; f < mesh.features.size(); ++f)
    if (const std::string problem = walk.problem(f); !problem.empty())
      wrong.push_back("'" + mesh.features[f].name + "' " + problem);
  return wrong;
}

}  // namespace strataflow
