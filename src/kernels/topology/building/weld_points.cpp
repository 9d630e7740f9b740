#include "kernels/topology/building/weld_points.h"

#include <array>
#include <bit>

#include "base/id.h"
#include "base/seed.h"

namespace strataflow {

namespace {
std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }  // −0 + 0 = +0

std::uint64_t hash_of(const Vec3& p) { return mix64(bits_of(p.x) ^ mix64(bits_of(p.y) ^ mix64(bits_of(p.z)))); }
}  // namespace

WeldedPoints weld_points(const std::vector<Vec3>& points) {
  WeldedPoints welded;
  welded.id.resize(points.size());
  welded.source.reserve(points.size());
  struct Slot {
    std::uint32_t tag = 0;  ///< high bits of the hash: almost no point is looked at in vain
    std::uint32_t id = no_index;
  };
  const std::size_t slots = std::bit_ceil(points.size() * 2 + 1);
  std::vector<Slot> table(slots);  // open addressing: one array, no nodes
  // Slots are fetched some points ahead of their use; they lie anywhere in memory.
  constexpr std::size_t ahead = 16;
  std::array<std::uint64_t, ahead> hashes{};
  for (std::size_t i = 0; i < points.size() + ahead; ++i) {
    const std::uint64_t hash = hashes[i % ahead];
    if (i < points.size()) {
      hashes[i % ahead] = hash_of(points[i]);
      __builtin_prefetch(&table[hashes[i % ahead] & (slots - 1)]);
    }
    if (i < ahead) continue;
    const auto p = static_cast<std::uint32_t>(i - ahead);
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    std::size_t slot = hash & (slots - 1);
    while (table[slot].id != no_index &&
           !(table[slot].tag == tag && points[welded.source[table[slot].id]] == points[p]))
      slot = (slot + 1) & (slots - 1);
    if (table[slot].id == no_index) {
      table[slot] = {tag, static_cast<std::uint32_t>(welded.source.size())};
      welded.source.push_back(p);
    }
    welded.id[p] = table[slot].id;
  }
  return welded;
}

}  // namespace strataflow
