#include "kernels/quality/topology_invariants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/seed.h"
#include "kernels/quality/curved_meshes.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using Betti = std::array<std::int64_t, 3>;

Betti betti(const TopologyInvariants& t) {
  return {static_cast<std::int64_t>(t.components), t.independent_loops, static_cast<std::int64_t>(t.cavities)};
}

TEST(TopologyInvariants, of_a_sphere_a_torus_a_klein_bottle_a_ring_and_a_moebius_strip) {
  EXPECT_EQ(betti(topology_invariants(sphere(1, 6).triangles)), (Betti{1, 0, 1}));
  EXPECT_EQ(betti(topology_invariants(closed_grid(5, true, false))), (Betti{1, 2, 1}));
  EXPECT_EQ(betti(topology_invariants(closed_grid(5, true, true))), (Betti{1, 2, 1}));
  const TopologyInvariants ring = topology_invariants(closed_grid(5, false, false));
  EXPECT_EQ(betti(ring), (Betti{1, 1, 0}));
  EXPECT_EQ(ring.borders, 2u);
  const TopologyInvariants moebius = topology_invariants(closed_grid(5, false, true));
  EXPECT_EQ(betti(moebius), (Betti{1, 1, 0}));
  EXPECT_EQ(moebius.borders, 1u);
}

TEST(TopologyInvariants, of_nothing_are_zero) { EXPECT_EQ(topology_invariants({}), TopologyInvariants{}); }

TEST(TopologyInvariants, a_membrane_across_a_sphere_makes_two_cavities) {
  Mesh mesh = sphere(1, 4);  // the ring of height 0 is row 2: points 9 … 16
  const auto centre = static_cast<std::uint32_t>(mesh.points.size());
  for (std::uint32_t j = 0; j < 8; ++j) mesh.triangles.push_back({centre, 9 + j, 9 + (j + 1) % 8});
  EXPECT_EQ(betti(topology_invariants(mesh.triangles)), (Betti{1, 0, 2}));
}

/// Betti numbers from the ranks of the full boundary matrices, entry by entry.
Betti betti_by_matrices(const std::vector<Triangle>& triangles) {
  std::map<std::uint32_t, std::uint32_t> vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {
    const auto key = std::minmax(a, b);
    return edges.try_emplace(key, edges.size()).first->second;
  };
  std::vector<std::vector<std::uint32_t>> faces;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) vertices.try_emplace(v, vertices.size());
    faces.push_back({edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])});
  }
  const auto rank = [](std::vector<std::vector<char>> rows) {
    std::int64_t found = 0;
    const std::size_t width = rows.empty() ? 0 : rows[0].size();
    for (std::size_t column = 0; column < width; ++column) {
      std::size_t pivot = found;
      while (pivot < rows.size() && !rows[pivot][column]) ++pivot;
      if (pivot == rows.size()) continue;
      std::swap(rows[found], rows[pivot]);
      for (std::size_t r = 0; r < rows.size(); ++r)
        if (r != static_cast<std::size_t>(found) && rows[r][column])
          for (std::size_t c = 0; c < width; ++c) rows[r][c] ^= rows[found][c];
      ++found;
    }
    return found;
  };
  std::vector<std::vector<char>> d2(triangles.size(), std::vector<char>(edges.size(), 0));
  for (std::size_t t = 0; t < faces.size(); ++t)
    for (const std::uint32_t e : faces[t]) d2[t][e] ^= 1;
  std::vector<std::vector<char>> d1(edges.size(), std::vector<char>(vertices.size(), 0));
  for (const auto& [ends, e] : edges) d1[e][vertices[ends.first]] = d1[e][vertices[ends.second]] = 1;
  const std::int64_t rank_1 = rank(d1), rank_2 = rank(d2);
  return {static_cast<std::int64_t>(vertices.size()) - rank_1,
          static_cast<std::int64_t>(edges.size()) - rank_1 - rank_2,
          static_cast<std::int64_t>(triangles.size()) - rank_2};
}

TEST(TopologyInvariants, of_random_tangles_are_those_of_the_boundary_matrices) {
  RandomStream random(3);
  for (int run = 0; run < 200; ++run) {
    std::set<std::array<std::uint32_t, 3>> chosen;
    const auto count = 4 + static_cast<int>(40 * random.unit());
    for (int i = 0; i < count; ++i) {
      std::array<std::uint32_t, 3> t;
      for (std::uint32_t& v : t) v = 3 * static_cast<std::uint32_t>(9 * random.unit());
      std::sort(t.begin(), t.end());
      if (t[0] != t[1] && t[1] != t[2]) chosen.insert(t);
    }
    const std::vector<Triangle> triangles(chosen.begin(), chosen.end());
    EXPECT_EQ(betti(topology_invariants(triangles)), betti_by_matrices(triangles)) << "run " << run;
  }
}

TEST(TopologyOf, a_model_has_as_many_cavities_as_regions) {  // Alexander duality: the other way to count
  for (const TriangleSoup& soup : {support::layered_box({0, 0.25, 0.5, 1}), support::nested_boxes(),
                                   support::box_with_floating_fault()}) {
    const StructuralModel model = build_structural_model(soup)->model;
    EXPECT_EQ(topology_of(model).whole.cavities, model.regions.size());
  }
  for (const std::string_view name : {"A1", "A3", "A4", "A6", "B", "D"}) {
    const StructuralModel model = build_structural_model(*generate_reference_model(name))->model;
    const ModelTopology topology = topology_of(model);
    EXPECT_EQ(topology.whole.cavities, model.regions.size()) << name;
    ASSERT_EQ(topology.surfaces.size(), model.surfaces.size());
    for (const TopologyInvariants& surface : topology.surfaces) EXPECT_EQ(surface.components, 1u) << name;
  }
}

}  // namespace
}  // namespace strataflow
