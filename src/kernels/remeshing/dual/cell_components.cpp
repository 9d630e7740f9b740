#include "kernels/remeshing/dual/cell_components.h"

#include <algorithm>
#include <optional>
#include <string>

#include "graph/parallel/parallel_map.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 1024;

/// Items grouped by a key below `key_count`, ascending inside a group.
void group_by(std::size_t key_count, const std::vector<std::uint32_t>& key_of, std::vector<std::uint32_t>& begin,
              std::vector<std::uint32_t>& items) {
  begin.assign(key_count + 1, 0);
  for (const std::uint32_t key : key_of)
    if (key != no_index) ++begin[key + 1];
  for (std::size_t k = 0; k < key_count; ++k) begin[k + 1] += begin[k];
  items.resize(begin[key_count]);
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t i = 0; i < key_of.size(); ++i)
    if (key_of[i] != no_index) items[next[key_of[i]]++] = i;
}

class ComponentSearch {
 public:
  ComponentSearch(const StructuralModel& model, const RestrictedDiagram& diagram, std::size_t site_count)
      : model_(model),
        diagram_(diagram),
        site_count_(site_count),
        edges_(build_edge_table(model.points.size(), model.triangles)) {}

  Result<CellComponents> run() {
    pair_inside_triangles();
    cut_lines();
    if (auto problem = pair_across_edges()) return *problem;
    join_pieces();
    join_parts();
    walk_borders();
    count_euler();
    return std::move(found_);
  }

 private:
  std::uint32_t next(std::uint32_t slot) const { return next_in_piece(diagram_, found_.slot_piece[slot], slot); }
  bool is_triangle_edge(std::uint32_t slot) const { return diagram_.edges[slot].is_triangle_edge(); }

