#include "kernels/adapters/cgal/bisector_side.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>

#include "base/internal_error.h"

namespace strataflow {

namespace {
using Number = CGAL::Exact_rational;
using Row = std::array<Number, 4>;

Number squared_distance(const Vec3& a, const Vec3& b) {
  const Number x = Number(a.x) - Number(b.x), y = Number(a.y) - Number(b.y), z = Number(a.z) - Number(b.z);
  return x * x + y * y + z * z;
}

Row bisector_values(std::span<const Vec3> corners, const Vec3& owner, const Vec3& other) {
  Row row;
  for (std::size_t i = 0; i < corners.size(); ++i)
    row[i] = squared_distance(corners[i], other) - squared_distance(corners[i], owner);
  return row;
}

/// Determinant of the first n rows and columns, by the first row.
Number determinant(const std::array<Row, 4>& rows, std::size_t n) {
  if (n == 1) return rows[0][0];
  if (n == 2) return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
  Number sum = 0;
  for (std::size_t column = 0; column < n; ++column) {
    std::array<Row, 4> minor;
    for (std::size_t i = 1; i < n; ++i)
      for (std::size_t j = 0, k = 0; j < n; ++j)
        if (j != column) minor[i - 1][k++] = rows[i][j];
    const Number term = rows[0][column] * determinant(minor, n - 1);
    sum = column % 2 == 0 ? Number(sum + term) : Number(sum - term);
  }
  return sum;
}

Row ones() { return {1, 1, 1, 1}; }

int sign_of(const Number& value) { return CGAL::sign(value); }

}  // namespace

int bisector_orientation(std::span<const Vec3> corners, const Vec3& owner, std::span<const PerturbedSite> bisectors) {
  std::array<Row, 4> rows;
  for (std::size_t i = 0; i < bisectors.size(); ++i)
    rows[i] = bisector_values(corners, owner, bisectors[i].position);
  rows[bisectors.size()] = ones();
  return sign_of(determinant(rows, corners.size()));
}

int bisector_side(std::span<const Vec3> corners, const PerturbedSite& owner, std::span<const PerturbedSite> bisectors,
                  const PerturbedSite& other) {
  const std::size_t n = corners.size();
  STRATAFLOW_ASSERT(n >= 1 && n <= 4 && bisectors.size() + 1 == n, "a simplex of n corners takes n − 1 bisectors");
  std::array<Row, 4> rows;
  for (std::size_t i = 0; i + 1 < n; ++i) rows[i] = bisector_values(corners, owner.position, bisectors[i].position);
  rows[n - 1] = ones();
  const Number orientation = determinant(rows, n);
  STRATAFLOW_ASSERT(sign_of(orientation) != 0, "the bisectors do not meet in one point");
  rows[n - 1] = bisector_values(corners, owner.position, other.position);
  if (const int side = sign_of(determinant(rows, n))) return side * sign_of(orientation);

  // With w(i) the enlargement of site i's squared distances, every row has (w(other) − w(owner)) added to each value,
  // and the determinant is linear in the w: the largest of them with a coefficient decides.
  struct Coefficient {
    std::uint32_t id;
    Number value;
  };
  std::array<Coefficient, 5> coefficients;
  Number of_owner = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::array<Row, 4> replaced = rows;
    replaced[i] = ones();
    coefficients[i] = {i + 1 < n ? bisectors[i].id : other.id, determinant(replaced, n)};
    of_owner -= coefficients[i].value;
  }
  coefficients[n] = {owner.id, of_owner};
  std::sort(coefficients.begin(), coefficients.begin() + static_cast<std::ptrdiff_t>(n) + 1,
            [](const Coefficient& a, const Coefficient& b) { return a.id < b.id; });
  for (std::size_t i = 0; i <= n; ++i)
    if (const int side = sign_of(coefficients[i].value)) return side * sign_of(orientation);
  STRATAFLOW_ASSERT(false, "the coefficient of the other site is the orientation, which is not 0");
  return 0;
}

}  // namespace strataflow
