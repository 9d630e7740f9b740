#include "kernels/complexity/cells/ball_pieces.h"

#include <array>
#include <cmath>
#include <numbers>

#include "graph/parallel/parallel_map.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 16;  ///< balls

/// The part [from, to] of a segment inside a ball; empty if from ≥ to.
std::array<double, 2> part_inside(const Vec3& centre, double radius, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a, away = a - centre;
  const double square = dot(along, along), middle = dot(along, away);
  const double discriminant = middle * middle - square * (dot(away, away) - radius * radius);
  if (!(square > 0) || !(discriminant > 0)) return {0, 0};
  const double root = std::sqrt(discriminant);
  return {std::max(0.0, (-middle - root) / square), std::min(1.0, (-middle + root) / square)};
}

/// Area of a triangle within a ball: the sum over its edges of what lies between the edge and the centre's foot point,
/// straight where the edge is inside the circle that the plane cuts from the ball, round elsewhere.
double area_inside(const Vec3& centre, double radius, const std::array<Vec3, 3>& corners) {
  Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double size = length(normal);
  if (!(size > 0)) return 0;
  normal = (1 / size) * normal;
  const double height = dot(centre - corners[0], normal), square = radius * radius - height * height;
  if (!(square > 0)) return 0;
  const Vec3 foot = centre - height * normal;
  const double circle = std::sqrt(square);
  double twice = 0;
  const auto round = [&](const Vec3& p, const Vec3& q) {
    twice += square * std::atan2(dot(cross(p, q), normal), dot(p, q));
  };
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = corners[k] - foot, b = corners[(k + 1) % 3] - foot;
    const auto [from, to] = part_inside({}, circle, a, b);
    if (!(from < to)) {
      round(a, b);
      continue;
    }
    const Vec3 in = a + from * (b - a), out = a + to * (b - a);
    if (from > 0) round(a, in);
    twice += dot(cross(in, out), normal);
    if (to < 1) round(out, b);
  }
  return std::max(0.0, 0.5 * twice);
}

template <class BoxOf>
BoundingVolumeTree tree_of(std::size_t count, const BoxOf& box_of) {
  std::vector<FloatBox> boxes;
  for (std::size_t i = 0; i < count; ++i) boxes.push_back(enclosing(box_of(i)));
  return BoundingVolumeTree(boxes);
}

}  // namespace

CellPieces cut_by_balls(const StructuralModel& model, const std::vector<Vec3>& centres, double radius_m) {
  struct LineEdge {
    std::uint32_t line, edge;
    Vec3 from, to;
  };
  std::vector<LineEdge> edges;
  for (std::uint32_t l = 0; l < model.lines.size(); ++l) {
    const Line& line = model.lines[l];
    const auto count = static_cast<std::uint32_t>(line.vertices.size());
    for (std::uint32_t i = 0; i < (line.is_closed() ? count : count - 1); ++i)
      edges.push_back({l, i, model.points[line.vertices[i]], model.points[line.vertices[(i + 1) % count]]});
  }
  const BoundingVolumeTree triangles = tree_of(model.triangles.size(), [&](std::size_t t) {
    Box3 box;
    for (const std::uint32_t v : model.triangles[t]) box.take(model.points[v]);
    return box;
  });
  const BoundingVolumeTree segments = tree_of(edges.size(), [&](std::size_t e) {
    Box3 box;
    box.take(edges[e].from);
    box.take(edges[e].to);
    return box;
  });
  const BoundingVolumeTree corners = tree_of(model.corners.size(), [&](std::size_t c) {
    Box3 box;
    box.take(model.points[model.corners[c].vertex]);
    return box;
  });

  struct Ball {
    std::vector<SurfacePiece> surfaces;
    std::vector<LinePiece> lines;
    std::vector<std::uint32_t> corners;
  };
  const auto balls = parallel_map(
      centres.size(),
      [&](std::size_t c) {
        const Vec3& centre = centres[c];
        const Vec3 reach{radius_m, radius_m, radius_m};
        const FloatBox around = enclosing({centre - reach, centre + reach});
        const auto is_inside = [&](const Vec3& p) { return length(p - centre) < radius_m; };
        Ball ball;
        triangles.visit_items(around, [&](std::uint32_t t) {
          const auto [i, j, k] = model.triangles[t];
          const std::array<Vec3, 3> corner{model.points[i], model.points[j], model.points[k]};
          SurfacePiece piece{t, 0, area_inside(centre, radius_m, corner)};
          const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
          bool is_centre_within = true;  // seen along the normal
          for (std::uint32_t e = 0; e < 3; ++e) {
            const Vec3 &a = corner[e], &b = corner[(e + 1) % 3];
            const auto [from, to] = part_inside(centre, radius_m, a, b);
            if (from < to) piece.edges |= 1u << e;
            is_centre_within = is_centre_within && dot(cross(b - a, centre - a), normal) >= 0;
          }
          if (piece.area_m2 > 0 && (piece.edges != 0 || is_centre_within)) ball.surfaces.push_back(piece);
        });
        segments.visit_items(around, [&](std::uint32_t e) {
          const LineEdge& edge = edges[e];
          const auto [from, to] = part_inside(centre, radius_m, edge.from, edge.to);
          if (!(from < to)) return;
          const std::uint32_t ends = (is_inside(edge.from) ? 1u : 0u) | (is_inside(edge.to) ? 2u : 0u);
          ball.lines.push_back({edge.line, edge.edge, ends, 0, (to - from) * length(edge.to - edge.from)});
        });
        corners.visit_items(around, [&](std::uint32_t corner) {
          if (is_inside(model.points[model.corners[corner].vertex])) ball.corners.push_back(corner);
        });
        return ball;
      },
      grain);
  CellPieces result;
  result.sites = centres;
  result.resolution_m = radius_m * std::cbrt(4 * std::numbers::pi / 3);
  for (const Ball& ball : balls) {
    result.surface_pieces.insert(result.surface_pieces.end(), ball.surfaces.begin(), ball.surfaces.end());
    result.line_pieces.insert(result.line_pieces.end(), ball.lines.begin(), ball.lines.end());
    result.corners.insert(result.corners.end(), ball.corners.begin(), ball.corners.end());
    result.first_surface.push_back(static_cast<std::uint32_t>(result.surface_pieces.size()));
    result.first_line.push_back(static_cast<std::uint32_t>(result.line_pieces.size()));
    result.first_corner.push_back(static_cast<std::uint32_t>(result.corners.size()));
  }
  return result;
}

}  // namespace strataflow
