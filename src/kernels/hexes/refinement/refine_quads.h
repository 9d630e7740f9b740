#pragma once
#include <vector>

#include "model/quad_mesh.h"

namespace strataflow {

/// Cuts quads in three along both directions, and those around them so that all stay quads and conform (the templates
/// of Schneiders 1996): `is_fine` says per quad. Points keep their numbers and places; new ones lie on thirds of their
/// quad, those of edges on features on the same features. An edge is cut near each of its ends that belongs to a fine
/// quad. Points of `keeps` (per point) are no such ends: what lies around them stays as it is. Quads on strips are for
/// the caller to keep so (coudert2024 S20).
QuadMesh refine_quads(const QuadMesh& plan, const std::vector<char>& is_fine, const std::vector<char>& keeps);

}  // namespace strataflow
