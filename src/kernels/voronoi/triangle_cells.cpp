#include "kernels/voronoi/triangle_cells.h"

#include <algorithm>
#include <cmath>

#include "base/internal_error.h"
#include "kernels/adapters/cgal/bisector_side.h"
#include "kernels/voronoi/clip_by_neighbours.h"

namespace strataflow {

std::uint32_t find_nearest_site(const SiteNeighbours& neighbours, const Vec3& x, std::uint32_t hint) {
  const std::vector<Vec3>& sites = neighbours.sites();
  std::uint32_t owner = hint;
  double distance = squared_distance(x, sites[owner]);
  const auto beats = [&](std::uint32_t other, double& other_distance) {
    other_distance = squared_distance(x, sites[other]);
    const double difference = other_distance - distance;
    if (std::abs(difference) > 8 * half_ulp * (other_distance + distance)) return difference < 0;
    const PerturbedSite own{sites[owner], owner}, its{sites[other], other};
    return bisector_side({&x, 1}, own, {}, its) < 0;
  };
  std::vector<NearSite> beyond;
  for (;;) {
    const double reach = security * std::sqrt(distance) + neighbours.slack();
    const auto near = neighbours.near(owner);
    std::uint32_t better = owner;
    double better_distance = 0;
    bool is_settled = neighbours.lists_hold_all();
    for (const NearSite& other : near) {
      if (other.distance > reach) {
        is_settled = true;
        break;
      }
      if (beats(other.site, better_distance)) {
        better = other.site;
        break;
      }
    }
    if (better == owner && !is_settled) {
      neighbours.find_within(owner, security * std::sqrt(distance), beyond);
      for (const NearSite& other : beyond)
        if (beats(other.site, better_distance)) {
          better = other.site;
          break;
        }
    }
    if (better == owner) return owner;
    owner = better;
    distance = better_distance;
  }
}

void TriangleCells::cut(const std::array<Vec3, 3>& corners, std::uint32_t start) {
  corners_ = corners;
  pieces_.clear();
  points_.clear();
  edges_.clear();
  queue_.assign(1, start);
  for (std::size_t next = 0; next < queue_.size(); ++next) cut_piece(queue_[next]);
}

void TriangleCells::cut_piece(std::uint32_t owner) {
  owner_ = owner;
  const std::vector<Vec3>& sites = neighbours_.sites();
  for (std::size_t i = 0; i < 3; ++i) owner_distance_[i] = squared_distance(corners_[i], sites[owner]);
  bisectors_.clear();
  polygon_.clear();
  for (std::uint32_t i = 0; i < 3; ++i) {
    Corner corner{{0, 0, 0}, 0, 1, (i + 2) % 3, i};
    corner.weight[i] = 1;
    polygon_.push_back(corner);
  }
  if (!clip_by_neighbours(
          neighbours_, owner, beyond_, [&] { return reach(); }, [&](std::uint32_t site) { return clip(site); },
          [&] { return polygon_.empty(); }, [&](std::uint32_t site) { return has_edge_with(site); }))
    return;
  pieces_.push_back({owner, static_cast<std::uint32_t>(points_.size()), static_cast<std::uint32_t>(polygon_.size())});
  for (const Corner& corner : polygon_) {
    points_.push_back(position(corner));
    if (corner.after < 3) {
      edges_.push_back({PieceEdge::on_triangle | corner.after});
      continue;
    }
    const std::uint32_t other = bisectors_[corner.after - 3].site;
    edges_.push_back({other});
    if (std::find(queue_.begin(), queue_.end(), other) == queue_.end()) queue_.push_back(other);
  }
}

bool TriangleCells::clip(std::uint32_t site) {
  const Vec3& at = neighbours_.sites()[site];
  Bisector bisector{site, {}, {}, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double distance = squared_distance(corners_[i], at);
    bisector.distance[i] = distance;
    bisector.value[i] = distance - owner_distance_[i];
    bisector.error = std::max(bisector.error, 8 * half_ulp * (distance + owner_distance_[i]));
    bisector.largest = std::max(bisector.largest, std::abs(bisector.value[i]));
  }
  if (bisector.value[0] > bisector.error && bisector.value[1] > bisector.error && bisector.value[2] > bisector.error)
    return false;  // the owner has the whole triangle from it
  const std::size_t count = polygon_.size();
  keep_.resize(count);
  bool keeps_all = true;
  for (std::size_t i = 0; i < count; ++i) {
    keep_[i] = is_nearer_to_owner(polygon_[i], bisector) ? 1 : 0;
    keeps_all = keeps_all && keep_[i] != 0;
  }
  if (keeps_all) return false;
  bisectors_.push_back(bisector);
  const auto cut = static_cast<std::uint32_t>(2 + bisectors_.size());
  clipped_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = i + 1 == count ? 0 : i + 1;
    if (keep_[i]) clipped_.push_back(polygon_[i]);
    if (keep_[i] == keep_[next]) continue;
    const std::uint32_t edge = polygon_[i].after;
    if (keep_[i]) {  // the piece ends here: what follows is the new edge
      clipped_.push_back(make_corner(edge, cut));
    } else {
      clipped_.push_back(make_corner(cut, edge));
    }
  }
  polygon_.swap(clipped_);
  return true;
}

