#include "kernels/remeshing/guarded/space_blocks.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace strataflow {

namespace {

/// So many boxes at most are looked at to choose a plane.
constexpr std::size_t most_looked_at = 1024;

struct Plane {
  std::size_t axis = 0;
  float at = 0;
};

/// Of one plane across each axis the one that cuts the fewest boxes.
std::optional<Plane> best_plane(const std::vector<FloatBox>& boxes, const std::vector<std::uint32_t>& indices,
                                double share) {
  const std::size_t stride = indices.size() / most_looked_at + 1, count = indices.size() / stride;
  std::vector<float> middles(count);
  std::optional<Plane> best;
  std::size_t fewest = count / 4;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < count; ++k) {
      const FloatBox& box = boxes[indices[k * stride]];
      middles[k] = 0.5f * (box.low[axis] + box.high[axis]);
    }
    const auto cut = middles.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(count));
    std::nth_element(middles.begin(), cut, middles.end());
    std::size_t met = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const FloatBox& box = boxes[indices[k * stride]];
      met += box.low[axis] <= *cut && *cut <= box.high[axis];
    }
    if (met < fewest) {
      fewest = met;
      best = Plane{axis, *cut};
    }
  }
  return best;
}

bool is_inside(const FloatBox& box, const FloatBox& block) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(box.low[axis] > block.low[axis] && box.high[axis] < block.high[axis])) return false;
  return true;
}

void cut(const std::vector<FloatBox>& boxes, std::vector<std::uint32_t> indices, const FloatBox& block,
         std::size_t most, double share, std::vector<SpaceBlock>& blocks) {
  const std::optional<Plane> plane = indices.size() > most ? best_plane(boxes, indices, share) : std::nullopt;
  if (!plane) {
    SpaceBlock& made = blocks.emplace_back(SpaceBlock{block, {}, {}});
    for (const std::uint32_t i : indices) (is_inside(boxes[i], block) ? made.inside : made.across).push_back(i);
    return;
  }
  std::vector<std::uint32_t> below, above;
  for (const std::uint32_t i : indices) {
    if (boxes[i].low[plane->axis] <= plane->at) below.push_back(i);
    if (boxes[i].high[plane->axis] >= plane->at) above.push_back(i);
  }
  indices = {};
  FloatBox lower = block, upper = block;
  lower.high[plane->axis] = upper.low[plane->axis] = plane->at;
  cut(boxes, std::move(below), lower, most, share, blocks);
  cut(boxes, std::move(above), upper, most, share, blocks);
}

}  // namespace

std::vector<SpaceBlock> cut_space(const std::vector<FloatBox>& boxes, std::vector<std::uint32_t> chosen,
                                  std::size_t most, double share) {
  constexpr float far = std::numeric_limits<float>::infinity();
  std::vector<SpaceBlock> blocks;
  cut(boxes, std::move(chosen), {{-far, -far, -far}, {far, far, far}}, most, share, blocks);
  return blocks;
}

}  // namespace strataflow
