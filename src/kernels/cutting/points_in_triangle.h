#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/adapters/cgal/exact_position.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/cutting/pair_contact.h"

namespace strataflow {

/// The points of one triangle that is being cut, corners first, seen along the axis in which the triangle is largest.
/// Decisions use rounded positions while half a unit in the last place cannot change them, rational ones otherwise.
class PointsInTriangle {
 public:
  /// `input` are the points definitions refer to.
  /// Positions were rounded where `origin` was added to them.
  explicit PointsInTriangle(const std::vector<Vec3>& input, const Vec3& origin = {})
      : input_(&input), largest_origin_(std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)})) {}

  /// Starts over with a triangle of non-zero area. Its corners become points 0, 1, 2.
  void restart(const Triangle& triangle);
  /// Adds a point of the triangle; `rounded` is its rounded position.
  std::uint32_t add(const PointDefinition& definition, const Vec3& rounded, PlaceInTriangle place);

  std::uint32_t count() const { return static_cast<std::uint32_t>(points_.size()); }
  PlaceInTriangle place(std::uint32_t i) const { return points_[i].place; }
  const Vec3& rounded(std::uint32_t i) const { return points_[i].rounded; }
  /// Position in the plane of sight: counter-clockwise triangles of the model are counter-clockwise here.
  double u(std::uint32_t i) const { return points_[i].u; }
  double v(std::uint32_t i) const { return points_[i].v; }

  /// Exact: +1 when i, j, k turn as the triangle's corners do.
  int orientation(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    const Point &a = points_[i], &b = points_[j], &c = points_[k];
    if ((a.edges & b.edges & c.edges) != 0) return 0;
    const double left = (a.u - c.u) * (b.v - c.v), right = (a.v - c.v) * (b.u - c.u);
    const double determinant = left - right;
    constexpr double unit = 0x1.0p-53;
    // Shewchuk's bound for exact input plus what moving every coordinate by `half_ulp_` can do.
    double bound = (4 * unit) * (std::abs(left) + std::abs(right)) + 1e-290;
    if (!(a.is_vertex && b.is_vertex && c.is_vertex))
      bound +=
          2.1 * half_ulp_ * (std::abs(a.u - c.u) + std::abs(b.v - c.v) + std::abs(a.v - c.v) + std::abs(b.u - c.u)) +
          9 * half_ulp_ * half_ulp_;
    if (determinant > bound) return 1;
    if (determinant < -bound) return -1;
    return exact_orientation(i, j, k);
  }

  /// Exact order of two points of one line, along that line from `from` towards `to`: is i before j?
  bool precedes(std::uint32_t i, std::uint32_t j, std::uint32_t from, std::uint32_t to) const;

  /// Exact: k, known to be on the line i j, lies strictly between i and j.
  bool is_between(std::uint32_t k, std::uint32_t i, std::uint32_t j) const;

  /// Surely inside the circle through i, j, k (counter-clockwise), judged by rounded positions in the triangle's own
  /// plane; false when rounding could decide. Truthful, so flipping by it ends.
  bool is_surely_in_circle(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) const;

  int axis() const { return axis_; }
  /// How far a rounded coordinate may be from the true one.
  double roundoff() const { return half_ulp_; }

 private:
  struct Point {
    double u, v;  ///< along the plane of sight
    double s, t;  ///< along the triangle's own plane, metres
    Vec3 rounded;
    PointDefinition definition;
    PlaceInTriangle place;
    std::uint8_t edges;  ///< bits of the edges it lies on
    bool is_vertex;
  };

  int exact_orientation(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  const ExactPosition& exact(std::uint32_t i) const;
  int compare_along_axis(std::uint32_t i, std::uint32_t j, int axis) const;

  const std::vector<Vec3>* input_;
  std::vector<Point> points_;
  mutable std::vector<ExactPosition> exact_;
  int axis_ = 2;
  bool is_mirrored_ = false;
  double largest_origin_ = 0;
  double half_ulp_ = 0;
  Vec3 origin_, s_axis_, t_axis_;
};

}  // namespace strataflow
