#pragma once
#include <array>

#include "model/vector3.h"

namespace strataflow {

/// Real spherical harmonics of band 2 (m = −2 … 2) and band 4 (m = −4 … 4) as homogeneous polynomials of x, y, z,
/// orthonormal on the sphere (coudert2024 S32).
std::array<double, 5> harmonics_2(const Vec3& u);
std::array<double, 9> harmonics_4(const Vec3& u);

/// Their gradients by x, y, z.
std::array<Vec3, 5> harmonics_2_gradient(const Vec3& u);
std::array<Vec3, 9> harmonics_4_gradient(const Vec3& u);

}  // namespace strataflow
