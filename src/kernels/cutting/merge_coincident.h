#pragma once
#include <cstdint>
#include <vector>

#include "kernels/cutting/repair_rounding.h"
#include "model/cut_result.h"

namespace strataflow {

/// Of identical triangles the youngest entity's own (its first) stays, and those of several entities go to a patch that
/// stands for all of them: one new patch per set of patches, its entity the youngest. `mesh`: its `origin` points into
/// the triangles of `input`; `out`: gets the patches. Returns the patch of each triangle left. Adds what coincides to
/// `changes`
/// (`coincident_patches`).
std::vector<std::uint32_t> merge_coincident(CutMesh& mesh, const TriangleSoup& input, TriangleSoup& out,
                                            std::vector<Change>& changes);

}  // namespace strataflow
