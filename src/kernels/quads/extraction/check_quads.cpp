#include "kernels/quads/extraction/check_quads.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <tuple>

#include "base/id.h"
#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

namespace {

template <std::size_t n>
std::int64_t characteristic(std::size_t point_count, const std::vector<std::array<std::uint32_t, n>>& faces) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<char> is_used(point_count, 0);
  for (const auto& face : faces)
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % n];
      edges.push_back({std::min(a, b), std::max(a, b)});
      is_used[a] = 1;
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return std::count(is_used.begin(), is_used.end(), 1) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(faces.size());
}

/// A directed side of a quad: from, to, quad.
using QuadSide = std::array<std::uint32_t, 3>;

std::vector<QuadSide> sorted_sides(const QuadMesh& mesh) {
  std::vector<QuadSide> sides;
  sides.reserve(4 * mesh.quads.size());
  for (std::uint32_t q = 0; q < mesh.quads.size(); ++q)
    for (int k = 0; k < 4; ++k) sides.push_back({mesh.quads[q][k], mesh.quads[q][(k + 1) % 4], q});
  std::sort(sides.begin(), sides.end());
  return sides;
}

bool holds(const std::vector<QuadSide>& sides, std::uint32_t a, std::uint32_t b) {
  const auto at = std::lower_bound(sides.begin(), sides.end(), QuadSide{a, b, 0});
  return at != sides.end() && (*at)[0] == a && (*at)[1] == b;
}

Failure not_manifold(const QuadMesh& mesh, const std::string& what, std::uint32_t point) {
  return Failure{FailureCode::geometry_failed,
                 "the quads are no manifold: " + what + " at " + place_text(mesh.points[point], mesh.local_origin),
                 "try a smaller edge length"};
}

template <std::size_t corners>
std::vector<std::uint32_t> patches_of(const std::vector<std::array<std::uint32_t, corners>>& faces,
                                      const std::vector<FeatureEdge>& features) {
  struct Side {
    std::uint32_t a, b, face;
  };
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < corners; ++k) {
      const auto [a, b] = std::minmax(faces[f][k], faces[f][(k + 1) % corners]);
      sides.push_back({a, b, f});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& x, const Side& y) { return std::tie(x.a, x.b, x.face) < std::tie(y.a, y.b, y.face); });
  std::vector<std::uint32_t> patch(faces.size());
  std::iota(patch.begin(), patch.end(), 0u);
  const auto least = [&](std::uint32_t f) {
    while (patch[f] != f) f = patch[f] = patch[patch[f]];
    return f;
  };
  const auto before = [](const FeatureEdge& e, const Side& s) { return std::tie(e.a, e.b) < std::tie(s.a, s.b); };
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i - 1].a != sides[i].a || sides[i - 1].b != sides[i].b) continue;
    const auto feature = std::lower_bound(features.begin(), features.end(), sides[i], before);
    if (feature != features.end() && feature->a == sides[i].a && feature->b == sides[i].b) continue;
    const std::uint32_t x = least(sides[i - 1].face), y = least(sides[i].face);
    patch[std::max(x, y)] = std::min(x, y);
  }
  for (std::uint32_t f = 0; f < patch.size(); ++f) patch[f] = least(f);
  return patch;
}

}  // namespace

std::vector<std::uint32_t> smooth_patches(const std::vector<Triangle>& triangles,
                                          const std::vector<FeatureEdge>& features) {
  return patches_of(triangles, features);
}

std::vector<std::uint32_t> smooth_patches(const std::vector<std::array<std::uint32_t, 4>>& quads,
                                          const std::vector<FeatureEdge>& features) {
  return patches_of(quads, features);
}

std::int64_t euler_characteristic(std::size_t point_count, const std::vector<Triangle>& triangles) {
  return characteristic<3>(point_count, triangles);
}
std::int64_t euler_characteristic(std::size_t point_count, const std::vector<std::array<std::uint32_t, 4>>& quads) {
  return characteristic<4>(point_count, quads);
}

std::vector<std::uint32_t> quad_valence(const QuadMesh& quads) {
  std::vector<std::uint32_t> valence(quads.points.size(), 0);
  for (const auto& quad : quads.quads)
    for (const std::uint32_t p : quad) ++valence[p];
  return valence;
}

std::vector<char> boundary_points(const QuadMesh& quads) {
  std::vector<char> is_boundary(quads.points.size(), 0);
  const auto sides = sorted_sides(quads);
  for (const QuadSide& s : sides)
    if (!holds(sides, s[1], s[0])) is_boundary[s[0]] = is_boundary[s[1]] = 1;
  return is_boundary;
}