  /// Bisectors' twins, and where each half-edge of the mesh starts.
  void pair_inside_triangles() {
    const std::size_t slot_count = diagram_.edges.size();
    found_.slot_piece.resize(slot_count);
    found_.slot_twin.assign(slot_count, no_index);
    found_.slot_part.assign(slot_count, no_index);
    found_.slot_corner.assign(slot_count, no_index);
    half_edge_slot_.assign(3 * model_.triangles.size(), no_index);
    triangle_begin_.assign(model_.triangles.size() + 1, 0);
    for (const std::uint32_t t : diagram_.piece_triangle) ++triangle_begin_[t + 1];
    for (std::size_t t = 0; t < model_.triangles.size(); ++t) triangle_begin_[t + 1] += triangle_begin_[t];
    parallel_ranges(model_.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> by_site;
      for (std::size_t t = begin; t < end; ++t) pair_inside(static_cast<std::uint32_t>(t), by_site);
    });
  }

  void pair_inside(std::uint32_t t, std::vector<std::uint32_t>& by_site) {
    by_site.clear();
    for (std::uint32_t piece = triangle_begin_[t]; piece < triangle_begin_[t + 1]; ++piece) by_site.push_back(piece);
    const auto site_less = [&](std::uint32_t a, std::uint32_t b) {
      return diagram_.piece_site[a] < diagram_.piece_site[b];
    };
    std::sort(by_site.begin(), by_site.end(), site_less);
    for (const std::uint32_t piece : by_site) {
      const std::uint32_t first = diagram_.piece_begin[piece], last = diagram_.piece_begin[piece + 1];
      for (std::uint32_t slot = first; slot < last; ++slot) {
        found_.slot_piece[slot] = piece;
        const PieceEdge edge = diagram_.edges[slot];
        if (edge.is_triangle_edge()) {
          if (is_triangle_edge(slot == first ? last - 1 : slot - 1))
            half_edge_slot_[3 * std::size_t{t} + edge.triangle_edge()] = slot;
          continue;
        }
        const auto other = std::partition_point(by_site.begin(), by_site.end(),
                                                [&](std::uint32_t p) { return diagram_.piece_site[p] < edge.site(); });
        STRATAFLOW_ASSERT(other != by_site.end() && diagram_.piece_site[*other] == edge.site(),
                          "a cell's neighbour is missing in a triangle");
        for (std::uint32_t s = diagram_.piece_begin[*other]; s < diagram_.piece_begin[*other + 1]; ++s)
          if (!is_triangle_edge(s) && diagram_.edges[s].site() == diagram_.piece_site[piece])
            found_.slot_twin[slot] = s;
        STRATAFLOW_ASSERT(found_.slot_twin[slot] != no_index, "a bisector has one side only");
      }
    }
  }

  /// Slots along a half-edge of the mesh, from its start.
  void walk_half_edge(std::uint32_t half_edge, std::vector<std::uint32_t>& slots) const {
    slots.clear();
    for (std::uint32_t slot = half_edge_slot_[half_edge]; slot != no_index;) {
      slots.push_back(slot);
      const std::uint32_t turn = next(slot);
      slot = is_triangle_edge(turn) ? no_index : next(found_.slot_twin[turn]);
    }
  }

  void cut_lines() {
    is_line_.assign(edges_.edge_count(), 0);
    found_.line_begin.assign(1, 0);
    std::vector<std::uint32_t> slots;
    for (std::uint32_t l = 0; l < model_.lines.size(); ++l) {
      const Line& line = model_.lines[l];
      const std::size_t count = line.vertices.size(), edge_count = line.is_closed() ? count : count - 1;
      for (std::size_t i = 0; i < edge_count; ++i) {
        const std::uint32_t from = line.vertices[i], to = line.vertices[(i + 1) % count];
        const std::uint32_t edge = find_edge(edges_, from, to);
        STRATAFLOW_ASSERT(edge != no_index, "a line leaves the triangles");
        is_line_[edge] = 1;
        const auto first_part = static_cast<std::uint32_t>(found_.parts.size());
        for (const std::uint32_t half_edge : edges_.around(edge)) {
          walk_half_edge(half_edge, slots);
          const std::uint32_t end_vertex = model_.triangles[half_edge / 3][(half_edge % 3 + 1) % 3];
          if (const std::int32_t corner = model_.point_corner[end_vertex]; corner >= 0)
            found_.slot_corner[slots.back()] = static_cast<std::uint32_t>(corner);
          if (end_vertex != to) std::reverse(slots.begin(), slots.end());
          if (half_edge == edges_.around(edge)[0])
            for (const std::uint32_t slot : slots) found_.parts.push_back(make_part(l, slot, end_vertex == to));
          STRATAFLOW_ASSERT(found_.parts.size() == first_part + slots.size(),
                            "an edge is cut differently on its sides");
          for (std::uint32_t k = 0; k < slots.size(); ++k) {
            STRATAFLOW_ASSERT(site_of_slot(slots[k]) == found_.parts[first_part + k].site,
                              "an edge is cut differently on its sides");
            found_.slot_part[slots[k]] = first_part + k;
          }
        }
      }
      found_.line_begin.push_back(static_cast<std::uint32_t>(found_.parts.size()));
    }
  }

  std::uint32_t site_of_slot(std::uint32_t slot) const { return diagram_.piece_site[found_.slot_piece[slot]]; }

  LinePart make_part(std::uint32_t line, std::uint32_t slot, bool is_forward) const {
    LinePart part{0, line, site_of_slot(slot), diagram_.points[slot], diagram_.points[next(slot)]};
    if (!is_forward) std::swap(part.begin, part.end);
    return part;
  }

  std::optional<Failure> pair_across_edges() {
    std::vector<char> is_twisted(edges_.edge_count(), 0);
    parallel_ranges(edges_.edge_count(), grain, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> one, other;
      for (std::size_t e = begin; e < end; ++e) {
        if (is_line_[e]) continue;
        const auto around = edges_.around(static_cast<std::uint32_t>(e));
        STRATAFLOW_ASSERT(around.size() == 2, "an edge where surfaces meet is on no line");
        const auto start = [&](std::uint32_t h) { return model_.triangles[h / 3][h % 3]; };
        if (start(around[0]) == start(around[1])) {
          is_twisted[e] = 1;
          continue;
        }
        walk_half_edge(around[0], one);
        walk_half_edge(around[1], other);
        STRATAFLOW_ASSERT(one.size() == other.size(), "an edge is cut differently on its sides");
        for (std::size_t k = 0; k < one.size(); ++k) {
          const std::uint32_t a = one[k], b = other[one.size() - 1 - k];
          STRATAFLOW_ASSERT(site_of_slot(a) == site_of_slot(b), "an edge is cut differently on its sides");
          found_.slot_twin[a] = b;
          found_.slot_twin[b] = a;
        }
      }
    });
    const auto twisted = std::find(is_twisted.begin(), is_twisted.end(), 1);
    if (twisted == is_twisted.end()) return std::nullopt;
    const std::uint32_t half_edge = edges_.around(static_cast<std::uint32_t>(twisted - is_twisted.begin()))[0];
    return Failure{FailureCode::unsupported,
                   "surface " + std::to_string(model_.triangle_surface[half_edge / 3]) + " has no coherent orientation",
                   "cut it in two"};
  }

  void join_pieces() {
    const std::size_t piece_count = diagram_.piece_count();
    UnionFind sets(piece_count);
    for (std::uint32_t slot = 0; slot < diagram_.edges.size(); ++slot)
      if (is_triangle_edge(slot) && found_.slot_twin[slot] != no_index && found_.slot_twin[slot] > slot)
        sets.unite(found_.slot_piece[slot], found_.slot_piece[found_.slot_twin[slot]]);
    std::vector<std::uint32_t> root_site(piece_count, no_index), order;
    for (std::uint32_t piece = 0; piece < piece_count; ++piece)
      if (sets.find(piece) == piece) root_site[piece] = diagram_.piece_site[piece];
    group_by(site_count_, root_site, found_.site_surfaces, order);
    std::vector<std::uint32_t> component_of_root(piece_count, no_index);
    for (const std::uint32_t root : order) {
      component_of_root[root] = static_cast<std::uint32_t>(found_.surfaces.size());
      found_.surfaces.push_back({diagram_.piece_site[root], model_.triangle_surface[diagram_.piece_triangle[root]], 1});
    }
    found_.piece_component.resize(piece_count);
    for (std::uint32_t piece = 0; piece < piece_count; ++piece)
      found_.piece_component[piece] = component_of_root[sets.find(piece)];
    group_by(found_.surfaces.size(), found_.piece_component, found_.pieces_begin, found_.pieces);
  }

  void join_parts() {
    const std::size_t part_count = found_.parts.size();
    UnionFind sets(part_count);
    std::vector<std::uint32_t> corner_part(model_.corners.size(), no_index);
    const auto meet_at_corner = [&](std::uint32_t corner, std::uint32_t part) {
      if (corner_part[corner] == no_index) corner_part[corner] = part;
      sets.unite(corner_part[corner], part);
    };
    for (std::uint32_t l = 0; l < model_.lines.size(); ++l) {
      const Line& line = model_.lines[l];
      const std::uint32_t begin = found_.line_begin[l], end = found_.line_begin[l + 1];
      for (std::uint32_t i = begin; i + 1 < end; ++i)
        if (found_.parts[i].site == found_.parts[i + 1].site) sets.unite(i, i + 1);
      if (line.is_closed()) {
        if (found_.parts[begin].site == found_.parts[end - 1].site) sets.unite(begin, end - 1);
      } else {
        meet_at_corner(line.corners[0], begin);
        meet_at_corner(line.corners[1], end - 1);
      }
    }
    std::vector<std::uint32_t> root_site(part_count, no_index), order, component_of_root(part_count, no_index);
    for (std::uint32_t part = 0; part < part_count; ++part)
      if (sets.find(part) == part) root_site[part] = found_.parts[part].site;
    group_by(site_count_, root_site, found_.site_lines, order);
    for (const std::uint32_t root : order) {
      component_of_root[root] = static_cast<std::uint32_t>(found_.lines.size());
      found_.lines.push_back({found_.parts[root].site, found_.parts[root].line});
    }
    std::vector<std::uint32_t> component_of(part_count);
    for (std::uint32_t part = 0; part < part_count; ++part)
      found_.parts[part].component = component_of[part] = component_of_root[sets.find(part)];
    group_by(found_.lines.size(), component_of, found_.parts_begin, found_.part_ids);
    for (const std::uint32_t part : corner_part)
      found_.corner_component.push_back(part == no_index ? no_index : component_of[part]);
    group_by(found_.lines.size(), found_.corner_component, found_.corners_begin, found_.corners);
  }

  void walk_borders() {
    const auto is_border = [&](std::uint32_t slot) { return !is_triangle_edge(slot) || found_.is_on_line(slot); };
    std::vector<char> is_walked(diagram_.edges.size(), 0);
    found_.loop_begin.assign(1, 0);
    for (std::uint32_t component = 0; component < found_.surfaces.size(); ++component)
      for (const std::uint32_t piece : found_.pieces_of(component))
        for (std::uint32_t start = diagram_.piece_begin[piece]; start < diagram_.piece_begin[piece + 1]; ++start) {
          if (is_walked[start] || !is_border(start)) continue;
          std::uint32_t slot = start;
          do {
            is_walked[slot] = 1;
            found_.loop_slots.push_back(slot);
            for (slot = next(slot); !is_border(slot);) slot = next(found_.slot_twin[slot]);
          } while (slot != start);
          found_.loop_begin.push_back(static_cast<std::uint32_t>(found_.loop_slots.size()));
          found_.loop_component.push_back(component);
        }
    found_.touched_begin.assign(1, 0);
    std::size_t loop = 0;
    std::vector<std::uint32_t> here;
    for (std::uint32_t component = 0; component < found_.surfaces.size(); ++component) {
      here.clear();
      for (; loop < found_.loop_component.size() && found_.loop_component[loop] == component; ++loop)
        for (const std::uint32_t slot : found_.loop(loop))
          if (found_.is_on_line(slot)) here.push_back(found_.parts[found_.slot_part[slot]].component);
      std::sort(here.begin(), here.end());
      here.erase(std::unique(here.begin(), here.end()), here.end());
      found_.touched.insert(found_.touched.end(), here.begin(), here.end());
      found_.touched_begin.push_back(static_cast<std::uint32_t>(found_.touched.size()));
    }
  }

  /// V − E + F, where a border has as many vertices as edges and the vertices inside are those of the mesh.
  void count_euler() {
    std::vector<std::int64_t> doubled(found_.surfaces.size(), 0);
    for (std::uint32_t component = 0; component < found_.surfaces.size(); ++component)
      for (const std::uint32_t piece : found_.pieces_of(component))
        doubled[component] += 2 - std::int64_t{diagram_.piece_begin[piece + 1] - diagram_.piece_begin[piece]};
    for (std::size_t loop = 0; loop < found_.loop_component.size(); ++loop)
      doubled[found_.loop_component[loop]] += static_cast<std::int64_t>(found_.loop(loop).size());
    std::vector<char> is_counted(model_.points.size(), 0);
    for (std::size_t h = 0; h < half_edge_slot_.size(); ++h) {
      const std::uint32_t vertex = model_.triangles[h / 3][h % 3];
      if (is_counted[vertex] || model_.point_line[vertex] >= 0 || model_.point_corner[vertex] >= 0) continue;
      is_counted[vertex] = 1;
      doubled[found_.piece_component[found_.slot_piece[half_edge_slot_[h]]]] += 2;
    }
    for (std::size_t c = 0; c < doubled.size(); ++c)
      found_.surfaces[c].euler = static_cast<std::int32_t>(doubled[c] / 2);
  }

  const StructuralModel& model_;
  const RestrictedDiagram& diagram_;
  std::size_t site_count_;
  EdgeTable edges_;
  std::vector<std::uint32_t> triangle_begin_;  ///< per triangle: its pieces
  std::vector<std::uint32_t> half_edge_slot_;  ///< per half-edge of the mesh: its first slot
  std::vector<char> is_line_;                  ///< per edge
  CellComponents found_;
};

}  // namespace

std::uint32_t next_in_piece(const RestrictedDiagram& diagram, std::uint32_t piece, std::uint32_t slot) {
  return slot + 1 == diagram.piece_begin[piece + 1] ? diagram.piece_begin[piece] : slot + 1;
}

std::uint32_t previous_in_piece(const RestrictedDiagram& diagram, std::uint32_t piece, std::uint32_t slot) {
  return (slot == diagram.piece_begin[piece] ? diagram.piece_begin[piece + 1] : slot) - 1;
}

Result<CellComponents> find_cell_components(const StructuralModel& model, const RestrictedDiagram& diagram,
                                            std::size_t site_count) {
  return ComponentSearch(model, diagram, site_count).run();
}

}  // namespace strataflow
