#include "kernels/hexes/tet_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "kernels/volumes/tet_faces.h"

namespace strataflow {
namespace {

constexpr double touching_ratio = 1e-9;  // of a layer's length in W

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double squared = dot(b - a, b - a);
  return length(p - a - (squared > 0 ? std::clamp(dot(p - a, b - a) / squared, 0.0, 1.0) : 0.0) * (b - a));
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  if (dot(n, cross(b - a, p - a)) >= 0 && dot(n, cross(c - b, p - b)) >= 0 && dot(n, cross(a - c, p - c)) >= 0)
    return std::abs(dot(n, p - a)) / length(n);
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

std::vector<double> scaled(std::vector<double> w, double scale_m) {
  for (double& one : w) one *= scale_m;
  return w;
}

std::vector<char> flipped_tets(const LayeredSpace& space) {
  std::vector<char> is_flipped(space.layers.tets.size(), 0);
  for (const std::uint32_t t : space.flipped) is_flipped[t] = 1;
  return is_flipped;
}

}  // namespace

TetLocator::TetLocator(const LayeredSpace& space, double w_scale_m)
    : TetLocator(space, w_scale_m, scaled(space.layers.w, w_scale_m), flipped_tets(space)) {}

TetLocator TetLocator::of_heights(const LayeredSpace& space) {
  std::vector<double> height_m;
  for (const std::uint32_t p : space.layers.point) height_m.push_back(space.model.points[p].z);
  std::vector<char> has_no_volume(space.layers.tets.size(), 0);
  std::fill(has_no_volume.begin() + space.layers.model_tets, has_no_volume.end(), 1);
  return TetLocator(space, 1, std::move(height_m), std::move(has_no_volume));
}

TetLocator::TetLocator(const LayeredSpace& space, double w_scale_m, std::vector<double> height_m,
                       std::vector<char> is_left_aside)
    : space_(space), w_scale_m_(w_scale_m), height_m_(std::move(height_m)), is_left_aside_(std::move(is_left_aside)) {
  const std::vector<FloatBox> boxes = parallel_map(
      space.layers.tets.size(),
      [&](std::size_t t) {
        Box3 box;
        for (const Vec3& p : corners(static_cast<std::uint32_t>(t))) box.take(p);
        return enclosing(box);
      },
      4096);
  tree_ = BoundingVolumeTree(boxes);
}

std::array<Vec3, 4> TetLocator::corners(std::uint32_t tet) const {
  std::array<Vec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t copy = space_.layers.tets[tet][k];
    const Vec3& plan = space_.plan[space_.layers.point[copy]];
    p[k] = {plan.x, plan.y, height_m_[copy]};
  }
  return p;
}

double TetLocator::outside_m(std::uint32_t tet, const Vec3& p) const {
  const std::array<Vec3, 4> c = corners(tet);
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& face : face_corners) {
    const Vec3 n = cross(c[face[1]] - c[face[0]], c[face[2]] - c[face[0]]);
    most = std::max(most, dot(n, p - c[face[0]]) / length(n));
  }
  return most;
}

TetLocator::Place TetLocator::place_in(std::uint32_t tet, const Vec3& p) const {
  const double outside = outside_m(tet, p);
  std::size_t at_level = 0;
  for (const std::uint32_t copy : space_.layers.tets[tet]) at_level += height_m_[copy] == p.z ? 1 : 0;
  return {tet, outside, at_level >= 3 && outside <= touching_ratio * w_scale_m_};
}

TetLocator::Place TetLocator::locate(const Vec3& p, double reach_m) const {
  for (double reach = 1e-9 * reach_m;; reach = std::min(reach_m, std::max(1e3 * reach, 0.03 * reach_m))) {
    Place best{no_index, std::numeric_limits<double>::infinity()};
    const Vec3 r{reach, reach, reach};
    tree_.visit_items(enclosing({p - r, p + r}), [&](std::uint32_t t) {
      if (is_left_aside_[t]) return;
      if (const Place place = place_in(t, p); place.is_before(best)) best = place;
    });
    if ((best.tet != no_index && best.outside_m <= reach) || reach >= reach_m) return best;
  }
}

