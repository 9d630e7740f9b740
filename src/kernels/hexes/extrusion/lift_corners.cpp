#include "kernels/hexes/extrusion/lift_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/extrusion/wall_faces.h"

namespace strataflow {
namespace {

std::size_t place_in(const std::vector<std::uint32_t>& ball, std::uint32_t tet) {
  return static_cast<std::size_t>(std::lower_bound(ball.begin(), ball.end(), tet) - ball.begin());
}

}  // namespace

CornerLifter::CornerLifter(const LayeredSpace& space, const QuadMesh& plan, const PlanEdges& edges,
                           const ExtrudeOptions& options)
    : space_(space),
      plan_(plan),
      edges_(edges),
      options_(options),
      layers_(space.layers.layer_count()),
      edge_m_(mean_plan_edge_m(plan)),
      locator_(space, edge_m_),
      wall_of_face_(walls_of_faces(space)) {
  if (std::any_of(space.model.facets.begin(), space.model.facets.end(),
                  [](const SheetFacet& facet) { return facet.kind == SheetKind::fault && facet.is_aligned == 0; })) {
    lines_.emplace(space, space.plan);
    heights_.emplace(TetLocator::of_heights(space));
  }
  lift_centres();
}

/// Of all layers' middles, for regions, and of all levels beside faults.
void CornerLifter::lift_centres() {
  centre_places_ = parallel_map(
      plan_.quads.size(),
      [&](std::size_t q) {
        bool is_beside_fault = false;
        Vec3 centre;
        for (const std::uint32_t p : plan_.quads[q]) {
          centre = centre + 0.25 * plan_.points[p];
          is_beside_fault = is_beside_fault || edges_.is_on_fault[p] || edges_.zones.is_on_strip[p];
        }
        std::vector<TetLocator::Place> column;
        for (std::uint32_t k = 0; k < layers_; ++k)
          column.push_back(locator_.locate(locator_.at(centre, k + 0.5), edge_m_));
        for (std::uint32_t level = 0; is_beside_fault && level <= layers_; ++level)
          column.push_back(locator_.locate(locator_.at(centre, level), edge_m_));
        return column;
      },
      16);
  for (std::uint32_t q = 0; q < centre_places_.size() && !outside_quad_; ++q)
    for (const TetLocator::Place& place : centre_places_[q])
      if (place.tet == no_index) outside_quad_ = q;
}

/// In `start`, if that is known, of several tetrahedra that hold the place.
Lift CornerLifter::lift(std::uint32_t point, double w, std::uint32_t start) const {
  const Vec3 at = locator_.at(plan_.points[point], w);
  TetLocator::Place place = locator_.locate(at, edge_m_);
  if (start != no_index) place = {start, locator_.outside_m(start, at)};
  if (place.tet == no_index) place.tet = tet_of_cell(edges_.wedges[edges_.first_wedge[point]] / 4, 0);
  Lift one{place.tet, place.outside_m, {}, false, false};
  const bool is_outside = place.outside_m > 1e-9 * edge_m_;
  one.position = position_in(
      locator_, place,
      is_outside ? locator_.in_ball(at, std::max(2 * place.outside_m, 0.2 * edge_m_)) : std::vector<std::uint32_t>{},
      at);
  if (!edges_.is_on_outline[point]) return one;
  const std::vector<std::uint32_t> ball = locator_.in_ball(at, wall_reach_m(point));
  if (std::binary_search(ball.begin(), ball.end(), place.tet))
    if (const auto held = position_on_walls(locator_, point, connected_in_ball(place.tet, ball), at))
      one.position = *held;
  return one;
}

/// The tetrahedron of the ball that is fewest steps away, of equal ones the lowest; no_index if none can be reached.
std::uint32_t CornerLifter::first_in_ball(std::uint32_t from, const std::vector<std::uint32_t>& ball) const {
  constexpr std::size_t most_visited = 50000;
  std::uint32_t start = no_index;
  std::unordered_map<std::uint32_t, char> visited{{from, 1}};  // looked up, never iterated over
  std::vector<std::uint32_t> front{from}, next;
  while (!ball.empty() && !front.empty() && visited.size() < most_visited) {
    for (const std::uint32_t t : front)
      if (std::binary_search(ball.begin(), ball.end(), t)) start = std::min(start, t);
    if (start != no_index) break;
    next.clear();
    for (const std::uint32_t t : front)
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t other = space_.layers.neighbour[4 * t + k];
        if (other != no_index && visited.emplace(other / 4, 1).second) next.push_back(other / 4);
      }
    front.swap(next);
  }
  return start;
}

