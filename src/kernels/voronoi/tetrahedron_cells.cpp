#include "kernels/voronoi/tetrahedron_cells.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "kernels/adapters/cgal/bisector_side.h"
#include "kernels/voronoi/clip_by_neighbours.h"

namespace strataflow {

namespace {
double determinant(double a, double b, double c, double d, double e, double f, double g, double h, double i) {
  return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
}

/// Sorts the first `count` of four.
template <class T, class Less>
void sort_few(std::array<T, 4>& values, std::size_t count, Less less) {
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t j = i; j > 0 && less(values[j], values[j - 1]); --j) std::swap(values[j], values[j - 1]);
}

/// The vector orthogonal to count − 1 rows of `count` values each, as cofactors; its sign is that of the rows' order.
void cofactors(std::size_t count, const std::array<const double*, 3>& rows, std::array<double, 4>& result) {
  if (count == 2) {
    result[0] = rows[0][1];
    result[1] = -rows[0][0];
  } else if (count == 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      result[i] = rows[0][j] * rows[1][k] - rows[0][k] * rows[1][j];
    }
  } else {
    const double *p = rows[0], *q = rows[1], *r = rows[2];
    result[0] = determinant(p[1], p[2], p[3], q[1], q[2], q[3], r[1], r[2], r[3]);
    result[1] = -determinant(p[0], p[2], p[3], q[0], q[2], q[3], r[0], r[2], r[3]);
    result[2] = determinant(p[0], p[1], p[3], q[0], q[1], q[3], r[0], r[1], r[3]);
    result[3] = -determinant(p[0], p[1], p[2], q[0], q[1], q[2], r[0], r[1], r[2]);
  }
}
}  // namespace

TetrahedronPiece TetrahedronCells::piece(std::size_t index) const {
  const Piece& p = pieces_[index];
  return {p.site,
          {points_.data() + p.first_point, p.point_count},
          {faces_.data() + p.first_face, p.face_count},
          {rings_.data() + p.first_ring, p.ring_count}};
}

void TetrahedronCells::cut(const std::array<Vec3, 4>& corners, std::uint32_t start) {
  corners_ = corners;
  pieces_.clear();
  points_.clear();
  faces_.clear();
  rings_.clear();
  queue_.assign(1, start);
  for (std::size_t next = 0; next < queue_.size(); ++next) cut_piece(queue_[next]);
}

void TetrahedronCells::cut_piece(std::uint32_t owner) {
  owner_ = owner;
  for (std::size_t i = 0; i < 4; ++i) owner_distance_[i] = squared_distance(corners_[i], neighbours_.sites()[owner]);
  bisectors_.clear();
  polyhedron_.clear();
  constexpr std::array<std::array<std::uint32_t, 3>, 4> planes{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  for (std::size_t i = 0; i < 4; ++i) polyhedron_.push_back(make_corner(planes[i]));
  if (clip_by_neighbours(
          neighbours_, owner, beyond_, [&] { return reach(); }, [&](std::uint32_t site) { return clip(site); },
          [&] { return polyhedron_.empty(); }, [&](std::uint32_t site) { return has_face_with(site); }))
    emit();
}

bool TetrahedronCells::clip(std::uint32_t site) {
  const Vec3& at = neighbours_.sites()[site];
  Bisector bisector{site, {}, 0, 0};
  bool is_off = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const double distance = squared_distance(corners_[i], at);
    bisector.value[i] = distance - owner_distance_[i];
    bisector.error = std::max(bisector.error, 8 * half_ulp * (distance + owner_distance_[i]));
    bisector.largest = std::max(bisector.largest, std::abs(bisector.value[i]));
  }
  for (const double value : bisector.value) is_off = is_off && value > bisector.error;
  if (is_off) return false;
  keep_.resize(polyhedron_.size());
  bool keeps_all = true;
  for (std::size_t i = 0; i < polyhedron_.size(); ++i) {
    keep_[i] = is_nearer_to_owner(polyhedron_[i], bisector) ? 1 : 0;
    keeps_all = keeps_all && keep_[i] != 0;
  }
  if (keeps_all) return false;
  bisectors_.push_back(bisector);
  const auto cut = static_cast<std::uint32_t>(3 + bisectors_.size());
  kept_pairs_.clear();
  removed_pairs_.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < polyhedron_.size(); ++i) {
    const std::array<std::uint32_t, 3> planes = polyhedron_[i].planes;
    auto& pairs = keep_[i] ? kept_pairs_ : removed_pairs_;
    for (std::size_t k = 0; k < 3; ++k) pairs.push_back({planes[k], planes[(k + 1) % 3]});
    if (keep_[i]) polyhedron_[kept++] = polyhedron_[i];
  }
  polyhedron_.resize(kept);
  for (const auto& [a, b] : removed_pairs_)  // edges from a removed corner to a kept one
    if (std::find(kept_pairs_.begin(), kept_pairs_.end(), std::array{b, a}) != kept_pairs_.end())
      polyhedron_.push_back(make_corner({a, b, cut}));
  return true;
}

