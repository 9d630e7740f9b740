#pragma once
#include <vector>

#include "base/result.h"
#include "kernels/quads/map/map_energy.h"

namespace strataflow {

/// X of least squares given by their derivatives at X = 0. While triangles come out flipped, or nearly, their weight is
/// multiplied by about `growth` and the system solved again, up to `stiffenings` times (local stiffening, Bommes 2009);
/// the X with the fewest flipped triangles is returned. Fails with geometry_failed when the system is singular.
Result<std::vector<double>> fit_without_folds(const std::vector<LinearDerivatives>& at_zero, MapEnergy& energy,
                                              std::int64_t stiffenings = 30, double growth = 3);

/// X of the map whose gradients are nearest, in least squares, to the frame field scaled so that quads have unit
/// edges along its isolines (coudert2024 S5; Kälberer 2007), by fit_without_folds.
Result<std::vector<double>> integrate_field(const MapReduction& reduction, const FrameField& field, MapEnergy& energy,
                                            std::int64_t stiffenings = 30, double growth = 3);

}  // namespace strataflow