/// Those of the ball that `start` is connected with inside it, ascending.
std::vector<std::uint32_t> CornerLifter::connected_in_ball(std::uint32_t start,
                                                           const std::vector<std::uint32_t>& ball) const {
  std::vector<char> is_reached(ball.size(), 0);
  std::vector<std::uint32_t> stack{start};
  is_reached[place_in(ball, start)] = 1;
  while (!stack.empty()) {
    const std::uint32_t t = stack.back();
    stack.pop_back();
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t other = space_.layers.neighbour[4 * t + k];
      if (other == no_index || !std::binary_search(ball.begin(), ball.end(), other / 4)) continue;
      char& reached = is_reached[place_in(ball, other / 4)];
      if (reached) continue;
      reached = 1;
      stack.push_back(other / 4);
    }
  }
  std::vector<std::uint32_t> connected;
  for (std::size_t i = 0; i < ball.size(); ++i)
    if (is_reached[i]) connected.push_back(ball[i]);
  return connected;
}

/// `start`: a tetrahedron on the side of the corner, if one is known better than that below the quad's centre.
Lift CornerLifter::lift_on_fault(std::uint32_t corner, double w, std::uint32_t start) const {
  const std::uint32_t q = corner / 4, point = plan_.quads[q][corner % 4];
  const Vec3 p = locator_.at(plan_.points[point], w);
  const std::uint32_t below_centre =
      start != no_index ? start : centre_places_[q][layers_ + static_cast<std::size_t>(std::llround(w))].tet;
  if (options_.uses_barycentre_tet)
    return {below_centre, locator_.outside_m(below_centre, p), locator_.lifted(below_centre, p), false, false};
  const std::vector<std::uint32_t> ball = locator_.in_ball(p, options_.ball_ratio * edges_.local_edge_m[point]);
  const std::uint32_t first = first_in_ball(below_centre, ball);
  if (first == no_index) {
    const TetLocator::Place place = locator_.locate(p, edge_m_);
    const std::uint32_t tet = place.tet == no_index ? below_centre : place.tet;
    return {tet, locator_.outside_m(tet, p), locator_.lifted(tet, p), true, false};
  }
  const std::vector<std::uint32_t> reached = connected_in_ball(first, ball);
  TetLocator::Place best{no_index, std::numeric_limits<double>::infinity()};
  for (const std::uint32_t t : reached)
    if (const TetLocator::Place place = locator_.place_in(t, p); place.is_before(best)) best = place;
  const std::vector<std::uint32_t> wide = locator_.in_ball(p, wall_reach_m(point));
  const auto held = position_on_walls(locator_, point, connected_in_ball(first, wide), p);
  return {best.tet, best.outside_m, held ? *held : position_in(locator_, best, reached, p), false, false};
}

/// Over a corner, at a height: no fault parts what lies below and above.
Lift CornerLifter::lift_at_height(std::uint32_t corner, double z) const {
  const std::uint32_t point = plan_.quads[corner / 4][corner % 4];
  const Vec3 at = heights_->at(plan_.points[point], z);
  const double reach = wall_reach_m(point);
  TetLocator::Place place = heights_->locate(at, edge_m_);
  if (place.tet == no_index) place = {tet_of_cell(corner / 4, 0), edge_m_};
  const std::vector<std::uint32_t> near = heights_->in_ball(at, std::max(reach, 2 * place.outside_m));
  const auto held = edges_.is_on_outline[point] || edges_.is_on_fault[point]
                        ? position_on_walls(*heights_, point, near, at)
                        : std::nullopt;
  return {place.tet, std::max(0.0, place.outside_m), held ? *held : position_in(*heights_, place, near, at), false,
          false};
}

