#include "kernels/hexes/extrusion/make_hex_facets.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "graph/parallel/parallel_map.h"
#include "kernels/quality/nearest_triangle.h"

namespace strataflow {
namespace {

class FacetMaker {
 public:
  FacetMaker(const HexGrid& grid, const HexFacetSource& source)
      : grid_(grid), source_(source), model_(source.space.model) {}

  std::vector<MeshFacet> make() {
    make_levels();
    make_sides_and_faults();
    return std::move(facets_);
  }

 private:
  std::uint32_t cell(std::uint32_t quad, std::uint32_t layer) const { return quad * grid_.layers + layer; }
  std::uint32_t point_at(std::uint32_t quad, std::uint32_t corner, std::uint32_t level) const {
    const bool is_low = level < grid_.layers;
    return grid_.mesh
        .cell_vertices[8 * std::size_t{cell(quad, is_low ? level : level - 1)} + corner % 4 + (is_low ? 0 : 4)];
  }

  /// The entity with most facets of a kind.
  std::uint32_t main_entity(SheetKind kind) const {
    std::vector<std::uint32_t> count(model_.entities.size() + 1, 0);
    for (const SheetFacet& facet : model_.facets)
      if (facet.kind == kind) ++count[facet.entity];
    return static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
  }

  /// Horizons, top and bottom: the face over the cell below, counter-clockwise from above.
  void make_levels() {
    const StratigraphicTets& layers = source_.space.layers;
    const std::vector<std::uint32_t>& level_of = source_.space.levels.level_of;
    surface_of_level_.assign(grid_.layers + 1, no_index);
    for (std::uint32_t level = 1; level + 1 < layers.level_w.size(); ++level)
      for (std::uint32_t e = 0; e < level_of.size(); ++e)
        if (level_of[e] == level) surface_of_level_[layers.level_w[level]] = e;
    surface_of_level_.front() = main_entity(SheetKind::bottom);
    surface_of_level_.back() = main_entity(SheetKind::top);
    find_nearest();
    const std::vector<std::vector<std::uint32_t>> surfaces = parallel_map(
        grid_.plan.quads.size(),
        [&](std::size_t q) {
          std::vector<std::uint32_t> column(grid_.layers + 1, no_index);
          for (std::uint32_t level = 0; level <= grid_.layers; ++level)
            if (surface_of_level_[level] != no_index)
              column[level] = real_surface(static_cast<std::uint32_t>(q), level);
          return column;
        },
        32);
    for (std::uint32_t level = 0; level <= grid_.layers; ++level) {
      if (surface_of_level_[level] == no_index) continue;
      for (std::uint32_t q = 0; q < grid_.plan.quads.size(); ++q) {
        MeshFacet facet;
        facet.surface = surfaces[q][level];
        for (std::uint32_t c = 0; c < 4; ++c) facet.vertices[c] = point_at(q, level == 0 ? 3 - c : c, level);
        facet.cell_0 = cell(q, level == 0 ? 0 : level - 1);
        facet.cell_1 = level == 0 || level == grid_.layers ? no_index : cell(q, level);
        if (facet.surface != no_index) facets_.push_back(facet);
      }
    }
  }

  /// Seen from the cell, the normal points out.
  void make_sides_and_faults() {
    for (std::uint32_t e = 0; e < source_.edges.edges.size(); ++e) {
      const PlanEdge& edge = source_.edges.edges[e];
      const bool is_side = edge.quads[1] == no_index;
      const std::uint32_t entity = is_side ? side_surface(edge) : edge.faults.empty() ? no_index : edge.faults.front();
      for (std::uint32_t k = 0; k < grid_.layers; ++k) {
        if (!is_side && !source_.is_fault_face(e, k)) continue;
        std::array<MeshFacet, 2> both;
        for (std::size_t s = 0; s < (is_side ? 1u : 2u); ++s) {
          const std::uint32_t q = edge.quads[s], c = edge.sides[s];
          both[s].vertices = {point_at(q, c, k), point_at(q, c + 1, k), point_at(q, c + 1, k + 1),
                              point_at(q, c, k + 1)};
          both[s].cell_0 = cell(q, k);
          both[s].surface = entity;
        }
        auto left = both[0].vertices, right = both[1].vertices;
        std::sort(left.begin(), left.end());
        std::sort(right.begin(), right.end());
        const bool is_one = !is_side && left == right;
        if (is_one) both[0].cell_1 = both[1].cell_0;
        facets_.push_back(both[0]);
        if (!is_side && !is_one) facets_.push_back(both[1]);
      }
    }
  }

