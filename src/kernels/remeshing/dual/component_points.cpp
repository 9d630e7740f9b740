#include "kernels/remeshing/dual/component_points.h"

#include <algorithm>
#include <array>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "kernels/remeshing/dual/boundary_sides.h"
#include "kernels/remeshing/dual/piece_distance.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

using Indices = std::vector<std::uint32_t>;

/// A line that leaves the straight way through a cell by this share of its length has its point there.
constexpr double bend_share = 0.05;

struct Node {
  PointKind kind;
  std::uint32_t element;    ///< corner of the model, line component, surface component
  Indices boundaries;       ///< sides of the box it is on, ascending
  std::uint32_t roles = 0;  ///< bits
};

struct Group {
  Indices members;  ///< ascending
  Indices boundaries;
  std::uint32_t roles = 0;
};

/// One cell: its points before merging, then as groups.
struct Cell {
  std::vector<Node> nodes;
  Indices group_of;
  std::vector<Group> groups;
  std::vector<PointMerge> merges;
  std::vector<Vec3> positions;  ///< per group that has members
};

class PointPlacing {
 public:
  PointPlacing(const StructuralModel& model, const RestrictedDiagram& diagram, const CellComponents& components,
               const MergeOptions& options)
      : model_(model),
        diagram_(diagram),
        components_(components),
        options_(options),
        boundary_sides_(find_boundary_sides(model)) {
    corner_surfaces_.resize(model.corners.size());
    for (const Line& line : model.lines)
      if (!line.is_closed())
        for (const std::uint32_t corner : line.corners)
          corner_surfaces_[corner].insert(corner_surfaces_[corner].end(), line.surfaces.begin(), line.surfaces.end());
    for (Indices& surfaces : corner_surfaces_) surfaces = sorted_unique(std::move(surfaces));
    corners_passed_.resize(components.surfaces.size());
    for (std::size_t l = 0; l < components.loop_component.size(); ++l)
      for (const std::uint32_t slot : components.loop(l))
        if (components.slot_corner[slot] != no_index)
          corners_passed_[components.loop_component[l]].push_back(components.slot_corner[slot]);
  }

  ComponentPoints run() const {
    const std::size_t site_count = components_.site_surfaces.size() - 1;
    const std::vector<Cell> cells = parallel_map(
        site_count, [&](std::size_t site) { return place(static_cast<std::uint32_t>(site)); }, 64);
    ComponentPoints found;
    found.corner_point.assign(model_.corners.size(), no_index);
    found.line_point.assign(components_.lines.size(), no_index);
    found.surface_point.assign(components_.surfaces.size(), no_index);
    for (std::uint32_t site = 0; site < site_count; ++site) {
      const Cell& cell = cells[site];
      Indices point_of(cell.groups.size(), no_index);
      for (std::size_t g = 0; g < cell.groups.size(); ++g) {
        if (cell.groups[g].members.empty()) continue;
        point_of[g] = static_cast<std::uint32_t>(found.points.size());
        const Node& leader = cell.nodes[cell.groups[g].members[leader_of(cell, cell.groups[g])]];
        const std::uint32_t element = leader.kind == PointKind::corner ? leader.element
                                      : leader.kind == PointKind::line ? components_.lines[leader.element].line
                                                                       : components_.surfaces[leader.element].surface;
        found.points.push_back({cell.positions[g], site, leader.kind, element});
      }
      for (std::size_t n = 0; n < cell.nodes.size(); ++n) {
        const Node& node = cell.nodes[n];
        auto& list = node.kind == PointKind::corner ? found.corner_point
                     : node.kind == PointKind::line ? found.line_point
                                                    : found.surface_point;
        list[node.element] = point_of[cell.group_of[n]];
      }
      found.merges.insert(found.merges.end(), cell.merges.begin(), cell.merges.end());
    }
    return found;
  }

 private:
  Cell place(std::uint32_t site) const {
    Cell cell;
    gather(site, cell);
    if (cell.nodes.size() > 1 && (site >= options_.unmerged_sites.size() || !options_.unmerged_sites[site])) {
      if (options_.merges_linked_corners) merge_linked_corners(site, cell);
      if (options_.merges_beyond_two_points) merge_beyond_two_points(site, cell);
      if (options_.resolution_m > 0) merge_near(site, cell);
    }
    cell.positions.resize(cell.groups.size());
    for (std::size_t g = 0; g < cell.groups.size(); ++g)
      if (!cell.groups[g].members.empty()) cell.positions[g] = position_of(cell, cell.groups[g]);
    return cell;
  }

