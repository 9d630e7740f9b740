#include "kernels/hexes/extrusion/bridged_levels.h"

#include <algorithm>
#include <cmath>

namespace strataflow {
namespace {

constexpr double same_w = 1e-9;  // of a layer

}  // namespace

BridgedLevels::BridgedLevels(PlumbLine line, const std::vector<std::uint32_t>& level_w)
    : line_(std::move(line)), leaps_(line_.dropped_leaps()) {
  if (!is_needed()) return;
  for (const std::uint32_t w : level_w) {
    const bool is_end = w == level_w.front() || w == level_w.back();
    const bool is_lost = std::any_of(leaps_.begin(), leaps_.end(), [&](const PlumbLeap& leap) {
      return leap.from_w + same_w < w && w < leap.to_w - same_w;
    });
    if (is_end || !is_lost) kept_.push_back({static_cast<double>(w), line_.at_level(w).z});
  }
  // Several faults on one line may leave horizons out of order: neither of two that descend can be trusted.
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    std::vector<char> goes(kept_.size(), 0);
    for (std::size_t i = 0; i + 1 < kept_.size(); ++i) {
      if (!(kept_[i].z > kept_[i + 1].z)) continue;
      goes[i] = i > 0;
      goes[i + 1] = i + 2 < kept_.size();
    }
    std::vector<Kept> left;
    for (std::size_t i = 0; i < kept_.size(); ++i)
      if (!goes[i]) left.push_back(kept_[i]);
    has_changed = left.size() < kept_.size();
    kept_ = std::move(left);
  }
  std::size_t level = 0;
  for (std::size_t i = 0; i + 1 < kept_.size(); ++i) {
    const bool is_cut = std::any_of(leaps_.begin(), leaps_.end(), [&](const PlumbLeap& leap) {
      const double low = std::min(leap.from_w, leap.to_w), high = std::max(leap.from_w, leap.to_w);
      return std::max(low, kept_[i].w) + same_w < std::min(high, kept_[i + 1].w);
    });
    const std::size_t first = level;
    while (level_w[level] < kept_[i + 1].w) ++level;
    is_bridged_.push_back(is_cut || level - first > 1);
  }
}

BridgedLevels::Place BridgedLevels::at(double w) const {
  const double own_z = line_.at_level(w).z;
  for (std::size_t i = 0; i + 1 < kept_.size(); ++i) {
    const Kept &low = kept_[i], &high = kept_[i + 1];
    if (!(low.w + same_w < w && w < high.w - same_w && is_bridged_[i])) continue;
    const double z = low.z + (w - low.w) / (high.w - low.w) * (high.z - low.z);
    return {z, true, std::abs(z - own_z)};
  }
  return {own_z, false, 0};
}

}  // namespace strataflow
