#include "kernels/simulation_grid/plan_blocks.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

namespace strataflow {

namespace {
std::uint32_t next_in_quad(std::uint32_t h) { return h % 4 == 3 ? h - 3 : h + 1; }

struct PlanVertices {
  std::vector<std::uint32_t> valence;  ///< quads around each vertex
  std::vector<std::uint8_t> on_boundary;
  bool is_irregular(std::uint32_t v) const { return on_boundary[v] ? valence[v] > 2 : valence[v] != 4; }
};

PlanVertices classify_vertices(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite) {
  PlanVertices vertices{std::vector<std::uint32_t>(plan.points.size()), std::vector<std::uint8_t>(plan.points.size())};
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    const std::uint32_t from = plan.quads[h / 4][h % 4], to = plan.quads[h / 4][(h + 1) % 4];
    ++vertices.valence[from];
    if (opposite[h] == no_index) vertices.on_boundary[from] = vertices.on_boundary[to] = 1;
  }
  return vertices;
}

/// Per half-edge with a quad across: whether it lies on a feature of role fault.
std::vector<std::uint8_t> half_edges_on_faults(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const FeatureEdge& edge : plan.edges)
    if (plan.features[edge.feature].role == Role::fault) edges.push_back({edge.a, edge.b});
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint8_t> on_fault(opposite.size());
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    const std::uint32_t a = plan.quads[h / 4][h % 4], b = plan.quads[h / 4][(h + 1) % 4];
    on_fault[h] = opposite[h] != no_index &&
                  std::binary_search(edges.begin(), edges.end(), std::array{std::min(a, b), std::max(a, b)});
  }
  return on_fault;
}

struct Place {
  std::int64_t i = 0, j = 0;
  std::uint32_t turn = 0;
  friend constexpr bool operator==(const Place&, const Place&) = default;
};

/// Where the quad across side `side` of a quad at `place` must be, its own side being `far_side`.
Place place_across(const Place& place, std::uint32_t side, std::uint32_t far_side) {
  static constexpr int step_i[] = {0, 1, 0, -1}, step_j[] = {-1, 0, 1, 0};
  const std::uint32_t direction = (side + 4 - place.turn) % 4;  // J−, I+, J+, I−
  return {place.i + step_i[direction], place.j + step_j[direction], (far_side + 4 - (direction + 2) % 4) % 4};
}

/// The parts of a plan that hold together across edges that are not cut, each with places that agree along a spanning
/// tree; `is_consistent` if they agree everywhere and no two quads share a place.
struct IndexedPart {
  std::vector<std::uint32_t> quads;
  bool is_consistent = true;
  std::int64_t low_i = 0, high_i = 0, low_j = 0, high_j = 0;
  std::array<std::uint64_t, 2> size() const {
    return {static_cast<std::uint64_t>(high_i - low_i + 1), static_cast<std::uint64_t>(high_j - low_j + 1)};
  }
};

std::vector<IndexedPart> index_parts(std::uint32_t quad_count, const std::vector<std::uint32_t>& opposite,
                                     const std::vector<std::uint8_t>& is_cut, std::vector<Place>& places) {
  std::vector<IndexedPart> parts;
  std::vector<std::uint8_t> is_placed(quad_count);
  places.assign(quad_count, {});
  for (std::uint32_t seed = 0; seed < quad_count; ++seed) {
    if (is_placed[seed]) continue;
    IndexedPart part;
    part.quads.push_back(seed);
    is_placed[seed] = 1;
    for (std::size_t head = 0; head < part.quads.size(); ++head) {
      const std::uint32_t quad = part.quads[head];
      for (std::uint32_t side = 0; side < 4; ++side) {
        const std::uint32_t across = opposite[4 * quad + side];
        if (across == no_index || is_cut[4 * quad + side]) continue;
        const Place place = place_across(places[quad], side, across % 4);
        if (!is_placed[across / 4]) {
          is_placed[across / 4] = 1;
          places[across / 4] = place;
          part.quads.push_back(across / 4);
          part.low_i = std::min(part.low_i, place.i), part.high_i = std::max(part.high_i, place.i);
          part.low_j = std::min(part.low_j, place.j), part.high_j = std::max(part.high_j, place.j);
        } else if (!(places[across / 4] == place)) {
          part.is_consistent = false;
        }
      }
    }
    auto by_place = part.quads;
    std::sort(by_place.begin(), by_place.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tie(places[a].j, places[a].i, a) < std::tie(places[b].j, places[b].i, b);
    });
    for (std::size_t n = 1; n < by_place.size(); ++n)
      if (places[by_place[n]].i == places[by_place[n - 1]].i && places[by_place[n]].j == places[by_place[n - 1]].j)
        part.is_consistent = false;
    parts.push_back(std::move(part));
  }
  return parts;
}