/// The levels on the line over a corner; over walls, on a line beside them, in its quad. None where no fault that need
/// not be followed crosses it.
std::optional<BridgedLevels> CornerLifter::bridges_over(std::uint32_t corner) const {
  if (!lines_) return std::nullopt;
  const std::uint32_t point = plan_.quads[corner / 4][corner % 4];
  const Vec3& p = plan_.points[point];
  Vec3 inward = -1.0 * p;
  for (const std::uint32_t other : plan_.quads[corner / 4]) inward = inward + 0.25 * plan_.points[other];
  const bool is_on_wall = edges_.is_on_fault[point] || edges_.is_on_outline[point] || edges_.zones.is_on_strip[point];
  const double beside = is_on_wall ? options_.ball_ratio * edges_.local_edge_m[point] / length(inward) : 0;
  for (const double share : {beside, 0.25, 0.5, 1.0}) {
    const Vec3 at = p + share * inward;
    PlumbLine line = lines_->at(at.x, at.y);
    if (line.is_empty()) continue;
    BridgedLevels bridges(std::move(line), space_.layers.level_w);
    return bridges.is_needed() ? std::optional(std::move(bridges)) : std::nullopt;
  }
  return std::nullopt;
}

/// The position of p: where it lies a little outside, that of the nearest point of its level in one of the candidates,
/// so that it stays on horizons, faults and sides.
Vec3 CornerLifter::position_in(const TetLocator& locator, const TetLocator::Place& best,
                               const std::vector<std::uint32_t>& candidates, const Vec3& p) const {
  if (best.outside_m <= 1e-9 * edge_m_) return locator.lifted(best.tet, p);
  TetLocator::LevelPoint nearest{p, std::numeric_limits<double>::infinity()};
  std::uint32_t tet = best.tet;
  for (const std::uint32_t t : candidates) {
    const TetLocator::LevelPoint one = locator.nearest_at_level(t, p);
    if (!(one.distance_m < nearest.distance_m)) continue;
    nearest = one;
    tet = t;
  }
  return locator.lifted(tet, nearest.at);
}

std::vector<Lift> CornerLifter::lift_column(std::uint32_t point) const {
  if (const std::uint32_t beside = edges_.corner_beside_strip(point); beside != no_index)
    return lift_column_on_fault(beside);
  return lift_bridged(edges_.wedges[edges_.first_wedge[point]],
                      [&](double w, std::uint32_t start) { return lift(point, w, start); });
}

std::vector<Lift> CornerLifter::lift_column_on_fault(std::uint32_t corner) const {
  return lift_bridged(corner, [&](double w, std::uint32_t start) { return lift_on_fault(corner, w, start); });
}

/// `lift_at` (w, a tetrahedron on the right side of faults that need not be followed, or no_index), where W has a
/// place.
template <class LiftAt>
std::vector<Lift> CornerLifter::lift_bridged(std::uint32_t corner, LiftAt&& lift_at) const {
  const std::optional<BridgedLevels> bridges = bridges_over(corner);
  return lift_levels([&](double w) {
    if (!bridges) return lift_at(w, no_index);
    const BridgedLevels::Place place = bridges->at(w);
    if (!place.is_bridged) return lift_at(w, bridges->tet_at(place.z));
    Lift one = lift_at_height(corner, place.z);
    one.is_bridged = true;
    one.bridged_m = place.moved_m;
    return one;
  });
}

