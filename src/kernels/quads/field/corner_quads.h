#pragma once
#include <cstdint>
#include <vector>

#include "kernels/quads/field/feature_layout.h"

namespace strataflow {

/// Per node: how many quads a quad mesh shall have there. In the sector between two features at least one; two where a
/// feature runs through without a corner. 0 where nothing is asked for: inside and on a free boundary.
///
/// A sector of angle θ with n quads costs n (θ/n − π/2)², the squared deviations of its corners from right angles.
/// Around a point inside, the numbers sum up to the quads that its total angle holds (4 in the plane) whenever its
/// features leave room for that: sines of an angle and of its complement are the same, so a crossing at 20° is as good
/// regular as with five or six quads, and costs no singularity (the numbers of Desobry 2021b's role in coudert2024
/// S11).
std::vector<std::uint8_t> choose_corner_quads(const FeatureMesh& mesh, const FeatureLayout& layout);

}  // namespace strataflow
