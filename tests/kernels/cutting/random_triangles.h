#pragma once
#include <map>
#include <sstream>
#include <string>

#include "base/seed.h"
#include "kernels/intersection/find_intersections.h"
#include "model/triangle_soup.h"

namespace strataflow::support {

/// Ways to be awkward. All coordinates are integers, so that much happens exactly.
enum class TriangleKind {
  grid_3,         ///< corners in 0 … 3: everything coincides often
  grid_8,         ///< corners in 0 … 8
  large,          ///< corners in 0 … 2^20
  shared_vertex,  ///< all have one corner in common
  shared_edge,    ///< all have two
  one_plane,      ///< all lie in one oblique plane
  two_planes,     ///< each lies in one of two planes
  needles,        ///< two corners next to each other, the third far away
  resting,        ///< corners on edges and inside of the first triangle
  one_point       ///< all planes pass through one point inside all
};
inline constexpr TriangleKind all_triangle_kinds[] = {
    TriangleKind::grid_3,      TriangleKind::grid_8,    TriangleKind::large,      TriangleKind::shared_vertex,
    TriangleKind::shared_edge, TriangleKind::one_plane, TriangleKind::two_planes, TriangleKind::needles,
    TriangleKind::resting,     TriangleKind::one_point};

/// Welded points, triangles with area.
struct RandomMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

inline std::string describe(const RandomMesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t)
      text << '(' << mesh.points[v].x << ' ' << mesh.points[v].y << ' ' << mesh.points[v].z << ") ";
    text << '\n';
  }
  return text.str();
}

inline RandomMesh random_mesh(TriangleKind kind, int triangle_count, std::uint64_t seed) {
  RandomStream random(mix64(seed * 16 + static_cast<std::uint64_t>(kind)) >> 1);
  RandomMesh mesh;
  const auto whole = [&](std::uint64_t below) { return static_cast<double>(random.below(below)); };
  const auto grid = [&](std::uint64_t below) { return Vec3{whole(below), whole(below), whole(below)}; };
  const auto index_of = [&](const Vec3& p) {
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
      if (mesh.points[i] == p) return i;
    mesh.points.push_back(p);
    return static_cast<std::uint32_t>(mesh.points.size() - 1);
  };
  const Vec3 origin = grid(4), u = grid(4) - Vec3{1, 1, 1}, v = grid(4) - Vec3{2, 1, 1}, w = grid(4) - Vec3{1, 2, 1};
  const auto in_plane = [&](const Vec3& along) { return origin + whole(5) * u + whole(5) * along; };
  Vec3 first[3];
  for (int tries = 0; static_cast<int>(mesh.triangles.size()) < triangle_count && tries < 1000; ++tries) {
    Vec3 p[3];
    const bool is_first = mesh.triangles.empty();
    const bool other_plane = random.below(2) == 1;
    for (int k = 0; k < 3; ++k) switch (kind) {
        case TriangleKind::grid_3:
          p[k] = grid(4);
          break;
        case TriangleKind::grid_8:
          p[k] = grid(9);
          break;
        case TriangleKind::large:
          p[k] = grid((1u << 20) + 1);
          break;
        case TriangleKind::shared_vertex:
          p[k] = k == 0 ? origin : grid(4);
          break;
        case TriangleKind::shared_edge:
          p[k] = k == 0 ? origin : k == 1 ? origin + Vec3{2, 1, 0} : grid(5);
          break;
        case TriangleKind::one_plane:
          p[k] = in_plane(v);
          break;
        case TriangleKind::two_planes:
          p[k] = in_plane(other_plane ? v : w);
          break;
        case TriangleKind::needles:
          p[k] = k == 0 ? grid(4) : k == 1 ? p[0] + grid(2) : p[0] + 300.0 * (grid(3) - Vec3{1, 1, 1}) + grid(4);
          break;
        case TriangleKind::resting: {
          if (is_first) {
            p[k] = 12.0 * grid(4);
            break;
          }
          const double a = whole(5), b = whole(static_cast<std::uint64_t>(5 - a)), c = 4 - a - b;
          p[k] = random.below(3) == 0 ? 6.0 * grid(7) : (a / 4) * first[0] + (b / 4) * first[1] + (c / 4) * first[2];
          break;
        }
        case TriangleKind::one_point:
          p[k] = Vec3{60, 60, 60} +
                 (k < 2 ? 6.0 * (grid(7) - Vec3{3, 3, 3}) : Vec3{60, 60, 60} - p[0] + (Vec3{60, 60, 60} - p[1]));
          break;
      }
    if (is_first) std::copy(p, p + 3, first);
    const std::size_t before = mesh.points.size();
    const Triangle t{index_of(p[0]), index_of(p[1]), index_of(p[2])};
    if (is_degenerate(mesh.points, t))
      mesh.points.resize(before);
    else
      mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace strataflow::support
