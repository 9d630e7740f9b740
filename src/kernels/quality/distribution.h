#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace strataflow {

/// How one measure is spread over a mesh: extremes, mean, and a histogram of equal bins over [low, high]. A value
/// outside is counted in the end bin, so the bins always add up to `count`. All zero while `count` is 0.
struct Distribution {
  std::string name;  ///< snake_case, with its unit suffix
  double low = 0;
  double high = 1;
  std::uint64_t count = 0;
  double minimum = 0;
  double maximum = 0;
  double sum = 0;
  std::vector<std::uint64_t> bins;

  Distribution() = default;
  Distribution(std::string measure, double lowest, double highest, std::size_t bin_count)
      : name(std::move(measure)), low(lowest), high(highest), bins(bin_count, 0) {}

  void add(double value);
  /// Adds all of `other`, which has the same bins.
  void add(const Distribution& other);
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }

  template <class A>
  void archive(A& a) {
    a(name, low, high, count, minimum, maximum, sum, bins);
  }
};

}  // namespace strataflow
