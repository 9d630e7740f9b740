#include "kernels/cutting/cluster_points.h"

#include <numeric>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

PointClusters cluster_points(const std::vector<Vec3>& points, const std::vector<char>& is_fixed, double tolerance_m) {
  constexpr std::size_t grain = 4096;
  const auto count = static_cast<std::uint32_t>(points.size());
  PointClusters clusters;
  clusters.representative.resize(count);
  std::iota(clusters.representative.begin(), clusters.representative.end(), 0u);
  if (!(tolerance_m > 0) || count < 2) return clusters;
  const auto fixed = [&](std::uint32_t i) { return !is_fixed.empty() && is_fixed[i] != 0; };

  std::vector<FloatBox> boxes(count);
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Box3 box;
      box.take(points[i]);
      boxes[i] = enclosing(box);
    }
  });
  const BoundingVolumeTree tree(boxes);
  const double reach = tolerance_m * tolerance_m;
  const auto visit_neighbours = [&](std::uint32_t i, auto&& visit) {
    const Vec3 room{tolerance_m, tolerance_m, tolerance_m};
    Box3 box;
    box.take(points[i] - room);
    box.take(points[i] + room);
    tree.visit_items(enclosing(box), [&](std::uint32_t j) {
      if (j == i) return;
      const Vec3 d = points[j] - points[i];
      const double squared = dot(d, d);
      if (squared <= reach) visit(j, squared);
    });
  };
  // Few points have company; only they are looked at one after the other.
  const std::vector<char> has_company = parallel_map(
      count,
      [&](std::size_t i) {
        char found = 0;
        if (!fixed(static_cast<std::uint32_t>(i)))
          visit_neighbours(static_cast<std::uint32_t>(i), [&](std::uint32_t, double) { found = 1; });
        return found;
      },
      grain);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < count; ++i)
    if (has_company[i]) order.push_back(i);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return points[a] == points[b] ? a < b : lexicographically_less(points[a], points[b]);
  };
  sort_total_order(order, before);
  enum class State : char { undecided, stays, moved };
  std::vector<State> state(count, State::undecided);
  for (const std::uint32_t i : order) {
    std::uint32_t best = no_index;
    double best_squared = 0;
    bool best_is_fixed = false;
    visit_neighbours(i, [&](std::uint32_t j, double squared) {
      const bool j_fixed = fixed(j);
      if (!j_fixed && state[j] != State::stays) return;
      const bool is_better =
          best == no_index || (j_fixed && !best_is_fixed) ||
          (j_fixed == best_is_fixed && (squared < best_squared || (squared == best_squared && before(j, best))));
      if (!is_better) return;
      best = j;
      best_squared = squared;
      best_is_fixed = j_fixed;
    });
    if (best == no_index) {
      state[i] = State::stays;
      continue;
    }
    state[i] = State::moved;
    clusters.representative[i] = best;
    ++clusters.merged_count;
    clusters.largest_move_m = std::max(clusters.largest_move_m, std::sqrt(best_squared));
  }
  return clusters;
}

}  // namespace strataflow