TriangleCells::Corner TriangleCells::make_corner(std::uint32_t before, std::uint32_t after) const {
  Corner corner{{0, 0, 0}, 0, 0, before, after};
  const std::uint32_t other = std::min(before, after), cut = std::max(before, after);  // the bisector came last
  const Bisector& b = bisectors_[cut - 3];
  if (other < 3) {
    const std::uint32_t from = other, to = (other + 1) % 3;
    corner.weight[from] = std::abs(b.value[to]);
    corner.weight[to] = std::abs(b.value[from]);
    corner.error = b.error;
  } else {
    const Bisector& a = bisectors_[other - 3];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      corner.weight[i] = a.value[j] * b.value[k] - a.value[k] * b.value[j];
    }
    corner.error = 4 * (a.error * b.largest + b.error * a.largest);
    const double sum = corner.weight[0] + corner.weight[1] + corner.weight[2];
    bool is_turned = sum < 0;
    if (!(std::abs(sum) > 4 * corner.error)) {
      const std::vector<Vec3>& sites = neighbours_.sites();
      const PerturbedSite both[2]{{sites[a.site], a.site}, {sites[b.site], b.site}};
      is_turned = bisector_orientation(corners_, sites[owner_], both) < 0;
    }
    if (is_turned)
      for (double& weight : corner.weight) weight = -weight;
  }
  corner.largest = std::max({std::abs(corner.weight[0]), std::abs(corner.weight[1]), std::abs(corner.weight[2])});
  return corner;
}

bool TriangleCells::is_nearer_to_owner(const Corner& corner, const Bisector& other) const {
  const double value = corner.weight[0] * other.value[0] + corner.weight[1] * other.value[1] +
                       corner.weight[2] * other.value[2];
  const double error = 4 * (corner.error * other.largest + corner.largest * other.error);
  if (std::abs(value) > error) return value > 0;
  return decide_exactly(corner, other);
}

bool TriangleCells::decide_exactly(const Corner& corner, const Bisector& other) const {
  const std::vector<Vec3>& sites = neighbours_.sites();
  const PerturbedSite owner{sites[owner_], owner_}, its{sites[other.site], other.site};
  PerturbedSite bisectors[2];
  std::size_t bisector_count = 0;
  for (const std::uint32_t edge : {corner.before, corner.after})
    if (edge >= 3) {
      const std::uint32_t site = bisectors_[edge - 3].site;
      bisectors[bisector_count++] = {sites[site], site};
    }
  if (bisector_count == 2) return bisector_side(corners_, owner, {bisectors, 2}, its) > 0;
  if (bisector_count == 1) {
    const std::uint32_t edge = std::min(corner.before, corner.after);
    const Vec3 ends[2]{corners_[edge], corners_[(edge + 1) % 3]};
    return bisector_side(ends, owner, {bisectors, 1}, its) > 0;
  }
  return bisector_side({&corners_[corner.after], 1}, owner, {}, its) > 0;
}

Vec3 TriangleCells::position(const Corner& corner) const {
  const std::uint32_t low = std::min(corner.before, corner.after), high = std::max(corner.before, corner.after);
  if (high < 3) return corners_[corner.after];
  const auto share = [](double part, double whole) {
    const double ratio = part / whole;
    return ratio > 0 ? std::min(ratio, 1.0) : 0.0;  // also where rounding left 0 / 0
  };
  if (low < 3) {  // from the end that comes first in space, whichever triangle asks
    std::uint32_t from = low, to = (low + 1) % 3;
    if (lexicographically_less(corners_[to], corners_[from])) std::swap(from, to);
    return corners_[from] +
           share(corner.weight[to], corner.weight[from] + corner.weight[to]) * (corners_[to] - corners_[from]);
  }
  // Three cells meet here, and each would round differently: take it from the one of the lowest id.
  struct Seen {
    std::uint32_t site;
    const std::array<double, 3>* distance;
  };
  std::array<Seen, 3> seen{Seen{owner_, &owner_distance_},
                           Seen{bisectors_[low - 3].site, &bisectors_[low - 3].distance},
                           Seen{bisectors_[high - 3].site, &bisectors_[high - 3].distance}};
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.site < b.site; });
  std::array<double, 3> a, b, weight;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = (*seen[1].distance)[i] - (*seen[0].distance)[i];
    b[i] = (*seen[2].distance)[i] - (*seen[0].distance)[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    weight[i] = a[j] * b[k] - a[k] * b[j];
  }
  const double sum = weight[0] + weight[1] + weight[2];
  double second = share(weight[1], sum), third = share(weight[2], sum);
  if (const double excess = second + third; excess > 1) {
    second /= excess;
    third /= excess;
  }
  return corners_[0] + second * (corners_[1] - corners_[0]) + third * (corners_[2] - corners_[0]);
}

double TriangleCells::reach() const {
  const Vec3& site = neighbours_.sites()[owner_];
  double farthest = 0;
  for (const Corner& corner : polygon_) {
    double square;
    if (corner.before < 3 && corner.after < 3) {
      square = owner_distance_[corner.after];
    } else {
      const double sum = corner.weight[0] + corner.weight[1] + corner.weight[2];
      if (!(sum > well_known * corner.error)) {
        square = std::max({owner_distance_[0], owner_distance_[1], owner_distance_[2]});
      } else {
        const double second = corner.weight[1] / sum, third = corner.weight[2] / sum;
        square = squared_distance(
            corners_[0] + second * (corners_[1] - corners_[0]) + third * (corners_[2] - corners_[0]), site);
      }
    }
    farthest = std::max(farthest, square);
  }
  return std::sqrt(farthest);
}

bool TriangleCells::has_edge_with(std::uint32_t site) const {
  for (const Corner& corner : polygon_)
    if (corner.after >= 3 && bisectors_[corner.after - 3].site == site) return true;
  return false;
}

}  // namespace strataflow
