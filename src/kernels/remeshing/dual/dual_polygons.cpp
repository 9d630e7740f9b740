#include "kernels/remeshing/dual/dual_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/remeshing/dual/polygon_triangles.h"

namespace strataflow {

namespace {

using Indices = std::vector<std::uint32_t>;

struct SurfaceTriangle {
  Triangle corners;
  std::uint32_t surface, site;
};

/// The chains of a surface component between two stretches of its border on lines, in the order of its loop.
struct Run {
  std::uint32_t component;
  std::uint32_t from, to;     ///< points: of the last stretch, of the next
  std::uint32_t begin, end;   ///< into run_slots_
  Indices chain_begin;        ///< into run_slots_, per chain
  std::size_t switch_at = 0;  ///< the first chain that belongs to `to`
};

class DualBuilding {
 public:
  DualBuilding(const StructuralModel& model, const RestrictedDiagram& diagram, const CellComponents& components,
               const ComponentPoints& points)
      : model_(model), diagram_(diagram), components_(components), points_(points) {
    for (const DualPoint& point : points.points) positions_.push_back(point.position);
  }

  DualMesh run() {
    label_borders();
    choose_switches();
    emit();
    drop_repeated();
    mesh_.points = points_.points;
    mesh_.corner_point = points_.corner_point;
    for (std::uint32_t l = 0; l < model_.lines.size(); ++l) mesh_.line_points.push_back(points_of_line(l));
    tie_tips();
    std::sort(mesh_.flaws.begin(), mesh_.flaws.end());
    return std::move(mesh_);
  }

 private:
  std::uint32_t piece(std::uint32_t slot) const { return components_.slot_piece[slot]; }
  std::uint32_t site(std::uint32_t slot) const { return diagram_.piece_site[piece(slot)]; }
  std::uint32_t next(std::uint32_t slot) const { return next_in_piece(diagram_, piece(slot), slot); }
  std::uint32_t previous(std::uint32_t slot) const { return previous_in_piece(diagram_, piece(slot), slot); }
  std::uint32_t component(std::uint32_t slot) const { return components_.piece_component[piece(slot)]; }

  Vec3 normal_of_triangle(std::uint32_t t) const {
    const auto& [a, b, c] = model_.triangles[t];
    return cross(model_.points[b] - model_.points[a], model_.points[c] - model_.points[a]);
  }
  Vec3 normal_at(std::uint32_t slot) const { return normal_of_triangle(diagram_.piece_triangle[piece(slot)]); }
  Vec3 normal_of(std::uint32_t surface_component) const {
    Vec3 sum;
    for (const std::uint32_t p : components_.pieces_of(surface_component)) {
      const auto corners = diagram_.piece_points(p);
      for (std::size_t k = 2; k < corners.size(); ++k)
        sum = sum + cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
    }
    return sum;
  }

  /// Whether the loop passes a corner of the diagram, where three cells meet, from this slot to the next of its loop.
  bool meets_third_cell(std::uint32_t slot, std::uint32_t next_slot) const {
    return next(slot) == next_slot && !components_.is_on_line(slot) && !components_.is_on_line(next_slot);
  }

  /// The points of a stretch of a loop on lines: [first, last] of its slots.
  void points_of_stretch(std::span<const std::uint32_t> loop, std::size_t first, std::size_t count,
                         Indices& found) const {
    const std::size_t size = loop.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t slot = loop[(first + k) % size];
      const std::uint32_t line_component = components_.parts[components_.slot_part[slot]].component;
      const std::uint32_t point = components_.slot_corner[slot] != no_index
                                      ? points_.corner_point[components_.slot_corner[slot]]
                                      : points_.line_point[line_component];
      if (point != no_index && (found.empty() || found.back() != point)) found.push_back(point);
    }
  }

