#include "kernels/complexity/principal_axes.h"

#include <algorithm>
#include <cmath>

namespace strataflow {

namespace {
void add(Symmetric3& sum, const Symmetric3& more) {
  for (std::size_t i = 0; i < 6; ++i) sum[i] += more[i];
}
}  // namespace

Symmetric3 outer_product(const Vec3& a, const Vec3& b, double factor) {
  const double half = 0.5 * factor;
  return {factor * a.x * b.x,
          factor * a.y * b.y,
          factor * a.z * b.z,
          half * (a.x * b.y + a.y * b.x),
          half * (a.x * b.z + a.z * b.x),
          half * (a.y * b.z + a.z * b.y)};
}

PrincipalAxes principal_axes(const Symmetric3& m) {
  double a[3][3] = {{m[0], m[3], m[4]}, {m[3], m[1], m[5]}, {m[4], m[5], m[2]}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double vp = v[k][p], vq = v[k][q];
          v[k][p] = c * vp - s * vq;
          v[k][q] = s * vp + c * vq;
        }
        a[p][q] = a[q][p] = 0;
      }
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return a[i][i] > a[j][j]; });
  PrincipalAxes result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.axes[k] = {v[0][order[k]], v[1][order[k]], v[2][order[k]]};
    result.values[k] = a[order[k]][order[k]];
  }
  return result;
}

void MassMoments::take_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double area = 0.5 * length(cross(b - a, c - a));
  const Vec3 sum = a + b + c;
  mass_ += area;
  first_ = first_ + (area / 3) * sum;
  for (const Vec3* p : {&a, &b, &c, &sum}) add(second_, outer_product(*p, *p, area / 12));
}

void MassMoments::take_segment(const Vec3& a, const Vec3& b) {
  const double along = length(b - a);
  const Vec3 sum = a + b;
  mass_ += along;
  first_ = first_ + (along / 2) * sum;
  for (const Vec3* p : {&a, &b, &sum}) add(second_, outer_product(*p, *p, along / 6));
}

PrincipalAxes MassMoments::axes() const {
  Symmetric3 about_centre = second_;
  const Vec3 mean = centre();
  add(about_centre, outer_product(mean, mean, -mass_));
  return principal_axes(about_centre);
}

}  // namespace strataflow
