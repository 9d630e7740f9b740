#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace strataflow {

/// Finds points by the numbers a file gives them, which may leave gaps and come in any order.
class TaggedPoints {
 public:
  void add(std::int64_t tag) { tags_.emplace_back(tag, static_cast<std::uint32_t>(tags_.size())); }
  /// To be called after the last `add`; false when a number comes twice.
  bool finish() {
    std::sort(tags_.begin(), tags_.end());
    for (std::size_t i = 1; i < tags_.size(); ++i)
      if (tags_[i].first == tags_[i - 1].first) return false;
    return true;
  }
  /// The index of the point, in the order of the calls of `add`.
  std::optional<std::uint32_t> index(std::int64_t tag) const {
    if (tags_.empty() || tag < tags_.front().first || tag > tags_.back().first) return std::nullopt;
    const std::uint64_t guess = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(tags_.front().first);
    if (guess < tags_.size() && tags_[guess].first == tag) return tags_[guess].second;  // no gaps before it
    const auto place = std::lower_bound(tags_.begin(), tags_.end(), std::pair(tag, std::uint32_t{0}));
    if (place == tags_.end() || place->first != tag) return std::nullopt;
    return place->second;
  }

 private:
  std::vector<std::pair<std::int64_t, std::uint32_t>> tags_;
};

}  // namespace strataflow
