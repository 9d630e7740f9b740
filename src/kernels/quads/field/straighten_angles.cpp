#include "kernels/quads/field/straighten_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

#include "base/id.h"
#include "kernels/quads/field/compartment_system.h"

namespace strataflow {

namespace {

constexpr double right_angle = std::numbers::pi / 2;

/// Nodes of a compartment by their distance along its edges from one of them.
struct NodeDistances {
  const FeatureLayout& layout;
  std::vector<double> distance;
  std::vector<std::uint32_t> reached;  ///< nearest first

  explicit NodeDistances(const FeatureLayout& l) : layout(l), distance(l.node_count(), -1) {}

  void search(std::uint32_t from, double limit) {
    using Item = std::pair<double, std::uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    for (const std::uint32_t n : touched_) distance[n] = -1;
    touched_ = {from};
    reached.clear();
    distance[from] = 0;
    queue.push({0, from});
    while (!queue.empty()) {
      const auto [so_far, node] = queue.top();
      queue.pop();
      if (so_far > distance[node]) continue;
      reached.push_back(node);
      // Beyond the limit only until something inside is found.
      if (so_far > limit && found_inside_) break;
      found_inside_ = (node != from && found_inside_) || layout.node_kind[node] == NodeKind::inside;
      for (const std::uint32_t c : layout.corners_of(node))
        for (const auto& [end, edge] : {std::pair(layout.node_of[next_half_edge(c)], c),
                                        std::pair(layout.node_of[previous_half_edge(c)], previous_half_edge(c))}) {
          const double total = so_far + layout.length_m[edge];
          if (distance[end] >= 0 && distance[end] <= total) continue;
          if (distance[end] < 0) touched_.push_back(end);
          distance[end] = total;
          queue.push({total, end});
        }
    }
  }

 private:
  std::vector<std::uint32_t> touched_;
  bool found_inside_ = false;
};

}  // namespace

Result<std::vector<double>> straighten_angles(const FeatureMesh& mesh, const FeatureLayout& layout,
                                              const std::vector<std::uint8_t>& corner_quads) {
  const std::uint32_t nodes = layout.node_count();
  std::vector<double> gain(nodes, 0.0);
  const double quad_m = mesh.edge_length_m > 0 ? mesh.edge_length_m : 2 * layout.length_m[0];
  NodeDistances near(layout);
  for (std::uint32_t n = 0; n < nodes; ++n) {
    if (layout.node_kind[n] != NodeKind::sector) continue;
    double angle = 0;
    for (const std::uint32_t c : layout.corners_of(n)) angle += layout.angle[c];
    const std::size_t fan = layout.nodes_of(layout.node_point[n]).size();
    const bool runs_through = corner_quads[n] == 2 && fan <= 2;
    const double wanted = corner_quads[n] * right_angle - angle;
    if (runs_through || std::abs(wanted) < 1e-12) continue;
    gain[n] += wanted;
    // What the corner gains is taken from the points around, about where the sector is a quad wide.
    const double reach = quad_m * std::clamp(0.7 / angle, 0.7, 4.0);
    near.search(n, 3 * reach);
    const auto weight = [&](std::uint32_t other) {
      if (layout.node_kind[other] != NodeKind::inside) return 0.0;
      const double d = near.distance[other] / reach;
      return 1 / (1 + d * d * d * d * d * d);
    };
    double total = 0;
    bool is_open = false;
    for (const std::uint32_t other : near.reached) {
      total += weight(other);
      is_open |= layout.node_kind[other] == NodeKind::open;
    }
    if (!(total > 0)) {
      if (is_open) continue;
      return Failure{FailureCode::geometry_failed,
                     "the compartment at " + name_point(mesh, layout.node_point[n]) + " beside " +
                         name_feature(mesh, layout, layout.corners_of(n)[0]) +
                         " needs a singular point but has no point inside",
                     "refine the triangles there (separate_features does)"};
    }
    for (const std::uint32_t other : near.reached) gain[other] -= wanted * weight(other) / total;
  }

  // Least squares of the changes x of corners with Σ x = 0 per triangle and Σ x = gain per node: x = μ_node − mean of
  // μ.
  PatternBuilder builder(nodes);
  const auto count = static_cast<std::uint32_t>(layout.triangle_count());
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::uint32_t k = 0; k < 3; ++k) builder.add(layout.node_of[3 * t + k], layout.node_of[3 * t + (k + 1) % 3]);
  std::vector<std::uint32_t> starts, rows, slots;
  builder.finish(starts, rows, slots);
  std::vector<double> values(rows.size(), 0.0), diagonal(nodes, 1e-9);
  for (std::uint32_t h = 0; h < 3 * count; ++h) {
    const std::uint32_t a = layout.node_of[h], b = layout.node_of[next_half_edge(h)];
    diagonal[a] += 2.0 / 3;
    // An open node asks for nothing: its multiplier is 0.
    if (a != b && layout.node_kind[a] != NodeKind::open && layout.node_kind[b] != NodeKind::open)
      values[slots[h]] -= 1.0 / 3;
    else if (a == b)
      diagonal[a] -= 2.0 / 3;
  }
  for (std::uint32_t n = 0; n < nodes; ++n) {
    values[starts[n]] = diagonal[n];
    if (layout.node_kind[n] == NodeKind::open) gain[n] = 0;
  }
  auto system = CompartmentSystem<double>::analyse(starts, rows);
  if (!system) return system.failure();
  if (auto factorized = system->factorize(values); !factorized) return factorized.failure();
  const std::vector<double> potential = system->solve(gain);

  std::vector<double> angle = layout.angle;
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::array<double, 3> mu{potential[layout.node_of[3 * t]], potential[layout.node_of[3 * t + 1]],
                                   potential[layout.node_of[3 * t + 2]]};
    const double mean = (mu[0] + mu[1] + mu[2]) / 3;
    for (std::size_t k = 0; k < 3; ++k) angle[3 * t + k] += mu[k] - mean;
  }
  return angle;
}

}  // namespace strataflow