  /// The point of a component where none of its borders tells.
  std::uint32_t any_point(std::uint32_t surface_component) const {
    if (points_.surface_point[surface_component] != no_index) return points_.surface_point[surface_component];
    const std::uint32_t line_component = components_.touched_by(surface_component)[0];
    const auto corners = components_.corners_of(line_component);
    return corners.empty() ? points_.line_point[line_component] : points_.corner_point[corners[0]];
  }

  void label_borders() {
    label_.assign(diagram_.edges.size(), no_index);
    run_of_.assign(diagram_.edges.size(), no_index);
    Indices loop_count(components_.surfaces.size(), 0);
    for (std::size_t l = 0; l < components_.loop_component.size(); ++l) {
      ++loop_count[components_.loop_component[l]];
      label_loop(components_.loop_component[l], components_.loop(l));
    }
    for (std::uint32_t c = 0; c < components_.surfaces.size(); ++c)
      if (loop_count[c] > 1 || components_.surfaces[c].euler != 1) note(DualFlawKind::not_a_disc, c);
  }

  void note(DualFlawKind kind, std::uint32_t surface_component) {
    const SurfaceComponent& where = components_.surfaces[surface_component];
    mesh_.flaws.push_back({kind, where.site, where.surface});
  }

  void label_loop(std::uint32_t in, std::span<const std::uint32_t> loop) {
    const std::size_t size = loop.size();
    std::size_t start = size;  // where a stretch on lines begins
    for (std::size_t k = 0; k < size && start == size; ++k)
      if (components_.is_on_line(loop[k]) && !components_.is_on_line(loop[(k + size - 1) % size])) start = k;
    const bool is_all_line = start == size && components_.is_on_line(loop[0]);
    Indices polygon;
    if (start == size && !is_all_line) {
      bool is_closed_chain = true;
      for (std::size_t k = 0; k < size; ++k) {
        label_[loop[k]] = any_point(in);
        if (meets_third_cell(loop[k], loop[(k + 1) % size])) is_closed_chain = false;
      }
      if (is_closed_chain) note(DualFlawKind::closed_chain, in);
      return;
    }
    if (is_all_line) {  // a whole surface, or the inner side of a closed line, in one cell
      points_of_stretch(loop, 0, size, polygon);
    } else {
      std::size_t k = 0;
      std::uint32_t first_of_first = no_index;
      while (k < size) {
        const std::size_t stretch = k;
        while (k < size && components_.is_on_line(loop[(start + k) % size])) ++k;
        Indices passed;
        points_of_stretch(loop, start + stretch, k - stretch, passed);
        if (passed.empty()) passed.push_back(any_point(in));
        if (stretch > 0) runs_.back().to = passed.front();
        if (stretch == 0) first_of_first = passed.front();
        for (const std::uint32_t point : passed) polygon.push_back(point);
        Run run{in, passed.back(), no_index, static_cast<std::uint32_t>(run_slots_.size()), 0, {}, 0};
        for (; k < size && !components_.is_on_line(loop[(start + k) % size]); ++k) {
          const std::uint32_t slot = loop[(start + k) % size];
          if (run.chain_begin.empty() || meets_third_cell(run_slots_.back(), slot))
            run.chain_begin.push_back(static_cast<std::uint32_t>(run_slots_.size()));
          run_slots_.push_back(slot);
          run_of_[slot] = static_cast<std::uint32_t>(runs_.size());
        }
        run.end = static_cast<std::uint32_t>(run_slots_.size());
        runs_.push_back(std::move(run));
      }
      runs_.back().to = first_of_first;
    }
    if (polygon.size() > 2) component_polygons_.push_back({in, std::move(polygon)});
  }

  void label_run(const Run& run) {
    for (std::size_t c = 0; c < run.chain_begin.size(); ++c) {
      const std::uint32_t end = c + 1 < run.chain_begin.size() ? run.chain_begin[c + 1] : run.end;
      for (std::uint32_t k = run.chain_begin[c]; k < end; ++k)
        label_[run_slots_[k]] = c < run.switch_at ? run.from : run.to;
    }
  }

