#include "kernels/topology/weld_points.h"

#include <bit>

#include "base/seed.h"
#include "base/id.h"

namespace strataflow {

namespace {
std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }  // −0 + 0 = +0

std::uint64_t hash_of(const Vec3& p) { return mix64(bits_of(p.x) ^ mix64(bits_of(p.y) ^ mix64(bits_of(p.z)))); }
}  // namespace

WeldedPoints weld_points(const std::vector<Vec3>& points) {
  WeldedPoints welded;
  welded.id.resize(points.size());
  const std::size_t slots = std::bit_ceil(points.size() * 2 + 1);
  std::vector<std::uint32_t> table(slots, no_index);  // open addressing: one array, no nodes
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::size_t slot = hash_of(points[i]) & (slots - 1);
    while (table[slot] != no_index && !(points[welded.source[table[slot]]] == points[i])) slot = (slot + 1) & (slots - 1);
    if (table[slot] == no_index) {
      table[slot] = static_cast<std::uint32_t>(welded.source.size());
      welded.source.push_back(i);
    }
    welded.id[i] = table[slot];
  }
  return welded;
}

}  // namespace strataflow
