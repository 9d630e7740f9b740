#include "kernels/quads/field/feature_layout.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/id.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {

namespace {

Failure bad_mesh(const std::string& what) {
  return {FailureCode::invalid_input, what, "repair the triangle mesh, or let the plan stage make it"};
}

Result<void> check_numbers(const FeatureMesh& mesh) {
  if (mesh.triangles.empty() || mesh.triangles.size() >= no_index / 3) return bad_mesh("a mesh without triangles");
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    if (!is_finite(mesh.points[p])) return bad_mesh("point " + std::to_string(p) + " is not finite");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangles[t];
    for (const std::uint32_t p : tri)
      if (p >= mesh.points.size())
        return bad_mesh("triangle " + std::to_string(t) + " names a point that is not there");
    if (tri[0] == tri[1] || tri[1] == tri[2] || tri[2] == tri[0])
      return bad_mesh("triangle " + std::to_string(t) + " has a corner twice");
  }
  for (const FeatureEdge& edge : mesh.edges)
    if (edge.a >= edge.b || edge.b >= mesh.points.size() || edge.feature >= mesh.features.size())
      return bad_mesh("a feature edge names a point or a feature that is not there");
  return {};
}

/// Opposite half-edges and features of the edges.
Result<void> pair_half_edges(const FeatureMesh& mesh, FeatureLayout& layout) {
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  const std::size_t half_edges = 3 * mesh.triangles.size();
  layout.opposite.assign(half_edges, no_index);
  layout.is_feature.assign(half_edges, 0);
  layout.feature.assign(half_edges, no_index);
  const auto origin = [&](std::uint32_t h) { return mesh.triangles[h / 3][h % 3]; };
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    const auto around = table.around(e);
    const std::string where = "edge " + std::to_string(table.edges[e][0]) + "-" + std::to_string(table.edges[e][1]);
    if (around.size() > 2) return bad_mesh(where + " has " + std::to_string(around.size()) + " triangles");
    if (around.size() < 2) continue;
    if (origin(around[0]) == origin(around[1])) return bad_mesh(where + " has two triangles that turn opposite ways");
    layout.opposite[around[0]] = around[1];
    layout.opposite[around[1]] = around[0];
  }
  for (const FeatureEdge& edge : mesh.edges) {
    const std::uint32_t e = find_edge(table, edge.a, edge.b);
    if (e == no_index)
      return bad_mesh("feature " + mesh.features[edge.feature].name + " runs between " + name_point(mesh, edge.a) +
                      " and " + name_point(mesh, edge.b) + ", which is no edge of the mesh");
    for (const std::uint32_t h : table.around(e)) {
      layout.is_feature[h] = 1;
      layout.feature[h] = std::min(layout.feature[h], edge.feature);
    }
  }
  return {};
}

/// Edge lengths, corner angles and areas.
Result<void> measure(const FeatureMesh& mesh, FeatureLayout& layout) {
  const std::size_t count = mesh.triangles.size();
  layout.length_m.resize(3 * count);
  layout.angle.resize(3 * count);
  layout.area_m2.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Triangle& tri = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 along = mesh.points[tri[(k + 1) % 3]] - mesh.points[tri[k]];
      const Vec3 back = mesh.points[tri[(k + 2) % 3]] - mesh.points[tri[k]];
      const double twice = length(cross(along, back));
      layout.length_m[3 * t + k] = length(along);
      layout.angle[3 * t + k] = std::atan2(twice, dot(along, back));
      if (k == 0) layout.area_m2[t] = twice / 2;
    }
    // Heights below a billionth of the longest side drown in rounding: nothing could be mapped reliably.
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, layout.length_m[3 * t + k]);
    if (!(layout.area_m2[t] > 1e-9 * longest * longest) || !std::isfinite(layout.area_m2[t]))
      return bad_mesh("triangle " + std::to_string(t) + " at " + name_point(mesh, tri[0]) + " has no area");
  }
  return {};
}

