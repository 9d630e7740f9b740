#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow::testing_support {

/// Written for these tests alone, on maps and atan2: what a soup encloses, with points taken as they are (a sealed
/// reference model repeats no position).
struct SoupTopology {
  using Edge = std::array<std::uint32_t, 2>;
  std::map<Edge, std::vector<std::uint32_t>> edge_triangles;
  std::vector<double> region_volumes;                ///< of shells that look inwards, descending
  double outer_volume = 0;                           ///< of the shell that looks outwards, negative
  std::size_t surfaces = 0, lines = 0, corners = 0;  ///< off the sides of the box (pellerin2014 §2.1)
  std::vector<Edge> free_edges;
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

inline std::uint32_t entity_of(const TriangleSoup& soup, std::size_t triangle) {
  return soup.patch_entity[soup.triangle_patch[triangle]];
}

inline SoupTopology topology_of(const TriangleSoup& soup) {
  SoupTopology result;
  const auto count = static_cast<std::uint32_t>(soup.triangles.size());
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = soup.triangles[t][k], b = soup.triangles[t][(k + 1) % 3];
      result.edge_triangles[{std::min(a, b), std::max(a, b)}].push_back(t);
    }
  UnionFind sides(2 * count), pieces(count);
  std::map<SoupTopology::Edge, std::vector<std::uint32_t>> feature_edges;
  for (const auto& [edge, around] : result.edge_triangles) {
    if (around.size() == 1) {
      sides.unite(2 * around[0], 2 * around[0] + 1);
      result.free_edges.push_back(edge);
    }
    const Vec3 origin = soup.points[edge[0]], axis = soup.points[edge[1]] - origin;
    const Vec3 any = std::abs(axis.x) < std::abs(axis.y) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 u = cross(axis, any);
    u = (1 / length(u)) * u;
    const Vec3 v = (1 / length(axis)) * cross(axis, u);
    std::vector<std::array<double, 2>> turn;  // angle, triangle
    for (const std::uint32_t t : around) {
      for (const std::uint32_t p : soup.triangles[t]) {
        if (p == edge[0] || p == edge[1]) continue;
        const Vec3 d = soup.points[p] - origin;
        turn.push_back({std::atan2(dot(d, v), dot(d, u)), double(t)});
      }
    }
    std::sort(turn.begin(), turn.end());
    for (std::size_t i = 0; i < turn.size() && turn.size() > 1; ++i) {
      // Side 2t is the one the normal points to. A triangle that runs along the edge has its normal ahead of it.
      const auto side = [&](std::size_t at, bool is_ahead) {
        const auto t = static_cast<std::uint32_t>(turn[at % turn.size()][1]);
        const auto& corners = soup.triangles[t];
        bool runs_along = false;
        for (std::size_t k = 0; k < 3; ++k)
          runs_along = runs_along || (corners[k] == edge[0] && corners[(k + 1) % 3] == edge[1]);
        return 2 * t + (runs_along == is_ahead ? 0u : 1u);
      };
      sides.unite(side(i, true), side(i + 1, false));
    }
    if (around.size() == 2 && entity_of(soup, around[0]) == entity_of(soup, around[1]))
      pieces.unite(around[0], around[1]);
    else
      feature_edges[edge] = around;
  }
  std::map<std::uint32_t, double> volume;
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    const double six = dot(soup.points[a], cross(soup.points[b], soup.points[c]));
    volume[sides.find(2 * t)] -= six / 6;
    volume[sides.find(2 * t + 1)] += six / 6;
  }
  for (const auto& [shell, value] : volume) {
    if (value > 0)
      result.region_volumes.push_back(value);
    else
      result.outer_volume += value;
  }
  std::sort(result.region_volumes.rbegin(), result.region_volumes.rend());

  const auto is_box = [&](std::uint32_t t) { return soup.entities[entity_of(soup, t)].role == Role::boundary; };
  std::set<std::uint32_t> surfaces;
  for (std::uint32_t t = 0; t < count; ++t)
    if (!is_box(t)) surfaces.insert(pieces.find(t));
  result.surfaces = surfaces.size();
  std::map<std::uint32_t, std::vector<SoupTopology::Edge>> at_point;
  std::map<SoupTopology::Edge, std::uint32_t> number;
  std::map<SoupTopology::Edge, std::vector<std::uint32_t>> signature;
  for (const auto& [edge, around] : feature_edges) {
    for (const std::uint32_t p : edge) at_point[p].push_back(edge);
    for (const std::uint32_t t : around) signature[edge].push_back(pieces.find(t));
    std::sort(signature[edge].begin(), signature[edge].end());
    if (std::none_of(around.begin(), around.end(), is_box))
      number.emplace(edge, static_cast<std::uint32_t>(number.size()));
  }
  UnionFind lines(number.size());
  for (const auto& [p, edges] : at_point) {
    if (std::any_of(edges.begin(), edges.end(), [&](const auto& edge) { return number.count(edge) == 0; })) continue;
    if (edges.size() == 2 && signature[edges[0]] == signature[edges[1]])
      lines.unite(number[edges[0]], number[edges[1]]);
    else
      ++result.corners;
  }
  std::set<std::uint32_t> roots;
  for (const auto& [edge, n] : number) roots.insert(lines.find(n));
  result.lines = roots.size();
  return result;
}

/// Connected pieces (over shared points) of one entity.
inline std::size_t piece_count(const TriangleSoup& soup, std::uint32_t entity) {
  UnionFind points(soup.points.size());
  std::set<std::uint32_t> roots;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (entity_of(soup, t) == entity)
      for (const std::uint32_t p : soup.triangles[t]) points.unite(p, soup.triangles[t][0]);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (entity_of(soup, t) == entity) roots.insert(points.find(soup.triangles[t][0]));
  return roots.size();
}

inline std::uint32_t entity_named(const TriangleSoup& soup, std::string_view name) {
  for (std::uint32_t e = 0; e < soup.entities.size(); ++e)
    if (soup.entities[e].name == name) return e;
  return 0xffffffffu;
}

/// The points of one entity's triangles, each once.
inline std::vector<Vec3> points_of(const TriangleSoup& soup, std::string_view name) {
  std::set<std::uint32_t> used;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (entity_of(soup, t) == entity_named(soup, name)) used.insert(soup.triangles[t].begin(), soup.triangles[t].end());
  std::vector<Vec3> points;
  for (const std::uint32_t p : used) points.push_back(soup.points[p]);
  return points;
}

}  // namespace strataflow::testing_support
