#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kernels/voronoi/cvt_energy.h"
#include "model/site_set.h"

namespace strataflow {

struct OptimiseSitesOptions {
  std::size_t lloyd_iterations = 5;   ///< steps to the centroids first: slow but never wrong
  std::size_t iterations = 100;       ///< quasi-Newton steps after them, at most
  /// Weight of the attraction of lines against the even spread, in [0, 1): absent, both pull alike at the start.
  std::optional<double> line_attraction = 0.0;
  std::function<bool()> is_cancelled = {};  ///< asked after every step: true stops where we are
};

struct OptimisedSites {
  std::vector<Vec3> sites;
  std::vector<CvtStep> lloyd_steps, newton_steps;
  double line_attraction = 0;       ///< α as used
  std::size_t evaluations = 0;      ///< of the restricted diagram
  std::size_t replanted_sites = 0;  ///< that had lost their cells
  std::string stopped_by;
  CvtTerms terms;                   ///< at the end
};

/// Moves sites to a centroidal Voronoi tessellation (pellerin2014 §2.4, 2.5): Lloyd steps,
/// then L-BFGS with variables scaled so that its first step is Lloyd's. Sites are not held on the surface. A site
/// whose cell is empty is replanted where the energy is largest. `fixed` (empty, or per site) holds sites in place.
OptimisedSites optimise_sites(SiteEnergy& energy, std::vector<Vec3> sites, const std::vector<char>& fixed,
                              const OptimiseSitesOptions& options = {});

/// The same, of the energy of this domain.
OptimisedSites optimise_sites(const CvtDomain& domain, std::vector<Vec3> sites, const std::vector<char>& fixed,
                              const OptimiseSitesOptions& options = {});

}  // namespace strataflow