  /// Whether a level has no height over the one below it, all over a quad.
  bool is_closed(std::uint32_t quad, std::uint32_t level) const {
    const std::vector<Vec3>& points = grid_.mesh.points;
    for (std::uint32_t c = 0; c < 4; ++c)
      if (!(points[point_at(quad, c, level)] == points[point_at(quad, c, level - 1)])) return false;
    return true;
  }

  /// The surface a level over a quad lies on: where units have no thickness, that of the surface that is there, for
  /// the lowest and the highest of the levels that coincide, and none for those between.
  std::uint32_t real_surface(std::uint32_t quad, std::uint32_t level) const {
    std::uint32_t low = level, high = level;
    while (low > 0 && is_closed(quad, low)) --low;
    while (high < grid_.layers && is_closed(quad, high + 1)) ++high;
    if (low == high) return surface_of_level_[level];
    std::uint32_t first = no_index, last = 0, real = no_index;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t l = low; l <= high; ++l) {
      if (surface_of_level_[l] == no_index) continue;
      first = std::min(first, l);
      last = l;
      const NearestTriangle& nearest = *nearest_[surface_of_level_[l]];
      double squared = 0;
      for (std::uint32_t c = 0; c < 4; ++c)
        squared += nearest.nearest(grid_.mesh.points[point_at(quad, c, l)]).squared_m2;
      if (squared < least - 1e-12 * source_.edge_m * source_.edge_m) {
        least = squared;
        real = surface_of_level_[l];
      }
    }
    return level == first || level == last ? real : no_index;
  }

  /// The triangles of every level's surface, where any layer has closed.
  void find_nearest() {
    nearest_.resize(model_.entities.size());
    if (std::find(grid_.is_dead.begin(), grid_.is_dead.end(), 1) == grid_.is_dead.end()) return;
    for (const std::uint32_t entity : surface_of_level_) {
      if (entity == no_index || nearest_[entity]) continue;
      std::vector<Triangle> triangles;
      for (const SheetFacet& facet : model_.facets)
        if (facet.kind != SheetKind::fault && facet.kind != SheetKind::side && facet.entity == entity)
          triangles.push_back(facet.vertices);
      nearest_[entity] = std::make_unique<NearestTriangle>(TriangleMesh{model_.points, triangles});
    }
  }

  /// The entity of a side: its feature's, or the nearest side facet's.
  std::uint32_t side_surface(const PlanEdge& edge) const {
    if (edge.side_entity >= 0) return static_cast<std::uint32_t>(edge.side_entity);
    const std::vector<Vec3>& plan = source_.space.plan;
    const Vec3 middle = 0.5 * (grid_.plan.points[edge.points[0]] + grid_.plan.points[edge.points[1]]);
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t entity = main_entity(SheetKind::side);
    for (const SheetFacet& facet : model_.facets) {
      if (facet.kind != SheetKind::side) continue;
      const Vec3 d = (1.0 / 3) * (plan[facet.vertices[0]] + plan[facet.vertices[1]] + plan[facet.vertices[2]]) - middle;
      if (dot(d, d) < nearest) {
        nearest = dot(d, d);
        entity = facet.entity;
      }
    }
    return entity;
  }

  const HexGrid& grid_;
  const HexFacetSource& source_;
  const LabelledTets& model_;
  std::vector<std::uint32_t> surface_of_level_;
  std::vector<std::unique_ptr<NearestTriangle>> nearest_;  // per entity that is a level
  std::vector<MeshFacet> facets_;
};

}  // namespace

std::vector<MeshFacet> make_hex_facets(const HexGrid& grid, const HexFacetSource& source) {
  return FacetMaker(grid, source).make();
}

}  // namespace strataflow