PlanBlock block_of(const IndexedPart& part, const std::vector<Place>& places) {
  PlanBlock block;
  block.size = {static_cast<std::uint32_t>(part.size()[0]), static_cast<std::uint32_t>(part.size()[1])};
  block.quads.assign(std::size_t{block.size[0]} * block.size[1], no_index);
  block.turns.assign(block.quads.size(), 0);
  for (const std::uint32_t quad : part.quads) {
    const std::size_t slot = static_cast<std::size_t>(places[quad].i - part.low_i) +
                             block.size[0] * static_cast<std::size_t>(places[quad].j - part.low_j);
    block.quads[slot] = quad;
    block.turns[slot] = places[quad].turn;
  }
  return block;
}

PlanBlock single_block(std::uint32_t quad) { return {{1, 1}, {quad}, {0}}; }

/// Whether neighbours by index touch and quads around a place between four share the point there. Arms that lie side by
/// side in index space only would become neighbours, or share a pillar.
bool is_well_joined(const PlanBlock& block, const QuadMesh& plan, const std::vector<std::uint32_t>& opposite) {
  std::vector<std::uint32_t> node_point(std::size_t{block.size[0] + 1} * (block.size[1] + 1), no_index);
  for (std::uint32_t j = 0; j < block.size[1]; ++j)
    for (std::uint32_t i = 0; i < block.size[0]; ++i) {
      const std::uint32_t quad = block.quad(i, j), turn = block.turn(i, j);
      if (quad == no_index) continue;
      for (std::uint32_t c = 0; c < 4; ++c) {
        std::uint32_t& point = node_point[(i + (c == 1 || c == 2)) + std::size_t{block.size[0] + 1} * (j + (c >= 2))];
        const std::uint32_t own = plan.quads[quad][(turn + c) % 4];
        if (point != no_index && point != own) return false;
        point = own;
      }
      const auto touches = [&](std::uint32_t other, std::uint32_t side) {
        const std::uint32_t across = opposite[4 * quad + (turn + side) % 4];
        return other == no_index || (across != no_index && other == across / 4);
      };
      if ((i + 1 < block.size[0] && !touches(block.quad(i + 1, j), 1)) ||
          (j + 1 < block.size[1] && !touches(block.quad(i, j + 1), 2)))
        return false;
    }
  return true;
}

Failure not_native(const std::string& reason) {
  return Failure{FailureCode::unsupported, reason, "choose the layout blocks or unstructured"};
}
}  // namespace

Result<std::vector<std::uint32_t>> opposite_half_edges(const QuadMesh& plan) {
  struct Side {
    std::uint32_t low, high, half_edge;
  };
  std::vector<Side> sides;
  sides.reserve(4 * plan.quads.size());
  for (std::uint32_t h = 0; h < 4 * plan.quads.size(); ++h) {
    const std::uint32_t a = plan.quads[h / 4][h % 4], b = plan.quads[h / 4][(h + 1) % 4];
    if (a >= plan.points.size() || b >= plan.points.size() || a == b)
      return Failure{FailureCode::invalid_input, "quad " + std::to_string(h / 4) + " of the plan has no valid corners",
                     "report this: the plan mesh is damaged"};
    sides.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.half_edge) < std::tie(b.low, b.high, b.half_edge);
  });
  std::vector<std::uint32_t> opposite(sides.size(), no_index);
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    const std::uint32_t h = sides[begin].half_edge, g = sides[end - 1].half_edge;
    if (end - begin > 2 || (h != g && plan.quads[h / 4][h % 4] == plan.quads[g / 4][g % 4]))
      return Failure{FailureCode::invalid_input,
                     "the plan mesh is no oriented surface at the edge from point " + std::to_string(sides[begin].low) +
                         " to point " + std::to_string(sides[begin].high),
                     "report this: the plan mesh is damaged"};
    if (h != g) opposite[h] = g, opposite[g] = h;
    begin = end;
  }
  return opposite;
}