TetrahedronCells::Corner TetrahedronCells::make_corner(const std::array<std::uint32_t, 3>& planes) const {
  Corner corner{planes, {0, 0, 0, 0}, 0, 0};
  std::array<bool, 4> is_free{true, true, true, true};
  std::array<const Bisector*, 3> bisectors{};
  std::size_t bisector_count = 0;
  for (const std::uint32_t plane : planes) {
    if (plane < 4)
      is_free[plane] = false;
    else
      bisectors[bisector_count++] = &bisectors_[plane - 4];
  }
  std::array<std::size_t, 4> free_corners{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (is_free[i]) free_corners[count++] = i;
  if (count == 1) {
    corner.weight[free_corners[0]] = 1;
    corner.largest = 1;
    return corner;
  }
  std::array<std::array<double, 4>, 3> values{};
  std::array<const double*, 3> rows{};
  double product = 1, relative = 0;  // of the rows' largest values, and the sum of their relative errors
  for (std::size_t i = 0; i < bisector_count; ++i) {
    for (std::size_t j = 0; j < count; ++j) values[i][j] = bisectors[i]->value[free_corners[j]];
    rows[i] = values[i].data();
    product *= bisectors[i]->largest;
    relative += bisectors[i]->error / bisectors[i]->largest;
  }
  std::array<double, 4> weight{};
  cofactors(count, rows, weight);
  corner.error = 8 * product * (relative + 16 * half_ulp);
  double sum = 0;
  for (std::size_t j = 0; j < count; ++j) sum += weight[j];
  bool is_turned = sum < 0;
  if (!(std::abs(sum) > 4 * corner.error)) {
    const std::vector<Vec3>& sites = neighbours_.sites();
    std::array<Vec3, 4> ends;
    std::array<PerturbedSite, 3> others;
    for (std::size_t j = 0; j < count; ++j) ends[j] = corners_[free_corners[j]];
    for (std::size_t i = 0; i < bisector_count; ++i) others[i] = {sites[bisectors[i]->site], bisectors[i]->site};
    // The exact determinant has the row of ones last, cofactors develop it as the first: (−1)^(count − 1).
    const int orientation = bisector_orientation({ends.data(), count}, sites[owner_], {others.data(), bisector_count});
    is_turned = (count % 2 == 0 ? -orientation : orientation) < 0;
  }
  for (std::size_t j = 0; j < count; ++j) {
    corner.weight[free_corners[j]] = is_turned ? -weight[j] : weight[j];
    corner.largest = std::max(corner.largest, std::abs(weight[j]));
  }
  return corner;
}

bool TetrahedronCells::is_nearer_to_owner(const Corner& corner, const Bisector& other) const {
  double value = 0;
  for (std::size_t i = 0; i < 4; ++i) value += corner.weight[i] * other.value[i];
  const double error = 6 * (corner.error * other.largest + corner.largest * other.error);
  if (std::abs(value) > error) return value > 0;
  const std::vector<Vec3>& sites = neighbours_.sites();
  std::array<Vec3, 4> ends;
  std::array<PerturbedSite, 3> bisectors;
  std::array<bool, 4> is_free{true, true, true, true};
  std::size_t count = 0, bisector_count = 0;
  for (const std::uint32_t plane : corner.planes) {
    if (plane < 4) {
      is_free[plane] = false;
    } else {
      const std::uint32_t site = bisectors_[plane - 4].site;
      bisectors[bisector_count++] = {sites[site], site};
    }
  }
  for (std::size_t i = 0; i < 4; ++i)
    if (is_free[i]) ends[count++] = corners_[i];
  return bisector_side({ends.data(), count}, {sites[owner_], owner_}, {bisectors.data(), bisector_count},
                       {sites[other.site], other.site}) > 0;
}

Vec3 TetrahedronCells::position(const Corner& corner) const {
  // From the same corners and sites in the same order, whichever tetrahedron and cell asks.
  std::array<Vec3, 4> ends;
  std::array<std::uint32_t, 4> sites;
  std::array<bool, 4> is_free{true, true, true, true};
  std::size_t count = 0, site_count = 0;
  sites[site_count++] = owner_;
  for (const std::uint32_t plane : corner.planes) {
    if (plane < 4)
      is_free[plane] = false;
    else
      sites[site_count++] = bisectors_[plane - 4].site;
  }
  for (std::size_t i = 0; i < 4; ++i)
    if (is_free[i]) ends[count++] = corners_[i];
  if (count == 1) return ends[0];
  sort_few(ends, count, lexicographically_less);
  sort_few(sites, site_count, std::less<>());
  std::array<std::array<double, 4>, 3> values{};
  std::array<const double*, 3> rows{};
  for (std::size_t j = 0; j < count; ++j) {
    const double own = squared_distance(ends[j], neighbours_.sites()[sites[0]]);
    for (std::size_t i = 1; i < site_count; ++i)
      values[i - 1][j] = squared_distance(ends[j], neighbours_.sites()[sites[i]]) - own;
  }
  for (std::size_t i = 0; i + 1 < site_count; ++i) rows[i] = values[i].data();
  std::array<double, 4> weight{};
  cofactors(count, rows, weight);
  double sum = 0;
  for (std::size_t j = 0; j < count; ++j) sum += weight[j];
  double total = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const double share = weight[j] / sum;
    weight[j] = share > 0 ? std::min(share, 1.0) : 0.0;  // also where rounding left 0 / 0
    total += weight[j];
  }
  Vec3 place = ends[0];
  if (total > 0)
    for (std::size_t j = 1; j < count; ++j) place = place + (weight[j] / total) * (ends[j] - ends[0]);
  return place;
}

