#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <vector>

namespace strataflow {

/// Numbers of quarter turns: i to the power of `turns`, exactly.
inline std::complex<double> turned(std::complex<double> z, int turns) {
  switch (turns & 3) {
    case 1: return {-z.imag(), z.real()};
    case 2: return {-z.real(), -z.imag()};
    case 3: return {z.imag(), -z.real()};
    default: return z;
  }
}

/// Which coordinate of a map is constant along a half-edge.
enum class MapAxis : std::uint8_t { none = 0, real = 1, imaginary = 2 };  ///< real: the half-edge runs along u, v is constant

/// Directions of a quad mesh on a FeatureMesh: per triangle two *gradient* directions, those of the two coordinates of
/// a map, as angles against the triangle's first half-edge (h = 3·t), counter-clockwise, radians; the second lies
/// between the first and the first + π. Across half-edge h the neighbour's directions, turned by `turns[h]` quarter
/// turns (first → second → −first → −second), are nearest to ours: turns[opposite] = −turns[h] mod 4
/// (coudert2024 S5, S30). r_h = i^turns[h] of formula (4.1) maps the opposite triangle's chart into ours.
struct FrameField {
  std::vector<std::array<double, 2>> angles;  ///< per triangle
  std::vector<std::uint8_t> turns;            ///< per half-edge, 0…3; 0 on the boundary
  std::vector<MapAxis> axes;                  ///< per half-edge: what a feature edge forces, none elsewhere
  std::vector<std::int8_t> valence;           ///< per point: of the quad mesh to be; 4 inside where regular. On the
                                              ///< boundary and at feature corners: quads around it
  double smallest_sine = 1;                   ///< of the angle between both directions, over all triangles
  template <class A>
  void archive(A& a) {
    a(angles, turns, axes, valence, smallest_sine);
  }
};

/// A map of a FeatureMesh into the plane, per corner: u + i·v of corner k of triangle t at 3·t + k, with
/// U[h] = r_h·U[succ(opp h)] + t_h (coudert2024 S34). Seamless: any t; grid-preserving: t and the values at singular
/// points are Gaussian integers, and so is the constant coordinate of every feature edge.
struct CornerMap {
  std::vector<std::array<double, 2>> uv;  ///< per corner
  std::vector<std::uint8_t> turns;        ///< per half-edge
  std::vector<MapAxis> axes;              ///< per half-edge
  std::vector<std::int8_t> valence;       ///< per point
  std::complex<double> at(std::uint32_t corner) const { return {uv[corner][0], uv[corner][1]}; }
  template <class A>
  void archive(A& a) {
    a(uv, turns, axes, valence);
  }
};

}  // namespace strataflow
