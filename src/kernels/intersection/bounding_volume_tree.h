#pragma once
#include <array>
#include <cstdint>
#include <algorithm>
#include <vector>

#include "model/box3.h"

namespace strataflow {

/// An axis-aligned box in single precision, rounded outward: half the memory traffic, never too small.
struct FloatBox {
  std::array<float, 3> low{};
  std::array<float, 3> high{};
};

inline bool overlap(const FloatBox& a, const FloatBox& b) {
  return (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]) & (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]) &
         (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
}

FloatBox enclosing(const Box3& box);

/// A complete binary tree of boxes over items sorted along a space-filling curve. Leaves hold `leaf_size`
/// consecutive items; level l has ceil(leaves / 2^l) nodes, node n covers nodes 2n and 2n + 1 of the level below.
/// About 36 bytes an item. Building and queries run in parallel and do not depend on the schedule.
class BoundingVolumeTree {
 public:
  static constexpr std::uint32_t leaf_size = 4;

  BoundingVolumeTree() = default;
  explicit BoundingVolumeTree(const std::vector<FloatBox>& item_boxes);

  std::uint32_t item_count() const { return static_cast<std::uint32_t>(items_.size()); }
  /// Item at a place along the curve, and its box.
  std::uint32_t item_at(std::uint32_t place) const { return items_[place]; }
  const FloatBox& box_at(std::uint32_t place) const { return boxes_[place]; }
  const std::vector<FloatBox>& leaf_boxes() const { return levels_.front(); }

  /// Calls visit(leaf) for every leaf ≥ first_leaf whose box overlaps `box`, in ascending order.
  template <class Visit>
  void visit_leaves(const FloatBox& box, std::uint32_t first_leaf, Visit&& visit) const {
    if (levels_.empty()) return;
    struct Entry {
      std::uint32_t level, node;
    };
    std::array<Entry, 72> stack;
    std::size_t depth = 0;
    stack[depth++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
    while (depth > 0) {
      const auto [level, node] = stack[--depth];
      if (((node + std::uint64_t{1}) << level) <= first_leaf || !overlap(levels_[level][node], box)) continue;
      if (level == 0) {
        visit(node);
        continue;
      }
      const std::uint32_t left = 2 * node;
      if (left + 1 < levels_[level - 1].size()) stack[depth++] = {level - 1, left + 1};
      stack[depth++] = {level - 1, left};
    }
  }

  /// Calls visit(item) for every item whose box overlaps `box`, in the order of the curve.
  template <class Visit>
  void visit_items(const FloatBox& box, Visit&& visit) const {
    visit_leaves(box, 0, [&](std::uint32_t leaf) {
      const std::uint32_t end = std::min(item_count(), (leaf + 1) * leaf_size);
      for (std::uint32_t place = leaf * leaf_size; place < end; ++place)
        if (overlap(boxes_[place], box)) visit(items_[place]);
    });
  }

 private:
  std::vector<std::uint32_t> items_;
  std::vector<FloatBox> boxes_;
  std::vector<std::vector<FloatBox>> levels_;  ///< [0] leaves … back() the root
};

}  // namespace strataflow
