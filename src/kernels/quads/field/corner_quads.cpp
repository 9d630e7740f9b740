#include "kernels/quads/field/corner_quads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/id.h"

namespace strataflow {

namespace {

constexpr double right_angle = std::numbers::pi / 2;

/// What a sector may cost more for the point to be regular: at 35° a crossing is, at 30° it has six quads.
constexpr double most = 0.9;

double cost(double angle, int quads) {
  const double off = angle / quads - right_angle;
  return quads * off * off;
}

int best_quads(double angle) {
  int quads = 1;
  while (quads < 120 && cost(angle, quads + 1) < cost(angle, quads)) ++quads;
  return quads;
}

}  // namespace

std::vector<std::uint8_t> choose_corner_quads(const FeatureMesh& mesh, const FeatureLayout& layout) {
  std::vector<std::uint8_t> quads(layout.node_count(), 0);
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    const auto nodes = layout.nodes_of(p);
    if (nodes.empty()) continue;
    double total = 0;
    bool has_boundary = false, has_open = false;
    std::vector<double> angle(nodes.size(), 0.0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      has_open |= layout.node_kind[nodes[i]] == NodeKind::open;
      const auto corners = layout.corners_of(nodes[i]);
      for (const std::uint32_t c : corners) angle[i] += layout.angle[c];
      has_boundary |= layout.opposite[corners[0]] == no_index;
      total += angle[i];
    }
    if (layout.node_kind[nodes[0]] == NodeKind::inside) continue;
    // One curve that turns: two quads on each side unless it turns by more than 65°, whose sine is no worse than that
    // of one quad and three, and a curve that zigzags keeps its direction.
    const bool one_curve = !has_open && nodes.size() == (has_boundary ? 1 : 2);
    const double least_straight = (has_boundary ? 127.2 : 115.0) * std::numbers::pi / 180;
    int sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (layout.node_kind[nodes[i]] == NodeKind::open) continue;
      const bool straight = one_curve && angle[i] > least_straight && angle[i] < 4 * right_angle - least_straight;
      quads[nodes[i]] = static_cast<std::uint8_t>(straight ? 2 : best_quads(angle[i]));
      sum += quads[nodes[i]];
    }
    if (has_boundary || has_open) continue;
    const int wanted = std::max(static_cast<int>(nodes.size()), best_quads(total));
    while (sum != wanted) {
      const int step = sum < wanted ? 1 : -1;
      std::size_t best = nodes.size();
      double least = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const int now = quads[nodes[i]];
        if (now + step < 1 || now + step > 120) continue;
        const double change = cost(angle[i], now + step) - cost(angle[i], now);
        if (change > most && static_cast<int>(nodes.size()) <= wanted) continue;
        if (best == nodes.size() || change < least) {
          least = change;
          best = i;
        }
      }
      if (best == nodes.size()) break;
      quads[nodes[best]] = static_cast<std::uint8_t>(quads[nodes[best]] + step);
      sum += step;
    }
  }
  return quads;
}

}  // namespace strataflow
