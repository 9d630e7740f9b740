#include "kernels/quads/quantization/round_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "kernels/quads/quantization/close_vectors.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {
namespace {

Failure refuse(const std::string& what) {
  return {FailureCode::invalid_input, what, "compute the seamless map anew, or repair the triangles there"};
}

std::string at_edge(const FlatMesh& flat, std::uint32_t h) {
  return "edge " + std::to_string(flat.origin[h]) + "–" + std::to_string(flat.end(h));
}

/// A point whose triangles do not form one fan.
std::optional<std::uint32_t> pinched_point(std::size_t point_count, const FlatMesh& flat) {
  std::vector<std::uint32_t> corners(point_count, 0), first(point_count, FlatMesh::outside);
  for (std::uint32_t h = 0; h < flat.half_edge_count(); ++h) {
    const std::uint32_t p = flat.origin[h];
    ++corners[p];
    if (first[p] == FlatMesh::outside || flat.opposite[h] == FlatMesh::outside) first[p] = h;  // clockwise end
  }
  for (std::uint32_t p = 0; p < point_count; ++p) {
    if (first[p] == FlatMesh::outside) continue;
    std::uint32_t seen = 1;
    for (std::uint32_t h = flat.left_of(first[p]); h != FlatMesh::outside && h != first[p]; h = flat.left_of(h)) ++seen;
    if (seen != corners[p]) return p;
  }
  return std::nullopt;
}

/// Numbers the sets of features that edges have: 1 for a boundary without any.
void number_curves(const FeatureMesh& mesh, const EdgeTable& table, FlatMesh& flat) {
  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers;
  flat.curve.assign(flat.origin.size(), 0);
  flat.curve_features.assign(2, {});
  for (std::size_t i = 0; i < mesh.edges.size();) {
    const FeatureEdge& edge = mesh.edges[i];
    std::vector<std::uint32_t> features;
    for (; i < mesh.edges.size() && mesh.edges[i].a == edge.a && mesh.edges[i].b == edge.b; ++i)
      features.push_back(mesh.edges[i].feature);
    const std::uint32_t e = find_edge(table, edge.a, edge.b);
    if (e >= table.edge_count()) continue;
    const auto [place, is_new] = numbers.try_emplace(features, static_cast<std::uint32_t>(flat.curve_features.size()));
    if (is_new) flat.curve_features.push_back(features);
    for (const std::uint32_t h : table.around(e)) flat.curve[h] = place->second;
  }
  for (std::size_t h = 0; h < flat.curve.size(); ++h)
    if (flat.opposite[h] == FlatMesh::outside && flat.curve[h] == 0) flat.curve[h] = 1;
}

}  // namespace

Result<FlatMesh> round_map(const FeatureMesh& mesh, const CornerMap& map) {
  const std::size_t count = 3 * mesh.triangles.size();
  if (map.uv.size() != count || map.turns.size() != count || map.axes.size() != count)
    return refuse("the map has " + std::to_string(map.uv.size()) + " corners, its mesh " + std::to_string(count));
  double extent = 0;
  for (std::size_t c = 0; c < count; ++c) {
    const double size = std::max(std::abs(map.uv[c][0]), std::abs(map.uv[c][1]));
    if (!std::isfinite(map.uv[c][0]) || !std::isfinite(map.uv[c][1]))
      return refuse("the map is not finite at corner " + std::to_string(c % 3) + " of triangle " +
                    std::to_string(c / 3));
    extent = std::max(extent, size);
  }
  if (!(extent > 1e-100) || !(extent < 1e100)) return refuse("the map has no extent");
  constexpr int bits = 42;
  int exponent = 0;
  std::frexp(extent, &exponent);

  FlatMesh flat;
  flat.step = std::ldexp(1.0, exponent - bits);
  flat.origin.resize(count);
  for (std::size_t h = 0; h < count; ++h) flat.origin[h] = mesh.triangles[h / 3][h % 3];
  flat.turns = map.turns;
  flat.axis = map.axes;
  flat.opposite.assign(count, FlatMesh::outside);
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    const auto around = table.around(e);
    if (around.size() == 1) continue;
    if (around.size() > 2 || flat.origin[around[0]] == flat.origin[around[1]])
      return refuse(at_edge(flat, around[0]) + " is not manifold and oriented");
    flat.opposite[around[0]] = around[1];
    flat.opposite[around[1]] = around[0];
  }
  if (const auto point = pinched_point(mesh.points.size(), flat))
    return refuse("at point " + std::to_string(*point) + " several sheets of the surface touch");
  number_curves(mesh, table, flat);

  const auto rounded = [&](std::size_t c) {
    return GaussianInteger{std::llround(map.uv[c][0] / flat.step), std::llround(map.uv[c][1] / flat.step)};
  };
  flat.vector.resize(count);
  for (std::uint32_t h = 0; h < count; ++h) flat.vector[h] = rounded(FlatMesh::next(h)) - rounded(h);
  const double aligned = std::ldexp(1e-9, bits), seamless = std::ldexp(1e-6, bits);
  std::vector<std::uint8_t> fixed(count, 0);
  for (std::uint32_t h = 0; h < count; ++h) {
    const std::uint32_t other = flat.opposite[h];
    if (other != FlatMesh::outside && other < h) continue;
    GaussianInteger& v = flat.vector[h];
    if (flat.axis[h] == MapAxis::real && std::abs(static_cast<double>(v.im)) <= aligned) {
      v.im = 0;
      fixed[h] = fixed_imaginary;
    } else if (flat.axis[h] == MapAxis::imaginary && std::abs(static_cast<double>(v.re)) <= aligned) {
      v.re = 0;
      fixed[h] = fixed_real;
    }
    if (other == FlatMesh::outside) continue;
    if (((map.turns[h] + map.turns[other]) & 3) != 0 || map.turns[h] > 3 || map.turns[other] > 3 ||
        map.axes[other] != turned(map.axes[h], map.turns[h]))
      return refuse("turns or axes disagree on both sides of " + at_edge(flat, h));
    const GaussianInteger wanted = -turned(v, map.turns[other]), off = wanted - flat.vector[other];
    if (std::abs(static_cast<double>(off.re)) > seamless || std::abs(static_cast<double>(off.im)) > seamless)
      return refuse("the map is not seamless across " + at_edge(flat, h));
    flat.vector[other] = wanted;
    if (fixed[h] != 0) fixed[other] = flat.axis[other] == MapAxis::real ? fixed_imaginary : fixed_real;
  }
  if (!close_vectors(flat, fixed, flat.vector)) return refuse("the features leave the map no freedom to be closed");
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (!flat.is_positive(t)) return refuse("triangle " + std::to_string(t) + " is not positive in the map");
  return flat;
}

}  // namespace strataflow
