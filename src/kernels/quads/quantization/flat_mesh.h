#pragma once
#include <complex>
#include <cstdint>
#include <vector>

#include "kernels/quads/integer_constraint.h"
#include "model/corner_map.h"

namespace strataflow {

__extension__ using WideInteger = __int128;

/// The axis of a half-edge after its chart was turned.
constexpr MapAxis turned(MapAxis axis, int turns) {
  if (axis == MapAxis::none || turns % 2 == 0) return axis;
  return axis == MapAxis::real ? MapAxis::imaginary : MapAxis::real;
}

/// Sign of cross(a, b), whatever their size.
constexpr int cross_sign(GaussianInteger a, GaussianInteger b) {
  const WideInteger c = WideInteger(a.re) * b.im - WideInteger(a.im) * b.re;
  return c > 0 ? 1 : c < 0 ? -1 : 0;
}

/// Which quarter of the plane z ≠ 0 points to, counter-clockwise from the positive real axis; each quarter holds the
/// axis that it starts with.
constexpr int quadrant(GaussianInteger z) {
  if (z.re > 0 && z.im >= 0) return 0;
  if (z.re <= 0 && z.im > 0) return 1;
  if (z.re < 0 && z.im <= 0) return 2;
  return 3;
}

/// Triangles laid out flat, each in a chart of its own, with edge vectors in whole steps: the exact form of a seamless
/// map (coudert2024 S34) and of its decimated mesh (S38). Half-edge h = 3·t + k. Exactly:
///   vector[a] + vector[b] + vector[c] = 0 on each triangle and vector[h] = −i^turns[h] · vector[opposite[h]].
/// Two triangles may share several edges, an edge may join a point to itself and a triangle may be its own neighbour.
struct FlatMesh {
  static constexpr std::uint32_t outside = 0xFFFFFFFFu;

  double step = 1;                      ///< length of one step, in units of the map (quads)
  std::vector<std::uint32_t> origin;    ///< per half-edge: point of the FeatureMesh
  std::vector<std::uint32_t> opposite;  ///< per half-edge: on the other side, or `outside`
  std::vector<GaussianInteger> vector;  ///< per half-edge: from origin to the next origin, in its triangle's chart
  std::vector<std::uint8_t> turns;      ///< per half-edge: i^turns maps directions of the opposite chart into ours
  std::vector<MapAxis> axis;            ///< per half-edge: what a feature asks for
  std::vector<std::uint32_t> curve;     ///< per half-edge: 0 none, 1 boundary without feature, 2… a set of features
  std::vector<std::vector<std::uint32_t>> curve_features;  ///< per number in `curve`: its features, ascending

  static constexpr std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static constexpr std::uint32_t before(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t half_edge_count() const { return static_cast<std::uint32_t>(origin.size()); }
  std::uint32_t end(std::uint32_t h) const { return origin[next(h)]; }
  /// The next half-edge out of the same point, counter-clockwise, or `outside`.
  std::uint32_t left_of(std::uint32_t h) const { return opposite[before(h)]; }
  /// The next one clockwise, or `outside`.
  std::uint32_t right_of(std::uint32_t h) const { return opposite[h] == outside ? outside : next(opposite[h]); }
  bool is_positive(std::uint32_t triangle) const {
    return cross_sign(vector[3 * triangle], vector[3 * triangle + 1]) > 0;
  }
  /// Quarters entered when turning counter-clockwise through the corner at h: 0, 1 or 2. Their sum around a point
  /// is the number of quads around it, exactly, if its cone angle is a whole number of quarters.
  int corner_quarters(std::uint32_t h) const { return (quadrant(-vector[before(h)]) - quadrant(vector[h])) & 3; }
};

/// A sparse linear form with Gaussian integer coefficients, ascending by variable, no zero coefficient.
struct LinearTerm {
  std::uint32_t variable = 0;
  GaussianInteger coefficient;
};
using LinearForm = std::vector<LinearTerm>;

/// i^turns_a · a + i^turns_b · b.
LinearForm combine(const LinearForm& a, int turns_a, const LinearForm& b, int turns_b);

}  // namespace strataflow
