#include "kernels/reference_models/seal_columns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>

#include "base/internal_error.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/reference_models/polygon_triangulation.h"

namespace strataflow {
namespace {

constexpr double weld_m = 1e-8;      // heights of one column nearer than this are one point
constexpr double snap_ratio = 0.15;  // a contact nearer to a map point than this share of the edge moves onto it
constexpr std::size_t grain = 512;
constexpr std::uint32_t none = 0xffffffffu;

/// The levels of one block over one map point: the entries [first_level, + levels of the block) of the level arrays.
struct Stack {
  std::uint32_t point = 0, block = 0;
  std::size_t first_level = 0;
};

/// One edge of the map and a triangle beside it.
struct HalfEdge {
  std::uint32_t low = 0, high = 0, triangle = 0;
};

/// A point where a level meets the cutter inside an edge of the map; `t` runs from the edge's lower point number.
struct Contact {
  std::uint32_t edge = 0;
  double t = 0;
  std::uint32_t point = 0;
};

/// What one wall asks of the column at one of its ends.
struct WallEnd {
  std::uint32_t point = 0;
  double low_m = 0, high_m = 0;
};

struct PathNode {
  std::uint32_t point = 0;
  double t = 0;
  friend bool operator==(const PathNode& a, const PathNode& b) { return a.point == b.point; }
};
/// A level across a wall, from the column at its first end to the column at its second.
using Path = std::vector<PathNode>;

class SealedColumns {
 public:
  SealedColumns(const ColumnModel& model, double edge_m) : model_(model), edge_m_(edge_m), map_(model.map(edge_m)) {}

  TriangleSoup build() {
    find_edges();
    find_heights();
    snap_to_cutter();
    place_columns();
    place_contacts();
    for (const MapTriangle& triangle : map_.triangles) add_levels(triangle);
    for (const Wall& wall : map_.walls) add_wall(wall);
    return finished();
  }

 private:
  const std::vector<Level>& levels_of(const Stack& stack) const { return model_.blocks[stack.block]; }

  std::span<const Stack> stacks_at(std::uint32_t point) const {
    return {stacks_.data() + stack_begin_[point], stack_begin_[point + 1] - stack_begin_[point]};
  }

  const Stack& stack_at(std::uint32_t point, std::uint32_t block) const {
    for (const Stack& stack : stacks_at(point))
      if (stack.block == block) return stack;
    STRATAFLOW_ASSERT(false, "a map triangle without a stack at its corner");
    return stacks_.front();
  }

  static std::optional<std::uint32_t> cutter_of(const std::vector<Level>& levels) {
    for (std::uint32_t l = 0; l < levels.size(); ++l)
      if (levels[l].cut == Cut::cutter) return l;
    return std::nullopt;
  }

  static bool is_cut(Cut cut) { return cut == Cut::below_cutter || cut == Cut::above_cutter; }

  /// How far a level is from being cut away, metres; positive where it exists.
  double clearance(const Stack& stack, std::uint32_t level, std::uint32_t cutter) const {
    const double gap = height_[stack.first_level + cutter] - height_[stack.first_level + level];
    return levels_of(stack)[level].cut == Cut::below_cutter ? gap : -gap;
  }

  void find_edges() {
    half_edges_.reserve(3 * map_.triangles.size());
    for (std::uint32_t t = 0; t < map_.triangles.size(); ++t) {
      const auto& corners = map_.triangles[t].corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
        half_edges_.push_back({std::min(a, b), std::max(a, b), t});
      }
    }
    sort_total_order(half_edges_, [](const HalfEdge& a, const HalfEdge& b) {
      if (a.low != b.low) return a.low < b.low;
      if (a.high != b.high) return a.high < b.high;
      return a.triangle < b.triangle;
    });
    for (std::uint32_t i = 0; i < half_edges_.size(); ++i)
      if (i == 0 || half_edges_[i].low != half_edges_[i - 1].low || half_edges_[i].high != half_edges_[i - 1].high)
        edge_begin_.push_back(i);
    edge_begin_.push_back(static_cast<std::uint32_t>(half_edges_.size()));
  }