Result<void> check_quads(const QuadMesh& mesh) {
  for (const auto& quad : mesh.quads)
    for (int k = 0; k < 4; ++k) {
      if (quad[k] >= mesh.points.size())
        return Failure{FailureCode::geometry_failed, "a quad names a point that is not there", "report this mesh"};
      for (int l = 0; l < k; ++l)
        if (quad[k] == quad[l]) return not_manifold(mesh, "a quad has one corner twice", quad[k]);
    }
  const auto sides = sorted_sides(mesh);
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i][0] == sides[i - 1][0] && sides[i][1] == sides[i - 1][1])
      return not_manifold(mesh, "two quads use one side the same way", sides[i][0]);
  std::vector<std::int32_t> open_ends(mesh.points.size(), 0), quads(mesh.points.size(), 0);
  for (const auto& quad : mesh.quads)
    for (const std::uint32_t p : quad) ++quads[p];
  for (const QuadSide& s : sides)
    if (!holds(sides, s[1], s[0])) ++open_ends[s[0]];
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    if (quads[p] == 0) return not_manifold(mesh, "a point belongs to no quad", p);
    if (open_ends[p] > 1) return not_manifold(mesh, "the boundary meets itself", p);
  }
  // Around points inside, and on the boundary, walk once: every quad must be met.
  std::vector<char> is_done(mesh.points.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::uint32_t p = sides[i][0];
    if (is_done[p] || (open_ends[p] == 1 && holds(sides, sides[i][1], p))) continue;
    // Counter-clockwise: the next side out of p is the one whose quad lies across the side into p.
    is_done[p] = 1;
    std::int32_t met = 0;
    std::size_t at = i;
    for (;;) {
      ++met;
      const auto& quad = mesh.quads[sides[at][2]];
      const int k = static_cast<int>(std::find(quad.begin(), quad.end(), p) - quad.begin());
      const std::uint32_t before = quad[(k + 3) % 4];
      const auto next = std::lower_bound(sides.begin(), sides.end(), QuadSide{p, before, 0});
      if (next == sides.end() || (*next)[0] != p || (*next)[1] != before) break;
      at = static_cast<std::size_t>(next - sides.begin());
      if (at == i || met > quads[p]) break;
    }
    if (met != quads[p]) return not_manifold(mesh, "several fans of quads meet", p);
  }
  for (const FeatureEdge& e : mesh.edges)
    if (!holds(sides, e.a, e.b) && !holds(sides, e.b, e.a))
      return not_manifold(mesh, "an edge of \"" + mesh.features[e.feature].name + "\" is no edge of a quad", e.a);
  return {};
}

std::vector<std::vector<std::uint32_t>> feature_chains(const std::vector<FeatureEdge>& edges,
                                                       const std::vector<std::uint32_t>& corners,
                                                       std::uint32_t feature) {
  std::vector<std::uint32_t> mine;
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges[e].feature == feature) mine.push_back(e);
  std::vector<std::vector<std::uint32_t>> chains;
  if (mine.empty()) return chains;
  // Edges around each of its points, as a sorted list of (point, edge).
  std::vector<std::array<std::uint32_t, 2>> around;
  for (const std::uint32_t e : mine) {
    around.push_back({edges[e].a, e});
    around.push_back({edges[e].b, e});
  }
  std::sort(around.begin(), around.end());
  const auto edges_at = [&](std::uint32_t p) {
    const auto first = std::lower_bound(around.begin(), around.end(), std::array<std::uint32_t, 2>{p, 0});
    auto end = first;
    while (end != around.end() && (*end)[0] == p) ++end;
    return std::pair(first, end);
  };
  const auto stops_at = [&](std::uint32_t p) {
    const auto [first, end] = edges_at(p);
    return end - first != 2 || std::binary_search(corners.begin(), corners.end(), p);
  };
  std::vector<char> is_used(edges.size(), 0);
  const auto walk = [&](std::uint32_t from, std::uint32_t edge) {
    std::vector<std::uint32_t> chain{from};
    for (;;) {
      is_used[edge] = 1;
      const std::uint32_t p = edges[edge].a == chain.back() ? edges[edge].b : edges[edge].a;
      chain.push_back(p);
      if (p == from || stops_at(p)) break;
      const auto [first, end] = edges_at(p);
      edge = (*first)[1] == edge ? (*(first + 1))[1] : (*first)[1];
    }
    chains.push_back(std::move(chain));
  };
  for (const std::uint32_t e : mine)
    for (const std::uint32_t p : {edges[e].a, edges[e].b})
      if (!is_used[e] && stops_at(p)) walk(p, e);
  for (const std::uint32_t e : mine)
    if (!is_used[e]) walk(edges[e].a, e);
  return chains;
}

}  // namespace strataflow
