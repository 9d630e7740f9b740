#include "kernels/intersection/find_intersections.h"

#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

namespace {

constexpr std::size_t triangle_grain = 16384;
/// Leaves whose pairs one task looks for. They are neighbours along the curve, so one descent serves them all.
constexpr std::uint32_t leaves_per_block = 8;
constexpr std::size_t blocks_per_task = 32;

FloatBox box_of_leaves(const BoundingVolumeTree& tree, std::uint32_t begin, std::uint32_t end) {
  FloatBox box = tree.leaf_boxes()[begin];
  for (std::uint32_t leaf = begin + 1; leaf < end; ++leaf)
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], tree.leaf_boxes()[leaf].low[axis]);
      box.high[axis] = std::max(box.high[axis], tree.leaf_boxes()[leaf].high[axis]);
    }
  return box;
}

}  // namespace

bool is_degenerate(const std::vector<Vec3>& points, const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || projection_axis(points[t[0]], points[t[1]], points[t[2]]) < 0;
}

std::vector<IntersectingPair> find_intersections(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  const std::vector<char> degenerate = parallel_map(
      triangles.size(), [&](std::size_t t) { return static_cast<char>(is_degenerate(points, triangles[t])); },
      triangle_grain);
  std::vector<FloatBox> boxes(triangles.size());
  parallel_ranges(triangles.size(), triangle_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      Box3 box;
      for (const std::uint32_t v : triangles[t]) box.take(points[v]);
      boxes[t] = enclosing(box);
    }
  });
  const BoundingVolumeTree tree(boxes);
  boxes = {};

  // Triangles in the order of the curve: what one task reads lies together.
  const std::uint32_t count = tree.item_count();
  std::vector<Triangle> sorted(count);
  parallel_ranges(count, triangle_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) {
      const std::uint32_t t = tree.item_at(static_cast<std::uint32_t>(place));
      sorted[place] = triangles[t];
    }
  });

  const auto leaf_count = static_cast<std::uint32_t>(count == 0 ? 0 : tree.leaf_boxes().size());
  const std::size_t block_count = (leaf_count + leaves_per_block - 1) / leaves_per_block;
  const std::size_t task_count = (block_count + blocks_per_task - 1) / blocks_per_task;
  const auto found = parallel_map(task_count, [&](std::size_t task) {
    std::vector<IntersectingPair> pairs;
    std::vector<std::uint32_t> near;
    for (std::size_t block = task * blocks_per_task; block < std::min(block_count, (task + 1) * blocks_per_task); ++block) {
      const auto first_leaf = static_cast<std::uint32_t>(block * leaves_per_block);
      const std::uint32_t end_leaf = std::min(leaf_count, first_leaf + leaves_per_block);
      const std::uint32_t begin = first_leaf * BoundingVolumeTree::leaf_size;
      const std::uint32_t end = std::min(count, end_leaf * BoundingVolumeTree::leaf_size);
      const FloatBox block_box = box_of_leaves(tree, first_leaf, end_leaf);
      // Each pair is looked for once, from the block that holds its earlier place.
      near.clear();
      tree.visit_leaves(block_box, first_leaf, [&](std::uint32_t leaf) {
        const std::uint32_t last = std::min(count, (leaf + 1) * BoundingVolumeTree::leaf_size);
        for (std::uint32_t place = leaf * BoundingVolumeTree::leaf_size; place < last; ++place)
          if (overlap(tree.box_at(place), block_box)) near.push_back(place);
      });
      for (std::uint32_t place = begin; place < end; ++place) {
        const std::uint32_t t = tree.item_at(place);
        if (degenerate[t]) continue;
        const FloatBox box = tree.box_at(place);
        for (const std::uint32_t other : near) {
          if (other <= place || !overlap(tree.box_at(other), box)) continue;
          const std::uint32_t u = tree.item_at(other);
          if (degenerate[u]) continue;
          const PairMeeting meeting = meeting_of(points, sorted[place], sorted[other]);
          if (meeting != PairMeeting::proper) pairs.push_back({std::min(t, u), std::max(t, u), meeting});
        }
      }
    }
    return pairs;
  });
  std::vector<IntersectingPair> all;
  for (const auto& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
  sort_total_order(all, [](const IntersectingPair& a, const IntersectingPair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return all;
}

}  // namespace strataflow
