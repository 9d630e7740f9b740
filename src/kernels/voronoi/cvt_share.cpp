#include "kernels/voronoi/cvt_share.h"

namespace strataflow {

void sum_shares(const std::vector<std::vector<CvtShare>>& parts, const std::vector<Vec3>& sites, CvtTerms& terms) {
  terms.quantization = 0;
  terms.attraction = 0;
  terms.energy.assign(sites.size(), 0);
  terms.mass.assign(sites.size(), 0);
  terms.quantization_gradient.assign(sites.size(), Vec3{});
  terms.attraction_gradient.clear();
  terms.centroid = sites;
  for (const std::vector<CvtShare>& part : parts)
    for (const CvtShare& share : part) {
      terms.quantization += share.energy;
      terms.energy[share.site] += share.energy;
      terms.mass[share.site] += share.mass;
      terms.quantization_gradient[share.site] = terms.quantization_gradient[share.site] - 2 * share.moment;
    }
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (terms.mass[i] > 0) terms.centroid[i] = sites[i] - (0.5 / terms.mass[i]) * terms.quantization_gradient[i];
}

}  // namespace strataflow
