#pragma once
#include <cstdint>
#include <vector>

#include "kernels/quality/distribution.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// The worst of four corners: the sine of its angle, negative where the quad turns over against `normal` (unit).
/// Every corner is measured in the quad's own mean plane.
struct QuadShape {
  double scaled_jacobian = 1;
  double distortion = 0;  ///< sum over corners of (1 − 2·area/(squared sides))²: 0 for a square
};
QuadShape quad_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal);
double smallest_scaled_jacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal);

/// How good quads are. Scaled Jacobians are per quad, angles per corner, lengths per edge.
struct QuadQuality {
  Distribution scaled_jacobian{"scaled_jacobian", -1, 1, 40};
  Distribution angle_deg{"angle_deg", 0, 180, 36};
  Distribution edge_length_m;
  std::uint64_t inverted = 0;                   ///< quads with a scaled Jacobian that is not positive
  std::uint64_t interior_irregular = 0;         ///< points inside with other than four quads
  std::vector<std::uint64_t> interior_valence;  ///< points inside, by number of quads
  std::vector<std::uint64_t> boundary_valence;  ///< points on the boundary, by number of quads
  std::uint32_t worst_quad = 0;

  template <class A>
  void archive(A& a) {
    a(scaled_jacobian, angle_deg, edge_length_m, inverted, interior_irregular, interior_valence, boundary_valence,
      worst_quad);
  }
};

/// In the plane (all z 0) up is the normal of all quads; on a surface each quad is measured against the mean normal of
/// itself and the quads around it, as far as no feature lies between.
QuadQuality measure_quads(const QuadMesh& mesh);

}  // namespace strataflow
