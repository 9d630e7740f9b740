#pragma once
#include <vector>

#include "base/result.h"
#include "kernels/quads/map/foldover_free.h"
#include "model/corner_map.h"

namespace strataflow {

/// The scalars of a map in the common charts of a reduction with the same turns, whatever translations lie between its
/// triangles. Fails with invalid_input where corners that the reduction joins do not agree.
Result<std::vector<double>> develop_map(const FeatureLayout& layout, const MapReduction& reduction,
                                        const CornerMap& map);

/// Carries a map without folds over to constraints that it does not meet yet, without folding a triangle on the way:
/// Newton steps of the energy of make_foldover_free, each as far towards the constraints as triangles stay positive
/// (infeasible start; what is off shrinks by one minus the step). So points keep what the map winds around them, which a
/// fresh start does not promise. `scalars` belong to the map, in the common charts. Returns X that meets the reduction;
/// fails with geometry_failed when `steps` do not reach it.
Result<std::vector<double>> carry_map(MapEnergy& energy, const MapReduction& reduction, std::vector<double> scalars,
                                      std::int64_t steps = 40, const FoldoverFreeOptions& options = {});

}  // namespace strataflow
