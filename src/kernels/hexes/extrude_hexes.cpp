#include "kernels/hexes/extrude_hexes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <unordered_map>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/hexes/tet_locator.h"
#include "kernels/quality/measure_cell.h"
#include "kernels/quality/nearest_triangle.h"

namespace strataflow {
namespace {

Failure bad_plan(std::string what) {
  return {FailureCode::invalid_input, std::move(what), "make the plan from the curves of this model"};
}

/// An edge of the plan and the quads beside it; side k of a quad runs from its corner k to corner k + 1.
struct PlanEdge {
  std::array<std::uint32_t, 2> points{};
  std::array<std::uint32_t, 2> quads{no_index, no_index};
  std::array<std::uint32_t, 2> sides{};
  std::vector<std::uint32_t> faults;      ///< entities the edge is a trace of
  std::int32_t side_entity = -1;          ///< of the boundary
};

/// Where a corner of a quad lies at each level, on a fault.
struct Lift {
  std::uint32_t tet = no_index;
  double outside_m = 0;
  Vec3 position;
  bool is_unreached = false;
};

/// The triangles of one fault, to be hit by rays.
class FaultSurface {
 public:
  explicit FaultSurface(const LabelledTets& model, std::uint32_t entity) : points_(&model.points) {
    for (const SheetFacet& facet : model.facets)
      if (facet.kind == SheetKind::fault && facet.entity == entity) triangles_.push_back(facet.vertices);
    std::vector<FloatBox> boxes;
    for (const Triangle& t : triangles_) {
      Box3 box;
      for (const std::uint32_t v : t) box.take((*points_)[v]);
      boxes.push_back(enclosing(box));
    }
    tree_ = BoundingVolumeTree(boxes);
  }

  /// Whether the closed segment meets a closed triangle, decided exactly: rays through common edges are not lost.
  bool meets(const Vec3& a, const Vec3& b) const {
    Box3 box;
    box.take(a);
    box.take(b);
    bool is_met = false;
    tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
      const Vec3 &p = (*points_)[triangles_[t][0]], &q = (*points_)[triangles_[t][1]], &r = (*points_)[triangles_[t][2]];
      const int from = orientation_3d(p, q, r, a), to = orientation_3d(p, q, r, b);
      if (is_met || from == to) return;
      const int u = orientation_3d(a, b, p, q), v = orientation_3d(a, b, q, r), w = orientation_3d(a, b, r, p);
      is_met = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    });
    return is_met;
  }

 private:
  const std::vector<Vec3>* points_;
  std::vector<Triangle> triangles_;
  BoundingVolumeTree tree_;
};

class Extrusion {
 public:
  Extrusion(const LayeredSpace& space, const QuadMesh& plan, const ExtrudeOptions& options)
      : space_(space), plan_(plan), options_(options), layers_(space.layers.layer_count()),
        edge_m_(mean_edge_m(plan)), locator_(space, edge_m_) {}

  Result<ExtrudedHexes> extrude() {
    if (const Result<void> found = find_edges(); !found) return found.failure();
    find_wedges();
    lift_quad_centres();
    if (!outside_.empty())
      return bad_plan("the quad around (" + std::to_string(outside_[0].x) + ", " + std::to_string(outside_[0].y) +
                      ") lies outside the model");
    lift_fault_corners();
    find_fault_faces();
    place_points();
    make_cells();
    make_facets();
    judge_cells(result_);
    return std::move(result_);
  }

 private:
  static double mean_edge_m(const QuadMesh& plan) {
    const double sum = ordered_reduce(
        plan.quads.size(), 0.0,
        [&](std::size_t q) {
          double around = 0;
          for (std::size_t k = 0; k < 4; ++k)
            around += length(plan.points[plan.quads[q][k]] - plan.points[plan.quads[q][(k + 1) % 4]]);
          return around;
        },
        std::plus<double>());
    return plan.quads.empty() ? 1 : sum / (4.0 * static_cast<double>(plan.quads.size()));
  }

