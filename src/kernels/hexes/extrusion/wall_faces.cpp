#include "kernels/hexes/extrusion/wall_faces.h"

#include <algorithm>
#include <array>

#include "kernels/topology/sorted_unique.h"

namespace strataflow {
namespace {

struct WallEdge {
  std::uint32_t a = 0, b = 0, entity = 0;
};
bool by_ends(const WallEdge& x, const WallEdge& y) {
  return std::array{x.a, x.b, x.entity} < std::array{y.a, y.b, y.entity};
}

}  // namespace

std::vector<std::uint32_t> walls_of_faces(const LayeredSpace& space) {
  const LabelledTets& model = space.model;
  const StratigraphicTets& layers = space.layers;
  std::vector<std::uint32_t> walls(4 * layers.tets.size(), no_index);
  std::vector<WallEdge> edges;
  const bool has_closed_units = layers.tets.size() > layers.model_tets;
  for (std::uint32_t face = 0; face < 4 * layers.model_tets; ++face) {
    if (!model.is_wall(face)) continue;
    const SheetFacet& facet = model.facets[model.facet_of[face]];
    walls[face] = facet.entity;
    for (std::size_t k = 0; has_closed_units && k < 3; ++k) {
      const std::uint32_t a = facet.vertices[k], b = facet.vertices[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), facet.entity});
    }
  }
  std::sort(edges.begin(), edges.end(), by_ends);
  for (std::uint32_t face = 4 * layers.model_tets; face < walls.size(); ++face) {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t copy : face_vertices(layers.tets[face / 4], face % 4))
      points.push_back(layers.point[copy]);
    points = sorted_unique(std::move(points));
    if (points.size() != 2) continue;
    const auto edge = std::lower_bound(edges.begin(), edges.end(), WallEdge{points[0], points[1], 0}, by_ends);
    if (edge != edges.end() && edge->a == points[0] && edge->b == points[1]) walls[face] = edge->entity;
  }
  return walls;
}

}  // namespace strataflow
