#pragma once
#include <cstdint>
#include <vector>

#include "kernels/quads/quantization/flat_mesh.h"

namespace strataflow {

/// What of a half-edge's vector may not change.
inline constexpr std::uint8_t fixed_real = 1, fixed_imaginary = 2;

/// Whether steps in direction i^a may be added to a vector with these fixed parts.
constexpr bool may_change(std::uint8_t fixed, int a) { return !(fixed & (a % 2 == 0 ? fixed_real : fixed_imaginary)); }

/// Makes the vectors of every triangle sum to zero by moving whole steps along shortest paths between triangles, each
/// from a triangle and direction that lacks to one that has too much, or out through the boundary; the seams stay
/// exact (coudert2024 S42). A path from (t, a) to (t, −a) would count twice and serves only an amount of two or more.
/// Returns false, with `vectors` half changed, if what is fixed leaves no path.
bool close_vectors(const FlatMesh& mesh, const std::vector<std::uint8_t>& fixed, std::vector<GaussianInteger>& vectors);

}  // namespace strataflow
