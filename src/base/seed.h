#pragma once
#include <cstdint>
#include <string_view>

namespace strataflow {

/// One step of a 64-bit mixing function (the finaliser of SplitMix64): a bijection with good avalanche.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The seed of one node of one job: same job seed and node name, same stream, on any machine and schedule.
constexpr std::uint64_t seed_for(std::uint64_t job_seed, std::string_view node_name) {
  std::uint64_t seed = mix64(job_seed);
  for (const char c : node_name) seed = mix64(seed ^ static_cast<unsigned char>(c));
  return seed;
}

/// A small random stream whose n-th value depends on the seed and n only.
class RandomStream {
 public:
  explicit constexpr RandomStream(std::uint64_t seed) : state_(seed) {}
  constexpr std::uint64_t next() { return mix64(state_++); }
  /// Uniform in [0, 1), 53 bits.
  constexpr double unit() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// Uniform in [0, bound), bound > 0.
  constexpr std::uint64_t below(std::uint64_t bound) { return next() % bound; }

 private:
  std::uint64_t state_;
};

}  // namespace strataflow
