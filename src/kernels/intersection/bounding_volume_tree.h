#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "graph/parallel/unset_vector.h"
#include "model/box3.h"

namespace strataflow {

/// An axis-aligned box in single precision, rounded outward: half the memory traffic, never too small.
struct FloatBox {
  std::array<float, 3> low, high;

  /// A box that overlaps no box.
  static constexpr FloatBox nothing() {
    constexpr float far = std::numeric_limits<float>::infinity();
    return {{far, far, far}, {-far, -far, -far}};
  }
};

inline bool overlap(const FloatBox& a, const FloatBox& b) {
  return (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]) & (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]) &
         (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
}

FloatBox joined(const FloatBox& a, const FloatBox& b);
FloatBox enclosing(const Box3& box);

/// Four boxes side by side, so that one box is compared with all of them at once. Missing ones overlap nothing.
struct FourBoxes {
  static constexpr std::uint32_t size = 4;
  std::array<std::array<float, size>, 3> low, high;

  FloatBox box(std::uint32_t k) const {
    return {{low[0][k], low[1][k], low[2][k]}, {high[0][k], high[1][k], high[2][k]}};
  }
  void set(std::uint32_t k, const FloatBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis][k] = box.low[axis];
      high[axis][k] = box.high[axis];
    }
  }
  /// Squared distances from a point, infinite for missing boxes.
  std::array<double, size> squared_distances(const Vec3& p) const {
    std::array<double, size> squared{};
    for (int axis = 0; axis < 3; ++axis)
      for (std::uint32_t k = 0; k < size; ++k) {
        const double away = std::max({low[axis][k] - p[axis], p[axis] - high[axis][k], 0.0});
        squared[k] += away * away;
      }
    return squared;
  }
  /// Bit k is set when item k overlaps `other`.
  std::uint32_t overlaps(const FloatBox& other) const {
    using Four = float __attribute__((vector_size(16)));
    using FourBits = std::int32_t __attribute__((vector_size(16)));
    FourBits hit{1, 2, 4, 8};
    for (int axis = 0; axis < 3; ++axis) {
      const Four least = std::bit_cast<Four>(low[axis]), most = std::bit_cast<Four>(high[axis]);
      hit &= (least <= other.high[axis]) & (most >= other.low[axis]);
    }
    return static_cast<std::uint32_t>(hit[0] | hit[1] | hit[2] | hit[3]);
  }
};

/// A complete tree of boxes, four to a node, over items sorted along a space-filling curve. Leaves hold `leaf_size`
/// consecutive items, nodes four consecutive leaves or nodes of the level below. About 36 bytes an item. Building and
/// queries run in parallel and do not depend on the schedule.
class BoundingVolumeTree {
 public:
  static constexpr std::uint32_t leaf_size = FourBoxes::size;

  BoundingVolumeTree() = default;
  explicit BoundingVolumeTree(std::span<const FloatBox> item_boxes);

  std::uint32_t item_count() const { return static_cast<std::uint32_t>(items_.size()); }
  /// Item at a place along the curve, and its box.
  std::uint32_t item_at(std::uint32_t place) const { return items_[place]; }
  FloatBox box_at(std::uint32_t place) const { return boxes_[place / leaf_size].box(place % leaf_size); }
  const FourBoxes& item_boxes(std::uint32_t leaf) const { return boxes_[leaf]; }
  std::uint32_t leaf_count() const { return static_cast<std::uint32_t>(boxes_.size()); }
  FloatBox leaf_box(std::uint32_t leaf) const { return levels_.front()[leaf / 4].box(leaf % 4); }

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
      std::uint32_t hits = levels_[level][node].overlaps(box);
      if (level == 0) {
        for (; hits != 0; hits &= hits - 1) {
          const std::uint32_t leaf = 4 * node + static_cast<std::uint32_t>(std::countr_zero(hits));
          if (leaf >= first_leaf) visit(leaf);
        }
        continue;
      }
      for (std::uint32_t k = 4; k-- > 0;)
        if ((hits >> k & 1) != 0 && ((4 * node + k + std::uint64_t{1}) << 2 * level) > first_leaf)
          stack[depth++] = {level - 1, 4 * node + k};
    }
  }

  /// Calls visit(item) for every item whose box overlaps `box`, in the order of the curve.
  template <class Visit>
  void visit_items(const FloatBox& box, Visit&& visit) const {
    visit_leaves(box, 0, [&](std::uint32_t leaf) {
      for (std::uint32_t hits = boxes_[leaf].overlaps(box); hits != 0; hits &= hits - 1)
        visit(items_[leaf * leaf_size + static_cast<std::uint32_t>(std::countr_zero(hits))]);
    });
  }

  /// Calls limit = visit(place) for every item whose box lies within √limit of p, nearest boxes first; `visit` returns
  /// the squared distance from which on nothing matters any more.
  template <class Visit>
  void visit_nearest(const Vec3& p, double limit, Visit&& visit) const {
    if (levels_.empty()) return;
    struct Entry {
      std::uint32_t level, node;  // level 0: a leaf's items
      double squared;
    };
    std::array<Entry, 72> stack;
    std::size_t depth = 0;
    stack[depth++] = {static_cast<std::uint32_t>(levels_.size()), 0, 0};
    while (depth > 0) {
      const auto [level, node, squared] = stack[--depth];
      if (squared > limit) continue;
      const FourBoxes& boxes = level == 0 ? boxes_[node] : levels_[level - 1][node];
      const std::array<double, 4> away = boxes.squared_distances(p);
      if (level == 0) {
        for (std::uint32_t k = 0; k < leaf_size; ++k)
          if (leaf_size * node + k < items_.size() && away[k] <= limit) limit = visit(leaf_size * node + k);
        continue;
      }
      std::array<std::uint32_t, 4> order{0, 1, 2, 3};
      std::sort(order.begin(), order.end(),
                [&](std::uint32_t a, std::uint32_t b) { return away[a] != away[b] ? away[a] > away[b] : a > b; });
      for (const std::uint32_t k : order)
        if (away[k] <= limit && away[k] < std::numeric_limits<double>::infinity())
          stack[depth++] = {level - 1, 4 * node + k, away[k]};
    }
  }

 private:
  UnsetVector<std::uint32_t> items_;
  UnsetVector<FourBoxes> boxes_;                ///< per leaf
  std::vector<UnsetVector<FourBoxes>> levels_;  ///< [0] boxes of leaves … back() the root alone
};

}  // namespace strataflow
