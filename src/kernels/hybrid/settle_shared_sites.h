#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/result.h"
#include "kernels/hybrid/shared_sites.h"
#include "kernels/voronoi/cvt_energy.h"
#include "kernels/voronoi/optimise_sites.h"
#include "model/structural_model.h"

namespace strataflow {

/// Keeps a site on a plane in the middle of the sheets that it stands for. No hold: normal is 0.
struct SheetHold {
  Vec3 middle, normal;
  static constexpr bool is_flat = true;
};

/// The energy of a restricted tessellation, and for each held site `stiffness` · mass · (distance from its plane)².
/// Alone, sites between two sheets farther apart than 0.8 edges run off to one or the other.
class HeldEnergy : public SiteEnergy {
 public:
  HeldEnergy(const CvtDomain& domain, std::vector<SheetHold> holds) : energy_(domain), holds_(std::move(holds)) {}

  void evaluate(const std::vector<Vec3>& sites, bool with_attraction, CvtTerms& terms) override;
  bool has_lines() const override { return energy_.has_lines(); }
  std::span<const Vec3> points() const override { return energy_.points(); }
  const SiteNeighbours& neighbours() const override { return energy_.neighbours(); }

 private:
  CvtEnergy energy_;
  std::vector<SheetHold> holds_;
  std::vector<double> held_mass_;  ///< of the first evaluation: the stiffness is no function of the sites
};

/// The holds of sites whose cells see two sheets and more of their stacks (per site, its surfaces, ascending), and none
/// for the others. Fails as find_cell_components.
Result<std::vector<SheetHold>> find_sheet_holds(const StructuralModel& model, const std::vector<Vec3>& sites,
                                                const std::vector<std::vector<std::uint32_t>>& stacks);

struct SettleOptions {
  std::size_t rounds = 4;  ///< of optimising with the holds of the round before
  OptimiseSitesOptions optimise{.lloyd_iterations = 4, .iterations = 25, .line_attraction = {}};
};

/// Optimises sites (pellerin2014 §2.4, 2.5) such that those common to several sheets stay in their middle; pinned ones
/// stay where they are.
Result<OptimisedSites> settle_shared_sites(const StructuralModel& model, const CvtDomain& domain,
                                           const SharedSites& shared, const SettleOptions& options = {});

}  // namespace strataflow