  void gather(std::uint32_t site, Cell& cell) const {
    for (std::uint32_t l = components_.site_lines[site]; l < components_.site_lines[site + 1]; ++l) {
      const auto corners = components_.corners_of(l);
      if (corners.empty())
        cell.nodes.push_back(make_node(PointKind::line, l, model_.lines[components_.lines[l].line].surfaces));
      for (const std::uint32_t corner : corners)
        cell.nodes.push_back(make_node(PointKind::corner, corner, corner_surfaces_[corner]));
    }
    for (std::uint32_t s = components_.site_surfaces[site]; s < components_.site_surfaces[site + 1]; ++s)
      if (components_.touched_by(s).empty())
        cell.nodes.push_back(make_node(PointKind::surface, s, {components_.surfaces[s].surface}));
    for (std::uint32_t n = 0; n < cell.nodes.size(); ++n) {
      cell.group_of.push_back(n);
      cell.groups.push_back({{n}, cell.nodes[n].boundaries, cell.nodes[n].roles});
    }
  }

  Node make_node(PointKind kind, std::uint32_t element, const Indices& surfaces) const {
    Node node{kind, element, {}, 0};
    for (const std::uint32_t surface : surfaces) {
      for (const std::uint32_t entity : model_.surfaces[surface].all_entities)
        node.roles |= 1u << static_cast<unsigned>(model_.entities[entity].role);
      if (boundary_sides_[surface] != no_index) node.boundaries.push_back(boundary_sides_[surface]);
    }
    node.boundaries = sorted_unique(std::move(node.boundaries));
    return node;
  }

  bool may_merge(const Group& a, const Group& b) const {
    if (!options_.keeps_boundary) return true;
    if (a.boundaries.empty() != b.boundaries.empty()) return false;
    const auto holds = [](const Indices& more, const Indices& less) {
      return std::includes(more.begin(), more.end(), less.begin(), less.end());
    };
    return holds(a.boundaries, b.boundaries) || holds(b.boundaries, a.boundaries);
  }

  /// Makes one group of the nodes, as far as they may; says whether anything changed.
  bool merge(std::uint32_t site, Cell& cell, const Indices& nodes, MergeKind kind, double distance_m = 0) const {
    PointMerge record{kind, site, distance_m, {}, {}, {}};
    bool is_changed = false;
    for (std::size_t i = 1; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const std::uint32_t low = std::min(cell.group_of[nodes[i]], cell.group_of[nodes[j]]);
        const std::uint32_t high = std::max(cell.group_of[nodes[i]], cell.group_of[nodes[j]]);
        if (low == high || !may_merge(cell.groups[low], cell.groups[high])) continue;
        Group& kept = cell.groups[low];
        Group& gone = cell.groups[high];
        note(cell, kept, record);
        note(cell, gone, record);
        kept.members.insert(kept.members.end(), gone.members.begin(), gone.members.end());
        std::sort(kept.members.begin(), kept.members.end());
        if (gone.boundaries.size() > kept.boundaries.size()) kept.boundaries = gone.boundaries;
        kept.roles |= gone.roles;
        for (const std::uint32_t member : gone.members) cell.group_of[member] = low;
        gone = {};
        is_changed = true;
      }
    if (!is_changed) return false;
    record.corners = sorted_unique(std::move(record.corners));
    record.lines = sorted_unique(std::move(record.lines));
    record.surfaces = sorted_unique(std::move(record.surfaces));
    cell.merges.push_back(std::move(record));
    return true;
  }

  void note(const Cell& cell, const Group& group, PointMerge& record) const {
    for (const std::uint32_t member : group.members) {
      const Node& node = cell.nodes[member];
      if (node.kind == PointKind::corner) record.corners.push_back(node.element);
      if (node.kind == PointKind::line) record.lines.push_back(components_.lines[node.element].line);
      if (node.kind == PointKind::surface) record.surfaces.push_back(components_.surfaces[node.element].surface);
    }
  }

  template <class Test>
  static Indices nodes_where(const Cell& cell, Test test) {
    Indices nodes;
    for (std::uint32_t n = 0; n < cell.nodes.size(); ++n)
      if (test(cell.nodes[n])) nodes.push_back(n);
    return nodes;
  }

  void merge_linked_corners(std::uint32_t site, Cell& cell) const {
    for (std::uint32_t l = components_.site_lines[site]; l < components_.site_lines[site + 1]; ++l) {
      if (components_.corners_of(l).size() < 2) continue;
      const Indices linked = nodes_where(cell, [&](const Node& node) {
        return node.kind == PointKind::corner && components_.corner_component[node.element] == l;
      });
      merge(site, cell, linked, MergeKind::linked_corners);
    }
  }

