#include "kernels/scars/pair_borders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/building/weld_points.h"

namespace strataflow {

namespace {

struct Lip {
  std::array<std::uint32_t, 2> ends;  ///< places, ascending
  std::uint32_t half_edge;
  bool runs_up;
};

/// The way from the edge into the triangle, at right angles to the edge.
Vec3 way_in(const TriangleSoup& soup, std::uint32_t h) {
  const Triangle& t = soup.triangles[h / 3];
  const Vec3 &a = soup.points[t[h % 3]], &b = soup.points[t[(h % 3 + 1) % 3]], &c = soup.points[t[(h % 3 + 2) % 3]];
  const Vec3 along = b - a;
  return cross(cross(along, c - a), along);
}

/// π minus the angle between two ways into the triangles: ‖θi − θj| − π| of the source. NaN without area.
double deviation_of(const Vec3& u, const Vec3& w) {
  if (!(dot(u, u) > 0 && dot(w, w) > 0)) return std::nan("");
  return std::numbers::pi - std::atan2(length(cross(u, w)), dot(u, w));
}

}  // namespace

std::vector<std::uint32_t> find_mates(std::size_t point_count, const std::vector<Triangle>& triangles,
                                      const std::vector<std::uint32_t>& triangle_patch) {
  const EdgeTable edges = build_edge_table(point_count, triangles);
  std::vector<std::uint32_t> mates(3 * triangles.size(), no_index);
  parallel_ranges(edges.edge_count(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto around = edges.around(static_cast<std::uint32_t>(e));
      for (const std::uint32_t h : around) {
        std::uint32_t found = 0, mate = no_index;
        for (const std::uint32_t other : around)
          if (other != h && triangle_patch[other / 3] == triangle_patch[h / 3]) {
            mate = other;
            ++found;
          }
        if (found == 1) mates[h] = mate;
      }
    }
  });
  return mates;
}

PairedBorders pair_borders(const TriangleSoup& soup, const std::vector<std::uint32_t>& mates,
                           const std::vector<EdgePlace>& split_edges) {
  // Split lines are given by position: weld their ends together with the points.
  std::vector<Vec3> positions = soup.points;
  for (const EdgePlace& edge : split_edges) positions.insert(positions.end(), edge.begin(), edge.end());
  const std::vector<std::uint32_t> place = weld_points(positions).id;
  std::vector<std::array<std::uint32_t, 2>> selected;
  for (std::size_t i = soup.points.size(); i < place.size(); i += 2)
    selected.push_back({std::min(place[i], place[i + 1]), std::max(place[i], place[i + 1])});
  std::sort(selected.begin(), selected.end());

  std::vector<Lip> lips;
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (mates[h] != no_index) continue;
    const std::uint32_t a = place[soup.triangles[h / 3][h % 3]], b = place[soup.triangles[h / 3][(h % 3 + 1) % 3]];
    if (a != b) lips.push_back({{std::min(a, b), std::max(a, b)}, h, a < b});
  }
  sort_total_order(
      lips, [](const Lip& x, const Lip& y) { return x.ends != y.ends ? x.ends < y.ends : x.half_edge < y.half_edge; });

  PairedBorders out;
  const auto entity = [&](const Lip& lip) { return soup.patch_entity[soup.triangle_patch[lip.half_edge / 3]]; };
  struct Candidate {
    double deviation;
    std::size_t i, j;
  };
  std::vector<Candidate> candidates;
  std::vector<std::size_t> turned, wanted;  // lips that have a flat partner, but facing the wrong way; or a good one
  for (std::size_t begin = 0, end = 0; begin < lips.size(); begin = end) {
    while (end < lips.size() && lips[end].ends == lips[begin].ends) ++end;
    const std::size_t n = end - begin;
    if (n < 2 || (!selected.empty() && !std::binary_search(selected.begin(), selected.end(), lips[begin].ends)))
      continue;
    const double most = std::numbers::pi / 2 / static_cast<double>(n);
    candidates.clear();
    turned.clear();
    wanted.clear();
    std::vector<Vec3> ways;
    for (std::size_t i = begin; i < end; ++i) ways.push_back(way_in(soup, lips[i].half_edge));
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = i + 1; j < end; ++j) {
        const double deviation = deviation_of(ways[i - begin], ways[j - begin]);
        if (!(deviation <= most) || entity(lips[i]) != entity(lips[j])) continue;
        auto& list = lips[i].runs_up == lips[j].runs_up ? turned : wanted;
        list.insert(list.end(), {i, j});
        if (lips[i].runs_up != lips[j].runs_up) candidates.push_back({deviation, i, j});
      }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
      return x.deviation != y.deviation ? x.deviation < y.deviation : x.i != y.i ? x.i < y.i : x.j < y.j;
    });
    std::vector<char> used(n, 0);
    for (const Candidate& c : candidates) {
      if (used[c.i - begin] || used[c.j - begin]) continue;
      used[c.i - begin] = used[c.j - begin] = 1;
      out.pairs.push_back({lips[c.i].half_edge, lips[c.j].half_edge, c.deviation});
    }
    const auto is_in = [](const std::vector<std::size_t>& list, std::size_t i) {
      return std::find(list.begin(), list.end(), i) != list.end();
    };
    for (std::size_t i = begin; i < end; ++i) {
      if (used[i - begin]) continue;
      const bool has_kin = std::any_of(
          lips.begin() + static_cast<std::ptrdiff_t>(begin), lips.begin() + static_cast<std::ptrdiff_t>(end),
          [&](const Lip& other) { return other.half_edge != lips[i].half_edge && entity(other) == entity(lips[i]); });
      if (!has_kin) continue;  // a contact with other surfaces, not a split
      out.refused.push_back({lips[i].half_edge, is_in(wanted, i)   ? LipRefusal::taken
                                                : is_in(turned, i) ? LipRefusal::orientation
                                                                   : LipRefusal::fold});
    }
  }
  std::sort(out.pairs.begin(), out.pairs.end(), [](const LipPair& a, const LipPair& b) { return a.first < b.first; });
  std::sort(out.refused.begin(), out.refused.end(),
            [](const RefusedLip& a, const RefusedLip& b) { return a.half_edge < b.half_edge; });
  return out;
}

}  // namespace strataflow
