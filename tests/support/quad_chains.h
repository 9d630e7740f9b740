#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/feature_mesh.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// Whether quads hold every feature of the mesh they were made from, found out without any of the mesher's code:
/// every labelled point lies on the feature's segments within 1e-9 of the domain, every segment of the feature is
/// covered from end to end by chains of labelled edges, and every labelled edge is a side of a quad. Returns what is
/// wrong, one line each; empty is good.
inline std::vector<std::string> features_not_held(const FeatureMesh& mesh, const QuadMesh& quads) {
  std::vector<std::string> wrong;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const double near = 1e-9 * length(high - low);
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const auto& q : quads.quads)
    for (std::size_t k = 0; k < 4; ++k) sides.insert(std::minmax(q[k], q[(k + 1) % 4]));
  for (const FeatureEdge& e : quads.edges)
    if (sides.count(std::minmax(e.a, e.b)) == 0)
      wrong.push_back(quads.features[e.feature].name + ": a labelled edge is no side");
  for (std::uint32_t f = 0; f < mesh.features.size(); ++f) {
    // The feature as one graph; labelled points sit on its segments at a place in [0, 1].
    std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;
    for (const FeatureEdge& e : mesh.edges)
      if (e.feature == f) segments.emplace_back(e.a, e.b);
    std::set<std::uint32_t> nodes;
    for (const FeatureEdge& e : quads.edges)
      if (e.feature == f) {
        nodes.insert(e.a);
        nodes.insert(e.b);
      }
    const std::string& name = mesh.features[f].name;
    if (segments.empty() != nodes.empty()) {
      wrong.push_back(name + ": is missing");
      continue;
    }
    // Stations along the feature: its own points and the labelled points, linked along the segments.
    struct Station {
      double place;
      std::uint32_t node;
    };
    std::vector<std::vector<Station>> on(segments.size());
    for (const std::uint32_t n : nodes) {
      bool is_on = false;
      for (std::size_t s = 0; s < segments.size(); ++s) {
        const Vec3 a = mesh.points[segments[s].first], d = mesh.points[segments[s].second] - a;
        const double t = std::clamp(dot(quads.points[n] - a, d) / dot(d, d), 0.0, 1.0);
        if (length(quads.points[n] - (a + t * d)) > near) continue;
        on[s].push_back({t, n});
        is_on = true;
      }
      if (!is_on) wrong.push_back(name + ": a labelled point is not on it");
    }
    // Walk from labelled point to labelled point along the segments: each step must be a labelled edge.
    std::set<std::pair<std::uint32_t, std::uint32_t>> labelled;
    for (const FeatureEdge& e : quads.edges)
      if (e.feature == f) labelled.insert(std::minmax(e.a, e.b));
    std::map<std::uint32_t, std::vector<std::pair<std::size_t, bool>>>
        around;  // mesh point → segments, at their start?
    for (std::size_t s = 0; s < segments.size(); ++s) {
      around[segments[s].first].emplace_back(s, true);
      around[segments[s].second].emplace_back(s, false);
      std::sort(on[s].begin(), on[s].end(), [](const Station& a, const Station& b) {
        return a.place != b.place ? a.place < b.place : a.node < b.node;
      });
    }
    const auto same = [&](std::uint32_t node, std::uint32_t point) {
      return length(quads.points[node] - mesh.points[point]) <= near;
    };
    // The next labelled point after leaving `point` along segment s, or −1 where the feature ends first.
    const auto next_from = [&](std::size_t s, bool from_start, std::int64_t skip) -> std::int64_t {
      for (std::size_t steps = 0; steps <= 2 * segments.size(); ++steps) {
        std::vector<Station> row = on[s];
        if (!from_start) std::reverse(row.begin(), row.end());
        for (const Station& station : row)
          if (static_cast<std::int64_t>(station.node) != skip) return station.node;
        const std::uint32_t end = from_start ? segments[s].second : segments[s].first;
        const auto& out = around[end];
        if (out.size() != 2) return -1;
        const auto next = out[0].first == s ? out[1] : out[0];
        s = next.first;
        from_start = next.second;
      }
      return -1;
    };
    for (std::size_t s = 0; s < segments.size(); ++s)
      for (std::size_t i = 0; i < on[s].size(); ++i) {
        const std::uint32_t node = on[s][i].node;
        std::int64_t next = -1;
        if (i + 1 < on[s].size()) {
          next = on[s][i + 1].node;
        } else {
          const std::uint32_t end = segments[s].second;
          if (same(node, end)) continue;  // its own segments carry on
          const auto& out = around[end];
          if (out.size() != 2) {
            wrong.push_back(name + ": an end has no labelled point");
            continue;
          }
          const auto onward = out[0].first == s ? out[1] : out[0];
          next = next_from(onward.first, onward.second, node);
        }
        if (next < 0 || labelled.count(std::minmax(node, static_cast<std::uint32_t>(next))) == 0)
          wrong.push_back(name + ": is no chain of edges near (" + std::to_string(quads.points[node].x) + ", " +
                          std::to_string(quads.points[node].y) + ")");
      }
    for (const auto& [point, out] : around) {
      if (out.size() == 2) continue;
      if (std::none_of(nodes.begin(), nodes.end(), [&, p = point](std::uint32_t n) { return same(n, p); }))
        wrong.push_back(name + ": an end or junction is no point of the quads");
    }
  }
  return wrong;
}

}  // namespace strataflow