  std::uint32_t entity_named(const std::string& name) const {
    for (std::uint32_t e = 0; e < space_.model.entities.size(); ++e)
      if (space_.model.entities[e].name == name) return e;
    return no_index;
  }

  Result<void> find_edges() {
    struct Side {
      std::uint32_t a, b, quad, side;
    };
    std::vector<Side> sides;
    for (std::uint32_t q = 0; q < plan_.quads.size(); ++q)
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t a = plan_.quads[q][k], b = plan_.quads[q][(k + 1) % 4];
        if (a >= plan_.points.size() || b >= plan_.points.size() || a == b) return bad_plan("a quad is not one");
        sides.push_back({std::min(a, b), std::max(a, b), q, k});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      return std::array{x.a, x.b, x.quad, x.side} < std::array{y.a, y.b, y.quad, y.side};
    });
    edge_of_.assign(4 * plan_.quads.size(), 0);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const bool is_second = i > 0 && sides[i].a == sides[i - 1].a && sides[i].b == sides[i - 1].b;
      if (!is_second) edges_.push_back({});
      PlanEdge& edge = edges_.back();
      if (is_second && edge.quads[1] != no_index) return bad_plan("three quads share an edge");
      edge.points = {sides[i].a, sides[i].b};
      edge.quads[is_second ? 1 : 0] = sides[i].quad;
      edge.sides[is_second ? 1 : 0] = sides[i].side;
      edge_of_[4 * sides[i].quad + sides[i].side] = static_cast<std::uint32_t>(edges_.size() - 1);
    }
    is_on_fault_.assign(plan_.points.size(), 0);
    for (const FeatureEdge& on : plan_.edges) {
      if (on.feature >= plan_.features.size()) return bad_plan("an edge lies on a feature that is not there");
      const Feature& feature = plan_.features[on.feature];
      const std::array<std::uint32_t, 2> ends{on.a, on.b};
      const auto edge = std::lower_bound(edges_.begin(), edges_.end(), ends,
                                         [](const PlanEdge& e, const auto& key) { return e.points < key; });
      if (edge == edges_.end() || edge->points != ends) return bad_plan(feature.name + " leaves the edges of the quads");
      const std::uint32_t entity = entity_named(feature.name);
      if (edge->quads[1] == no_index && entity != no_index) edge->side_entity = static_cast<std::int32_t>(entity);
      if (feature.role != Role::fault || edge->quads[1] == no_index || feature.strip_quads > 0) continue;
      if (entity == no_index) return bad_plan("the plan follows " + feature.name + ", which the model has not");
      edge->faults.push_back(entity);
      for (const std::uint32_t p : ends) is_on_fault_[p] = 1;
      if (surface_of_.emplace(entity, surfaces_.size()).second) surfaces_.emplace_back(space_.model, entity);
    }
    return {};
  }

  /// Corners of quads around each point.
  void find_wedges() {
    first_wedge_.assign(plan_.points.size() + 1, 0);
    for (const auto& quad : plan_.quads)
      for (const std::uint32_t p : quad) ++first_wedge_[p + 1];
    for (std::size_t p = 0; p < plan_.points.size(); ++p) first_wedge_[p + 1] += first_wedge_[p];
    wedges_.resize(4 * plan_.quads.size());
    std::vector<std::uint32_t> next = first_wedge_;
    for (std::uint32_t q = 0; q < plan_.quads.size(); ++q)
      for (std::uint32_t k = 0; k < 4; ++k) wedges_[next[plan_.quads[q][k]]++] = 4 * q + k;
    local_edge_m_.assign(plan_.points.size(), std::numeric_limits<double>::infinity());
    for (const PlanEdge& edge : edges_)
      for (const std::uint32_t p : edge.points)
        local_edge_m_[p] = std::min(local_edge_m_[p], length(plan_.points[edge.points[0]] - plan_.points[edge.points[1]]));
  }

  /// The tetrahedra below the centres of quads: of all layers' middles, for regions, and of all levels beside faults.
  void lift_quad_centres() {
    const std::vector<std::vector<TetLocator::Place>> places = parallel_map(
        plan_.quads.size(),
        [&](std::size_t q) {
          bool is_beside_fault = false;
          Vec3 centre;
          for (const std::uint32_t p : plan_.quads[q]) {
            centre = centre + 0.25 * plan_.points[p];
            is_beside_fault = is_beside_fault || is_on_fault_[p];
          }
          std::vector<TetLocator::Place> column;
          for (std::uint32_t k = 0; k < layers_; ++k) column.push_back(locator_.locate(locator_.at(centre, k + 0.5), edge_m_));
          for (std::uint32_t level = 0; is_beside_fault && level <= layers_; ++level)
            column.push_back(locator_.locate(locator_.at(centre, level), edge_m_));
          return column;
        },
        16);
    for (std::uint32_t q = 0; q < places.size(); ++q) {
      for (const TetLocator::Place& place : places[q])
        if (place.tet == no_index) {
          outside_.push_back(plan_.points[plan_.quads[q][0]]);
          break;
        }
    }
    centre_places_ = places;
  }

  /// The tetrahedron for a corner on a fault: that of the ball around it nearest to the one below the quad's centre,
  /// counted in steps that cross no fault; of those connected with it in the ball, the one that holds the corner best.
  Lift lift_on_fault(std::uint32_t corner, std::uint32_t level) const {
    const std::uint32_t q = corner / 4, point = plan_.quads[q][corner % 4];
    const Vec3 p = locator_.at(plan_.points[point], level);
    const std::uint32_t below_centre = centre_places_[q][layers_ + level].tet;
    if (options_.uses_barycentre_tet)
      return {below_centre, locator_.outside_m(below_centre, p), locator_.lifted(below_centre, p), false};
    const std::vector<std::uint32_t> ball = locator_.in_ball(p, options_.ball_ratio * local_edge_m_[point]);
    const auto in_ball = [&](std::uint32_t t) { return std::binary_search(ball.begin(), ball.end(), t); };
    std::uint32_t start = no_index;
    constexpr std::size_t most_visited = 50000;
    std::unordered_map<std::uint32_t, char> visited{{below_centre, 1}};  // looked up, never iterated over
    std::vector<std::uint32_t> front{below_centre}, next;
    while (!ball.empty() && !front.empty() && visited.size() < most_visited) {
      for (const std::uint32_t t : front)
        if (in_ball(t)) start = std::min(start, t);
      if (start != no_index) break;
      next.clear();
      for (const std::uint32_t t : front)
        for (std::uint32_t k = 0; k < 4; ++k) {
          const std::uint32_t other = space_.layers.neighbour[4 * t + k];
          if (other != no_index && visited.emplace(other / 4, 1).second) next.push_back(other / 4);
        }
      front.swap(next);
    }
    if (start == no_index) {
      const TetLocator::Place place = locator_.locate(p, edge_m_);
      const std::uint32_t tet = place.tet == no_index ? below_centre : place.tet;
      return {tet, locator_.outside_m(tet, p), locator_.lifted(tet, p), true};
    }
    std::vector<char> is_reached(ball.size(), 0);
    const auto place_of = [&](std::uint32_t t) {
      return static_cast<std::size_t>(std::lower_bound(ball.begin(), ball.end(), t) - ball.begin());
    };
    std::vector<std::uint32_t> stack{start};
    is_reached[place_of(start)] = 1;
    Lift best{no_index, std::numeric_limits<double>::infinity(), {}, false};
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      const double outside = locator_.outside_m(t, p);
      if (outside < best.outside_m || (outside == best.outside_m && t < best.tet)) best = {t, outside, {}, false};
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t other = space_.layers.neighbour[4 * t + k];
        if (other == no_index || !in_ball(other / 4) || is_reached[place_of(other / 4)]) continue;
        is_reached[place_of(other / 4)] = 1;
        stack.push_back(other / 4);
      }
    }
    std::vector<std::uint32_t> reached;
    for (std::size_t i = 0; i < ball.size(); ++i)
      if (is_reached[i]) reached.push_back(ball[i]);
    best.position = position_in(best, reached, p);
    return best;
  }

  /// The position of p: where it lies a little outside, that of the nearest point of its level in one of the candidates,
  /// so that it stays on horizons, faults and sides.
  Vec3 position_in(const Lift& best, const std::vector<std::uint32_t>& candidates, const Vec3& p) const {
    if (best.outside_m <= 1e-9 * edge_m_) return locator_.lifted(best.tet, p);
    TetLocator::LevelPoint nearest{p, std::numeric_limits<double>::infinity()};
    std::uint32_t tet = best.tet;
    for (const std::uint32_t t : candidates) {
      const TetLocator::LevelPoint one = locator_.nearest_at_level(t, p);
      if (!(one.distance_m < nearest.distance_m)) continue;
      nearest = one;
      tet = t;
    }
    return locator_.lifted(tet, nearest.at);
  }

  void lift_fault_corners() {
    lifts_of_.assign(4 * plan_.quads.size(), no_index);
    std::vector<std::uint32_t> corners;
    for (std::uint32_t c = 0; c < lifts_of_.size(); ++c) {
      if (!is_on_fault_[plan_.quads[c / 4][c % 4]]) continue;
      lifts_of_[c] = static_cast<std::uint32_t>(corners.size()) * (layers_ + 1);
      corners.push_back(c);
    }
    lifts_ = parallel_map(
        corners.size() * (layers_ + 1),
        [&](std::size_t i) {
          return lift_on_fault(corners[i / (layers_ + 1)], static_cast<std::uint32_t>(i % (layers_ + 1)));
        },
        16);
  }

  const Lift& lift(std::uint32_t quad, std::uint32_t corner, std::uint32_t level) const {
    return lifts_[lifts_of_[4 * quad + corner % 4] + level];
  }

  /// Per fault edge and layer, whether the fault is there: a ray through the middle of the vertical quad, seen from
  /// either side, meets it (S15).
  void find_fault_faces() {
    is_fault_.assign(edges_.size(), {});
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      if (!edges_[e].faults.empty()) candidates.push_back(e);
    const std::vector<std::vector<char>> found = parallel_map(candidates.size(), [&](std::size_t i) {
      const PlanEdge& edge = edges_[candidates[i]];
      const double reach = length(plan_.points[edge.points[0]] - plan_.points[edge.points[1]]);
      std::vector<char> is_there(layers_, 0);
      for (std::uint32_t k = 0; k < layers_; ++k)
        for (std::size_t side = 0; side < 2 && !is_there[k]; ++side) {
          const std::uint32_t q = edge.quads[side], s = edge.sides[side];
          const Vec3 &a = lift(q, s, k).position, &b = lift(q, s + 1, k).position;
          const Vec3 &c = lift(q, s + 1, k + 1).position, &d = lift(q, s, k + 1).position;
          Vec3 n = cross(c - a, d - b);
          if (!(length(n) > 1e-12 * reach * reach)) n = cross(b - a, Vec3{0, 0, 1});  // a dead cell's face
          if (!(length(n) > 0)) continue;
          n = (reach / length(n)) * n;
          const Vec3 middle = 0.25 * (a + b + c + d);
          for (const std::uint32_t fault : edge.faults)
            is_there[k] = is_there[k] || surfaces_[surface_of_.at(fault)].meets(middle - n, middle + n);
        }
      return is_there;
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) is_fault_[candidates[i]] = found[i];
  }

  bool is_fault_face(std::uint32_t edge, std::uint32_t layer) const {
    return !is_fault_[edge].empty() && is_fault_[edge][layer];
  }

  /// Points: column by column, level by level; on faults, one per group of cells that no fault face parts.
  void place_points() {
    struct Column {
      std::vector<Vec3> positions;
      std::vector<std::uint32_t> of;  // per wedge and level; empty: per level alone
      double outside_m = 0;
    };
    const std::vector<Column> columns = parallel_map(
        plan_.points.size(),
        [&](std::size_t point) {
          Column column;
          const auto p = static_cast<std::uint32_t>(point);
          const std::uint32_t wedge_count = first_wedge_[p + 1] - first_wedge_[p];
          if (wedge_count == 0) return column;
          if (!is_on_fault_[p]) {
            for (std::uint32_t level = 0; level <= layers_; ++level) {
              const Vec3 at = locator_.at(plan_.points[p], level);
              TetLocator::Place place = locator_.locate(at, edge_m_);
              if (place.tet == no_index) place.tet = centre_places_[wedges_[first_wedge_[p]] / 4][0].tet;
              const Lift one{place.tet, place.outside_m, {}, false};
              const bool is_outside = place.outside_m > 1e-9 * edge_m_;
              column.positions.push_back(position_in(
                  one, is_outside ? locator_.in_ball(at, std::max(2 * place.outside_m, 0.2 * edge_m_))
                                  : std::vector<std::uint32_t>{},
                  at));
              column.outside_m = std::max(column.outside_m, place.outside_m);
            }
            return column;
          }
          column.of.assign(std::size_t{wedge_count} * (layers_ + 1), 0);
          for (std::uint32_t level = 0; level <= layers_; ++level) {
            const std::vector<std::uint32_t> group = groups_around(p, level);
            for (std::uint32_t i = 0; i < wedge_count; ++i) {
              std::uint32_t& number = column.of[std::size_t{i} * (layers_ + 1) + level];
              if (group[i] != i) {
                number = column.of[std::size_t{group[i]} * (layers_ + 1) + level];
                continue;
              }
              number = static_cast<std::uint32_t>(column.positions.size());
              const Lift* best = nullptr;
              for (std::uint32_t j = i; j < wedge_count; ++j) {
                const std::uint32_t corner = wedges_[first_wedge_[p] + j];
                const Lift& one = lifts_[lifts_of_[corner] + level];
                if (group[j] == i && (best == nullptr || one.outside_m < best->outside_m)) best = &one;
              }
              column.positions.push_back(best->position);
              column.outside_m = std::max(column.outside_m, best->outside_m);
            }
          }
          return column;
        },
        8);
    first_point_.assign(1, 0);
    VolumeMesh& mesh = result_.grid.mesh;
    for (const Column& column : columns) {
      mesh.points.insert(mesh.points.end(), column.positions.begin(), column.positions.end());
      first_point_.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      result_.report.largest_outside_m = std::max(result_.report.largest_outside_m, column.outside_m);
      copies_.push_back(column.of);
    }
    for (const Lift& one : lifts_) result_.report.unreached += one.is_unreached ? 1 : 0;
  }

  /// Wedges around a point at a level: each gets the first of those it is connected with, through faces of the layers
  /// below and above that are no fault.
  std::vector<std::uint32_t> groups_around(std::uint32_t p, std::uint32_t level) const {
    const std::uint32_t begin = first_wedge_[p], count = first_wedge_[p + 1] - begin;
    std::vector<std::uint32_t> group(count);
    std::iota(group.begin(), group.end(), 0u);
    const auto wedge_of = [&](std::uint32_t quad) {
      for (std::uint32_t i = 0; i < count; ++i)
        if (wedges_[begin + i] / 4 == quad) return i;
      return no_index;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t corner = wedges_[begin + i], q = corner / 4, k = corner % 4;
      for (const std::uint32_t side : {k, (k + 3) % 4}) {
        const std::uint32_t e = edge_of_[4 * q + side];
        const std::uint32_t other = edges_[e].quads[0] == q ? edges_[e].quads[1] : edges_[e].quads[0];
        if (other == no_index) continue;
        const bool is_open_below = level > 0 && !is_fault_face(e, level - 1);
        const bool is_open_above = level < layers_ && !is_fault_face(e, level);
        if (!is_open_below && !is_open_above) continue;
        const std::uint32_t j = wedge_of(other);
        const std::uint32_t low = std::min(group[i], group[j]), high = std::max(group[i], group[j]);
        for (std::uint32_t& g : group)
          if (g == high) g = low;
      }
    }
    return group;
  }

  std::uint32_t point_at(std::uint32_t quad, std::uint32_t corner, std::uint32_t level) const {
    const std::uint32_t p = plan_.quads[quad][corner % 4];
    if (copies_[p].empty()) return first_point_[p] + level;
    for (std::uint32_t i = first_wedge_[p];; ++i)
      if (wedges_[i] == 4 * quad + corner % 4)
        return first_point_[p] + copies_[p][std::size_t{i - first_wedge_[p]} * (layers_ + 1) + level];
  }

  void make_cells() {
    HexGrid& grid = result_.grid;
    VolumeMesh& mesh = grid.mesh;
    grid.plan = plan_;
    grid.layers = layers_;
    mesh.local_origin = space_.model.local_origin;
    mesh.entities = space_.model.entities;
    mesh.region_names = space_.model.region_names;
    for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) mesh.surface_entity.push_back(static_cast<std::int32_t>(e));
    for (std::uint32_t q = 0; q < plan_.quads.size(); ++q)
      for (std::uint32_t k = 0; k < layers_; ++k) {
        std::array<std::uint32_t, 8> corners{};
        for (std::uint32_t c = 0; c < 4; ++c) {
          corners[c] = point_at(q, c, k);
          corners[4 + c] = point_at(q, c, k + 1);
        }
        mesh.add_cell(CellType::hexahedron, corners.data(), region_near(centre_places_[q][k].tet));
        grid.cell_column.push_back(q);
        grid.cell_layer.push_back(k);
      }
    // Where units have no thickness, levels differ by rounding: they take one position, from below.
    for (std::size_t c = 0; c < mesh.cell_count(); ++c)
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& low = mesh.points[mesh.cell_vertices[8 * c + k]];
        Vec3& high = mesh.points[mesh.cell_vertices[8 * c + 4 + k]];
        if (length(high - low) < 1e-9 * edge_m_) high = low;
      }
  }

  /// The region of a tetrahedron; of one without volume, that of the nearest of the model.
  std::int32_t region_near(std::uint32_t tet) const {
    std::vector<std::uint32_t> front{tet};
    for (std::size_t i = 0; i < front.size() && i < 64; ++i) {
      if (front[i] < space_.layers.model_tets) return space_.model.region[front[i]];
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t other = space_.layers.neighbour[4 * front[i] + k];
        if (other != no_index) front.push_back(other / 4);
      }
    }
    return 0;
  }

  /// The entity with most facets of a kind.
  std::uint32_t main_entity(SheetKind kind) const {
    std::vector<std::uint32_t> count(space_.model.entities.size() + 1, 0);
    for (const SheetFacet& facet : space_.model.facets)
      if (facet.kind == kind) ++count[facet.entity];
    return static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
  }

  void make_facets() {
    std::vector<MeshFacet>& facets = result_.grid.mesh.facets;
    const auto cell = [&](std::uint32_t q, std::uint32_t k) { return q * layers_ + k; };
    // Horizons, top and bottom: the face over the cell below, counter-clockwise from above.
    std::vector<std::uint32_t> surface_of_level(layers_ + 1, no_index);
    for (std::uint32_t level = 1; level + 1 < space_.layers.level_w.size(); ++level)
      for (std::uint32_t e = 0; e < space_.levels.level_of.size(); ++e)
        if (space_.levels.level_of[e] == level) surface_of_level[space_.layers.level_w[level]] = e;
    surface_of_level.front() = main_entity(SheetKind::bottom);
    surface_of_level.back() = main_entity(SheetKind::top);
    for (std::uint32_t level = 0; level <= layers_; ++level) {
      if (surface_of_level[level] == no_index) continue;
      for (std::uint32_t q = 0; q < plan_.quads.size(); ++q) {
        MeshFacet facet;
        facet.surface = real_surface(q, level, surface_of_level);
        for (std::uint32_t c = 0; c < 4; ++c) facet.vertices[c] = point_at(q, level == 0 ? 3 - c : c, level);
        facet.cell_0 = cell(q, level == 0 ? 0 : level - 1);
        facet.cell_1 = level == 0 || level == layers_ ? no_index : cell(q, level);
        if (facet.surface != no_index) facets.push_back(facet);
      }
    }
    // Sides and faults: seen from the cell, the normal points out.
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const PlanEdge& edge = edges_[e];
      const bool is_side = edge.quads[1] == no_index;
      for (std::uint32_t k = 0; k < layers_ && (is_side || !is_fault_[e].empty()); ++k) {
        if (!is_side && !is_fault_face(e, k)) continue;
        std::array<MeshFacet, 2> both;
        for (std::size_t s = 0; s < (is_side ? 1u : 2u); ++s) {
          const std::uint32_t q = edge.quads[s], c = edge.sides[s];
          both[s].vertices = {point_at(q, c, k), point_at(q, c + 1, k), point_at(q, c + 1, k + 1), point_at(q, c, k + 1)};
          both[s].cell_0 = cell(q, k);
          both[s].surface = is_side ? side_surface(edge) : edge.faults.front();
        }
        auto left = both[0].vertices, right = both[1].vertices;
        std::sort(left.begin(), left.end());
        std::sort(right.begin(), right.end());
        const bool is_one = !is_side && left == right;
        if (is_one) both[0].cell_1 = both[1].cell_0;
        facets.push_back(both[0]);
        if (!is_side && !is_one) facets.push_back(both[1]);
      }
    }
  }

  /// Whether a level has no height over the one below it, all over a quad.
  bool is_closed(std::uint32_t quad, std::uint32_t level) const {
    const std::vector<Vec3>& points = result_.grid.mesh.points;
    for (std::uint32_t c = 0; c < 4; ++c)
      if (!(points[point_at(quad, c, level)] == points[point_at(quad, c, level - 1)])) return false;
    return true;
  }

  /// The surface a level over a quad lies on: where units have no thickness, that of the surface that is there, for
  /// the lowest and the highest of the levels that coincide, and none for those between.
  std::uint32_t real_surface(std::uint32_t quad, std::uint32_t level, const std::vector<std::uint32_t>& surface_of) {
    std::uint32_t low = level, high = level;
    while (low > 0 && is_closed(quad, low)) --low;
    while (high < layers_ && is_closed(quad, high + 1)) ++high;
    if (low == high) return surface_of[level];
    std::uint32_t first = no_index, last = 0, real = no_index;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t l = low; l <= high; ++l) {
      if (surface_of[l] == no_index) continue;
      first = std::min(first, l);
      last = l;
      const auto [nearest, is_new] = nearest_.try_emplace(surface_of[l]);
      if (is_new) {
        std::vector<Triangle> triangles;
        for (const SheetFacet& facet : space_.model.facets)
          if (facet.kind != SheetKind::fault && facet.kind != SheetKind::side && facet.entity == surface_of[l])
            triangles.push_back(facet.vertices);
        nearest->second = std::make_unique<NearestTriangle>(TriangleMesh{space_.model.points, triangles});
      }
      double squared = 0;
      for (std::uint32_t c = 0; c < 4; ++c)
        squared += nearest->second->nearest(result_.grid.mesh.points[point_at(quad, c, l)]).squared_m2;
      if (squared < least - 1e-12 * edge_m_ * edge_m_) {
        least = squared;
        real = surface_of[l];
      }
    }
    return level == first || level == last ? real : no_index;
  }

  /// The entity of a side: its feature's, or the nearest side facet's.
  std::uint32_t side_surface(const PlanEdge& edge) const {
    if (edge.side_entity >= 0) return static_cast<std::uint32_t>(edge.side_entity);
    const Vec3 middle = 0.5 * (plan_.points[edge.points[0]] + plan_.points[edge.points[1]]);
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t entity = main_entity(SheetKind::side);
    for (const SheetFacet& facet : space_.model.facets) {
      if (facet.kind != SheetKind::side) continue;
      const Vec3 d = (1.0 / 3) * (space_.plan[facet.vertices[0]] + space_.plan[facet.vertices[1]] +
                                  space_.plan[facet.vertices[2]]) - middle;
      if (dot(d, d) < nearest) {
        nearest = dot(d, d);
        entity = facet.entity;
      }
    }
    return entity;
  }

  const LayeredSpace& space_;
  const QuadMesh& plan_;
  const ExtrudeOptions& options_;
  std::uint32_t layers_ = 0;
  double edge_m_ = 1;
  TetLocator locator_;
  std::vector<PlanEdge> edges_;             // by points
  std::vector<std::uint32_t> edge_of_;      // per side 4·quad + k
  std::vector<char> is_on_fault_;           // per plan point
  std::unordered_map<std::uint32_t, std::size_t> surface_of_;  // fault entity to surfaces_
  std::vector<FaultSurface> surfaces_;
  std::vector<std::uint32_t> first_wedge_, wedges_;  // per plan point: corners 4·quad + k
  std::vector<double> local_edge_m_;                 // per plan point: shortest edge
  std::vector<std::vector<TetLocator::Place>> centre_places_;  // per quad: middles of layers, then levels
  std::vector<Vec3> outside_;
  std::vector<std::uint32_t> lifts_of_;  // per corner of a quad: first of lifts_, or no_index
  std::vector<Lift> lifts_;
  std::vector<std::vector<char>> is_fault_;  // per edge: per layer, or empty
  std::vector<std::uint32_t> first_point_;   // per plan point
  std::vector<std::vector<std::uint32_t>> copies_;
  std::unordered_map<std::uint32_t, std::unique_ptr<NearestTriangle>> nearest_;  // per entity
  ExtrudedHexes result_;
};

}  // namespace