/// All levels; inside units with parallel layers, at the W whose height is wanted: W grows with height, so that secants
/// between a point below and one above come nearer, halving where they do not.
template <class LiftAt>
std::vector<Lift> CornerLifter::lift_levels(LiftAt&& lift_at) const {
  constexpr double close_ratio = 1e-6;  // of a layer
  constexpr int most_steps = 40;
  const StratigraphicTets& layers = space_.layers;
  std::vector<Lift> column(layers_ + 1);
  for (const std::uint32_t w : layers.level_w) column[w] = lift_at(w);
  for (std::size_t unit = 0; unit + 1 < layers.level_w.size(); ++unit) {
    const std::uint32_t floor = layers.level_w[unit], roof = layers.level_w[unit + 1];
    const UnitLayers how = unit < layers.units.size() ? layers.units[unit] : UnitLayers{};
    const double base_m = column[floor].position.z, top_m = column[roof].position.z;
    const double share_m = (top_m - base_m) / (roof - floor);
    const bool is_parallel = how.layout != LayerLayout::proportional && share_m > how.thickness_m;
    column[roof].is_squeezed = how.layout != LayerLayout::proportional && !is_parallel;
    for (std::uint32_t level = floor + 1; level < roof; ++level) {
      if (!is_parallel) {
        column[level] = lift_at(level);
        continue;
      }
      const double wanted_m = how.layout == LayerLayout::parallel_to_top ? top_m - (roof - level) * how.thickness_m
                                                                         : base_m + (level - floor) * how.thickness_m;
      double low = floor, high = roof, low_m = base_m, high_m = top_m;
      Lift best = column[floor];
      for (int step = 0; step < most_steps; ++step) {
        const double share = std::clamp((wanted_m - low_m) / (high_m - low_m), 0.01, 0.99);
        const double w = step % 3 == 2 ? 0.5 * (low + high) : low + share * (high - low);
        best = lift_at(w);
        if (std::abs(best.position.z - wanted_m) <= close_ratio * how.thickness_m) break;
        (best.position.z < wanted_m ? low : high) = w;
        (best.position.z < wanted_m ? low_m : high_m) = best.position.z;
        if (!(high_m > low_m)) break;
      }
      column[level] = best;
    }
  }
  return column;
}

/// How far from a point of the plan its walls are looked for: the plan's lines moved by a tenth, and edges cut bends.
double CornerLifter::wall_reach_m(std::uint32_t point) const {
  constexpr double reach_ratio = 0.25;  // of the shortest edge
  return std::max(options_.ball_ratio, reach_ratio) * edges_.local_edge_m[point];
}

/// The nearest point of its level that lies on all walls the plan says it is on, of those the tetrahedra `near` have;
/// nothing where there are none.
std::optional<Vec3> CornerLifter::position_on_walls(const TetLocator& locator, std::uint32_t point,
                                                    const std::vector<std::uint32_t>& near, const Vec3& p) const {
  constexpr int most_rounds = 40;
  const double reach = wall_reach_m(point);
  struct WallFace {
    std::uint32_t entity, face;
  };
  std::vector<WallFace> faces;
  for (const std::uint32_t t : near)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t entity = wall_of_face_[4 * t + k];
      if (entity == no_index) continue;
      const std::vector<std::uint32_t>& faults = edges_.faults_at[point];
      const bool is_fault = space_.model.entities[entity].role == Role::fault;
      if (is_fault ? std::binary_search(faults.begin(), faults.end(), entity) : edges_.is_on_outline[point] != 0)
        faces.push_back({entity, 4 * t + k});
    }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const WallFace& a, const WallFace& b) { return a.entity < b.entity; });
  // From wall to wall, until it moves no more: the way to where they meet.
  Vec3 at = p;
  std::uint32_t tet = no_index;
  for (int round = 0; round < most_rounds; ++round) {
    const Vec3 before = at;
    std::size_t walls = 0;
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
      TetLocator::LevelPoint nearest{p, std::numeric_limits<double>::infinity()};
      std::uint32_t holder = no_index;
      for (; end < faces.size() && faces[end].entity == faces[begin].entity; ++end) {
        const TetLocator::LevelPoint one = locator.nearest_on_face(faces[end].face / 4, faces[end].face % 4, at);
        if (!(one.distance_m < nearest.distance_m)) continue;
        nearest = one;
        holder = faces[end].face / 4;
      }
      if (!(length(nearest.at - p) <= reach) || holder == no_index) continue;
      at = nearest.at;
      tet = holder;
      ++walls;
    }
    if (walls < 2 || length(at - before) < 1e-12 * edge_m_) break;
  }
  if (tet == no_index) return std::nullopt;
  return locator.lifted(tet, at);
}

}  // namespace strataflow
