#include "kernels/intersection/bounding_volume_tree.h"

#include <bit>
#include <limits>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 16384;

/// The next float towards −∞. std::nextafter is a call, and this runs six times an item.
float next_down(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return x == 0 ? -std::numeric_limits<float>::denorm_min() : std::bit_cast<float>(x > 0 ? bits - 1 : bits + 1);
}

float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  return nearest <= value ? nearest : next_down(nearest);
}

float rounded_up(double value) { return -rounded_down(-value); }

FloatBox whole(const FourBoxes& four) {
  return joined(joined(four.box(0), four.box(1)), joined(four.box(2), four.box(3)));
}

/// Spreads 21 bits so that two zero bits follow each.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

}  // namespace

FloatBox joined(const FloatBox& a, const FloatBox& b) {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(a.low[axis], b.low[axis]);
    box.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return box;
}

FloatBox enclosing(const Box3& box) {
  FloatBox out;
  for (int axis = 0; axis < 3; ++axis) {
    out.low[axis] = rounded_down(box.low[axis]);
    out.high[axis] = rounded_up(box.high[axis]);
  }
  return out;
}

BoundingVolumeTree::BoundingVolumeTree(std::span<const FloatBox> item_boxes) {
  const std::size_t count = item_boxes.size();
  if (count == 0) return;
  const FloatBox all = ordered_reduce(
      count, FloatBox::nothing(), [&](std::size_t i) { return item_boxes[i]; }, joined);
  // One scale for all axes keeps the curve's cells cubes, whatever the shape of the model.
  float extent = 0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, all.high[axis] - all.low[axis]);
  const float scale = extent > 0 ? 2097151.0f / extent : 0.0f;

  // Place on the curve and item in one number: as many leading bits of the place as the items leave free.
  const int item_bits = std::max(1, static_cast<int>(std::bit_width(count - 1)));
  UnsetVector<std::uint64_t> places(count);
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FloatBox& box = item_boxes[i];
      std::uint64_t code = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float middle = 0.5f * (box.low[axis] + box.high[axis]);
        code |= spread(static_cast<std::uint64_t>(std::max(0.0f, (middle - all.low[axis]) * scale))) << axis;
      }
      places[i] = code >> (item_bits - 1) << item_bits | i;
    }
  });
  sort_total_order(places, [](std::uint64_t a, std::uint64_t b) { return a < b; });

  items_.resize(count);
  boxes_.resize((count + leaf_size - 1) / leaf_size);
  parallel_ranges(boxes_.size(), grain / leaf_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf)
      for (std::uint32_t k = 0; k < leaf_size; ++k) {
        const std::size_t place = leaf * leaf_size + k;
        FloatBox box = FloatBox::nothing();
        if (place < count)
          box = item_boxes[items_[place] =
                               static_cast<std::uint32_t>(places[place] & ((std::uint64_t{1} << item_bits) - 1))];
        boxes_[leaf].set(k, box);
      }
  });
  do {
    const UnsetVector<FourBoxes>& below = levels_.empty() ? boxes_ : levels_.back();
    UnsetVector<FourBoxes> level((below.size() + 3) / 4);
    parallel_ranges(level.size(), grain / 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t node = begin; node < end; ++node)
        for (std::uint32_t k = 0; k < 4; ++k)
          level[node].set(k, 4 * node + k < below.size() ? whole(below[4 * node + k]) : FloatBox::nothing());
    });
    levels_.push_back(std::move(level));
  } while (levels_.back().size() > 1);
}

}  // namespace strataflow
