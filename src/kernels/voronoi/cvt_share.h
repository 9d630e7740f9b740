#pragma once
#include <cstdint>
#include <vector>

#include "kernels/voronoi/cvt_energy.h"

namespace strataflow {

/// What a part of the domain adds to one site. The moment is taken relative to the site: no digits are lost far away.
struct CvtShare {
  std::uint32_t site = 0;
  double mass = 0, energy = 0;
  Vec3 moment;
};

/// The terms of the quantization energy from the shares of all parts, in order; those of lines are cleared.
void sum_shares(const std::vector<std::vector<CvtShare>>& parts, const std::vector<Vec3>& sites, CvtTerms& terms);

}  // namespace strataflow