void judge_cells(ExtrudedHexes& hexes) {
  const VolumeMesh& mesh = hexes.grid.mesh;
  double edges = 0;
  for (const auto& quad : hexes.grid.plan.quads)
    edges += length(hexes.grid.plan.points[quad[0]] - hexes.grid.plan.points[quad[1]]);
  const double edge_m = edges / std::max<double>(1, static_cast<double>(hexes.grid.plan.quads.size()));
  enum : char { good, dead, degenerate, inverted };
  const std::vector<char> judged = parallel_map(
      mesh.cell_count(),
      [&](std::size_t c) -> char {
        std::array<Vec3, 8> p;
        for (std::size_t k = 0; k < 8; ++k) p[k] = mesh.points[mesh.cell_vertices[mesh.cell_offsets[c] + k]];
        std::size_t closed = 0;
        for (std::size_t k = 0; k < 4; ++k) closed += length(p[4 + k] - p[k]) <= 1e-8 * edge_m ? 1 : 0;
        if (closed == 4) return dead;
        if (closed > 0) return degenerate;
        return is_inverted(CellType::hexahedron, p) ? inverted : good;
      },
      256);
  ExtrusionReport& report = hexes.report;
  report.dead = report.degenerate = report.inverted = 0;
  hexes.grid.is_dead.assign(judged.size(), 0);
  for (std::size_t c = 0; c < judged.size(); ++c) {
    report.dead += judged[c] == dead ? 1 : 0;
    report.degenerate += judged[c] == degenerate ? 1 : 0;
    report.inverted += judged[c] == inverted ? 1 : 0;
    hexes.grid.is_dead[c] = judged[c] == dead ? 1 : 0;
  }
}

Result<ExtrudedHexes> extrude_hexes(const LayeredSpace& space, const QuadMesh& plan, const ExtrudeOptions& options) {
  if (!(options.ball_ratio >= 0 && options.ball_ratio <= 0.5))
    return Failure{FailureCode::invalid_options, "ball_ratio must lie in [0, 0.5]", "use 0.1"};
  if (plan.quads.empty()) return bad_plan("the plan has no quads");
  for (const Vec3& p : plan.points)
    if (!is_finite(p)) return bad_plan("the plan has a point that is not finite");
  if (static_cast<double>(plan.quads.size()) * (space.layers.layer_count() + 1.0) * 2 > double(1 << 30))
    return Failure{FailureCode::geometry_failed, "more than 2^30 vertices", "coarsen the plan or take fewer layers"};
  return Extrusion(space, plan, options).extrude();
}

}  // namespace strataflow