  /// The points around the corner of the diagram where a slot starts, counter-clockwise.
  Indices polygon_at(std::uint32_t slot) const {
    const std::uint32_t before = previous(slot);
    const std::uint32_t second = components_.slot_twin[before], third = next(components_.slot_twin[slot]);
    Indices polygon;
    const auto push = [&](std::uint32_t from_slot) {
      const std::uint32_t point = label_[from_slot];
      if (polygon.empty() || polygon.back() != point) polygon.push_back(point);
    };
    for (const std::uint32_t after : {slot, second, third}) {
      push(after);
      push(previous(after));
    }
    if (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
    return polygon;
  }

  double worst_around(const Run& run) const {
    double worst = 1;
    std::vector<Triangle> triangles;
    for (std::size_t c = 1; c < run.chain_begin.size(); ++c) {
      const std::uint32_t slot = run_slots_[run.chain_begin[c]];
      worst = std::min(worst, triangulate_polygon(polygon_at(slot), positions_, normal_at(slot), triangles));
    }
    return worst;
  }

  void choose_switches() {
    Indices open;
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      Run& run = runs_[r];
      double smallest = 0;
      for (std::size_t c = 1; c < run.chain_begin.size(); ++c) {
        const Vec3& at = diagram_.points[run_slots_[run.chain_begin[c]]];
        const double uneven = std::abs(length(at - positions_[run.from]) - length(at - positions_[run.to]));
        if (c == 1 || uneven < smallest) {
          smallest = uneven;
          run.switch_at = c;
        }
      }
      label_run(run);
      if (run.chain_begin.size() > 2 && run.from != run.to) open.push_back(r);
    }
    for (bool is_changed = true, is_second = false; is_changed && !is_second; is_second = true) {
      is_changed = false;
      for (const std::uint32_t r : open) {
        Run& run = runs_[r];
        const std::size_t before = run.switch_at;
        std::size_t best = before;
        double worst = worst_around(run);
        for (std::size_t c = 1; c < run.chain_begin.size(); ++c) {
          if (c == before) continue;
          run.switch_at = c;
          label_run(run);
          if (const double value = worst_around(run); value > worst) {
            worst = value;
            best = c;
          }
        }
        run.switch_at = best;
        label_run(run);
        is_changed = is_changed || best != before;
      }
    }
  }

  struct Emitted {
    std::vector<SurfaceTriangle> triangles;
    std::vector<DualFlaw> flaws;
  };

  void emit_polygon(std::span<const std::uint32_t> polygon, const Vec3& normal, std::uint32_t surface_component,
                    Emitted& into) const {
    std::vector<Triangle> triangles;
    const double worst = triangulate_polygon(polygon, positions_, normal, triangles);
    const SurfaceComponent& where = components_.surfaces[surface_component];
    for (const Triangle& triangle : triangles) into.triangles.push_back({triangle, where.surface, where.site});
    if (worst < 0) into.flaws.push_back({DualFlawKind::turned_triangle, where.site, where.surface});
  }

  void emit_corners(std::uint32_t of_piece, Emitted& into) const {
    const std::uint32_t own = diagram_.piece_site[of_piece];
    for (std::uint32_t slot = diagram_.piece_begin[of_piece]; slot < diagram_.piece_begin[of_piece + 1]; ++slot) {
      const PieceEdge after = diagram_.edges[slot], before = diagram_.edges[previous(slot)];
      if (after.is_triangle_edge() || before.is_triangle_edge() || after.site() < own || before.site() < own) continue;
      emit_polygon(polygon_at(slot), normal_at(slot), component(slot), into);
    }
  }

  /// A chain from line to line.
  void emit_chain(const Run& run, Emitted& into) const {
    const std::uint32_t first = run_slots_[run.begin], twin = components_.slot_twin[first];
    if (run.chain_begin.size() != 1 || site(twin) < site(first)) return;
    const Run& other = runs_[run_of_[twin]];
    Indices polygon;
    for (const std::uint32_t point : {run.to, run.from, other.to, other.from})
      if (polygon.empty() || polygon.back() != point) polygon.push_back(point);
    if (polygon.back() == polygon.front()) polygon.pop_back();
    emit_polygon(polygon, normal_at(first), run.component, into);
  }

