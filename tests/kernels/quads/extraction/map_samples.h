#pragma once
#include <map>
#include <set>

#include "base/seed.h"
#include "kernels/quads/extraction/grid_map.h"
#include "kernels/quads/plan/plan_mesh.h"
#include "kernels/topology/building/edge_table.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow::map_samples {

struct MappedMesh {
  FeatureMesh mesh;
  CornerMap map;
};

inline Polyline line(std::string name, Role role, std::vector<Vec3> points, bool is_closed = false) {
  return {std::move(name), role, std::move(points), is_closed};
}

/// Quarter turns from what the charts say about each edge; axes where a feature edge is along one.
inline void derive_turns_and_axes(MappedMesh& m) {
  const EdgeTable table = build_edge_table(m.mesh.points.size(), m.mesh.triangles);
  m.map.turns.assign(m.map.uv.size(), 0);
  m.map.axes.assign(m.map.uv.size(), MapAxis::none);
  const auto along = [&](std::uint32_t h) { return m.map.at(GridMap::next(h)) - m.map.at(h); };
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    const auto around = table.around(e);
    if (around.size() != 2) continue;
    for (int s = 0; s < 2; ++s) {
      const auto own = along(around[s]), other = -along(around[1 - s]);
      for (int k = 0; k < 4; ++k)
        if (std::abs(own - turned(other, k)) < 1e-3 * std::abs(own))
          m.map.turns[around[s]] = static_cast<std::uint8_t>(k);
    }
  }
  for (const FeatureEdge& e : m.mesh.edges)
    for (const std::uint32_t h : table.around(find_edge(table, e.a, e.b)))
      m.map.axes[h] = std::abs(along(h).imag()) < std::abs(along(h).real()) ? MapAxis::real : MapAxis::imaginary;
}

/// A rectangle [0, w] × [0, h] with curves, triangulated as the mesher does, mapped by the identity.
inline MappedMesh rectangle(double w, double h, const std::vector<Polyline>& curves, double edge_length_m = 1) {
  std::vector<Polyline> lines{line("outline", Role::outline, {{0, 0, 0}, {w, 0, 0}, {w, h, 0}, {0, h, 0}}, true)};
  lines.insert(lines.end(), curves.begin(), curves.end());
  PlanOptions options;
  options.edge_length_m = edge_length_m;
  MappedMesh m;
  m.mesh = *plan_mesh(lines, {}, {}, options);
  for (const Triangle& t : m.mesh.triangles)
    for (const std::uint32_t p : t) m.map.uv.push_back({m.mesh.points[p].x, m.mesh.points[p].y});
  derive_turns_and_axes(m);
  return m;
}

/// The faces of a box of unit squares `sides` whose normals are in `faces` (0 −x, 1 +x … 5 +z), each cut into `n` × `n`
/// cells of two triangles; every face has its own chart.
inline MappedMesh box_faces(std::array<int, 3> sides, const std::vector<int>& faces, int n) {
  MappedMesh m;
  std::map<std::array<int, 3>, std::uint32_t> number;  // in n-ths of the sides
  for (const int face : faces) {
    const int axis = face / 2, s = (axis + 1) % 3, t = (axis + 2) % 3;
    const bool is_high = face % 2 == 1;
    const auto point = [&](int i, int j) {
      std::array<int, 3> at{};
      at[static_cast<std::size_t>(axis)] = is_high ? n : 0;
      at[static_cast<std::size_t>(s)] = i;
      at[static_cast<std::size_t>(t)] = j;
      const auto [place, is_new] = number.try_emplace(at, static_cast<std::uint32_t>(m.mesh.points.size()));
      if (is_new) {
        Vec3 p;
        for (int k = 0; k < 3; ++k)
          p[k] = double(at[static_cast<std::size_t>(k)]) * sides[static_cast<std::size_t>(k)] / n;
        m.mesh.points.push_back(p);
      }
      return place->second;
    };
    const auto uv = [&](int i, int j) {
      const double u = double(i) * sides[static_cast<std::size_t>(s)] / n,
                   v = double(j) * sides[static_cast<std::size_t>(t)] / n;
      return is_high ? std::array<double, 2>{u, v} : std::array<double, 2>{v, u};
    };
    const auto add = [&](std::array<std::array<int, 2>, 3> c) {
      if (!is_high) std::swap(c[1], c[2]);
      m.mesh.triangles.push_back({point(c[0][0], c[0][1]), point(c[1][0], c[1][1]), point(c[2][0], c[2][1])});
      for (const auto& [i, j] : c) m.map.uv.push_back(uv(i, j));
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
        add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
  }
  // The open border is one feature.
  const EdgeTable table = build_edge_table(m.mesh.points.size(), m.mesh.triangles);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e)
    if (table.around(e).size() == 1) m.mesh.edges.push_back({table.edges[e][0], table.edges[e][1], 0});
  if (!m.mesh.edges.empty()) m.mesh.features.push_back({"border", Role::outline, 0, -1});
  derive_turns_and_axes(m);
  return m;
}

/// Every triangle in a chart of its own: quarter turns and whole translations, and noise below the tolerance.
inline void rechart(MappedMesh& m, std::uint64_t seed, double noise = 0) {
  RandomStream random(seed);
  for (std::size_t t = 0; t < m.mesh.triangles.size(); ++t) {
    const int turns = static_cast<int>(random.below(4));
    const std::complex<double> shift(double(random.below(21)) - 10, double(random.below(21)) - 10);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto z = turned(std::complex<double>{m.map.uv[3 * t + k][0], m.map.uv[3 * t + k][1]}, turns) + shift;
      m.map.uv[3 * t + k] = {z.real() + noise * (random.unit() - 0.5), z.imag() + noise * (random.unit() - 0.5)};
    }
  }
  derive_turns_and_axes(m);
}

}  // namespace strataflow::map_samples
