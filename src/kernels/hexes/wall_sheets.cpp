#include "kernels/hexes/wall_sheets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {
namespace {

constexpr double crease_cosine = -0.766;  // cos 140°, of the angle between both sides
constexpr double steep_sine = 0.5;        // creases and lines where walls meet that rise by 30° are upright

double rise(const LabelledTets& tets, const std::array<std::uint32_t, 2>& edge) {
  const Vec3 along = tets.points[edge[1]] - tets.points[edge[0]];
  return std::abs(along.z) / length(along);
}

/// From an edge into a triangle, in its plane, unit length.
Vec3 inward(const LabelledTets& tets, const WallSheets::Edge& edge, const WallSheets::Wall& wall) {
  const Vec3& a = tets.points[edge.points[0]];
  Vec3 along = tets.points[edge.points[1]] - a;
  along = (1 / length(along)) * along;
  for (const std::uint32_t v : wall.vertices) {
    if (v == edge.points[0] || v == edge.points[1]) continue;
    Vec3 in = tets.points[v] - a;
    in = in - dot(in, along) * along;
    return (1 / length(in)) * in;
  }
  return {};
}

}  // namespace

std::vector<std::uint32_t> WallSheets::sheets_at(std::uint32_t point) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t wall : point_walls[point]) found.push_back(walls[wall].sheet);
  return sorted_unique(std::move(found));
}

WallSheets find_wall_sheets(const LabelledTets& tets) {
  WallSheets sheets;
  std::vector<std::uint32_t> wall_of(tets.facets.size(), no_index);
  for (std::uint32_t face = 0; face < tets.facet_of.size(); ++face) {
    if (!tets.is_wall(face)) continue;
    std::uint32_t& wall = wall_of[tets.facet_of[face]];
    if (wall != no_index) {
      sheets.walls[wall].tets[1] = face / 4;
      continue;
    }
    wall = static_cast<std::uint32_t>(sheets.walls.size());
    sheets.walls.push_back(
        {face_vertices(tets.tets[face / 4], face % 4), tets.facet_of[face], 0, {face / 4, no_index}, {}});
  }
  struct Side {
    std::array<std::uint32_t, 2> points;
    std::uint32_t wall, side;
  };
  std::vector<Side> sides;
  for (std::uint32_t w = 0; w < sheets.walls.size(); ++w)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = sheets.walls[w].vertices[k], b = sheets.walls[w].vertices[(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, w, k});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.points != b.points ? a.points < b.points : a.wall < b.wall; });
  sheets.point_edges.resize(tets.points.size());
  sheets.point_walls.resize(tets.points.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i == 0 || sides[i].points != sides[i - 1].points) {
      for (const std::uint32_t p : sides[i].points)
        sheets.point_edges[p].push_back(static_cast<std::uint32_t>(sheets.edges.size()));
      sheets.edges.push_back({sides[i].points, {}});
    }
    sheets.edges.back().walls.push_back(sides[i].wall);
    sheets.walls[sides[i].wall].edges[sides[i].side] = static_cast<std::uint32_t>(sheets.edges.size() - 1);
  }
  const auto entity = [&](std::uint32_t wall) { return tets.facets[sheets.walls[wall].facet].entity; };
  UnionFind pieces(sheets.walls.size());
  for (const WallSheets::Edge& edge : sheets.edges)
    for (const std::uint32_t a : edge.walls) {
      if (std::count_if(edge.walls.begin(), edge.walls.end(),
                        [&](std::uint32_t b) { return entity(b) == entity(a); }) != 2)
        continue;
      for (const std::uint32_t b : edge.walls) {
        if (b <= a || entity(b) != entity(a)) continue;
        const double opening = dot(inward(tets, edge, sheets.walls[a]), inward(tets, edge, sheets.walls[b]));
        if (opening < crease_cosine || rise(tets, edge.points) < steep_sine) pieces.unite(a, b);
      }
    }
  for (std::uint32_t w = 0; w < sheets.walls.size(); ++w) {
    const std::uint32_t root = pieces.find(w);
    if (root == w) {
      sheets.walls[w].sheet = static_cast<std::uint32_t>(sheets.sheet_entity.size());
      sheets.sheet_entity.push_back(entity(w));
    } else {
      sheets.walls[w].sheet = sheets.walls[root].sheet;
    }
    for (const std::uint32_t p : sheets.walls[w].vertices) sheets.point_walls[p].push_back(w);
  }
  return sheets;
}

