#include "kernels/cutting/suspected_repeats.h"

#include <algorithm>

#include "base/seed.h"

namespace strataflow {

namespace {

struct Trace {
  std::uint32_t lowest;
  std::uint64_t bit;  ///< one of 64, by the two other vertices
};

Trace trace_of(const Triangle& t) {
  const std::uint32_t lowest = std::min({t[0], t[1], t[2]}), highest = std::max({t[0], t[1], t[2]});
  const std::uint32_t middle = t[0] ^ t[1] ^ t[2] ^ lowest ^ highest;
  return {lowest, std::uint64_t{1} << (mix64(std::uint64_t{middle} << 32 | highest) & 63)};
}

}  // namespace

std::vector<std::uint32_t> suspected_repeats(std::size_t point_count, const std::vector<Triangle>& triangles,
                                             const std::vector<char>& is_left_out) {
  // Each vertex keeps the bits of the triangles it is the lowest of: two or three, so that few agree by chance.
  struct Seen {
    std::uint64_t once = 0, twice = 0;
  };
  std::vector<Seen> seen(point_count);
  const auto counts = [&](std::size_t t) { return is_left_out.empty() || !is_left_out[t]; };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!counts(t)) continue;
    const Trace trace = trace_of(triangles[t]);
    seen[trace.lowest].twice |= seen[trace.lowest].once & trace.bit;
    seen[trace.lowest].once |= trace.bit;
  }
  std::vector<std::uint32_t> suspects;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!counts(t)) continue;
    const Trace trace = trace_of(triangles[t]);
    if ((seen[trace.lowest].twice & trace.bit) != 0) suspects.push_back(static_cast<std::uint32_t>(t));
  }
  return suspects;
}

}  // namespace strataflow
