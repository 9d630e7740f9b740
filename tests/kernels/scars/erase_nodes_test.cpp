#include "kernels/scars/erase_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strataflow {
namespace {

struct Mesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> patch;
};

/// A fan of n triangles around point 0.
Mesh fan(std::uint32_t n, double height = 0) {
  Mesh mesh;
  mesh.points.push_back({0, 0, height});
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.points.push_back({std::cos(6.283185307179586 * i / n), std::sin(6.283185307179586 * i / n), 0});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  mesh.patch.assign(n, 0);
  return mesh;
}

/// A strip around a line of scar nodes whose valences are given, as a clean split leaves them: node i stands on an
/// original edge from below i to above i. euler1999 §2.5.3: valence(i) = 5 + d(i) − d(i − 1).
Mesh scar_line(const std::vector<int>& valences) {
  const auto n = static_cast<std::uint32_t>(valences.size());
  std::vector<int> leans{0};  // d: in the cell after node i the diagonal starts at node i
  for (const int lowest : {0, 1}) {
    leans.assign(1, lowest);
    for (const int v : valences) leans.push_back(leans.back() + v - 5);
    if (std::all_of(leans.begin(), leans.end(), [](int d) { return d == 0 || d == 1; })) break;
  }
  Mesh mesh;
  // Nodes 0 … n+1 (the first and the last stay on the border), each with its edge's ends n+2+… below and above. The
  // crossed triangle between edges i and i + 1 has its apex below or above by turns, shared with both edges.
  const std::uint32_t count = n + 2;
  for (std::uint32_t i = 0; i < count; ++i) mesh.points.push_back({});
  std::uint32_t below = count, above = count + 1;
  mesh.points.push_back({0, -1, 0});
  mesh.points.push_back({0, 1, 0});
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const auto fresh = static_cast<std::uint32_t>(mesh.points.size());
    const bool moves_above = i % 2 == 0;
    mesh.points.push_back({1.0 * i + 1, moves_above ? 1.0 : -1.0, 0});
    const std::uint32_t p = i, q = i + 1;
    mesh.points[i] = 0.5 * (mesh.points[below] + mesh.points[above]);
    if (moves_above) {  // apex below: quad p q fresh above
      mesh.triangles.push_back({below, q, p});
      if (leans[i])
        mesh.triangles.insert(mesh.triangles.end(), {{p, q, fresh}, {p, fresh, above}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{p, q, above}, {q, fresh, above}});
      above = fresh;
    } else {
      mesh.triangles.push_back({above, p, q});
      if (leans[i])
        mesh.triangles.insert(mesh.triangles.end(), {{p, fresh, q}, {p, below, fresh}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{p, below, q}, {q, below, fresh}});
      below = fresh;
    }
  }
  mesh.points[count - 1] = 0.5 * (mesh.points[below] + mesh.points[above]);
  mesh.patch.assign(mesh.triangles.size(), 0);
  return mesh;
}

ErasureReport erase(Mesh& mesh, const std::vector<std::uint32_t>& nodes, const ErasureOptions& options = {}) {
  return erase_nodes(mesh.points, mesh.triangles, mesh.patch, nodes, std::vector<char>(mesh.points.size(), 0), {},
                     options);
}

std::vector<std::uint32_t> inner_nodes(std::size_t n) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t v = 1; v <= n; ++v) nodes.push_back(v);
  return nodes;
}

TEST(EraseNodes, fills_small_fans_directly_and_larger_ones_by_delaunay) {
  for (std::uint32_t n = 3; n < 12; ++n) {
    Mesh mesh = fan(n, 0.1);
    const ErasureReport report = erase(mesh, {0});
    EXPECT_EQ(report.erased, std::vector<std::uint32_t>{0});
    EXPECT_EQ(mesh.triangles.size(), n - 2);
    EXPECT_EQ(report.direct_fills, n <= 4 ? 1u : 0u);
    EXPECT_EQ(report.delaunay_fills, n <= 4 ? 0u : 1u);
    EXPECT_EQ(report.valence_count.at(n), 1u);
    for (const Triangle& t : mesh.triangles)
      EXPECT_GT(cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]).z, 0);
  }
}

