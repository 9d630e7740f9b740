#include "kernels/topology/building/shell_containment.h"

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

/// The sign of an affine function at a place: the point decides, or else what it is moved towards.
template <class Sign>
int first_sign(Place place, const Sign& sign) {
  for (const Vec3& p : place)
    if (const int found = sign(p); found != 0) return found;
  return 0;
}

/// orientation_2d(u, v, place) seen from above.
int turn_at(const Vec3& u, const Vec3& v, Place place) {
  return first_sign(place, [&](const Vec3& p) { return orientation_2d(u.x, u.y, v.x, v.y, p.x, p.y); });
}

/// The same with the place moved by (ε, ε²). 0 only for an edge that is vertical.
int perturbed_turn(const Vec3& u, const Vec3& v, Place place) {
  if (const int turn = turn_at(u, v, place); turn != 0) return turn;
  if (u.y != v.y) return u.y > v.y ? 1 : -1;
  if (u.x != v.x) return v.x > u.x ? 1 : -1;
  return 0;
}

}  // namespace

RayMeeting meeting_of_upward_ray(Place place, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3& p = place[0];
  const auto beyond = [&](double Vec3::*axis) {
    return (a.*axis < p.*axis && b.*axis < p.*axis && c.*axis < p.*axis) ||
           (a.*axis > p.*axis && b.*axis > p.*axis && c.*axis > p.*axis);
  };
  if (beyond(&Vec3::x) || beyond(&Vec3::y) || (a.z < p.z && b.z < p.z && c.z < p.z)) return RayMeeting::misses;
  const int height = first_sign(place, [&](const Vec3& q) { return orientation_3d(a, b, c, q); });
  const int turn = orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y);
  if (turn == 0) {  // vertical: the moved ray never meets it, but the place itself may lie on it
    const int axis = height == 0 ? projection_axis(a, b, c) : -1;
    if (axis < 0) return RayMeeting::misses;
    const int way = orientation_2d(a, b, c, axis);
    const auto within = [&](const Vec3& u, const Vec3& v) {
      return way * first_sign(place, [&](const Vec3& q) { return orientation_2d(u, v, q, axis); }) >= 0;
    };
    return within(a, b) && within(b, c) && within(c, a) ? RayMeeting::starts_on : RayMeeting::misses;
  }
  if (height == 0) {  // on its plane: borders count, from which the move may lead away
    const bool is_on =
        turn * turn_at(a, b, place) >= 0 && turn * turn_at(b, c, place) >= 0 && turn * turn_at(c, a, place) >= 0;
    return is_on ? RayMeeting::starts_on : RayMeeting::misses;
  }
  const bool is_above = turn * height < 0;
  return is_above && perturbed_turn(a, b, place) == turn && perturbed_turn(b, c, place) == turn &&
                 perturbed_turn(c, a, place) == turn
             ? RayMeeting::crosses
             : RayMeeting::misses;
}

std::vector<SurfaceSide> closed_shell_of(std::span<const SurfaceSide> sides) {
  std::vector<SurfaceSide> shell;
  for (const SurfaceSide side : sides)
    if (!shell.empty() && shell.back().surface == side.surface)
      shell.pop_back();
    else
      shell.push_back(side);
  return shell;
}

int place_in_shell(const StructuralModel& model, std::span<const SurfaceSide> closed_shell, Place place) {
  bool inside = false;
  for (const SurfaceSide side : closed_shell) {
    const Surface& surface = model.surfaces[side.surface];
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
      const Triangle& v = model.triangles[t];
      const RayMeeting meeting =
          meeting_of_upward_ray(place, model.points[v[0]], model.points[v[1]], model.points[v[2]]);
      if (meeting == RayMeeting::starts_on) return 0;
      if (meeting == RayMeeting::crosses) inside = !inside;
    }
  }
  return inside ? 1 : -1;
}

}  // namespace strataflow
