#include "kernels/quads/field/field_topology.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double right_angle = pi / 2;

double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

/// Changes the turn of h so that its origin loses a quad and its end gains one.
void shift_quad(const FeatureLayout& layout, FieldTopology& topology, std::uint32_t h) {
  const std::uint32_t g = layout.opposite[h];
  topology.turns[h] = (topology.turns[h] + 1) & 3;
  topology.turns[g] = (topology.turns[g] + 3) & 3;
  topology.residual[h] -= right_angle;
  topology.residual[g] += right_angle;
  --topology.quads[layout.node_of[h]];
  ++topology.quads[layout.node_of[g]];
}

double edge_weight(const FeatureLayout& layout, std::uint32_t h) {
  const double area = layout.area_m2[h / 3] + layout.area_m2[layout.opposite[h] / 3];
  return std::clamp(3 * layout.length_m[h] * layout.length_m[h] / area, 0.05, 20.0);
}

/// What shift_quad(h) adds to the squared residuals, in units of (π/2)².
double shift_cost(const FeatureLayout& layout, const FieldTopology& topology, std::uint32_t h) {
  return edge_weight(layout, h) * (1 - 2 * topology.residual[h] / right_angle);
}

/// Among the inner half-edges out of `node` that end inside and satisfy `allowed`, the one over which it costs least
/// to lose (`gain` false) or to gain a quad; no_index if there is none.
template <class Allowed>
std::uint32_t cheapest_way(const FeatureLayout& layout, const FieldTopology& topology, std::uint32_t node, bool gain,
                           Allowed allowed) {
  std::uint32_t best = no_index;
  double least = 0;
  const auto corners = layout.corners_of(node);
  for (std::size_t j = layout.node_kind[node] == NodeKind::inside ? 0 : 1; j < corners.size(); ++j) {
    const std::uint32_t h = corners[j], g = layout.opposite[h];
    const std::uint32_t other = layout.node_of[next_half_edge(h)];
    if (layout.node_kind[other] != NodeKind::inside || !allowed(other)) continue;
    const double cost = shift_cost(layout, topology, gain ? g : h);
    if (best == no_index || cost < least) {
      least = cost;
      best = gain ? g : h;
    }
  }
  return best;
}

/// Shortest path inside from a point of too many quads to one of too few; half-edges in order, empty if none costs at
/// most `limit`.
struct PathSearch {
  const FeatureLayout& layout;
  double quad_m;
  std::vector<double> cost;
  std::vector<std::uint32_t> via, touched;

  PathSearch(const FeatureLayout& l, double quad)
      : layout(l), quad_m(quad), cost(l.node_count(), -1), via(l.node_count(), no_index) {}

  std::vector<std::uint32_t> find(const FieldTopology& topology, std::uint32_t from, double limit) {
    using Item = std::pair<double, std::uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    for (const std::uint32_t n : touched) cost[n] = -1;
    touched = {from};
    cost[from] = 0;
    via[from] = no_index;
    queue.push({0, from});
    std::vector<std::uint32_t> path;
    while (!queue.empty()) {
      const auto [so_far, node] = queue.top();
      queue.pop();
      if (so_far > cost[node]) continue;
      if (so_far > limit) break;
      if (topology.quads[node] < 4) {
        for (std::uint32_t n = node; n != from; n = layout.node_of[via[n]]) path.push_back(via[n]);
        std::reverse(path.begin(), path.end());
        break;
      }
      for (const std::uint32_t h : layout.corners_of(node)) {
        const std::uint32_t other = layout.node_of[next_half_edge(h)];
        if (layout.node_kind[other] != NodeKind::inside) continue;
        const double total = so_far + std::max(1e-6, layout.length_m[h] / quad_m * shift_cost(layout, topology, h));
        if (cost[other] >= 0 && cost[other] <= total) continue;
        if (cost[other] < 0) touched.push_back(other);
        cost[other] = total;
        via[other] = h;
        queue.push({total, other});
      }
    }
    return path;
  }
};

}  // namespace