TEST(EraseNodes, keeps_a_node_on_a_border_and_one_between_patches) {
  Mesh open = fan(6);
  open.triangles.pop_back();
  open.patch.pop_back();
  ErasureReport report = erase(open, {0});
  ASSERT_EQ(report.refused.size(), 1u);
  EXPECT_EQ(report.refused[0].reason, ErasureRefusal::on_border);
  EXPECT_EQ(open.triangles.size(), 5u);
  Mesh parted = fan(6);
  parted.patch = {0, 0, 0, 1, 1, 1};
  EXPECT_EQ(erase(parted, {0}).refused.size(), 1u);
}

TEST(EraseNodes, keeps_a_node_whose_position_others_use) {
  Mesh mesh = fan(5);
  std::vector<char> shared(mesh.points.size(), 0);
  shared[0] = 1;
  const ErasureReport report = erase_nodes(mesh.points, mesh.triangles, mesh.patch, {0}, shared, {});
  ASSERT_EQ(report.refused.size(), 1u);
  EXPECT_EQ(report.refused[0].reason, ErasureRefusal::shared_place);
}

TEST(EraseNodes, keeps_a_node_whose_rim_crosses_itself_in_projection) {
  Mesh mesh = fan(5);
  mesh.points[1] = {-3, 0.3, 0};  // across the opposite side
  const ErasureReport report = erase(mesh, {0});
  ASSERT_EQ(report.refused.size(), 1u);
  EXPECT_EQ(report.refused[0].reason, ErasureRefusal::crossing_fill);
  EXPECT_EQ(mesh.triangles.size(), 5u);
}

TEST(EraseNodes, keeps_the_apex_of_a_closed_tetrahedron) {
  Mesh mesh = fan(3, 1);
  mesh.triangles.push_back({1, 3, 2});
  mesh.patch.push_back(0);
  const ErasureReport report = erase(mesh, {0});
  ASSERT_EQ(report.refused.size(), 1u);
  EXPECT_EQ(report.refused[0].reason, ErasureRefusal::repeated_edge);
}

TEST(EraseNodes, four_five_five_six_four_six_four_needs_no_delaunay) {  // figures 2-15, 2-16
  const std::vector<int> valences{4, 5, 5, 6, 4, 6, 4};
  Mesh mesh = scar_line(valences);
  std::vector<int> found(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++found[v];
  for (std::size_t i = 0; i < valences.size(); ++i) ASSERT_EQ(found[i + 1], valences[i]) << "node " << i;
  // The line is straight, so that both diagonals of every hole pass through its node. Its ends, on the border, stay.
  std::vector<std::uint32_t> nodes = inner_nodes(7);
  nodes.insert(nodes.end(), {0, 8});
  const ErasureReport report = erase(mesh, nodes);
  EXPECT_EQ(report.erased.size(), 7u);
  EXPECT_EQ(report.delaunay_fills, 0u);
  EXPECT_EQ(report.valence_count, (std::vector<std::uint64_t>{0, 0, 0, 0, 3, 2, 2}));
}

TEST(EraseNodes, blocked_lines_need_delaunay) {
  for (const std::vector<int>& valences : {std::vector<int>{5, 5, 5, 5}, {5, 5, 5, 6, 4}}) {
    Mesh mesh = scar_line(valences);
    const ErasureReport report = erase(mesh, inner_nodes(valences.size()));
    EXPECT_EQ(report.erased.size(), valences.size());
    EXPECT_GT(report.delaunay_fills, 0u);
  }
}

TEST(EraseNodes, recreates_the_edge_a_node_was_put_on) {
  Mesh mesh = fan(6);
  std::vector<std::array<std::uint32_t, 2>> original(mesh.points.size(), {0xffffffffu, 0xffffffffu});
  original[0] = {2, 5};
  erase_nodes(mesh.points, mesh.triangles, mesh.patch, {0}, std::vector<char>(mesh.points.size(), 0), original);
  const auto has = [&](std::uint32_t a, std::uint32_t b) {
    return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
    });
  };
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(has(2, 5), 2);
}

}  // namespace
}  // namespace strataflow
