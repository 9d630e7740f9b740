#include "kernels/volumes/split_surfaces.h"

#include <algorithm>
#include <array>

#include "model/volume_mesh.h"

namespace strataflow {

namespace {

/// The directed edges of a triangle, to be matched with their reverses.
struct PieceEdge {
  std::uint32_t low = 0, high = 0;
  std::uint32_t piece = 0;
};

/// Turns `pieces`, the triangles of one facet in any orientation, like the facet (a, b, c) and walks their border:
/// from a to b, b to c, c to a, corners included. False if they are not a disk with these corners.
bool orient_pieces(std::vector<Triangle>& pieces, const Triangle& facet,
                   std::array<std::vector<std::uint32_t>, 3>& sides) {
  std::vector<PieceEdge> edges;
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = pieces[i][k], b = pieces[i][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), i});
    }
  std::sort(edges.begin(), edges.end(), [](const PieceEdge& a, const PieceEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.piece < b.piece;
  });
  std::vector<PieceEdge> border;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    if (end - i > 2) return false;
    if (end - i == 1) border.push_back(edges[i]);
    i = end;
  }
  // Walk once round from corner a, starting along either border edge there.
  std::vector<std::uint32_t> loop{facet[0]};
  std::vector<std::uint8_t> used(border.size(), 0);
  for (bool is_moving = true; is_moving;) {
    is_moving = false;
    for (std::size_t i = 0; i < border.size() && !is_moving; ++i) {
      if (used[i] || (border[i].low != loop.back() && border[i].high != loop.back())) continue;
      used[i] = 1;
      loop.push_back(border[i].low == loop.back() ? border[i].high : border[i].low);
      is_moving = true;
    }
  }
  if (loop.size() != border.size() + 1 || loop.back() != facet[0]) return false;
  loop.pop_back();
  const auto position = [&loop](std::uint32_t vertex) {
    return std::find(loop.begin(), loop.end(), vertex) - loop.begin();
  };
  if (position(facet[1]) > position(facet[2])) std::reverse(loop.begin() + 1, loop.end());
  std::array<std::size_t, 4> corner{0, static_cast<std::size_t>(position(facet[1])),
                                    static_cast<std::size_t>(position(facet[2])), loop.size()};
  if (corner[2] == loop.size() || corner[1] >= corner[2]) return false;
  for (std::size_t s = 0; s < 3; ++s) {
    sides[s].clear();
    for (std::size_t i = corner[s]; i <= corner[s + 1]; ++i) sides[s].push_back(loop[i % loop.size()]);
  }

  // Border edges fix the turn of their pieces; neighbours turn the opposite way along their common edge.
  const auto has_directed = [](const Triangle& t, std::uint32_t a, std::uint32_t b) {
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
  };
  const auto piece_edge = [&edges](std::uint32_t a, std::uint32_t b) {
    const PieceEdge key{std::min(a, b), std::max(a, b), 0};
    return std::lower_bound(edges.begin(), edges.end(), key, [](const PieceEdge& x, const PieceEdge& y) {
      return x.low != y.low ? x.low < y.low : x.high < y.high;
    });
  };
  std::vector<std::uint8_t> is_turned(pieces.size(), 0);
  std::vector<std::uint32_t> front{piece_edge(loop[0], loop[1])->piece};
  if (!has_directed(pieces[front[0]], loop[0], loop[1])) std::swap(pieces[front[0]][1], pieces[front[0]][2]);
  is_turned[front[0]] = 1;
  std::size_t turned = 1;
  while (!front.empty()) {
    const Triangle piece = pieces[front.back()];
    const std::uint32_t self = front.back();
    front.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = piece[k], b = piece[(k + 1) % 3];
      for (auto edge = piece_edge(a, b);
           edge != edges.end() && edge->low == std::min(a, b) && edge->high == std::max(a, b); ++edge) {
        if (edge->piece == self) continue;
        Triangle& other = pieces[edge->piece];
        const bool is_right = has_directed(other, b, a);
        if (is_turned[edge->piece]) {
          if (!is_right) return false;
          continue;
        }
        if (!is_right) std::swap(other[1], other[2]);
        is_turned[edge->piece] = 1;
        ++turned;
        front.push_back(edge->piece);
      }
    }
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
    if (!has_directed(pieces[piece_edge(a, b)->piece], a, b)) return false;
  }
  return turned == pieces.size();
}

const SplitEdge* find_edge(const std::vector<SplitEdge>& edges, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t first = std::min(a, b), second = std::max(a, b);
  const auto found =
      std::lower_bound(edges.begin(), edges.end(), first, [second](const SplitEdge& edge, std::uint32_t f) {
        return edge.first != f ? edge.first < f : edge.second < second;
      });
  return found != edges.end() && found->first == first && found->second == second ? &*found : nullptr;
}

/// Divides a triangle at the points on its edges, one edge after the other: each point cuts the piece that has it on
/// an edge from that edge to the opposite corner.
void divide(const Triangle& triangle, const std::vector<SplitEdge>& edges, std::vector<Triangle>& pieces) {
  std::vector<Triangle> whole{triangle};
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint32_t a = triangle[k];
    const std::uint32_t b = triangle[(k + 1) % 3];
    const SplitEdge* edge = find_edge(edges, a, b);
    if (!edge) continue;
    std::vector<std::uint32_t> inserted = edge->inserted;
    if (a != edge->first) std::reverse(inserted.begin(), inserted.end());
    for (const std::uint32_t point : inserted) {
      for (std::size_t i = 0; i < whole.size(); ++i) {
        std::size_t c = 0;
        while (c < 3 && !(whole[i][c] == a && whole[i][(c + 1) % 3] == b)) ++c;
        if (c == 3) continue;
        const std::uint32_t opposite = whole[i][(c + 2) % 3];
        whole[i] = {a, point, opposite};
        whole.push_back({point, b, opposite});
        break;
      }
      a = point;
    }
  }
  pieces.insert(pieces.end(), whole.begin(), whole.end());
}

}  // namespace