  std::size_t edge_count() const { return edge_begin_.size() - 1; }

  std::uint32_t edge_between(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t low = std::min(a, b), high = std::max(a, b);
    const auto found = std::lower_bound(edge_begin_.begin(), edge_begin_.end() - 1, 0u, [&](std::uint32_t i, unsigned) {
      const HalfEdge& half = half_edges_[i];
      return half.low != low ? half.low < low : half.high < high;
    });
    return static_cast<std::uint32_t>(found - edge_begin_.begin());
  }

  /// The blocks beside an edge, each once.
  std::vector<std::uint32_t> blocks_beside(std::uint32_t edge) const {
    std::vector<std::uint32_t> blocks;
    for (std::uint32_t i = edge_begin_[edge]; i < edge_begin_[edge + 1]; ++i) {
      const std::uint32_t block = map_.triangles[half_edges_[i].triangle].block;
      if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
    }
    return blocks;
  }

  void find_heights() {
    for (const MapTriangle& triangle : map_.triangles)
      for (const std::uint32_t corner : triangle.corners) stacks_.push_back({corner, triangle.block, 0});
    const auto key_less = [](const Stack& a, const Stack& b) {
      return a.point != b.point ? a.point < b.point : a.block < b.block;
    };
    std::sort(stacks_.begin(), stacks_.end(), key_less);
    stacks_.erase(std::unique(stacks_.begin(), stacks_.end(),
                              [](const Stack& a, const Stack& b) { return a.point == b.point && a.block == b.block; }),
                  stacks_.end());
    stack_begin_.assign(map_.points.size() + 1, 0);
    std::size_t level_count = 0;
    for (Stack& stack : stacks_) {
      ++stack_begin_[stack.point + 1];
      stack.first_level = level_count;
      level_count += levels_of(stack).size();
    }
    for (std::size_t p = 0; p < map_.points.size(); ++p) stack_begin_[p + 1] += stack_begin_[p];
    height_.resize(level_count);
    state_.assign(level_count, 1);
    parallel_ranges(stacks_.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s)
        for (std::uint32_t l = 0; l < levels_of(stacks_[s]).size(); ++l)
          height_[stacks_[s].first_level + l] = model_.height(stacks_[s].block, l, map_.points[stacks_[s].point]);
    });
  }

  /// Gives every level of every stack its state: 1 exists, 0 lies on the cutter, −1 cut away. Contacts that would
  /// fall close to a map point move onto it; what lies between them and the cutter follows, so that order is kept.
  void snap_to_cutter() {
    std::vector<std::array<double, 2>> reach(map_.points.size(), {0, 0});  // per map point: snapped below, above
    for (std::uint32_t edge = 0; edge < edge_count(); ++edge) {
      const std::array<std::uint32_t, 2> ends{half_edges_[edge_begin_[edge]].low, half_edges_[edge_begin_[edge]].high};
      for (const std::uint32_t block : blocks_beside(edge)) {
        const auto& levels = model_.blocks[block];
        const auto cutter = cutter_of(levels);
        if (!cutter) continue;
        for (std::uint32_t l = 0; l < levels.size(); ++l) {
          if (!is_cut(levels[l].cut)) continue;
          const double a = clearance(stack_at(ends[0], block), l, *cutter);
          const double b = clearance(stack_at(ends[1], block), l, *cutter);
          if ((a > 0) == (b > 0)) continue;
          const double t = a / (a - b);
          if (t < snap_ratio) widen(reach[ends[0]], a);
          if (t > 1 - snap_ratio) widen(reach[ends[1]], b);
        }
      }
    }
    for (const Stack& stack : stacks_) {
      const auto& levels = levels_of(stack);
      const auto cutter = cutter_of(levels);
      if (!cutter) continue;
      for (std::uint32_t l = 0; l < levels.size(); ++l) {
        if (!is_cut(levels[l].cut)) continue;
        const double gap = clearance(stack, l, *cutter);
        const bool is_snapped = gap >= -reach[stack.point][0] - weld_m && gap <= reach[stack.point][1] + weld_m;
        state_[stack.first_level + l] = static_cast<std::int8_t>(is_snapped ? 0 : gap > 0 ? 1 : -1);
      }
    }
    for (const Stack& stack : stacks_) {
      const auto cutter = cutter_of(levels_of(stack));
      for (std::uint32_t l = 0; l < levels_of(stack).size(); ++l)
        if (state_[stack.first_level + l] == 0) height_[stack.first_level + l] = height_[stack.first_level + *cutter];
    }
  }

  static void widen(std::array<double, 2>& reach, double gap) {
    double& side = reach[gap > 0 ? 1 : 0];
    side = std::max(side, std::abs(gap));
  }

  /// One point per height of each column, ascending, with points between them where walls are high.
  void place_columns() {
    std::vector<WallEnd> wall_ends;
    for (const Wall& wall : map_.walls)
      for (std::size_t k = 0; k < 2; ++k) wall_ends.push_back({wall.ends[k], wall.low_m[k], wall.high_m[k]});
    std::sort(wall_ends.begin(), wall_ends.end(), [](const WallEnd& a, const WallEnd& b) {
      return std::tie(a.point, a.low_m, a.high_m) < std::tie(b.point, b.low_m, b.high_m);
    });
    std::vector<double> heights, column;
    std::vector<std::uint32_t> point_column;
    column_begin_.assign(1, 0);
    auto wall_end = wall_ends.begin();
    for (std::uint32_t p = 0; p < map_.points.size(); ++p) {
      auto last_wall_end = wall_end;
      while (last_wall_end != wall_ends.end() && last_wall_end->point == p) ++last_wall_end;
      heights.clear();
      for (const Stack& stack : stacks_at(p))
        for (std::size_t l = 0; l < levels_of(stack).size(); ++l)
          if (state_[stack.first_level + l] >= 0) heights.push_back(height_[stack.first_level + l]);
      for (auto end = wall_end; end != last_wall_end; ++end) heights.insert(heights.end(), {end->low_m, end->high_m});
      std::sort(heights.begin(), heights.end());
      column.clear();
      for (const double z : heights) {
        if (!column.empty() && z - column.back() <= weld_m) continue;
        const bool is_on_wall = !column.empty() && std::any_of(wall_end, last_wall_end, [&](const WallEnd& end) {
          return end.low_m < z - weld_m && end.high_m > column.back() + weld_m;
        });
        if (is_on_wall) add_between(p, column.back(), z, column);
        column.push_back(z);
      }
      wall_end = last_wall_end;
      column_height_.insert(column_height_.end(), column.begin(), column.end());
      point_column.insert(point_column.end(), column.size(), p);
      column_begin_.push_back(static_cast<std::uint32_t>(column_height_.size()));
    }
    points_.resize(column_height_.size());
    parallel_ranges(points_.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t p = point_column[i];
        points_[i] = model_.at(stacks_at(p).front().block, map_.points[p], column_height_[i]);
      }
    });
  }

  void add_between(std::uint32_t p, double low, double high, std::vector<double>& column) const {
    const std::uint32_t block = stacks_at(p).front().block;
    const double span = length(model_.at(block, map_.points[p], high) - model_.at(block, map_.points[p], low));
    const double count = std::max(1.0, std::round(span / edge_m_));
    for (double k = 1; k < count; ++k) column.push_back(low + (high - low) * (k / count));
  }

  /// The point of height `z_m` in column `p`.
  std::uint32_t node(std::uint32_t p, double z_m) const {
    const auto begin = column_height_.begin() + column_begin_[p], end = column_height_.begin() + column_begin_[p + 1];
    auto found = std::lower_bound(begin, end, z_m - weld_m);
    STRATAFLOW_ASSERT(found != end, "a height that its column does not hold");
    return static_cast<std::uint32_t>(found - column_height_.begin());
  }

  std::uint32_t node(const Stack& stack, std::uint32_t level) const {
    return node(stack.point, height_[stack.first_level + level]);
  }

  void place_contacts() {
    for (std::uint32_t edge = 0; edge < edge_count(); ++edge) {
      const std::uint32_t from = half_edges_[edge_begin_[edge]].low, to = half_edges_[edge_begin_[edge]].high;
      for (const std::uint32_t block : blocks_beside(edge)) {
        const auto& levels = model_.blocks[block];
        const auto cutter = cutter_of(levels);
        if (!cutter) continue;
        const Stack &a = stack_at(from, block), &b = stack_at(to, block);
        for (std::uint32_t l = 0; l < levels.size(); ++l) {
          if (!is_cut(levels[l].cut) || state(a, l) * state(b, l) >= 0) continue;
          contacts_.push_back({edge, contact_t(a, b, l, *cutter), none});
        }
      }
    }
    std::sort(contacts_.begin(), contacts_.end(),
              [](const Contact& a, const Contact& b) { return a.edge != b.edge ? a.edge < b.edge : a.t < b.t; });
    contacts_.erase(
        std::unique(contacts_.begin(), contacts_.end(),
                    [](const Contact& a, const Contact& b) { return a.edge == b.edge && is_same(a.t, b.t); }),
        contacts_.end());
    for (Contact& contact : contacts_) {
      const HalfEdge& half = half_edges_[edge_begin_[contact.edge]];
      const std::uint32_t block = map_.triangles[half.triangle].block;
      const std::uint32_t cutter = *cutter_of(model_.blocks[block]);
      const Vec3 a = points_[node(stack_at(half.low, block), cutter)];
      const Vec3 b = points_[node(stack_at(half.high, block), cutter)];
      contact.point = static_cast<std::uint32_t>(points_.size());
      points_.push_back(a + contact.t * (b - a));
      // Exactly in a side of the box: the product above may round.
      if (a.x == b.x) points_.back().x = a.x;
      if (a.y == b.y) points_.back().y = a.y;
    }
  }

  static bool is_same(double t, double u) { return std::abs(t - u) <= 1e-9; }

  int state(const Stack& stack, std::uint32_t level) const { return state_[stack.first_level + level]; }

  double contact_t(const Stack& a, const Stack& b, std::uint32_t level, std::uint32_t cutter) const {
    const double at_a = clearance(a, level, cutter), at_b = clearance(b, level, cutter);
    return at_a / (at_a - at_b);
  }

  std::span<const Contact> contacts_on(std::uint32_t edge) const {
    const auto edge_less = [](const Contact& a, const Contact& b) { return a.edge < b.edge; };
    const auto [first, last] = std::equal_range(contacts_.begin(), contacts_.end(), Contact{edge, 0, 0}, edge_less);
    return {first, last};
  }

  /// The contact of a level on the edge between two stacks of a block.
  const Contact& contact(const Stack& a, const Stack& b, std::uint32_t level, std::uint32_t cutter) const {
    const bool is_forward = a.point < b.point;
    const double t = is_forward ? contact_t(a, b, level, cutter) : contact_t(b, a, level, cutter);
    for (const Contact& candidate : contacts_on(edge_between(a.point, b.point)))
      if (is_same(candidate.t, t)) return candidate;
    STRATAFLOW_ASSERT(false, "a level changes side without a contact");
    return contacts_.front();
  }

  void add(std::uint32_t entity, const Triangle& triangle) {
    triangles_.push_back(triangle);
    triangle_entity_.push_back(entity);
  }

  void add_polygon(std::uint32_t entity, std::vector<PolygonNode>& polygon) {
    scratch_.clear();
    triangulate_polygon(polygon, points_, scratch_);
    for (const Triangle& triangle : scratch_) add(entity, triangle);
  }

  PolygonNode seen_from_above(std::uint32_t point) const { return {point, points_[point].x, points_[point].y}; }

  void add_levels(const MapTriangle& triangle) {
    const auto& levels = model_.blocks[triangle.block];
    const auto cutter = cutter_of(levels);
    const std::array<const Stack*, 3> stacks{&stack_at(triangle.corners[0], triangle.block),
                                             &stack_at(triangle.corners[1], triangle.block),
                                             &stack_at(triangle.corners[2], triangle.block)};
    for (std::uint32_t l = 0; l < levels.size(); ++l) {
      if (levels[l].cut == Cut::cutter) {
        add_cutter(levels, l, stacks);
      } else if (is_cut(levels[l].cut)) {
        add_cut_level(levels[l].entity, l, *cutter, stacks);
      } else {
        add(levels[l].entity, {node(*stacks[0], l), node(*stacks[1], l), node(*stacks[2], l)});
      }
    }
  }

  /// The part of a level that the cutter leaves of it.
  void add_cut_level(std::uint32_t entity, std::uint32_t level, std::uint32_t cutter,
                     const std::array<const Stack*, 3>& stacks) {
    std::vector<PolygonNode> polygon;
    bool exists = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Stack &a = *stacks[k], &b = *stacks[(k + 1) % 3];
      exists = exists || state(a, level) > 0;
      if (state(a, level) >= 0) polygon.push_back(seen_from_above(node(a, level)));
      if (state(a, level) * state(b, level) < 0) polygon.push_back(seen_from_above(contact(a, b, level, cutter).point));
      if (state(a, level) == 0 && state(b, level) == 0) add_contacts_between(a, b, polygon);
    }
    if (exists) add_polygon(entity, polygon);
  }

  void add_contacts_between(const Stack& a, const Stack& b, std::vector<PolygonNode>& polygon) const {
    const auto contacts = contacts_on(edge_between(a.point, b.point));
    for (std::size_t i = 0; i < contacts.size(); ++i)
      polygon.push_back(seen_from_above(contacts[a.point < b.point ? i : contacts.size() - 1 - i].point));
  }

  /// The cutter's triangle, divided along the levels that end on it.
  void add_cutter(const std::vector<Level>& levels, std::uint32_t cutter, const std::array<const Stack*, 3>& stacks) {
    std::vector<std::vector<PolygonNode>> polygons(1);
    for (std::size_t k = 0; k < 3; ++k) {
      polygons[0].push_back(seen_from_above(node(*stacks[k], cutter)));
      add_contacts_between(*stacks[k], *stacks[(k + 1) % 3], polygons[0]);
    }
    for (std::uint32_t l = 0; l < levels.size(); ++l) {
      if (!is_cut(levels[l].cut)) continue;
      std::vector<std::uint32_t> ends;
      int touching = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Stack &a = *stacks[k], &b = *stacks[(k + 1) % 3];
        if (state(a, l) == 0) ends.push_back(node(a, cutter)), ++touching;
        if (state(a, l) * state(b, l) < 0) ends.push_back(contact(a, b, l, cutter).point);
      }
      if (ends.size() == 2 && touching < 2) split(polygons, ends[0], ends[1]);
    }
    for (auto& polygon : polygons) add_polygon(levels[cutter].entity, polygon);
  }

  static void split(std::vector<std::vector<PolygonNode>>& polygons, std::uint32_t from, std::uint32_t to) {
    for (auto& polygon : polygons) {
      const auto has = [&](std::uint32_t point) {
        return std::find_if(polygon.begin(), polygon.end(), [&](const PolygonNode& n) { return n.point == point; });
      };
      if (has(from) == polygon.end() || has(to) == polygon.end()) continue;
      std::rotate(polygon.begin(), has(from), polygon.end());
      const auto middle = has(to);
      if (middle == polygon.begin() + 1 || middle == polygon.end() - 1) return;  // an edge of it already
      std::vector<PolygonNode> rest(middle, polygon.end());
      rest.push_back(polygon.front());
      polygon.erase(middle + 1, polygon.end());
      polygons.push_back(std::move(rest));
      return;
    }
  }

  /// The levels of one block across a wall; levels that coincide with the cutter all along are left out.
  void add_paths(const Stack& a, const Stack& b, std::uint32_t edge, std::vector<Path>& paths) const {
    const auto& levels = levels_of(a);
    const auto cutter = cutter_of(levels);
    Path along_cutter;
    if (cutter) {
      along_cutter.push_back({node(a, *cutter), 0});
      const auto contacts = contacts_on(edge);
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& c = contacts[a.point < b.point ? i : contacts.size() - 1 - i];
        along_cutter.push_back({c.point, a.point < b.point ? c.t : 1 - c.t});
      }
      along_cutter.push_back({node(b, *cutter), 1});
      paths.push_back(along_cutter);
    }
    for (std::uint32_t l = 0; l < levels.size(); ++l) {
      if (levels[l].cut == Cut::cutter) continue;
      const int at_a = state(a, l), at_b = state(b, l);
      if (at_a <= 0 && at_b <= 0) continue;
      if (at_a >= 0 && at_b >= 0) {
        paths.push_back({{node(a, l), 0}, {node(b, l), 1}});
        continue;
      }
      const PathNode meets{contact(a, b, l, *cutter).point, 0};
      const auto met = std::find(along_cutter.begin(), along_cutter.end(), meets);
      if (at_a > 0) {
        paths.emplace_back(met, along_cutter.end());
        paths.back().insert(paths.back().begin(), {node(a, l), 0});
      } else {
        paths.emplace_back(along_cutter.begin(), met + 1);
        paths.back().push_back({node(b, l), 1});
      }
    }
  }

  void add_wall(const Wall& wall) {
    const std::uint32_t edge = edge_between(wall.ends[0], wall.ends[1]);
    const std::array<std::uint32_t, 2> low{node(wall.ends[0], wall.low_m[0]), node(wall.ends[1], wall.low_m[1])};
    const std::array<std::uint32_t, 2> high{node(wall.ends[0], wall.high_m[0]), node(wall.ends[1], wall.high_m[1])};
    std::vector<Path> paths;
    for (const std::uint32_t block : blocks_beside(edge))
      add_paths(stack_at(wall.ends[0], block), stack_at(wall.ends[1], block), edge, paths);
    const auto ends_less = [](const Path& a, const Path& b) {
      return a.front().point != b.front().point ? a.front().point < b.front().point : a.back().point < b.back().point;
    };
    for (const auto& limit : {low, high}) {  // a tip line, unless a level runs there
      const Path straight{{limit[0], 0}, {limit[1], 1}};
      const bool is_level = std::any_of(paths.begin(), paths.end(), [&](const Path& path) {
        return !ends_less(path, straight) && !ends_less(straight, path);
      });
      if (!is_level) paths.push_back(straight);
    }
    std::sort(paths.begin(), paths.end(), ends_less);
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    for (std::size_t i = 0; i + 1 < paths.size(); ++i) {
      const Path &below = paths[i], &above = paths[i + 1];
      STRATAFLOW_ASSERT(below.back().point <= above.back().point, "levels cross inside an edge of the map");
      if (below.front().point >= low[0] && below.back().point >= low[1] && above.front().point <= high[0] &&
          above.back().point <= high[1])
        add_cell(wall.entity, below, above, length_of(wall));
    }
  }

  double length_of(const Wall& wall) const {
    return length(points_[node(wall.ends[1], wall.low_m[1])] - points_[node(wall.ends[0], wall.low_m[0])]);
  }

  /// The part of a wall between two neighbouring paths.
  void add_cell(std::uint32_t entity, Path below, Path above, double wall_length) {
    if (below.size() == 2 && above.size() == 2) {
      std::vector<std::uint32_t> left, right;
      for (std::uint32_t n = below.front().point; n <= above.front().point; ++n) left.push_back(n);
      for (std::uint32_t n = below.back().point; n <= above.back().point; ++n) right.push_back(n);
      scratch_.clear();
      triangulate_strip(left, right, points_, scratch_);
      for (const Triangle& triangle : scratch_) add(entity, triangle);
      return;
    }
    while (below.size() > 1 && above.size() > 1 && below.back() == above.back() &&
           below[below.size() - 2] == above[above.size() - 2]) {
      below.pop_back();
      above.pop_back();
    }
    while (below.size() > 1 && above.size() > 1 && below.front() == above.front() && below[1] == above[1]) {
      below.erase(below.begin());
      above.erase(above.begin());
    }
    std::vector<PolygonNode> polygon;
    const auto push = [&](std::uint32_t point, double t) {
      if (!polygon.empty() && (polygon.back().point == point || polygon.front().point == point)) return;
      polygon.push_back({point, t * wall_length, points_[point].z});
    };
    for (const PathNode& n : below) push(n.point, n.t);
    if (below.back().t == 1)
      for (std::uint32_t n = below.back().point + 1; n < above.back().point; ++n) push(n, 1);
    for (std::size_t i = above.size(); i-- > 0;) push(above[i].point, above[i].t);
    if (below.front().t == 0)
      for (std::uint32_t n = above.front().point; n-- > below.front().point + 1;) push(n, 0);
    if (polygon.size() >= 3) add_polygon(entity, polygon);
  }

  TriangleSoup finished() const {
    TriangleSoup soup;
    std::vector<std::uint32_t> new_point(points_.size(), none);
    for (const Triangle& triangle : triangles_)
      for (const std::uint32_t point : triangle) new_point[point] = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (new_point[i] == none) continue;
      new_point[i] = static_cast<std::uint32_t>(soup.points.size());
      soup.points.push_back(points_[i]);
    }
    std::vector<std::size_t> end(model_.entities.size() + 1, 0);
    for (const std::uint32_t entity : triangle_entity_) ++end[entity + 1];
    for (std::size_t e = 0; e < model_.entities.size(); ++e) end[e + 1] += end[e];
    soup.triangles.resize(triangles_.size());
    soup.triangle_patch.resize(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const std::size_t slot = end[triangle_entity_[t]]++;
      for (std::size_t k = 0; k < 3; ++k) soup.triangles[slot][k] = new_point[triangles_[t][k]];
      soup.triangle_patch[slot] = triangle_entity_[t];
    }
    soup.entities = model_.entities;
    for (std::uint32_t e = 0; e < model_.entities.size(); ++e) soup.patch_entity.push_back(e);
    return soup;
  }

  const ColumnModel& model_;
  double edge_m_;
  ColumnMap map_;
  std::vector<HalfEdge> half_edges_;         // by (low, high, triangle)
  std::vector<std::uint32_t> edge_begin_;    // per edge: its first half edge
  std::vector<Stack> stacks_;                // by (point, block)
  std::vector<std::uint32_t> stack_begin_;   // per map point: its first stack
  std::vector<double> height_;               // per level of a stack
  std::vector<std::int8_t> state_;           // per level of a stack
  std::vector<double> column_height_;        // per point that stands in a column, ascending in each
  std::vector<std::uint32_t> column_begin_;  // per map point: its first point
  std::vector<Vec3> points_;                 // columns, then contacts
  std::vector<Contact> contacts_;            // by (edge, t)
  std::vector<Triangle> triangles_, scratch_;
  std::vector<std::uint32_t> triangle_entity_;
};

}  // namespace

TriangleSoup seal_columns(const ColumnModel& model, double edge_m) { return SealedColumns(model, edge_m).build(); }

}  // namespace strataflow
