#include "kernels/hexes/plan_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "kernels/topology/sorted_unique.h"

namespace strataflow {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Polyline polyline_of(const PointChain& chain, const std::vector<Vec3>& plan, std::string name, Role role) {
  Polyline line;
  line.name = std::move(name);
  line.role = role;
  line.is_closed = chain.is_closed;
  for (const std::uint32_t p : chain.points)
    if (line.points.empty() || !(line.points.back() == plan[p])) line.points.push_back(plan[p]);
  return line;
}

double area_m2(const Polyline& line) {
  double twice = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    twice += cross(line.points[i], line.points[(i + 1) % line.points.size()]).z;
  return 0.5 * std::abs(twice);
}

/// Lines where facets of several horizons meet, by the pair of entities (of more than two, the lowest and the highest).
std::map<Edge, std::vector<Edge>> horizon_meetings(const LabelledTets& tets) {
  struct Use {
    Edge edge;
    std::uint32_t entity;
  };
  std::vector<Use> uses;
  for (const SheetFacet& facet : tets.facets) {
    if (facet.kind != SheetKind::horizon) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = facet.vertices[k], b = facet.vertices[(k + 1) % 3];
      uses.push_back({{std::min(a, b), std::max(a, b)}, facet.entity});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.entity < b.entity;
  });
  std::map<Edge, std::vector<Edge>> meetings;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].edge == uses[begin].edge) ++end;
    if (uses[begin].entity != uses[end - 1].entity)
      meetings[{uses[begin].entity, uses[end - 1].entity}].push_back(uses[begin].edge);
  }
  return meetings;
}

}  // namespace

std::optional<Vec3> plan_position(const LabelledTets& tets, const std::vector<Vec3>& plan, double x, double y) {
  for (const SheetFacet& facet : tets.facets) {
    if (facet.kind != SheetKind::top) continue;
    std::array<double, 3> share{};  // barycentric, times twice the area seen from above
    double all = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = tets.points[facet.vertices[(k + 1) % 3]], &b = tets.points[facet.vertices[(k + 2) % 3]];
      share[k] = (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x);
      all += share[k];
    }
    if (all == 0 || std::any_of(share.begin(), share.end(), [&](double s) { return s / all < 0; })) continue;
    Vec3 position;
    for (std::size_t k = 0; k < 3; ++k) position = position + (share[k] / all) * plan[facet.vertices[k]];
    return position;
  }
  return std::nullopt;
}

std::vector<PointChain> chain_edges(std::vector<Edge> edges) {
  for (Edge& edge : edges) std::sort(edge.begin(), edge.end());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<std::array<std::uint32_t, 2>> around;  // point, edge
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t p : edges[e]) around.push_back({p, e});
  std::sort(around.begin(), around.end());
  const auto at = [&](std::uint32_t p) {
    return std::equal_range(around.begin(), around.end(), Edge{p, 0},
                            [](const auto& a, const auto& b) { return a[0] < b[0]; });
  };
  std::vector<char> is_used(edges.size(), 0);
  std::vector<PointChain> chains;
  const auto walk = [&](std::uint32_t edge, std::uint32_t from) {
    PointChain chain;
    chain.points.push_back(from);
    for (std::uint32_t p = from;;) {
      is_used[edge] = 1;
      p = edges[edge][0] == p ? edges[edge][1] : edges[edge][0];
      if (p == from) {
        chain.is_closed = true;
        break;
      }
      chain.points.push_back(p);
      const auto [begin, end] = at(p);
      if (end - begin != 2) break;
      const std::uint32_t next = (*begin)[1] == edge ? (*(begin + 1))[1] : (*begin)[1];
      if (is_used[next]) break;
      edge = next;
    }
    chains.push_back(std::move(chain));
  };
  for (const auto& [p, edge] : around) {
    const auto [begin, end] = at(p);
    if (end - begin != 2 && !is_used[edge]) walk(edge, p);
  }
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (!is_used[e]) walk(e, edges[e][0]);
  return chains;
}

std::vector<Polyline> plan_lines(const LabelledTets& tets, const UprightPlan& upright, bool with_horizon_lines) {
  std::vector<std::vector<Edge>> fault_edges(tets.entities.size());
  std::vector<Edge> side_edges;
  for (const TracedWalls::LowerEdge& low : upright.traced.lower_edges) {
    const WallSheets::Edge& edge = upright.sheets.edges[low.edge];
    for (const std::uint32_t wall : edge.walls) {
      if (upright.sheets.walls[wall].sheet != low.sheet) continue;
      const bool is_side = tets.facets[upright.sheets.walls[wall].facet].kind == SheetKind::side;
      (is_side ? side_edges : fault_edges[upright.sheets.sheet_entity[low.sheet]]).push_back(edge.points);
      break;
    }
  }
  std::vector<Polyline> lines;
  for (const PointChain& chain : chain_edges(side_edges))
    lines.push_back(polyline_of(chain, upright.plan, "outline", Role::outline));
  if (lines.size() > 1) {
    std::size_t largest = 0;
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (area_m2(lines[i]) > area_m2(lines[largest])) largest = i;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (i == largest) continue;
      lines[i].role = Role::hole;
      lines[i].name = "hole_" + std::to_string(i);
    }
  }
  for (std::uint32_t entity = 0; entity < fault_edges.size(); ++entity)
    for (const PointChain& chain : chain_edges(fault_edges[entity]))
      lines.push_back(polyline_of(chain, upright.plan, tets.entities[entity].name, Role::fault));
  if (with_horizon_lines)
    for (const auto& [pair, edges] : horizon_meetings(tets))
      for (const PointChain& chain : chain_edges(edges))
        lines.push_back(polyline_of(chain, upright.plan,
                                    tets.entities[pair[0]].name + "-" + tets.entities[pair[1]].name, Role::curve));
  return lines;
}

}  // namespace strataflow
