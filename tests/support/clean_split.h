#pragma once
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "model/triangle_soup.h"
#include "support/shapes.h"

namespace strataflow::support {

/// A horizontal sheet of cells × cells unit squares whose inner grid points are moved at random by up to 0.4, Delaunay.
inline TriangleSoup jittered_sheet(int cells, std::uint32_t seed) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
  TriangleSoup soup;
  add_patch(soup, "H", Role::horizon);
  std::mt19937 random(seed);
  const auto jitter = [&] { return 0.8 * (static_cast<double>(random() % 100001) / 100000.0 - 0.5); };
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double dx = jitter(), dy = jitter();
      const bool is_inside = i > 0 && j > 0 && i < cells && j < cells;
      soup.points.push_back({i + (is_inside ? dx : 0), j + (is_inside ? dy : 0), 0});
    }
  Delaunay delaunay;
  for (std::uint32_t v = 0; v < soup.points.size(); ++v)
    delaunay.insert(Kernel::Point_2(soup.points[v].x, soup.points[v].y))->info() = v;
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face)
    soup.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  std::sort(soup.triangles.begin(), soup.triangles.end());  // the order of CGAL's faces is its own
  soup.triangle_patch.assign(soup.triangles.size(), 0);
  return soup;
}

/// A mesh cut cleanly along lines: nodes stand on edges only, and are doubled along each line.
struct CleanSplit {
  TriangleSoup soup;
  std::vector<char> inserted;                               ///< per point
  std::vector<std::array<std::uint32_t, 2>> original_edge;  ///< per point
  std::vector<std::vector<std::array<Vec3, 2>>> lines;      ///< per line: its edges
  std::set<std::array<std::uint32_t, 3>> crossed;           ///< original triangles the lines crossed, nodes ascending
};

inline std::array<std::uint32_t, 3> sorted_nodes(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

inline CleanSplit unsplit(TriangleSoup soup) {
  CleanSplit split;
  split.inserted.assign(soup.points.size(), 0);
  split.original_edge.assign(soup.points.size(), {0xffffffffu, 0xffffffffu});
  split.soup = std::move(soup);
  return split;
}

/// Splits along f = 0 (a function of the position). Quads are cut along their shortest diagonal.
inline void split_along(CleanSplit& split, const std::function<double(const Vec3&)>& f) {
  const TriangleSoup before = split.soup;
  const auto original_count = static_cast<std::uint32_t>(before.points.size());
  std::vector<double> value(before.points.size());
  for (std::size_t v = 0; v < value.size(); ++v) value[v] = f(before.points[v]);
  std::map<std::array<std::uint32_t, 2>, std::array<std::uint32_t, 2>> on_edge;  // edge → node below, node above
  TriangleSoup& soup = split.soup;
  soup.triangles.clear();
  soup.triangle_patch.clear();
  std::vector<std::array<Vec3, 2>> line;
  const auto node_on = [&](std::uint32_t a, std::uint32_t b) {
    auto [found, is_new] = on_edge.try_emplace({std::min(a, b), std::max(a, b)});
    if (is_new) {
      if (lexicographically_less(before.points[b], before.points[a])) std::swap(a, b);  // the same place on both lips
      const Vec3 p = before.points[a] + (value[a] / (value[a] - value[b])) * (before.points[b] - before.points[a]);
      for (std::uint32_t& copy : found->second) {
        copy = static_cast<std::uint32_t>(soup.points.size());
        soup.points.push_back(p);
        split.inserted.push_back(1);
        split.original_edge.push_back({a, b});
      }
    }
    return found->second;
  };
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    const Triangle& n = before.triangles[t];
    int lone = -1;
    for (int k = 0; k < 3; ++k)
      if ((value[n[k]] > 0) != (value[n[(k + 1) % 3]] > 0) && (value[n[k]] > 0) != (value[n[(k + 2) % 3]] > 0))
        lone = k;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      soup.triangles.push_back({a, b, c});
      soup.triangle_patch.push_back(before.triangle_patch[t]);
    };
    if (lone < 0) {
      add(n[0], n[1], n[2]);
      continue;
    }
    if (n[0] < original_count && !split.inserted[n[0]] && !split.inserted[n[1]] && !split.inserted[n[2]])
      split.crossed.insert(sorted_nodes(n));
    const std::uint32_t a = n[lone], b = n[(lone + 1) % 3], c = n[(lone + 2) % 3];
    const int side = value[a] > 0 ? 1 : 0;
    const auto ab = node_on(a, b), ac = node_on(a, c);
    line.push_back({soup.points[ab[0]], soup.points[ac[0]]});
    add(a, ab[side], ac[side]);
    const std::uint32_t p = ab[1 - side], q = ac[1 - side];
    if (length(soup.points[p] - soup.points[c]) < length(soup.points[q] - soup.points[b])) {
      add(p, b, c);
      add(p, c, q);
    } else {
      add(p, b, q);
      add(b, c, q);
    }
  }
  split.lines.push_back(std::move(line));
}

/// A sine from side to side of the sheet.
inline std::function<double(const Vec3&)> sine(double level, double height, double waves_per_unit, double phase) {
  return [=](const Vec3& p) { return p.y - level - height * std::sin(waves_per_unit * p.x + phase); };
}

/// How many of the crossed triangles are there again, as the same three nodes.
inline std::size_t restored(const CleanSplit& split, const std::vector<Triangle>& triangles,
                            const std::vector<std::uint32_t>& source) {
  std::size_t count = 0;
  for (const Triangle& t : triangles)
    count += split.crossed.count(sorted_nodes({source[t[0]], source[t[1]], source[t[2]]}));
  return count;
}

}  // namespace strataflow::support