  void emit() {
    constexpr std::size_t grain = 2048;
    const std::size_t piece_count = diagram_.piece_count(), chunks = (piece_count + grain - 1) / grain;
    std::vector<Emitted> parts = parallel_map(chunks, [&](std::size_t chunk) {
      Emitted part;
      const std::size_t end = std::min(piece_count, (chunk + 1) * grain);
      for (std::size_t p = chunk * grain; p < end; ++p) emit_corners(static_cast<std::uint32_t>(p), part);
      return part;
    });
    Emitted rest;
    for (const Run& run : runs_) emit_chain(run, rest);
    for (auto& [surface_component, walk] : component_polygons_) {
      std::vector<Indices> polygons;
      split_at_repeats(std::move(walk), polygons);
      for (const Indices& polygon : polygons)
        emit_polygon(polygon, normal_of(surface_component), surface_component, rest);
    }
    parts.push_back(std::move(rest));
    for (const Emitted& part : parts) {
      triangles_.insert(triangles_.end(), part.triangles.begin(), part.triangles.end());
      mesh_.flaws.insert(mesh_.flaws.end(), part.flaws.begin(), part.flaws.end());
    }
  }

  /// Leaves one of the triangles of a surface with the same three points, none where they cancel.
  void drop_repeated() {
    struct Key {
      std::uint32_t surface;
      Triangle sorted;
      std::uint32_t id;
      std::uint32_t is_even;
    };
    std::vector<Key> keys(triangles_.size());
    for (std::uint32_t t = 0; t < keys.size(); ++t) {
      const Triangle& corners = triangles_[t].corners;
      keys[t] = {triangles_[t].surface, corners, t, 0};
      std::sort(keys[t].sorted.begin(), keys[t].sorted.end());
      const auto first = std::find(corners.begin(), corners.end(), keys[t].sorted[0]) - corners.begin();
      keys[t].is_even = corners[static_cast<std::size_t>(first + 1) % 3] == keys[t].sorted[1] ? 1 : 0;
    }
    const auto is_same = [](const Key& a, const Key& b) { return a.surface == b.surface && a.sorted == b.sorted; };
    sort_total_order(keys, [](const Key& a, const Key& b) {
      if (a.surface != b.surface) return a.surface < b.surface;
      return a.sorted != b.sorted ? a.sorted < b.sorted : a.id < b.id;
    });
    std::vector<char> is_kept(triangles_.size(), 0);
    for (std::size_t begin = 0, end; begin < keys.size(); begin = end) {
      int net = 0;
      for (end = begin; end < keys.size() && is_same(keys[begin], keys[end]); ++end) net += keys[end].is_even ? 1 : -1;
      if (std::abs(net) > 1)
        mesh_.flaws.push_back({DualFlawKind::repeated_triangle, triangles_[keys[begin].id].site, keys[begin].surface});
      for (std::size_t k = begin; k < end && net != 0; ++k)
        if ((net > 0) == (keys[k].is_even != 0)) {
          is_kept[keys[k].id] = 1;
          break;
        }
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!is_kept[t]) continue;
      mesh_.triangles.push_back(triangles_[t].corners);
      mesh_.triangle_surface.push_back(triangles_[t].surface);
    }
  }

  /// A line that ends inside a surface and has its last points in one cell leaves the polygon of that cell there and
  /// back, so its tip is in no triangle of the surface: the triangle around it takes it in.
  void tie_tips() {
    std::vector<std::array<std::uint32_t, 2>> used;  // surface, point
    for (std::uint32_t l = 0; l < model_.lines.size(); ++l) {
      const Indices& around = model_.lines[l].surfaces;
      for (std::size_t k = 1; k < around.size(); ++k) {
        if (around[k] != around[k - 1]) continue;
        if (used.empty()) used = points_used();
        Indices along = mesh_.line_points[l];
        for (int pass = 0; pass < 2; ++pass) {
          for (std::size_t i = 1; i < along.size(); ++i)
            if (!std::binary_search(used.begin(), used.end(), std::array{around[k], along[i]}))
              tie_tip(around[k], along[i - 1], along[i]);
          std::reverse(along.begin(), along.end());
        }
      }
    }
  }

