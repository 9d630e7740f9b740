#include "kernels/borders/resample_borders.h"

#include <algorithm>
#include <cmath>

#include "base/id.h"

namespace strataflow {

namespace {

/// Nodes standing on the sides of one triangle, each side's from its first corner on.
struct Piece {
  Triangle corners;
  std::array<std::vector<std::uint32_t>, 3> on_side;
};

void split(const Piece& piece, std::vector<Triangle>& pieces) {
  for (int k = 0; k < 3; ++k) {
    const std::vector<std::uint32_t>& nodes = piece.on_side[k];
    if (nodes.empty()) continue;
    const std::uint32_t a = piece.corners[k], b = piece.corners[(k + 1) % 3], c = piece.corners[(k + 2) % 3];
    split({{a, nodes.front(), c}, {{{}, {}, piece.on_side[(k + 2) % 3]}}}, pieces);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) pieces.push_back({nodes[i], nodes[i + 1], c});
    split({{nodes.back(), b, c}, {{{}, piece.on_side[(k + 1) % 3], {}}}}, pieces);
    return;
  }
  pieces.push_back(piece.corners);
}

}  // namespace

ResampledMesh resample_borders(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                               const BorderNetwork& network, const std::vector<char>& is_chosen) {
  ResampledMesh mesh;
  mesh.points = points;
  mesh.border_of.assign(points.size(), no_index);
  std::vector<std::uint32_t> goes_to(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) goes_to[v] = v;
  std::vector<std::vector<std::uint32_t>> on_edge(network.edges.edge_count());  // from the edge's lower node on

  for (std::uint32_t b = 0; b < network.borders.size(); ++b) {
    const RadialBorder& border = network.borders[b];
    mesh.chains.push_back(border.nodes);
    if (!is_chosen[b]) continue;
    const std::size_t count = border.edge_count(), n = border.nodes.size();
    const std::size_t wanted = border.wanted_edge_count();
    std::vector<double> travelled(count + 1, 0);
    for (std::size_t i = 0; i < count; ++i)
      travelled[i + 1] = travelled[i] + length(points[border.nodes[(i + 1) % n]] - points[border.nodes[i]]);
    const double spacing = travelled[count] / static_cast<double>(wanted);
    std::vector<std::uint32_t>& chain = mesh.chains[b];
    chain.assign(1, border.nodes[0]);
    std::size_t i = 0;
    for (std::size_t j = 1; j < wanted; ++j) {
      const double s = spacing * static_cast<double>(j);
      while (i + 1 < count && travelled[i + 1] < s) ++i;
      const std::uint32_t from = border.nodes[i], to = border.nodes[(i + 1) % n];
      const bool is_at_start = s - travelled[i] <= 1e-6 * spacing, is_at_end = travelled[i + 1] - s <= 1e-6 * spacing;
      if ((is_at_start && i > 0) || (is_at_end && i + 1 < count)) {
        chain.push_back(is_at_start && i > 0 ? from : to);
        continue;
      }
      const double share = (s - travelled[i]) / (travelled[i + 1] - travelled[i]);
      const auto fresh = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(points[from] + share * (points[to] - points[from]));
      mesh.new_points.push_back({from, to, share});
      mesh.border_of.push_back(b);
      goes_to.push_back(fresh);
      chain.push_back(fresh);
      const std::uint32_t edge = find_edge(network.edges, from, to);
      auto& nodes = on_edge[edge];
      nodes.insert(from == network.edges.edges[edge][0] ? nodes.end() : nodes.begin(), fresh);
    }
    if (!border.is_closed) chain.push_back(border.nodes.back());
    for (std::size_t k = border.is_closed ? 0 : 1; k < (border.is_closed ? n : n - 1); ++k) {
      mesh.border_of[border.nodes[k]] = b;
      const double place = travelled[k] / spacing;
      const auto nearest = static_cast<std::size_t>(std::ceil(place - 0.5));
      goes_to[border.nodes[k]] = border.is_closed ? chain[nearest % wanted] : chain[std::min(nearest, wanted)];
    }
  }

  std::vector<Triangle> pieces;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Piece whole{triangles[t], {}};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t edge = network.edges.edge_of[3 * t + k];
      whole.on_side[k] = on_edge[edge];
      if (network.edges.edges[edge][0] != triangles[t][k])
        std::reverse(whole.on_side[k].begin(), whole.on_side[k].end());
    }
    pieces.clear();
    split(whole, pieces);
    for (Triangle piece : pieces) {
      std::array<std::uint32_t, 3> borders{};
      for (int k = 0; k < 3; ++k) {
        borders[k] = mesh.border_of[piece[k]];
        piece[k] = goes_to[piece[k]];
      }
      mesh.triangles.push_back(piece);
      mesh.source.push_back(t);
      mesh.borders.push_back(borders);
      mesh.is_flat.push_back(piece[0] == piece[1] || piece[1] == piece[2] || piece[2] == piece[0]);
    }
  }
  return mesh;
}

}  // namespace strataflow