std::vector<std::uint32_t> TetLocator::in_ball(const Vec3& p, double radius_m) const {
  std::vector<std::uint32_t> found;
  const Vec3 r{radius_m, radius_m, radius_m};
  tree_.visit_items(enclosing({p - r, p + r}), [&](std::uint32_t t) {
    if (is_left_aside_[t] || outside_m(t, p) > radius_m) return;
    // The planes of the faces are nearer than the faces. A tetrahedron that only its planes bring here would stand
    // apart from the others in the ball.
    if (outside_m(t, p) > 0) {
      const std::array<Vec3, 4> c = corners(t);
      double distance = std::numeric_limits<double>::infinity();
      for (const auto& f : face_corners)
        distance = std::min(distance, distance_to_triangle(p, c[f[0]], c[f[1]], c[f[2]]));
      if (distance > radius_m) return;
    }
    found.push_back(t);
  });
  std::sort(found.begin(), found.end());
  return found;
}

TetLocator::LevelPoint TetLocator::nearest_at_level(std::uint32_t tet, const Vec3& p) const {
  const std::array<Vec3, 4> c = corners(tet);
  std::array<Vec3, 8> section;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (c[i].z == p.z) section[count++] = c[i];
    for (std::size_t j = 0; j < 4; ++j) {
      if (!(c[i].z < p.z && c[j].z > p.z)) continue;
      section[count] = c[i] + ((p.z - c[i].z) / (c[j].z - c[i].z)) * (c[j] - c[i]);
      section[count++].z = p.z;
    }
  }
  LevelPoint best{{}, std::numeric_limits<double>::infinity()};
  const auto offer = [&](const Vec3& q) {
    const double away = length(q - p);
    if (away < best.distance_m) best = {q, away};
  };
  // A convex polygon is made of the triangles of its corners, whatever their order.
  for (std::size_t i = 0; i < count; ++i) {
    offer(section[i]);
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec3 along = section[j] - section[i];
      const double squared = dot(along, along);
      if (squared > 0) offer(section[i] + std::clamp(dot(p - section[i], along) / squared, 0.0, 1.0) * along);
      for (std::size_t k = j + 1; k < count; ++k) {
        const auto turn = [&](const Vec3& a, const Vec3& b) { return cross(b - a, p - a).z; };
        const double x = turn(section[i], section[j]), y = turn(section[j], section[k]),
                     z = turn(section[k], section[i]);
        if ((x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0)) return {p, 0};
      }
    }
  }
  return best;
}

TetLocator::LevelPoint TetLocator::nearest_on_face(std::uint32_t tet, std::uint32_t k, const Vec3& p) const {
  const std::array<Vec3, 4> all = corners(tet);
  const auto& face = face_corners[k];
  std::array<Vec3, 6> section;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = all[face[i]], &b = all[face[(i + 1) % 3]];
    if (a.z == p.z) section[count++] = a;
    if ((a.z < p.z && b.z > p.z) || (a.z > p.z && b.z < p.z)) {
      section[count] = a + ((p.z - a.z) / (b.z - a.z)) * (b - a);
      section[count++].z = p.z;
    }
  }
  LevelPoint best{{}, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i; j < count; ++j) {
      const Vec3 along = section[j] - section[i];
      const double squared = dot(along, along);
      const Vec3 q =
          section[i] + (squared > 0 ? std::clamp(dot(p - section[i], along) / squared, 0.0, 1.0) : 0.0) * along;
      if (length(q - p) < best.distance_m) best = {q, length(q - p)};
    }
  return best;
}

Vec3 TetLocator::lifted(std::uint32_t tet, const Vec3& p) const {
  const std::array<Vec3, 4> c = corners(tet);
  std::array<double, 4> weight;
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& face = face_corners[k];
    const Vec3 n = cross(c[face[1]] - c[face[0]], c[face[2]] - c[face[0]]);
    weight[k] = dot(n, c[face[0]] - p);
    sum += weight[k];
  }
  Vec3 position;
  for (std::size_t k = 0; k < 4; ++k)
    position = position + (weight[k] / sum) * space_.model.points[space_.layers.point[space_.layers.tets[tet][k]]];
  return position;
}

}  // namespace strataflow
