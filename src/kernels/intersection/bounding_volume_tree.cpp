#include "kernels/intersection/bounding_volume_tree.h"

#include <cmath>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 16384;

float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  return nearest <= value ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

float rounded_up(double value) {
  const float nearest = static_cast<float>(value);
  return nearest >= value ? nearest : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

FloatBox joined(const FloatBox& a, const FloatBox& b) {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(a.low[axis], b.low[axis]);
    box.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return box;
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

struct Place {
  std::uint64_t code;
  std::uint32_t item;
};

}  // namespace

FloatBox enclosing(const Box3& box) {
  FloatBox out;
  for (int axis = 0; axis < 3; ++axis) {
    out.low[axis] = rounded_down(box.low[axis]);
    out.high[axis] = rounded_up(box.high[axis]);
  }
  return out;
}

BoundingVolumeTree::BoundingVolumeTree(const std::vector<FloatBox>& item_boxes) {
  const std::size_t count = item_boxes.size();
  if (count == 0) return;
  FloatBox all = item_boxes.front();
  for (const FloatBox& box : item_boxes) all = joined(all, box);
  // One scale for all axes keeps the curve's cells cubes, whatever the shape of the model.
  float extent = 0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, all.high[axis] - all.low[axis]);
  const float scale = extent > 0 ? 2097151.0f / extent : 0.0f;

  std::vector<Place> places(count);
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FloatBox& box = item_boxes[i];
      std::uint64_t code = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float middle = 0.5f * (box.low[axis] + box.high[axis]);
        code |= spread(static_cast<std::uint64_t>(std::max(0.0f, (middle - all.low[axis]) * scale))) << axis;
      }
      places[i] = {code, static_cast<std::uint32_t>(i)};
    }
  });
  sort_total_order(places, [](const Place& a, const Place& b) { return a.code != b.code ? a.code < b.code : a.item < b.item; });

  items_.resize(count);
  boxes_.resize(count);
  std::vector<FloatBox> leaves((count + leaf_size - 1) / leaf_size);
  parallel_ranges(leaves.size(), grain / leaf_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      const std::size_t last = std::min(count, (leaf + 1) * leaf_size);
      for (std::size_t place = leaf * leaf_size; place < last; ++place) {
        items_[place] = places[place].item;
        boxes_[place] = item_boxes[places[place].item];
        leaves[leaf] = place == leaf * leaf_size ? boxes_[place] : joined(leaves[leaf], boxes_[place]);
      }
    }
  });
  levels_.push_back(std::move(leaves));
  while (levels_.back().size() > 1) {
    const std::vector<FloatBox>& below = levels_.back();
    std::vector<FloatBox> level((below.size() + 1) / 2);
    parallel_ranges(level.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t node = begin; node < end; ++node)
        level[node] = 2 * node + 1 < below.size() ? joined(below[2 * node], below[2 * node + 1]) : below[2 * node];
    });
    levels_.push_back(std::move(level));
  }
}

}  // namespace strataflow
