#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/hexes/stratigraphic_function.h"

namespace strataflow {

/// Where W falls upwards in some tetrahedron of the model, finds it anew: the least Σ |t| ‖∇W‖² with W rising upwards in
/// the plan by at least a twentieth of its slope everywhere it can (R9). The condition is linear in W, so the problem
/// is convex; tetrahedra all of whose corners are on levels are left as they are. Keeps the best W met in at most `rounds`
/// solves of the method of multipliers. `plan` holds (u, v) per point. Returns the solves done. Fails where a
/// factorisation fails.
Result<std::size_t> steepen_layers(const LabelledTets& tets, const StratigraphicLevels& levels,
                                   const std::vector<Vec3>& plan, StratigraphicTets& layers, std::size_t rounds = 40);

}  // namespace strataflow
