#include "kernels/cutting/points_in_triangle.h"

#include <algorithm>

namespace strataflow {

void PointsInTriangle::restart(const Triangle& triangle) {
  points_.clear();
  exact_.clear();
  const Vec3 &a = (*input_)[triangle[0]], &b = (*input_)[triangle[1]], &c = (*input_)[triangle[2]];
  axis_ = projection_axis(a, b, c);
  is_mirrored_ = strataflow::orientation_2d(a, b, c, axis_) < 0;
  double largest = 0;
  for (const Vec3* p : {&a, &b, &c})
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs((*p)[axis]));
  half_ulp_ = 0x1.0p-53 * (largest_origin_ > 0 ? 2 * largest + largest_origin_ : largest) * (1 + 1e-10);
  origin_ = a;
  const Vec3 along = b - a, normal = cross(along, c - a);
  const double l = length(along), n = length(normal);
  s_axis_ = l > 0 ? (1 / l) * along : Vec3{1, 0, 0};
  t_axis_ = n > 0 ? cross((1 / n) * normal, s_axis_) : Vec3{0, 1, 0};
  for (int k = 0; k < 3; ++k) add(vertex_point(triangle[k]), (*input_)[triangle[k]], static_cast<PlaceInTriangle>(k));
}

std::uint32_t PointsInTriangle::add(const PointDefinition& definition, const Vec3& rounded, PlaceInTriangle place) {
  const int first = axis_ == 0 ? 1 : 0, second = axis_ == 2 ? 1 : 2;
  const Vec3 from_origin = rounded - origin_;
  Point point{rounded[first],
              rounded[second],
              dot(from_origin, s_axis_),
              dot(from_origin, t_axis_),
              rounded,
              definition,
              place,
              edges_at(place),
              definition.kind == PointDefinition::Kind::vertex};
  if (is_mirrored_) std::swap(point.u, point.v);
  points_.push_back(point);
  exact_.emplace_back();
  return count() - 1;
}

const ExactPosition& PointsInTriangle::exact(std::uint32_t i) const {
  if (!exact_[i]) exact_[i] = exact_position(*input_, points_[i].definition);
  return exact_[i];
}

int PointsInTriangle::exact_orientation(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
  if (i == j || j == k || k == i) return 0;
  const int turn = points_[i].is_vertex && points_[j].is_vertex && points_[k].is_vertex
                       ? strataflow::orientation_2d(points_[i].rounded, points_[j].rounded, points_[k].rounded, axis_)
                       : strataflow::orientation_2d(exact(i), exact(j), exact(k), axis_);
  return is_mirrored_ ? -turn : turn;
}

int PointsInTriangle::compare_along_axis(std::uint32_t i, std::uint32_t j, int axis) const {
  const double a = points_[i].rounded[axis], b = points_[j].rounded[axis];
  if (a != b) return a < b ? -1 : 1;  // rounding keeps order
  if (points_[i].is_vertex && points_[j].is_vertex) return 0;
  return compare_along(exact(i), exact(j), axis);
}

bool PointsInTriangle::precedes(std::uint32_t i, std::uint32_t j, std::uint32_t from, std::uint32_t to) const {
  const Vec3 d = points_[to].rounded - points_[from].rounded;
  int axis = std::abs(d.x) >= std::abs(d.y) ? (std::abs(d.x) >= std::abs(d.z) ? 0 : 2)
                                            : (std::abs(d.y) >= std::abs(d.z) ? 1 : 2);
  int direction = d[axis] > 0 ? 1 : -1;
  if (d[axis] == 0) {  // ends that round to one position: ask exactly
    for (axis = 0; axis < 2 && compare_along_axis(from, to, axis) == 0;) ++axis;
    direction = compare_along_axis(from, to, axis) < 0 ? 1 : -1;
  }
  return compare_along_axis(i, j, axis) * direction < 0;
}

bool PointsInTriangle::is_between(std::uint32_t k, std::uint32_t i, std::uint32_t j) const {
  return precedes(i, k, i, j) && precedes(k, j, i, j);
}

bool PointsInTriangle::is_surely_in_circle(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) const {
  const Point &a = points_[i], &b = points_[j], &c = points_[k], &d = points_[l];
  const double ax = a.s - d.s, ay = a.t - d.t, bx = b.s - d.s, by = b.t - d.t, cx = c.s - d.s, cy = c.t - d.t;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double determinant = aa * (bx * cy - by * cx) - bb * (ax * cy - ay * cx) + cc * (ax * by - ay * bx);
  const double permanent = aa * (std::abs(bx * cy) + std::abs(by * cx)) + bb * (std::abs(ax * cy) + std::abs(ay * cx)) +
                           cc * (std::abs(ax * by) + std::abs(ay * bx));
  return determinant > 1e-14 * permanent;
}

}  // namespace strataflow