double TetrahedronCells::reach() const {
  const Vec3& site = neighbours_.sites()[owner_];
  double farthest = 0;
  for (const Corner& corner : polyhedron_) {
    double sum = 0;
    for (const double weight : corner.weight) sum += weight;
    double square = 0;
    if (!(sum > well_known * corner.error)) {
      for (const double distance : owner_distance_) square = std::max(square, distance);
    } else {
      Vec3 place = corners_[0];
      for (std::size_t i = 1; i < 4; ++i) place = place + (corner.weight[i] / sum) * (corners_[i] - corners_[0]);
      square = squared_distance(place, site);
    }
    farthest = std::max(farthest, square);
  }
  return std::sqrt(farthest);
}

bool TetrahedronCells::has_face_with(std::uint32_t site) const {
  for (const Corner& corner : polyhedron_)
    for (const std::uint32_t plane : corner.planes)
      if (plane >= 4 && bisectors_[plane - 4].site == site) return true;
  return false;
}

void TetrahedronCells::emit() {
  Piece piece{owner_, static_cast<std::uint32_t>(points_.size()), static_cast<std::uint32_t>(polyhedron_.size()),
              static_cast<std::uint32_t>(faces_.size()), 0, static_cast<std::uint32_t>(rings_.size()), 0};
  for (const Corner& corner : polyhedron_) points_.push_back(position(corner));
  std::vector<char> is_done(4 + bisectors_.size(), 0);
  for (std::uint32_t start = 0; start < polyhedron_.size(); ++start)
    for (const std::uint32_t plane : polyhedron_[start].planes) {
      if (is_done[plane]) continue;
      is_done[plane] = 1;
      PieceFace face{plane < 4 ? PieceFace::on_tetrahedron | plane : bisectors_[plane - 4].site,
                     static_cast<std::uint32_t>(rings_.size()) - piece.first_ring, 0};
      std::uint32_t at = start;
      do {  // with `plane` first a corner is (plane, a, b); the next around the face is (plane, b, …)
        rings_.push_back(at);
        const auto& planes = polyhedron_[at].planes;
        const std::size_t k = planes[0] == plane ? 0 : planes[1] == plane ? 1 : 2;
        const std::uint32_t b = planes[(k + 2) % 3];
        for (std::uint32_t next = 0; next < polyhedron_.size(); ++next) {
          const auto& others = polyhedron_[next].planes;
          const std::size_t m = others[0] == plane ? 0 : others[1] == plane ? 1 : others[2] == plane ? 2 : 3;
          if (m < 3 && others[(m + 1) % 3] == b) {
            at = next;
            break;
          }
        }
      } while (at != start);
      face.count = static_cast<std::uint32_t>(rings_.size()) - piece.first_ring - face.first;
      std::reverse(rings_.end() - static_cast<std::ptrdiff_t>(face.count), rings_.end());
      faces_.push_back(face);
      if (plane >= 4 && std::find(queue_.begin(), queue_.end(), face.label) == queue_.end())
        queue_.push_back(face.label);
    }
  piece.face_count = static_cast<std::uint32_t>(faces_.size()) - piece.first_face;
  piece.ring_count = static_cast<std::uint32_t>(rings_.size()) - piece.first_ring;
  pieces_.push_back(piece);
}

}  // namespace strataflow
