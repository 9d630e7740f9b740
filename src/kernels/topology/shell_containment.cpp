#include "kernels/topology/shell_containment.h"

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {
/// orientation_2d(u, v, p) seen from above, with p moved by (ε, ε²). 0 only for an edge that is vertical.
int perturbed_turn(const Vec3& u, const Vec3& v, const Vec3& p) {
  const int turn = orientation_2d(u.x, u.y, v.x, v.y, p.x, p.y);
  if (turn != 0) return turn;
  if (u.y != v.y) return u.y > v.y ? 1 : -1;
  if (u.x != v.x) return v.x > u.x ? 1 : -1;
  return 0;
}
}  // namespace

RayMeeting meeting_of_upward_ray(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto beyond = [&](double Vec3::*axis) {
    return (a.*axis < p.*axis && b.*axis < p.*axis && c.*axis < p.*axis) ||
           (a.*axis > p.*axis && b.*axis > p.*axis && c.*axis > p.*axis);
  };
  if (beyond(&Vec3::x) || beyond(&Vec3::y) || (a.z < p.z && b.z < p.z && c.z < p.z)) return RayMeeting::misses;
  const int turn = orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y);
  if (turn == 0) {  // vertical: the moved ray never meets it, but p itself may lie on it
    if (orientation_3d(a, b, c, p) != 0) return RayMeeting::misses;
    const int axis = projection_axis(a, b, c);
    if (axis < 0) return RayMeeting::misses;
    const int way = orientation_2d(a, b, c, axis);
    const bool inside = way * orientation_2d(a, b, p, axis) >= 0 && way * orientation_2d(b, c, p, axis) >= 0 &&
                        way * orientation_2d(c, a, p, axis) >= 0;
    return inside ? RayMeeting::starts_on : RayMeeting::misses;
  }
  const int first = perturbed_turn(a, b, p), second = perturbed_turn(b, c, p), third = perturbed_turn(c, a, p);
  const int height = turn * orientation_3d(a, b, c, p);
  if (first == turn && second == turn && third == turn) {
    if (height == 0) return RayMeeting::starts_on;
    return height < 0 ? RayMeeting::crosses : RayMeeting::misses;
  }
  if (height == 0 && turn * orientation_2d(a.x, a.y, b.x, b.y, p.x, p.y) >= 0 &&
      turn * orientation_2d(b.x, b.y, c.x, c.y, p.x, p.y) >= 0 && turn * orientation_2d(c.x, c.y, a.x, a.y, p.x, p.y) >= 0)
    return RayMeeting::starts_on;  // on the border, from which the move leads away
  return RayMeeting::misses;
}

int place_in_shell(const StructuralModel& model, std::span<const SurfaceSide> sides, const Vec3& p) {
  bool inside = false;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool both = (i > 0 && sides[i - 1].surface == sides[i].surface) ||
                      (i + 1 < sides.size() && sides[i + 1].surface == sides[i].surface);
    if (both) continue;
    const Surface& surface = model.surfaces[sides[i].surface];
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
      const Triangle& v = model.triangles[t];
      const RayMeeting meeting = meeting_of_upward_ray(p, model.points[v[0]], model.points[v[1]], model.points[v[2]]);
      if (meeting == RayMeeting::starts_on) return 0;
      if (meeting == RayMeeting::crosses) inside = !inside;
    }
  }
  return inside ? 1 : -1;
}

}  // namespace strataflow
