#include "kernels/quads/map/loosen_features.h"

#include <algorithm>
#include <cmath>

#include "base/id.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {

namespace {

bool is_one_of(const std::vector<std::uint32_t>& features, std::uint32_t feature) {
  return std::binary_search(features.begin(), features.end(), feature);
}

}  // namespace

FeatureMesh without_features(const FeatureMesh& mesh, const std::vector<std::uint32_t>& features) {
  FeatureMesh rest = mesh;
  std::erase_if(rest.edges, [&](const FeatureEdge& e) { return is_one_of(features, e.feature); });
  return rest;
}

std::vector<FeatureEdge> edges_of_features(const FeatureMesh& mesh, const std::vector<std::uint32_t>& features) {
  std::vector<FeatureEdge> edges = mesh.edges;
  std::erase_if(edges, [&](const FeatureEdge& e) { return !is_one_of(features, e.feature); });
  return edges;
}

std::optional<std::uint32_t> loosest_feature(const FeatureMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  std::vector<char> is_border(mesh.features.size(), 0);
  std::vector<std::vector<std::uint32_t>> features(table.edge_count());
  for (const FeatureEdge& e : mesh.edges) {
    const std::uint32_t edge = find_edge(table, e.a, e.b);
    features[edge].push_back(e.feature);
    if (table.around(edge).size() != 2) is_border[e.feature] = 1;
  }
  std::vector<char> is_seen(mesh.triangles.size(), 0);
  std::vector<std::uint32_t> ring;
  for (const std::uint32_t t : triangles)
    if (t < is_seen.size() && !is_seen[t]) {
      is_seen[t] = 1;
      ring.push_back(t);
    }
  while (!ring.empty()) {
    std::vector<std::size_t> met(mesh.features.size(), 0);
    std::vector<std::uint32_t> next;
    for (const std::uint32_t t : ring)
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const std::uint32_t edge = table.edge_of[h];
        for (const std::uint32_t f : features[edge]) met[f] += !is_border[f];
        for (const std::uint32_t g : table.around(edge)) {
          if (is_seen[g / 3]) continue;
          is_seen[g / 3] = 1;
          next.push_back(g / 3);
        }
      }
    const auto most = std::max_element(met.begin(), met.end());
    if (most != met.end() && *most > 0) return static_cast<std::uint32_t>(most - met.begin());
    ring.swap(next);
  }
  return std::nullopt;
}

std::vector<std::uint32_t> take_near_axes(const FeatureMesh& mesh, const std::vector<std::uint32_t>& features,
                                          CornerMap& map) {
  constexpr double steepest = 0.577;  // tan 30°
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  const auto next = [](std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; };
  std::vector<std::uint32_t> near;
  for (const std::uint32_t f : features) {
    std::vector<std::pair<std::uint32_t, MapAxis>> axes;
    bool is_near = true;
    for (const FeatureEdge& e : mesh.edges) {
      if (e.feature != f) continue;
      const auto around = table.around(find_edge(table, e.a, e.b));
      const auto along = map.at(next(around[0])) - map.at(around[0]);
      const double re = std::abs(along.real()), im = std::abs(along.imag());
      is_near = is_near && std::min(re, im) <= steepest * std::max(re, im);
      for (const std::uint32_t h : around) {
        const bool is_real = (re >= im) != (h != around[0] && map.turns[h] % 2 == 1);
        axes.emplace_back(h, is_real ? MapAxis::real : MapAxis::imaginary);
      }
    }
    if (!is_near || axes.empty()) continue;
    near.push_back(f);
    for (const auto& [h, axis] : axes)
      if (map.axes[h] == MapAxis::none) map.axes[h] = axis;
  }
  return near;
}

}  // namespace strataflow
