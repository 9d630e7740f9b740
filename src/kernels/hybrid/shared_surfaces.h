#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/hybrid/settle_shared_sites.h"
#include "kernels/hybrid/shared_sites.h"
#include "model/built_model.h"

namespace strataflow {

/// Name of the point property of remeshed surfaces that says which site a point belongs to.
inline constexpr const char* site_property = "site";

struct SharedSurfacesOptions {
  SettleOptions settle;
  std::vector<double> density = {};  ///< per point of the model, for the tessellation; empty: 1 everywhere
  std::int64_t rounds = 24;          ///< ≥ 0: of adding sites where the dual is not valid or does not keep all
  bool must_keep_all = true;         ///< a lost, merged, split or new element is a flaw
};

/// Surfaces whose triangles face each other across thin layers.
struct SharedSurfaces {
  BuiltModel built;
  TriangleSoup soup;  ///< what it was built from, with the property `site`
  std::uint64_t sites = 0, added_sites = 0;
  std::uint64_t ball_failures = 0;
  std::vector<std::string> changes;  ///< elements lost, merged, split or created
};

/// The dual of the components of the restricted cells of `shared`, with one point per surface component, corner and
/// line component (pellerin2014 §2.11.1, extended to lines, corners and dangling surfaces; §2.7.2–2.8). Nothing is
/// merged and no triangle is evened out by itself, so that sheets in the same cells get the same triangles. Where it is
/// not a valid, sealed model, or does not keep all, sites are added to the cells concerned and all settle again.
/// Fails with geometry_failed, naming the first flaw, when the rounds do not suffice, and with cancelled.
Result<SharedSurfaces> remesh_on_shared_sites(const StructuralModel& model, SharedSites shared,
                                              const SharedSurfacesOptions& options = {});

/// Per point of a model its site, from the property; no_index where it has none.
std::vector<std::uint32_t> sites_of_points(const StructuralModel& model);

}  // namespace strataflow