FieldTopology match_frames(const FeatureLayout& layout, const std::vector<double>& angle,
                           const std::vector<std::array<double, 2>>& frames) {
  const auto half_edges = static_cast<std::uint32_t>(3 * layout.triangle_count());
  FieldTopology topology{std::vector<std::uint8_t>(half_edges, 0), std::vector<double>(half_edges, 0.0),
                         std::vector<std::int8_t>(half_edges, -1), std::vector<std::int32_t>(layout.node_count(), 0)};
  std::vector<double> miss(half_edges, 0.0);  // of a feature edge's direction, once its label is taken off
  parallel_ranges(half_edges, 4096, [&](std::size_t begin, std::size_t end) {
    for (auto h = static_cast<std::uint32_t>(begin); h < end; ++h) {
      const auto [a, b] = frames[h / 3];
      const double direction = half_edge_direction(angle, h);
      if (layout.is_feature[h]) {
        double least = 10;
        for (int d = 0; d < 4; ++d) {
          // Odd: u is constant along it, so the first gradient stands on it; even: the second.
          const double off =
              std::abs(wrapped(d % 2 ? direction - d * right_angle - a : direction - (d - 1) * right_angle - b));
          if (off < least - 1e-12) {
            least = off;
            topology.label[h] = static_cast<std::int8_t>(d);
          }
        }
        miss[h] = wrapped(direction - (a + b) / 2 + pi / 4 - topology.label[h] * right_angle);
      }
    }
  });
  parallel_ranges(half_edges, 4096, [&](std::size_t begin, std::size_t end) {
    for (auto h = static_cast<std::uint32_t>(begin); h < end; ++h) {
      const std::uint32_t g = layout.opposite[h];
      if (g == no_index || (g < h && !layout.is_feature[h])) continue;
      if (layout.is_feature[h]) {
        topology.turns[h] = static_cast<std::uint8_t>((topology.label[h] - topology.label[g] + 2) & 3);
        continue;
      }
      const auto [a, b] = frames[h / 3];
      const double carry = half_edge_direction(angle, h) - half_edge_direction(angle, g) + pi;
      const double c = frames[g / 3][0] + carry, d = frames[g / 3][1] + carry;
      const std::array<std::array<double, 2>, 4> turned{{{c, d}, {d + pi, c}, {c + pi, d + pi}, {d, c + pi}}};
      double least = 10;
      for (std::size_t k = 0; k < 4; ++k) {
        const double off_a = wrapped(turned[k][0] - a), off_b = wrapped(turned[k][1] - b);
        const double off = std::abs(off_a) + std::abs(off_b);
        if (off < least - 1e-12) {
          least = off;
          topology.turns[h] = static_cast<std::uint8_t>(k);
          topology.turns[g] = static_cast<std::uint8_t>((4 - k) & 3);
          topology.residual[h] = (off_a + off_b) / 2;
          topology.residual[g] = -topology.residual[h];
        }
      }
    }
  });
  for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
    const auto corners = layout.corners_of(n);
    double sum = 0;
    for (std::size_t j = 0; j < corners.size(); ++j) {
      sum += angle[corners[j]];
      if (j > 0 || layout.node_kind[n] == NodeKind::inside) sum += topology.residual[corners[j]];
    }
    if (layout.node_kind[n] == NodeKind::sector) sum += miss[corners[0]] - miss[previous_half_edge(corners.back())];
    topology.quads[n] = static_cast<std::int32_t>(std::lround(sum / right_angle));
  }
  return topology;
}

Result<SettledSingularities> settle_singularities(const FeatureMesh& mesh, const FeatureLayout& layout,
                                                  const std::vector<std::uint8_t>& corner_quads, double cancel_cost,
                                                  FieldTopology& topology) {
  SettledSingularities done;
  const auto any = [](std::uint32_t) { return true; };
  for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
    if (layout.node_kind[n] != NodeKind::sector) continue;
    while (topology.quads[n] != corner_quads[n]) {
      const std::uint32_t way = cheapest_way(layout, topology, n, topology.quads[n] < corner_quads[n], any);
      if (way == no_index)
        return Failure{FailureCode::invalid_input,
                       "no point inside is next to " + name_point(mesh, layout.node_point[n]) + " of " +
                           name_feature(mesh, layout, layout.corners_of(n)[0]) + ", which needs " +
                           std::to_string(corner_quads[n]) + " quads on a side and has " +
                           std::to_string(topology.quads[n]),
                       "refine the triangles there (separate_features does)"};
      shift_quad(layout, topology, way);
      ++done.off_features;
    }
  }
  // Cancel first: what is left is spread.
  if (cancel_cost > 0) {
    PathSearch search(layout, mesh.edge_length_m > 0 ? mesh.edge_length_m : 2 * layout.length_m[0]);
    for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
      if (layout.node_kind[n] != NodeKind::inside) continue;
      while (topology.quads[n] > 4) {
        const auto path = search.find(topology, n, cancel_cost);
        if (path.empty()) break;
        for (const std::uint32_t h : path) shift_quad(layout, topology, h);
        ++done.cancelled;
      }
    }
  }
  for (int pass = 0; pass < 10; ++pass) {
    bool changed = false;
    for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
      if (layout.node_kind[n] != NodeKind::inside) continue;
      while (topology.quads[n] < 3 || topology.quads[n] > 5) {
        const bool gain = topology.quads[n] < 3;
        const std::uint32_t way = cheapest_way(layout, topology, n, gain, [&](std::uint32_t other) {
          return gain ? topology.quads[other] > 3 : topology.quads[other] < 5;
        });
        if (way == no_index) break;
        shift_quad(layout, topology, way);
        ++done.spread;
        changed = true;
      }
    }
    if (!changed) break;
  }
  for (std::uint32_t n = 0; n < layout.node_count(); ++n)
    if (layout.node_kind[n] == NodeKind::inside && topology.quads[n] < 1)
      return Failure{FailureCode::geometry_failed,
                     "the surroundings of " + name_point(mesh, layout.node_point[n]) +
                         " need more singular points than they have points",
                     "refine the triangles there"};
  return done;
}

std::int64_t index_sum(const FeatureMesh& mesh, const FeatureLayout& layout, const FieldTopology& topology) {
  std::vector<std::uint8_t> on_boundary(mesh.points.size(), 0);
  for (std::uint32_t h = 0; h < layout.opposite.size(); ++h)
    if (layout.opposite[h] == no_index) on_boundary[mesh.triangles[h / 3][h % 3]] = 1;
  std::int64_t sum = 0;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    const auto nodes = layout.nodes_of(p);
    if (nodes.empty()) continue;
    sum += on_boundary[p] ? 2 : 4;
    for (const std::uint32_t n : nodes) sum -= topology.quads[n];
  }
  return sum;
}

std::int64_t euler_characteristic(const FeatureMesh& mesh, const FeatureLayout& layout) {
  std::int64_t used = 0, edges = 0;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) used += !layout.nodes_of(p).empty();
  for (std::uint32_t h = 0; h < layout.opposite.size(); ++h)
    edges += layout.opposite[h] == no_index || h < layout.opposite[h];
  return used - edges + static_cast<std::int64_t>(layout.triangle_count());
}

}  // namespace strataflow