std::vector<PlanBlock> single_blocks(const QuadMesh& plan) {
  std::vector<Vec3> middles;
  for (const auto& quad : plan.quads)
    middles.push_back(plan.points[quad[0]] + plan.points[quad[1]] + plan.points[quad[2]] + plan.points[quad[3]]);
  std::vector<std::uint32_t> order(plan.quads.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(middles[a].x, middles[a].y, a) < std::tie(middles[b].x, middles[b].y, b);
  });
  std::vector<PlanBlock> blocks;
  for (const std::uint32_t quad : order) blocks.push_back(single_block(quad));
  return blocks;
}

Result<PlanBlock> native_block(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite) {
  const PlanVertices vertices = classify_vertices(plan, opposite);
  std::uint32_t singular = 0;
  for (std::uint32_t v = 0; v < plan.points.size(); ++v)
    singular += !vertices.on_boundary[v] && vertices.valence[v] != 4 && vertices.valence[v] != 0;
  if (singular > 0) return not_native("the plan has " + std::to_string(singular) + " singular vertices inside");
  std::vector<Place> places;
  const auto quad_count = static_cast<std::uint32_t>(plan.quads.size());
  const auto parts = index_parts(quad_count, opposite, std::vector<std::uint8_t>(opposite.size()), places);
  if (parts.size() != 1) return not_native("the plan has " + std::to_string(parts.size()) + " parts");
  if (!parts[0].is_consistent) return not_native("the indices of the plan do not close around a hole, or overlap");
  // A spiral may need a box far larger than itself.
  if (parts[0].size()[0] * parts[0].size()[1] > 64 + 16 * std::uint64_t{quad_count})
    return not_native("the plan fills less than a sixteenth of its index box");
  PlanBlock block = block_of(parts[0], places);
  if (!is_well_joined(block, plan, opposite)) return not_native("arms of the plan meet in index space only");
  return block;
}

std::vector<PlanBlock> separatrix_blocks(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite,
                                         bool at_faults) {
  const PlanVertices vertices = classify_vertices(plan, opposite);
  std::vector<std::uint8_t> is_cut(opposite.size()), is_passed(plan.points.size());
  std::vector<std::uint32_t> riders;  // half-edges about to be ridden along
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    const std::uint32_t from = plan.quads[h / 4][h % 4];
    if (!vertices.is_irregular(from)) continue;
    is_passed[from] = 1;
    if (opposite[h] != no_index) riders.push_back(h);
  }
  // The edge straight on from a half-edge inside: two edges to the left at its end.
  const auto straight_on = [&](std::uint32_t h) { return next_in_quad(opposite[next_in_quad(h)]); };
  if (at_faults) {
    const std::vector<std::uint8_t> on_fault = half_edges_on_faults(plan, opposite);
    for (std::uint32_t h = 0; h < opposite.size(); ++h) {
      if (!on_fault[h]) continue;
      const std::uint32_t to = plan.quads[h / 4][(h + 1) % 4];
      is_cut[h] = is_passed[to] = 1;
      if (!vertices.on_boundary[to] && !vertices.is_irregular(to) && !on_fault[straight_on(h)])
        riders.push_back(straight_on(h));
    }
  }
  while (!riders.empty()) {
    std::vector<std::uint32_t> further;
    for (const std::uint32_t h : riders) {
      if (is_cut[h]) continue;  // met another head on
      is_cut[h] = is_cut[opposite[h]] = 1;
      const std::uint32_t to = plan.quads[h / 4][(h + 1) % 4];
      if (is_passed[to] || vertices.on_boundary[to]) continue;
      is_passed[to] = 1;
      further.push_back(straight_on(h));
    }
    riders = std::move(further);
  }
  std::vector<Place> places;
  std::vector<PlanBlock> blocks;
  for (const IndexedPart& part : index_parts(static_cast<std::uint32_t>(plan.quads.size()), opposite, is_cut, places)) {
    // Without an irregular vertex a ring of quads closes on itself: no block, but its quads are.
    const bool is_full = part.is_consistent && part.size()[0] * part.size()[1] == part.quads.size();
    PlanBlock block = is_full ? block_of(part, places) : PlanBlock{};
    if (is_full && is_well_joined(block, plan, opposite))
      blocks.push_back(std::move(block));
    else
      for (const std::uint32_t quad : part.quads) blocks.push_back(single_block(quad));
  }
  return blocks;
}

}  // namespace strataflow
