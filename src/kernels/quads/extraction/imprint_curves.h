#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/extraction/extract_quads.h"

namespace strataflow {

/// Quads with curves laid into them.
struct ImprintedCurves {
  QuadMesh quads;
  std::vector<std::uint32_t> created;  ///< irregular points inside that are no singular points of the map; ascending
};

/// The quads of a map that `loose` edges of its mesh are not followed by (axis none; ascending like
/// FeatureMesh::edges, which they are not part of): those curves are laid across the quads, and every cell that comes
/// of it, crossed or not, is divided at the middles of its sides, so that all are quads and the curves chains of their
/// edges (coudert2024 S43, S3, T30). Corners of the mesh are vertices, on curves too; the cells are found exactly.
/// Where a curve crosses a side nearer than `snap` sides to its end, the end moves onto the curve, if no feature holds
/// it and no other curve takes it: with 0 nothing moves and cells become as narrow as they come.
/// Fails with geometry_failed where an open curve ends inside a quad or two curves want the same side.
Result<ImprintedCurves> imprint_curves(const FeatureMesh& mesh, const QuadsOnGrid& grid,
                                       const std::vector<FeatureEdge>& loose, double snap = 0.35);

}  // namespace strataflow
