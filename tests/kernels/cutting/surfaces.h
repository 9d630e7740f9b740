#pragma once
#include <algorithm>
#include <functional>
#include <numeric>

#include "base/seed.h"
#include "kernels/cutting/random_triangles.h"
#include "support/shapes.h"

namespace strataflow::support {

/// A grid of cells × cells quads over the parallelogram origin + [0, 1] u + [0, 1] v, points shared, as one entity.
inline void add_grid(TriangleSoup& soup, const std::string& name, Role role, int cells, const Vec3& origin,
                     const Vec3& u, const Vec3& v, const std::function<Vec3(const Vec3&)>& moved = {}) {
  const std::uint32_t patch = add_patch(soup, name, role);
  const auto first = static_cast<std::uint32_t>(soup.points.size()), row = static_cast<std::uint32_t>(cells + 1);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const Vec3 p = origin + (static_cast<double>(i) / cells) * u + (static_cast<double>(j) / cells) * v;
      soup.points.push_back(moved ? moved(p) : p);
    }
  for (std::uint32_t j = 0; j + 1 < row; ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = first + j * row + i, b = a + 1, c = b + row, d = a + row;
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
      soup.triangle_patch.insert(soup.triangle_patch.end(), {patch, patch});
    }
}

/// A horizon z = 0 and a fault x = 0.3 through it, gridded so that nothing coincides.
inline TriangleSoup horizon_and_fault(int cells = 4) {
  TriangleSoup soup;
  add_grid(soup, "H1", Role::horizon, cells, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  add_grid(soup, "F1", Role::fault, cells + 1, {0.3, -0.9, -0.7}, {0.1, 1.8, 0}, {0, 0, 1.5});
  return soup;
}

/// One entity per triangle.
inline TriangleSoup soup_of(const RandomMesh& mesh) {
  TriangleSoup soup;
  for (const Triangle& t : mesh.triangles)
    add_triangle(soup, add_patch(soup, "S" + std::to_string(soup.entities.size())), mesh.points[t[0]],
                 mesh.points[t[1]], mesh.points[t[2]]);
  return soup;
}

/// The same surfaces told another way: triangles, their first corners, points and entities in another order.
inline TriangleSoup shuffled(const TriangleSoup& soup, std::uint64_t seed) {
  RandomStream random(seed);
  const auto permutation = [&](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
  };
  const std::vector<std::uint32_t> points = permutation(soup.points.size()),
                                   triangles = permutation(soup.triangles.size()),
                                   entities = permutation(soup.entities.size());
  TriangleSoup other = soup;
  std::vector<std::uint32_t> new_point(points.size()), new_entity(entities.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    other.points[i] = soup.points[points[i]];
    new_point[points[i]] = i;
  }
  for (std::uint32_t i = 0; i < entities.size(); ++i) {
    other.entities[i] = soup.entities[entities[i]];
    new_entity[entities[i]] = i;
  }
  for (std::uint32_t& entity : other.patch_entity) entity = new_entity[entity];
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangle t = soup.triangles[triangles[i]];
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.below(3)), t.end());
    for (std::uint32_t& v : t) v = new_point[v];
    other.triangles[i] = t;
    other.triangle_patch[i] = soup.triangle_patch[triangles[i]];
  }
  return other;
}

struct ByPosition {
  bool operator()(const Vec3& a, const Vec3& b) const { return lexicographically_less(a, b); }
};

/// A triangle as its entity's name and its corners, lowest first, turned as they are.
struct PlacedTriangle {
  std::string name;
  std::array<Vec3, 3> corners;
  friend bool operator==(const PlacedTriangle&, const PlacedTriangle&) = default;
  friend bool operator<(const PlacedTriangle& a, const PlacedTriangle& b) {
    if (a.name != b.name) return a.name < b.name;
    for (int k = 0; k < 3; ++k)
      if (!(a.corners[k] == b.corners[k])) return lexicographically_less(a.corners[k], b.corners[k]);
    return false;
  }
};

/// The triangles of a soup (of one entity, when named), whatever their numbering; where entities coincide, of each.
inline std::vector<PlacedTriangle> placed_triangles(const TriangleSoup& soup, const std::string& only = "") {
  std::vector<PlacedTriangle> placed;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (const std::uint32_t entity : soup.entities_of(soup.triangle_patch[t])) {
      const std::string& name = soup.entities[entity].name;
      if (!only.empty() && name != only) continue;
      PlacedTriangle triangle{name, {}};
      for (int k = 0; k < 3; ++k) triangle.corners[k] = soup.points[soup.triangles[t][k]];
      std::rotate(triangle.corners.begin(),
                  std::min_element(triangle.corners.begin(), triangle.corners.end(), ByPosition{}),
                  triangle.corners.end());
      placed.push_back(triangle);
    }
  }
  std::sort(placed.begin(), placed.end());
  return placed;
}

}  // namespace strataflow::support