std::variant<SurfaceSplit, Rejection> surface_split(const RegionBoundary& boundary, const SurfaceTriangles& surfaces,
                                                    const RegionAnswer& answer) {
  const std::size_t old_points = boundary.points.size();
  SurfaceSplit split;
  // Points on facets become points of the surfaces, in TetGen's order; the others stay inside.
  std::vector<std::uint8_t> is_on_surface(answer.points.size(), 0);
  for (const Triangle& piece : answer.subfaces)
    for (const std::uint32_t vertex : piece) is_on_surface[vertex] = 1;
  std::vector<std::uint32_t> surface_point(boundary.points), tet_point(answer.points.size());
  surface_point.resize(answer.points.size(), no_index);
  for (std::uint32_t i = 0; i < old_points; ++i) tet_point[i] = i;
  split.tet_points = boundary.coordinates;
  for (const std::uint8_t wanted : {std::uint8_t{1}, std::uint8_t{0}})
    for (std::size_t i = old_points; i < answer.points.size(); ++i) {
      if (is_on_surface[i] != wanted) continue;
      if (wanted) {
        surface_point[i] = static_cast<std::uint32_t>(surfaces.points.size() + split.points.size());
        split.points.push_back(answer.points[i]);
      }
      tet_point[i] = static_cast<std::uint32_t>(split.tet_points.size());
      split.tet_points.push_back(answer.points[i]);
    }
  split.tets = answer.tets;
  for (Tet& tet : split.tets)
    for (std::uint32_t& vertex : tet) vertex = tet_point[vertex];

  split.facet_pieces.resize(boundary.facets.size());
  for (std::size_t i = 0; i < answer.subfaces.size(); ++i) {
    Triangle piece = answer.subfaces[i];
    for (std::uint32_t& vertex : piece) vertex = surface_point[vertex];
    split.facet_pieces[answer.subface_facet[i]].push_back(piece);
  }
  for (std::size_t f = 0; f < boundary.facets.size(); ++f) {
    std::array<std::vector<std::uint32_t>, 3> sides;
    const Triangle& triangle = surfaces.triangles[boundary.triangles[f]];
    if (split.facet_pieces[f].empty() || !orient_pieces(split.facet_pieces[f], triangle, sides))
      return Rejection{"TetGen lost a triangle of the surfaces"};
    for (std::vector<std::uint32_t>& side : sides) {
      if (side.front() > side.back()) std::reverse(side.begin(), side.end());
      split.edges.push_back({side.front(), side.back(), {side.begin() + 1, side.end() - 1}});
    }
  }
  std::sort(split.edges.begin(), split.edges.end(), [](const SplitEdge& a, const SplitEdge& b) {
    if (a.first != b.first) return a.first < b.first;
    if (a.second != b.second) return a.second < b.second;
    return a.inserted < b.inserted;
  });
  std::vector<SplitEdge> unique_edges;
  for (SplitEdge& edge : split.edges) {
    if (!unique_edges.empty() && unique_edges.back().first == edge.first && unique_edges.back().second == edge.second) {
      if (unique_edges.back().inserted != edge.inserted)
        return Rejection{"two triangles disagree on their common edge"};
      continue;
    }
    unique_edges.push_back(std::move(edge));
  }
  std::erase_if(unique_edges, [](const SplitEdge& edge) { return edge.inserted.empty(); });
  split.edges = std::move(unique_edges);
  return split;
}

SurfaceTriangles with_split(const SurfaceTriangles& surfaces, const RegionBoundary& boundary, const SurfaceSplit& split,
                            std::vector<std::uint8_t>& changed) {
  SurfaceTriangles result;
  result.points = surfaces.points;
  result.points.insert(result.points.end(), split.points.begin(), split.points.end());
  result.point_line = surfaces.point_line;
  result.point_line.resize(result.points.size(), -1);
  changed.assign(surfaces.triangles.size(), 0);
  for (std::size_t t = 0, f = 0; t < surfaces.triangles.size(); ++t) {
    const std::size_t before = result.triangles.size();
    if (f < boundary.triangles.size() && boundary.triangles[f] == t) {
      const std::vector<Triangle>& pieces = split.facet_pieces[f++];
      if (pieces.size() == 1)
        result.triangles.push_back(surfaces.triangles[t]);
      else
        result.triangles.insert(result.triangles.end(), pieces.begin(), pieces.end());
    } else {
      divide(surfaces.triangles[t], split.edges, result.triangles);
    }
    changed[t] = result.triangles.size() - before > 1 ? 1 : 0;
    result.triangle_surface.resize(result.triangles.size(), surfaces.triangle_surface[t]);
  }
  for (const LineSegment& segment : surfaces.segments) {
    std::uint32_t last = segment.first;
    if (const SplitEdge* edge = find_edge(split.edges, segment.first, segment.second))
      for (const std::uint32_t point : edge->inserted) {
        result.segments.push_back({std::min(last, point), std::max(last, point), segment.line});
        result.point_line[point] = static_cast<std::int32_t>(segment.line);
        last = point;
      }
    result.segments.push_back({std::min(last, segment.second), std::max(last, segment.second), segment.line});
  }
  std::sort(result.segments.begin(), result.segments.end(), [](const LineSegment& a, const LineSegment& b) {
    if (a.first != b.first) return a.first < b.first;
    if (a.second != b.second) return a.second < b.second;
    return a.line < b.line;
  });
  return result;
}

}  // namespace strataflow
