#include "kernels/quality/distribution.h"

#include <algorithm>

namespace strataflow {

void Distribution::add(double value) {
  const double position = (value - low) / (high - low) * static_cast<double>(bins.size());
  std::size_t bin = 0;
  if (position >= static_cast<double>(bins.size()))  // NaN stays in the first bin: it is as bad as it gets
    bin = bins.size() - 1;
  else if (position > 0)
    bin = static_cast<std::size_t>(position);
  ++bins[bin];
  minimum = count == 0 ? value : std::min(minimum, value);
  maximum = count == 0 ? value : std::max(maximum, value);
  sum += value;
  ++count;
}

void Distribution::add(const Distribution& other) {
  if (other.count == 0) return;
  minimum = count == 0 ? other.minimum : std::min(minimum, other.minimum);
  maximum = count == 0 ? other.maximum : std::max(maximum, other.maximum);
  sum += other.sum;
  count += other.count;
  for (std::size_t bin = 0; bin < bins.size(); ++bin) bins[bin] += other.bins[bin];
}

}  // namespace strataflow