std::vector<char> find_upright_lines(const LabelledTets& tets, const WallSheets& sheets) {
  std::vector<char> is_line;
  is_line.reserve(sheets.edges.size());
  for (const WallSheets::Edge& edge : sheets.edges) {
    const std::uint32_t first = sheets.walls[edge.walls.front()].sheet;
    is_line.push_back(std::any_of(edge.walls.begin(), edge.walls.end(),
                                  [&](std::uint32_t wall) { return sheets.walls[wall].sheet != first; }) &&
                      rise(tets, edge.points) > upright_sine);
  }
  return is_line;
}

Vec3 down_edge(const LabelledTets& tets, const WallSheets::Edge& edge) {
  const Vec3 along = tets.points[edge.points[1]] - tets.points[edge.points[0]];
  return (-1 / along.z) * along;
}

Result<void> check_walls(const LabelledTets& tets, const WallSheets& sheets, double flat_deg) {
  constexpr double tolerated_ratio = 0.05;
  const auto refused = [&](std::uint32_t entity, const std::string& why) {
    const std::string& name = tets.entities[entity].name;
    return Failure{FailureCode::unsupported, name + " " + why, "leave it out with drop_alignment = [\"" + name + "\"]"};
  };
  const double flat_cosine = std::cos(flat_deg * std::numbers::pi / 180);
  std::vector<std::array<double, 2>> area(tets.entities.size(), {0, 0});
  for (const WallSheets::Wall& wall : sheets.walls) {
    const auto& [a, b, c] = wall.vertices;
    const Vec3 n = cross(tets.points[b] - tets.points[a], tets.points[c] - tets.points[a]);
    auto& of_entity = area[tets.facets[wall.facet].entity];
    of_entity[0] += length(n);
    if (std::abs(n.z) > flat_cosine * length(n)) of_entity[1] += length(n);
  }
  for (std::uint32_t e = 0; e < area.size(); ++e)
    if (area[e][1] > tolerated_ratio * area[e][0])
      return refused(e, "is nearly horizontal, so it cannot stand upright");
  // Lines where a sheet ends inside another: mostly upright ones are corners of columns, flat ones mark a Y.
  struct Meeting {
    double flat_m = 0, all_m = 0;
  };
  std::map<std::array<std::uint32_t, 2>, Meeting> lines;  // ending sheet, sheet it ends on
  for (const WallSheets::Edge& edge : sheets.edges)
    for (const std::uint32_t a : edge.walls) {
      const auto in_sheet = [&](std::uint32_t sheet) {
        return std::count_if(edge.walls.begin(), edge.walls.end(),
                             [&](std::uint32_t w) { return sheets.walls[w].sheet == sheet; });
      };
      const std::uint32_t ending = sheets.walls[a].sheet;
      if (in_sheet(ending) != 1 || !(inward(tets, edge, sheets.walls[a]).z > 0)) continue;
      for (const std::uint32_t b : edge.walls) {
        const std::uint32_t other = sheets.walls[b].sheet;
        if (other == ending || in_sheet(other) < 2) continue;
        Meeting& line = lines[{ending, other}];
        const double long_m = 0.5 * length(tets.points[edge.points[1]] - tets.points[edge.points[0]]);
        line.all_m += long_m;
        if (rise(tets, edge.points) < upright_sine) line.flat_m += long_m;
      }
    }
  for (const auto& [pair, line] : lines) {
    if (!(line.flat_m > 0.5 * line.all_m)) continue;
    const std::uint32_t ending = sheets.sheet_entity[pair[0]], other = sheets.sheet_entity[pair[1]];
    return refused(ending, "ends downwards on " + tets.entities[other].name + ": the wedge between them has no plan");
  }
  return {};
}

}  // namespace strataflow
