#include "kernels/borders/border_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/topology/building/build_lines.h"
#include "kernels/topology/building/build_surfaces.h"
#include "kernels/topology/building/radial_order.h"

namespace strataflow {

namespace {

double turn_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::atan2(length(cross(b - a, c - b)), dot(b - a, c - b)) * 180 / std::numbers::pi;
}

/// Chains of a line between the nodes where it turns sharply, each from its lexicographically lower end.
std::vector<RadialBorder> chains_of(const std::vector<Vec3>& points, const Line& line, double corner_angle_deg) {
  const std::vector<std::uint32_t>& v = line.vertices;
  const std::size_t n = v.size();
  std::vector<std::size_t> stops;
  if (!line.is_closed()) stops.push_back(0);
  for (std::size_t i = line.is_closed() ? 0 : 1; i < (line.is_closed() ? n : n - 1); ++i)
    if (turn_deg(points[v[(i + n - 1) % n]], points[v[i]], points[v[(i + 1) % n]]) > corner_angle_deg)
      stops.push_back(i);
  if (!line.is_closed()) stops.push_back(n - 1);

  std::vector<RadialBorder> chains;
  if (stops.empty()) {
    RadialBorder whole;
    whole.is_closed = true;
    const auto lowest = std::min_element(v.begin(), v.end(), [&](std::uint32_t a, std::uint32_t b) {
      return lexicographically_less(points[a], points[b]);
    });
    whole.nodes.assign(lowest, v.end());
    whole.nodes.insert(whole.nodes.end(), v.begin(), lowest);
    if (lexicographically_less(points[whole.nodes.back()], points[whole.nodes[1]]))
      std::reverse(whole.nodes.begin() + 1, whole.nodes.end());
    chains.push_back(std::move(whole));
    return chains;
  }
  if (line.is_closed()) stops.push_back(stops.front() + n);
  for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
    RadialBorder chain;
    for (std::size_t i = stops[s]; i <= stops[s + 1]; ++i) chain.nodes.push_back(v[i % n]);
    const auto& ends = chain.nodes;  // of one stone twice: compare the neighbours
    const std::size_t at = ends.front() == ends.back() ? 1 : 0;
    if (lexicographically_less(points[ends[ends.size() - 1 - at]], points[ends[at]]))
      std::reverse(chain.nodes.begin(), chain.nodes.end());
    chains.push_back(std::move(chain));
  }
  return chains;
}

/// Triangles of the fan at `node` that starts with half-edge h; h becomes the half-edge the fan ends with, on the next
/// edge that bounds surfaces.
std::uint32_t cross_fan(const BorderNetwork& network, const std::vector<Triangle>& triangles, std::uint32_t node,
                        std::uint32_t& h) {
  for (std::uint32_t count = 1;; ++count) {
    const std::uint32_t t = h / 3, k = h % 3;
    h = 3 * t + (triangles[t][k] == node ? (k + 2) % 3 : (k + 1) % 3);  // the other edge of t at `node`
    const std::uint32_t edge = network.edges.edge_of[h];
    if (network.is_feature[edge] || count > triangles.size()) return count;
    const auto around = network.edges.around(edge);
    h = around[0] == h ? around[1] : around[0];
  }
}

}  // namespace

std::size_t RadialBorder::wanted_edge_count() const {
  if (is_closed) return std::max<std::size_t>(representative_count, 3);
  return std::max<std::size_t>(representative_count, nodes.front() == nodes.back() ? 4 : 3) - 1;
}

std::vector<std::uint32_t> surfaces_in_order(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                             const EdgeTable& edges, const std::vector<std::uint32_t>& surface_of,
                                             std::uint32_t edge, std::uint32_t from) {
  if (edges.around(edge).size() < 3) return {};
  const RadialOrder order = radial_order(points, triangles, edges.around(edge));
  if (order.is_ambiguous) return {};
  std::vector<std::uint32_t> surfaces;
  for (const std::uint32_t h : order.half_edges) surfaces.push_back(surface_of[h / 3]);
  if (edges.edges[edge][0] != from) std::reverse(surfaces.begin(), surfaces.end());
  std::vector<std::uint32_t> least = surfaces;
  for (std::size_t i = 1; i < surfaces.size(); ++i) {
    std::rotate(surfaces.begin(), surfaces.begin() + 1, surfaces.end());
    least = std::min(least, surfaces);
  }
  return least;
}

BorderNetwork find_radial_borders(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                  const std::vector<std::uint32_t>& triangle_patch, double corner_angle_deg) {
  BorderNetwork network;
  network.edges = build_edge_table(points.size(), triangles);
  SurfacePartition partition = build_surfaces(network.edges, triangles, triangle_patch);
  network.is_feature = std::move(partition.is_feature);
  network.surface_of = std::move(partition.surface_of);
  network.surface_count = partition.surface_count;
  network.is_stone.assign(points.size(), 0);
  const LineNetwork lines = build_lines(network.edges, network.is_feature, network.surface_of, points.size());
  for (const Corner& corner : lines.corners) network.is_stone[corner.vertex] = 1;
  for (const Line& line : lines.lines) {
    if (line.is_free_border()) continue;
    for (RadialBorder& chain : chains_of(points, line, corner_angle_deg)) network.borders.push_back(std::move(chain));
  }
  std::sort(network.borders.begin(), network.borders.end(), [&](const RadialBorder& a, const RadialBorder& b) {
    for (std::size_t i = 0; i < 2; ++i)  // two borders share at most one of their first edge's nodes
      if (a.nodes[i] != b.nodes[i]) return lexicographically_less(points[a.nodes[i]], points[b.nodes[i]]);
    return a.nodes < b.nodes;
  });
  parallel_ranges(network.borders.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      RadialBorder& border = network.borders[b];
      const std::size_t n = border.nodes.size();
      std::map<std::vector<std::uint32_t>, std::uint32_t> votes;
      for (std::size_t i = 0; i < border.edge_count(); ++i) {
        const std::uint32_t from = border.nodes[i];
        const std::uint32_t edge = find_edge(network.edges, from, border.nodes[(i + 1) % n]);
        const auto order = surfaces_in_order(points, triangles, network.edges, network.surface_of, edge, from);
        if (!order.empty()) ++votes[order];
      }
      for (const auto& [order, count] : votes)
        if (border.radial_order.empty() || count > votes[border.radial_order]) border.radial_order = order;
      // Each coinciding border is followed from its half-edge on the first edge, fan by fan.
      const std::uint32_t first = find_edge(network.edges, border.nodes[0], border.nodes[1]);
      border.representative_count = no_index;
      for (std::uint32_t h : network.edges.around(first)) {
        std::uint32_t count = border.is_closed ? 0 : 2;
        for (std::size_t i = 1; i < (border.is_closed ? n + 1 : n - 1); ++i)
          count += cross_fan(network, triangles, border.nodes[i % n], h) >= 3;
        border.representative_count = std::min(border.representative_count, count);
      }
    }
  });
  for (const RadialBorder& border : network.borders)
    if (!border.is_closed) network.is_stone[border.nodes.front()] = network.is_stone[border.nodes.back()] = 1;
  return network;
}

}  // namespace strataflow
