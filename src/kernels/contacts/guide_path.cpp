#include "kernels/contacts/guide_path.h"

#include <algorithm>
#include <queue>
#include <unordered_map>

#include "base/id.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

int GuidePlane::side_of(const Vec3& p) const { return orientation_3d(a, b, c, p); }

namespace {

/// Where edge and plane meet, computed once from the lower end.
Vec3 meeting_point(const ContactMesh& mesh, std::uint32_t a, std::uint32_t b, const GuidePlane& plane) {
  const Vec3 &p = mesh.point(std::min(a, b)), &q = mesh.point(std::max(a, b));
  const Vec3 n = cross(plane.b - plane.a, plane.c - plane.a);
  const double dp = dot(n, p - plane.a), dq = dot(n, q - plane.a);
  // Sides are exact, distances are not: one that comes out on the wrong side belongs to an end on the plane.
  const double t = dp == dq ? 0.5 : std::clamp(dp / (dp - dq), 0.0, 1.0);
  Vec3 x = p + t * (q - p);
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] == q[axis]) x[axis] = p[axis];
  return x;
}

struct State {
  PathNode node;
  double length_m = 0;
  std::uint32_t before = no_index;
  bool is_settled = false;
};

}  // namespace

std::optional<std::vector<PathNode>> find_guide_path(const ContactMesh& mesh, std::uint32_t entity, std::uint32_t from,
                                                     std::uint32_t to, const GuidePlane& plane, double max_length_m) {
  std::vector<State> states{{{from, from, mesh.point(from)}}};
  std::unordered_map<std::uint64_t, std::uint32_t> number{
      {(std::uint64_t{from} << 32) | from, 0}};  // only asked, never walked
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  front.push({0, 0});
  const auto reach = [&](std::uint32_t a, std::uint32_t b, std::uint32_t before) {
    if (a > b) std::swap(a, b);
    const auto [place, is_new] =
        number.try_emplace((std::uint64_t{a} << 32) | b, static_cast<std::uint32_t>(states.size()));
    const std::uint32_t id = place->second;
    if (is_new)
      states.push_back(
          {{a, b, a == b ? mesh.point(a) : meeting_point(mesh, a, b, plane)}, max_length_m, no_index, false});
    const double length_m = states[before].length_m + length(states[id].node.point - states[before].node.point);
    if (states[id].is_settled || !(length_m < states[id].length_m)) return;
    states[id].length_m = length_m;
    states[id].before = before;
    front.push({length_m, id});
  };
  const auto side = [&](std::uint32_t v) { return v == from || v == to ? 0 : plane.side_of(mesh.point(v)); };
  while (!front.empty()) {
    const std::uint32_t id = front.top().second;
    front.pop();
    if (states[id].is_settled) continue;
    states[id].is_settled = true;
    const PathNode node = states[id].node;
    if (node.a == to && node.b == to) {
      std::vector<PathNode> path;
      for (std::uint32_t s = states[id].before; s != 0; s = states[s].before) path.push_back(states[s].node);
      std::reverse(path.begin(), path.end());
      return path;
    }
    mesh.visit_triangles_at(node.a, [&](std::uint32_t t) {
      if (mesh.entity_of(t) != entity) return;
      const Triangle& tri = mesh.triangle(t);
      if (node.b != tri[0] && node.b != tri[1] && node.b != tri[2]) return;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t p = tri[k], q = tri[(k + 1) % 3];
        const int sp = side(p);
        if (sp == 0 && p != node.a) reach(p, p, id);
        if (sp * side(q) < 0) reach(p, q, id);
      }
    });
  }
  return std::nullopt;
}

}  // namespace strataflow
