#include "kernels/complexity/contact_wedges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/topology/building/radial_order.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {
constexpr double degrees = 180 / std::numbers::pi;

std::size_t edge_count(const Line& line) { return line.is_closed() ? line.vertices.size() : line.vertices.size() - 1; }
}  // namespace

std::vector<ContactWedge> find_contact_wedges(const StructuralModel& model, const EdgeTable& edges) {
  const auto per_line = parallel_map(model.lines.size(), [&](std::size_t l) {
    std::vector<ContactWedge> wedges;
    const Line& line = model.lines[l];
    for (std::size_t i = 0; i < edge_count(line); ++i) {
      const std::uint32_t v = line.vertices[i], w = line.vertices[(i + 1) % line.vertices.size()];
      const std::uint32_t e = find_edge(edges, v, w);
      if (e == no_index) continue;
      const Vec3 &low = model.points[edges.edges[e][0]], &high = model.points[edges.edges[e][1]];
      const double along = length(high - low);
      const RadialOrder order = radial_order(model.points, model.triangles, edges.around(e));
      if (order.is_ambiguous || !(along > 0)) continue;
      const Vec3 axis = (1 / along) * (high - low);
      const auto away = [&](std::uint32_t half_edge) {  // across the edge, into the triangle
        const Vec3 to = model.points[model.triangles[half_edge / 3][(half_edge + 2) % 3]] - low;
        return to - dot(to, axis) * axis;
      };
      const std::size_t count = order.half_edges.size();
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t here = order.half_edges[k], next = order.half_edges[(k + 1) % count];
        const Vec3 from = away(here), to = away(next);
        double angle = std::atan2(dot(cross(from, to), axis), dot(from, to)) * degrees;
        if (count == 1) angle = 360;
        if (angle < 0) angle += 360;
        // The normal of a triangle that runs along the axis points to where the angle grows.
        const Surface& surface = model.surfaces[model.triangle_surface[here / 3]];
        const bool runs_along = model.triangles[here / 3][here % 3] == edges.edges[e][0];
        wedges.push_back({static_cast<std::uint32_t>(l), static_cast<std::uint32_t>(i),
                          runs_along ? surface.region_plus : surface.region_minus, model.triangle_surface[here / 3],
                          model.triangle_surface[next / 3], angle, along});
      }
    }
    return wedges;
  });
  std::vector<ContactWedge> wedges;
  for (const auto& some : per_line) wedges.insert(wedges.end(), some.begin(), some.end());
  return wedges;
}

std::vector<std::uint32_t> line_of_edges(const StructuralModel& model, const EdgeTable& edges) {
  std::vector<std::uint32_t> line_of(edges.edge_count(), no_index);
  for (std::size_t l = 0; l < model.lines.size(); ++l) {
    const Line& line = model.lines[l];
    for (std::size_t i = 0; i < edge_count(line); ++i)
      if (const std::uint32_t e = find_edge(edges, line.vertices[i], line.vertices[(i + 1) % line.vertices.size()]);
          e != no_index)
        line_of[e] = static_cast<std::uint32_t>(l);
  }
  return line_of;
}

std::vector<CornerAngle> find_corner_angles(const StructuralModel& model, const EdgeTable& edges) {
  const std::vector<std::uint32_t> line_of = line_of_edges(model, edges);
  // Corners of triangles at a corner of the model, by surface.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> fans;
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (const std::int32_t corner = model.point_corner[model.triangles[t][k]]; corner >= 0)
        fans[{model.triangle_surface[t], static_cast<std::uint32_t>(corner)}].push_back(3 * t + k);
  std::vector<CornerAngle> angles;
  for (const auto& [key, fan] : fans) {
    // Triangles join across edges inside the surface; what holds together lies between two borders.
    UnionFind joined(fan.size());
    const auto place_of = [&](std::uint32_t triangle) {
      const auto found = std::lower_bound(fan.begin(), fan.end(), 3 * triangle);
      return static_cast<std::uint32_t>(found - fan.begin());
    };
    std::vector<double> angle(fan.size(), 0);
    bool has_border = false;
    for (std::uint32_t i = 0; i < fan.size(); ++i) {
      const std::uint32_t t = fan[i] / 3, k = fan[i] % 3;
      for (const std::uint32_t h : {3 * t + k, 3 * t + (k + 2) % 3}) {
        const std::uint32_t e = edges.edge_of[h];
        if (line_of[e] != no_index)
          has_border = true;
        else
          for (const std::uint32_t other : edges.around(e)) joined.unite(i, place_of(other / 3));
      }
    }
    if (!has_border) continue;  // the corner stands inside the surface
    for (std::uint32_t i = 0; i < fan.size(); ++i) {
      const Triangle& triangle = model.triangles[fan[i] / 3];
      const std::uint32_t k = fan[i] % 3;
      const Vec3 &at = model.points[triangle[k]], to = model.points[triangle[(k + 1) % 3]] - at,
                 from = model.points[triangle[(k + 2) % 3]] - at;
      angle[joined.find(i)] += std::atan2(length(cross(to, from)), dot(to, from)) * degrees;
    }
    double smallest = 360;
    for (std::uint32_t i = 0; i < fan.size(); ++i)
      if (joined.find(i) == i) smallest = std::min(smallest, angle[i]);
    angles.push_back({key.first, key.second, smallest});
  }
  return angles;
}

}  // namespace strataflow
