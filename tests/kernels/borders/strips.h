#pragma once
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "kernels/topology/building/weld_points.h"
#include "model/triangle_soup.h"
#include "support/shapes.h"

namespace strataflow::support {

/// A strip of `cells` squares' width 1 along x from 0 to `length_m`, leaving the x axis in the direction `away`, three
/// rows deep. Its border on the axis also holds `more` nodes, as a cut would insert them: border triangles are fans.
inline void add_strip(TriangleSoup& soup, std::uint32_t patch, int cells, double length_m, const Vec3& away,
                      const std::vector<double>& more = {}) {
  const auto at = [&](int i, int row) { return Vec3{length_m * i / cells, 0, 0} + (length_m / cells * row) * away; };
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < cells; ++i) {
      const Vec3 a = at(i, row), b = at(i + 1, row), c = at(i + 1, row + 1), d = at(i, row + 1);
      add_triangle(soup, patch, a, c, d);
      Vec3 last = a;
      if (row == 0)
        for (const double x : more)
          if (x > a.x && x < b.x) {
            add_triangle(soup, patch, last, {x, 0, 0}, c);
            last = {x, 0, 0};
          }
      add_triangle(soup, patch, last, b, c);
    }
}

/// The places i · length / cells of a strip's own nodes.
inline std::vector<double> places(int cells, double length_m) {
  std::vector<double> x;
  for (int i = 0; i <= cells; ++i) x.push_back(length_m * i / cells);
  return x;
}

/// Three strips around one contact on the x axis, of 10, 12 and 15 edges of their own, each with the nodes of the
/// others.
inline TriangleSoup three_strips() {
  TriangleSoup soup;
  std::vector<double> all = places(10, 60);
  for (const int cells : {12, 15})
    for (const double x : places(cells, 60)) all.push_back(x);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  add_strip(soup, add_patch(soup, "H", Role::horizon), 10, 60, {0, 1, 0}, all);
  add_strip(soup, add_patch(soup, "F", Role::fault), 12, 60, {0, 0, 1}, all);
  add_strip(soup, add_patch(soup, "G", Role::fault), 15, 60, {0, -1, 0.2}, all);
  return soup;
}

/// Nodes on the x axis used by one entity's triangles.
inline std::set<double> axis_nodes(const TriangleSoup& soup, std::uint32_t entity) {
  std::set<double> x;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (const std::uint32_t v : soup.triangles[t])
      if (soup.patch_entity[soup.triangle_patch[t]] == entity && soup.points[v].y == 0 && soup.points[v].z == 0)
        x.insert(soup.points[v].x);
  return x;
}

inline double smallest_angle_deg(const TriangleSoup& soup) {
  double least = 180;
  for (const Triangle& t : soup.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = soup.points[t[(k + 1) % 3]] - soup.points[t[k]],
                 w = soup.points[t[(k + 2) % 3]] - soup.points[t[k]];
      least = std::min(least, std::atan2(length(cross(u, w)), dot(u, w)) * 57.29577951308232);
    }
  return least;
}

/// Equal positions made one, as the kernels below simplify_borders expect.
inline TriangleSoup weld(TriangleSoup soup) {
  const WeldedPoints welded = weld_points(soup.points);
  std::vector<Vec3> points;
  for (const std::uint32_t v : welded.source) points.push_back(soup.points[v]);
  for (Triangle& t : soup.triangles)
    for (std::uint32_t& v : t) v = welded.id[v];
  soup.points = points;
  return soup;
}

}  // namespace strataflow::support