  void merge_beyond_two_points(std::uint32_t site, Cell& cell) const {
    std::vector<Indices> nodes_of;
    for (std::uint32_t s = components_.site_surfaces[site]; s < components_.site_surfaces[site + 1]; ++s) {
      const auto holds = [](std::span<const std::uint32_t> list, std::uint32_t item) {
        return std::find(list.begin(), list.end(), item) != list.end();
      };
      nodes_of.push_back(nodes_where(cell, [&](const Node& node) {
        return (node.kind == PointKind::corner && holds(corners_passed_[s], node.element)) ||
               (node.kind == PointKind::line && holds(components_.touched_by(s), node.element));
      }));
    }
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const Indices& nodes : nodes_of) {
        Indices groups;
        for (const std::uint32_t node : nodes) groups.push_back(cell.group_of[node]);
        if (sorted_unique(std::move(groups)).size() > 2)
          is_changed = merge(site, cell, nodes, MergeKind::beyond_two_points) || is_changed;
      }
    }
  }

  /// Calls visit(points) for each segment or polygon of the model that a node stands for.
  template <class Visit>
  void for_pieces(const Node& node, Visit visit) const {
    if (node.kind == PointKind::surface) {
      for (const std::uint32_t piece : components_.pieces_of(node.element)) visit(diagram_.piece_points(piece));
    } else if (node.kind == PointKind::line) {
      for (const std::uint32_t part : components_.parts_of(node.element)) {
        const std::array<Vec3, 2> ends{components_.parts[part].begin, components_.parts[part].end};
        visit(std::span<const Vec3>(ends));
      }
    } else {
      const Vec3 at = model_.points[model_.corners[node.element].vertex];
      const std::array<Vec3, 2> ends{at, at};
      visit(std::span<const Vec3>(ends));
    }
  }

  Box3 box_of(const Node& node) const {
    Box3 box;
    for_pieces(node, [&](std::span<const Vec3> points) {
      for (const Vec3& p : points) box.take(p);
    });
    return box;
  }

  void merge_near(std::uint32_t site, Cell& cell) const {
    struct Near {
      double squared;
      std::uint32_t a, b;
    };
    std::vector<Near> near;
    const double limit = options_.resolution_m * options_.resolution_m;
    std::vector<Box3> boxes;
    for (const Node& node : cell.nodes) boxes.push_back(box_of(node));
    for (std::uint32_t a = 0; a < cell.nodes.size(); ++a)
      for (std::uint32_t b = a + 1; b < cell.nodes.size(); ++b) {
        if (cell.group_of[a] == cell.group_of[b]) continue;
        if (!options_.merges_different_roles && (cell.nodes[a].roles & cell.nodes[b].roles) == 0) continue;
        const double squared = squared_distance(cell.nodes[a], boxes[a], cell.nodes[b], boxes[b], limit);
        if (squared < limit) near.push_back({squared, a, b});
      }
    std::sort(near.begin(), near.end(), [](const Near& x, const Near& y) {
      if (x.squared != y.squared) return x.squared < y.squared;
      return x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    for (const Near& pair : near)
      if (!moves_too_far(cell, cell.group_of[pair.a], cell.group_of[pair.b]))
        merge(site, cell, {pair.a, pair.b}, MergeKind::resolution, std::sqrt(pair.squared));
  }

  /// Pieces near each other at one end only, as of lines that meet at an angle, must not become one as far as the cell
  /// goes: the common point would leave one of them by much more than the resolution.
  bool moves_too_far(const Cell& cell, std::uint32_t a, std::uint32_t b) const {
    if (!(options_.most_move_m > 0) || a == b) return false;
    Group both = cell.groups[a];
    both.members.insert(both.members.end(), cell.groups[b].members.begin(), cell.groups[b].members.end());
    std::sort(both.members.begin(), both.members.end());
    const Vec3 common = position_of(cell, both);
    return std::any_of(both.members.begin(), both.members.end(), [&](std::uint32_t member) {
      return length(nearest_of({&cell.nodes[member]}, common) - common) > options_.most_move_m;
    });
  }

  /// Of the pieces two nodes stand for; anything above `limit` where that is clear from boxes.
  double squared_distance(const Node& a, const Box3& box_a, const Node& b, const Box3& box_b, double limit) const {
    const auto gap = [](const Box3& x, const Box3& y) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        const double d = std::max({0.0, x.low[k] - y.high[k], y.low[k] - x.high[k]});
        sum += d * d;
      }
      return sum;
    };
    double smallest = std::numeric_limits<double>::infinity();
    if (gap(box_a, box_b) >= limit) return smallest;
    for_pieces(a, [&](std::span<const Vec3> piece_a) {
      Box3 box;
      for (const Vec3& p : piece_a) box.take(p);
      if (gap(box, box_b) >= limit) return;
      for_pieces(b, [&](std::span<const Vec3> piece_b) {
        smallest = std::min(smallest, squared_distance_of_pieces(piece_a, piece_b));
      });
    });
    return smallest;
  }

  /// Which member of a group decides where it goes, as an index into members: of the most boundaries, then of the
  /// highest kind, then the first.
  std::size_t leader_of(const Cell& cell, const Group& group) const {
    std::size_t leader = 0;
    for (std::size_t m = 1; m < group.members.size(); ++m) {
      const Node& best = cell.nodes[group.members[leader]];
      const Node& node = cell.nodes[group.members[m]];
      if (node.boundaries.size() != best.boundaries.size() ? node.boundaries.size() > best.boundaries.size()
                                                           : node.kind > best.kind)
        leader = m;
    }
    return leader;
  }

  Vec3 position_of(const Cell& cell, const Group& group) const {
    const Node& leader = cell.nodes[group.members[leader_of(cell, group)]];
    std::vector<const Node*> equals;
    for (const std::uint32_t member : group.members) {
      const Node& node = cell.nodes[member];
      if (node.kind == leader.kind && node.boundaries.size() == leader.boundaries.size()) equals.push_back(&node);
    }
    Vec3 mean;
    for (const Node* node : equals) mean = mean + own_position(*node);
    mean = (1.0 / static_cast<double>(equals.size())) * mean;
    if (equals.size() == 1 && leader.kind != PointKind::surface) return mean;
    return nearest_of(equals, mean);
  }

  Vec3 nearest_of(const std::vector<const Node*>& nodes, const Vec3& p) const {
    Vec3 nearest = p;
    double smallest = std::numeric_limits<double>::infinity();
    for (const Node* node : nodes)
      for_pieces(*node, [&](std::span<const Vec3> piece) {
        const Vec3 x = piece.size() == 2 ? nearest_on_segment(p, piece[0], piece[1]) : nearest_on_polygon(p, piece);
        if (const double d = dot(x - p, x - p); d < smallest) {
          smallest = d;
          nearest = x;
        }
      });
    return nearest;
  }

  /// The corner; half way along the line, or where it bends most; the centroid of the surface.
  Vec3 own_position(const Node& node) const {
    if (node.kind == PointKind::corner) return model_.points[model_.corners[node.element].vertex];
    if (node.kind == PointKind::line) return middle_of(node.element);
    Vec3 moment;
    double area = 0;
    for (const std::uint32_t piece : components_.pieces_of(node.element)) {
      const auto p = diagram_.piece_points(piece);
      for (std::size_t k = 2; k < p.size(); ++k) {
        const double a = length(cross(p[k - 1] - p[0], p[k] - p[0]));
        moment = moment + (a / 3) * (p[0] + p[k - 1] + p[k]);
        area += a;
      }
    }
    return area > 0 ? (1 / area) * moment : diagram_.piece_points(components_.pieces_of(node.element)[0])[0];
  }

  Vec3 middle_of(std::uint32_t line_component) const {
    const auto parts = components_.parts_of(line_component);
    // A closed line may run through the cell at its first vertex: start after the gap.
    std::size_t start = 0;
    for (std::size_t k = 1; k < parts.size(); ++k)
      if (parts[k] != parts[k - 1] + 1) start = k;
    const auto part_at = [&](std::size_t k) -> const LinePart& {
      return components_.parts[parts[(start + k) % parts.size()]];
    };
    double total = 0, farthest = 0;
    Vec3 bend;
    const Vec3 &from = part_at(0).begin, &to = part_at(parts.size() - 1).end;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Vec3& p = part_at(k).end;
      total += length(p - part_at(k).begin);
      if (const double d = length(nearest_on_segment(p, from, to) - p); d > farthest && from != to) {
        farthest = d;
        bend = p;
      }
    }
    if (options_.follows_bends && farthest > bend_share * total) return bend;  // else the mesh would cut it off
    double left = total / 2;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const LinePart& part = part_at(k);
      const double own = length(part.end - part.begin);
      if (left <= own || k + 1 == parts.size())
        return own > 0 ? part.begin + std::min(1.0, left / own) * (part.end - part.begin) : part.begin;
      left -= own;
    }
    return components_.parts[parts[0]].begin;
  }

  const StructuralModel& model_;
  const RestrictedDiagram& diagram_;
  const CellComponents& components_;
  const MergeOptions& options_;
  Indices boundary_sides_;
  std::vector<Indices> corner_surfaces_;
  std::vector<Indices> corners_passed_;  ///< per surface component, along its borders
};

}  // namespace

std::string_view to_string(MergeKind kind) {
  switch (kind) {
    case MergeKind::linked_corners:
      return "linked_corners";
    case MergeKind::beyond_two_points:
      return "beyond_two_points";
    case MergeKind::resolution:
      return "resolution";
  }
  return "unknown";
}

ComponentPoints place_component_points(const StructuralModel& model, const RestrictedDiagram& diagram,
                                       const CellComponents& components, const MergeOptions& options) {
  return PointPlacing(model, diagram, components, options).run();
}

}  // namespace strataflow