/// Gathers the corners of every point into nodes.
Result<void> build_nodes(const FeatureMesh& mesh, FeatureLayout& layout) {
  const auto corners = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  layout.node_of.assign(corners, no_index);
  layout.node_first = {0};
  const auto is_wall = [&](std::uint32_t h) { return layout.is_feature[h] || layout.opposite[h] == no_index; };
  const auto add_node = [&](std::uint32_t first, NodeKind kind) {
    const auto node = static_cast<std::uint32_t>(layout.node_kind.size());
    std::uint32_t corner = first;
    while (true) {
      layout.node_of[corner] = node;
      layout.node_corners.push_back(corner);
      const std::uint32_t incoming = previous_half_edge(corner);
      if (is_wall(incoming)) {
        if (!layout.is_feature[incoming]) kind = NodeKind::open;
        break;
      }
      corner = layout.opposite[incoming];
      if (corner == first) break;
    }
    layout.node_first.push_back(static_cast<std::uint32_t>(layout.node_corners.size()));
    layout.node_kind.push_back(kind);
    layout.node_point.push_back(mesh.triangles[first / 3][first % 3]);
  };
  for (std::uint32_t h = 0; h < corners; ++h)
    if (is_wall(h)) add_node(h, layout.is_feature[h] ? NodeKind::sector : NodeKind::open);
  for (std::uint32_t h = 0; h < corners; ++h)
    if (layout.node_of[h] == no_index) add_node(h, NodeKind::inside);
  layout.point_first.assign(mesh.points.size() + 1, 0);
  for (const std::uint32_t p : layout.node_point) ++layout.point_first[p + 1];
  for (std::size_t p = 0; p < mesh.points.size(); ++p) layout.point_first[p + 1] += layout.point_first[p];
  layout.point_nodes.resize(layout.node_count());
  std::vector<std::uint32_t> place(layout.point_first.begin(), layout.point_first.end() - 1);
  for (std::uint32_t n = 0; n < layout.node_count(); ++n) layout.point_nodes[place[layout.node_point[n]]++] = n;
  // A manifold point has one fan: walking over its walls, from the boundary if there is one, visits all nodes.
  std::vector<std::uint32_t> start(mesh.points.size(), no_index);
  for (std::uint32_t h = 0; h < corners; ++h) {
    if (layout.opposite[h] != no_index) continue;
    std::uint32_t& first = start[mesh.triangles[h / 3][h % 3]];
    if (first != no_index) return bad_mesh("two sheets touch in " + name_point(mesh, mesh.triangles[h / 3][h % 3]));
    first = h;
  }
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    const auto nodes = layout.nodes_of(p);
    if (nodes.size() < 2) continue;
    const std::uint32_t first = start[p] != no_index ? start[p] : layout.corners_of(nodes[0])[0];
    std::uint32_t corner = first;
    std::size_t seen = 0;
    do {
      ++seen;
      const std::uint32_t node = layout.node_of[corner];
      corner = layout.node_kind[node] == NodeKind::inside
                   ? no_index
                   : layout.opposite[previous_half_edge(layout.corners_of(node).back())];
    } while (corner != first && corner != no_index && seen <= nodes.size());
    if (seen != nodes.size()) return bad_mesh("two sheets touch in " + name_point(mesh, p));
  }
  return {};
}

void find_compartments(FeatureLayout& layout) {
  const std::size_t count = layout.triangle_count();
  layout.compartment.assign(count, no_index);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (layout.compartment[seed] != no_index) continue;
    layout.compartment[seed] = layout.compartment_count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (layout.is_feature[h] || layout.opposite[h] == no_index) continue;
        const std::uint32_t other = layout.opposite[h] / 3;
        if (layout.compartment[other] != no_index) continue;
        layout.compartment[other] = layout.compartment_count;
        stack.push_back(other);
      }
    }
    ++layout.compartment_count;
  }
}

}  // namespace

Result<FeatureLayout> build_feature_layout(const FeatureMesh& mesh) {
  FeatureLayout layout;
  if (auto checked = check_numbers(mesh); !checked) return checked.failure();
  if (auto paired = pair_half_edges(mesh, layout); !paired) return paired.failure();
  if (auto measured = measure(mesh, layout); !measured) return measured.failure();
  if (auto built = build_nodes(mesh, layout); !built) return built.failure();
  find_compartments(layout);
  return layout;
}

std::string name_point(const FeatureMesh& mesh, std::uint32_t point) {
  std::ostringstream text;
  const Vec3 at = mesh.points[point] + mesh.local_origin;
  text.precision(10);
  text << "point " << point << " at (" << at.x << ", " << at.y << ", " << at.z << ")";
  return text.str();
}

std::string name_feature(const FeatureMesh& mesh, const FeatureLayout& layout, std::uint32_t half_edge) {
  const std::uint32_t feature = layout.feature[half_edge];
  return feature == no_index ? "the surface" : "feature " + mesh.features[feature].name;
}

}  // namespace strataflow
