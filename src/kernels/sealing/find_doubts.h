#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/sealing/extend_borders.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Something in sealed surfaces that nobody can have meant.
struct Doubt {
  std::string text;    ///< what and where
  std::string remedy;  ///< the option that would mend it
};

/// What sealing may have left or made, where the surfaces conform vertex for vertex:
/// - juts: pieces of horizons and unconformities with one region on both sides, which end free beyond a contact that
///   their entity goes on behind; of a fault only past what its own named contacts say it ends on, as faults may die
///   inside a region;
/// - slivers: regions smaller than the cube of `distance_m` and on average thinner than 0.08 of it, beside a contact on
///   which one entity ends and another goes on. (What two crossing surfaces enclose is theirs. True regions at an
///   unconformity that grazes a horizon are this thin where they are larger; up to 0.05 they are merged unasked.)
/// Ordered by surface, then by region.
Result<std::vector<Doubt>> find_doubts(const TriangleSoup& soup, double distance_m,
                                       const std::vector<NamedContact>& contacts);

}  // namespace strataflow
