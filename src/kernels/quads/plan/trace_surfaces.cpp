#include "kernels/quads/plan/trace_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/id.h"
#include "kernels/topology/building/weld_points.h"

namespace strataflow {

namespace {

using Edge = std::array<std::uint32_t, 2>;

/// How far the triangle falls away from its edge ab, 1: straight down the dip; −1: it rises; 0: the edge runs down.
double falls_away(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a), into = cross(normal, b - a);  // in the triangle, from the edge towards c
  const double steepness = std::hypot(normal.x, normal.y) / length(normal);
  return -into.z / (length(into) * steepness);
}

/// Edges as chains that end where other than two meet; closed ones repeat their first point.
std::vector<std::vector<std::uint32_t>> chains_of(const std::vector<Edge>& edges) {
  std::map<std::uint32_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const std::uint32_t p : edges[i]) at[p].push_back(i);
  std::vector<char> is_used(edges.size(), 0);
  std::vector<std::vector<std::uint32_t>> chains;
  const auto follow = [&](std::uint32_t from, std::size_t edge) {
    std::vector<std::uint32_t> chain{from};
    for (;;) {
      is_used[edge] = 1;
      chain.push_back(edges[edge][edges[edge][0] == chain.back() ? 1 : 0]);
      const auto& meeting = at.at(chain.back());
      if (meeting.size() != 2) break;
      edge = meeting[meeting[0] == edge ? 1 : 0];
      if (is_used[edge]) break;
    }
    chains.push_back(std::move(chain));
  };
  for (const auto& [p, meeting] : at)
    for (const std::size_t edge : meeting)
      if (meeting.size() != 2 && !is_used[edge]) follow(p, edge);
  for (const auto& [p, meeting] : at)
    if (!is_used[meeting[0]]) follow(p, meeting[0]);
  return chains;
}

}  // namespace

std::vector<Polyline> traces_of_surfaces(const TriangleSoup& soup) {
  const WeldedPoints welded = weld_points(soup.points);
  struct Side {
    Edge edge;
    double falls;
  };
  std::vector<std::vector<Side>> sides(soup.entities.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Triangle& c = soup.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % 3];
      const auto [low, high] = std::minmax(welded.id[a], welded.id[b]);
      sides[soup.patch_entity[soup.triangle_patch[t]]].push_back(
          {{low, high}, falls_away(soup.points[a], soup.points[b], soup.points[c[(k + 2) % 3]])});
    }
  }
  std::vector<Polyline> traces;
  for (std::size_t e = 0; e < sides.size(); ++e) {
    std::sort(sides[e].begin(), sides[e].end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
    std::vector<Edge> upper;
    constexpr double near_the_dip = 0.5;  // cos 60°
    for (std::size_t i = 0; i < sides[e].size(); ++i) {
      const bool is_border = (i == 0 || sides[e][i - 1].edge != sides[e][i].edge) &&
                             (i + 1 == sides[e].size() || sides[e][i + 1].edge != sides[e][i].edge);
      if (is_border && sides[e][i].falls > near_the_dip) upper.push_back(sides[e][i].edge);
    }
    for (const auto& chain : chains_of(upper)) {
      Polyline line{soup.entities[e].name, soup.entities[e].role, {}, chain.size() > 3 && chain.front() == chain.back()};
      for (std::size_t i = 0; i + (line.is_closed ? 1 : 0) < chain.size(); ++i)
        line.points.push_back(soup.points[welded.source[chain[i]]]);
      traces.push_back(std::move(line));
    }
  }
  return traces;
}

}  // namespace strataflow