  std::vector<std::array<std::uint32_t, 2>> points_used() const {
    std::vector<std::array<std::uint32_t, 2>> used;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t corner : mesh_.triangles[t]) used.push_back({mesh_.triangle_surface[t], corner});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }

  /// `base` may have triangles in the surface; if `tip` has none, it goes into the best of them.
  void tie_tip(std::uint32_t surface, std::uint32_t base, std::uint32_t tip) {
    std::size_t best = mesh_.triangles.size();
    double best_value = -1;
    Triangle turned{};
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (mesh_.triangle_surface[t] != surface) continue;
      Triangle corners = mesh_.triangles[t];
      if (std::find(corners.begin(), corners.end(), tip) != corners.end()) return;
      const auto at = std::find(corners.begin(), corners.end(), base);
      if (at == corners.end()) continue;
      std::rotate(corners.begin(), at, corners.end());
      const auto& [a, b, c] = corners;
      const Vec3 normal = cross(positions_[b] - positions_[a], positions_[c] - positions_[a]);
      const auto value = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        return signed_sharpness(positions_[x], positions_[y], positions_[z], normal);
      };
      if (const double worst = std::min({value(a, b, tip), value(tip, b, c), value(a, tip, c)}); worst > best_value) {
        best_value = worst;
        best = t;
        turned = corners;
      }
    }
    if (best == mesh_.triangles.size()) return;
    const auto [a, b, c] = turned;
    mesh_.triangles[best] = {a, b, tip};
    mesh_.triangles.push_back({tip, b, c});
    mesh_.triangles.push_back({a, tip, c});
    mesh_.triangle_surface.insert(mesh_.triangle_surface.end(), 2, surface);
  }

  std::vector<std::uint32_t> points_of_line(std::uint32_t l) const {
    const Line& line = model_.lines[l];
    Indices along;
    const auto push = [&](std::uint32_t point) {
      if (point != no_index && (along.empty() || along.back() != point)) along.push_back(point);
    };
    if (!line.is_closed()) push(points_.corner_point[line.corners[0]]);
    for (std::uint32_t part = components_.line_begin[l]; part < components_.line_begin[l + 1]; ++part)
      push(points_.line_point[components_.parts[part].component]);
    if (!line.is_closed()) push(points_.corner_point[line.corners[1]]);
    if (line.is_closed() && along.size() > 1 && along.back() != along.front()) along.push_back(along.front());
    return along;
  }

  const StructuralModel& model_;
  const RestrictedDiagram& diagram_;
  const CellComponents& components_;
  const ComponentPoints& points_;
  std::vector<Vec3> positions_;
  Indices label_;   ///< per slot that bisects: the point of its own cell that stands for it
  Indices run_of_;  ///< per slot of a run
  Indices run_slots_;
  std::vector<Run> runs_;
  std::vector<std::pair<std::uint32_t, Indices>> component_polygons_;
  std::vector<SurfaceTriangle> triangles_;
  DualMesh mesh_;
};

}  // namespace

std::string_view to_string(DualFlawKind kind) {
  switch (kind) {
    case DualFlawKind::closed_chain:
      return "closed_chain";
    case DualFlawKind::not_a_disc:
      return "not_a_disc";
    case DualFlawKind::turned_triangle:
      return "turned_triangle";
    case DualFlawKind::repeated_triangle:
      return "repeated_triangle";
  }
  return "unknown";
}

DualMesh build_dual_polygons(const StructuralModel& model, const RestrictedDiagram& diagram,
                             const CellComponents& components, const ComponentPoints& points) {
  return DualBuilding(model, diagram, components, points).run();
}

}  // namespace strataflow
