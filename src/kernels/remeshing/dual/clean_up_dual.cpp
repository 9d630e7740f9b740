#include "kernels/remeshing/dual/clean_up_dual.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "kernels/remeshing/dual/piece_distance.h"
#include "kernels/remeshing/dual/polygon_triangles.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

using Indices = std::vector<std::uint32_t>;

constexpr double flat = 0.02;  // sine of the smallest angle

class DualCleaning {
 public:
  DualCleaning(const StructuralModel& model, DualMesh& mesh) : model_(model), mesh_(mesh) {
    is_dead_.assign(mesh.triangles.size(), 0);
    flips_.assign(mesh.triangles.size(), 0);
    around_.resize(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t corner : mesh.triangles[t]) around_[corner].push_back(t);
    find_lines();
  }

  CleanUpReport run() {
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      report_.refused.clear();
      for (std::uint32_t p = 0; p < mesh_.points.size(); ++p) is_changed = remove_valence_3(p) || is_changed;
      for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        if (!is_dead_[t]) is_changed = flatten(t) || is_changed;
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_dead_[t]) continue;
      mesh_.triangles[kept] = mesh_.triangles[t];
      mesh_.triangle_surface[kept++] = mesh_.triangle_surface[t];
    }
    mesh_.triangles.resize(kept);
    mesh_.triangle_surface.resize(kept);
    return std::move(report_);
  }

 private:
  /// Points that one line passes once have their line; ends and points of several have none.
  void find_lines() {
    line_of_.assign(mesh_.points.size(), no_index);
    is_on_lines_.assign(mesh_.points.size(), 0);
    lines_at_.resize(mesh_.points.size());
    for (std::uint32_t l = 0; l < mesh_.line_points.size(); ++l) {
      const Indices& along = mesh_.line_points[l];
      for (std::size_t i = 0; i < along.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == along.size();
        line_of_[along[i]] = is_end || is_on_lines_[along[i]] ? no_index : l;
        is_on_lines_[along[i]] = 1;
        if (lines_at_[along[i]].empty() || lines_at_[along[i]].back() != l) lines_at_[along[i]].push_back(l);
      }
    }
    for (const std::uint32_t corner : mesh_.corner_point)
      if (corner != no_index) {
        line_of_[corner] = no_index;
        is_on_lines_[corner] = 1;
      }
  }

  static bool has(const Triangle& triangle, std::uint32_t point) {
    return triangle[0] == point || triangle[1] == point || triangle[2] == point;
  }
  const Vec3& at(std::uint32_t point) const { return mesh_.points[point].position; }
  Vec3 normal(const Triangle& t) const { return cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])); }

  bool exists(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return std::any_of(around_[a].begin(), around_[a].end(),
                       [&](std::uint32_t t) { return has(mesh_.triangles[t], b) && has(mesh_.triangles[t], c); });
  }
  bool has_edge(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(around_[a].begin(), around_[a].end(),
                       [&](std::uint32_t t) { return has(mesh_.triangles[t], b); });
  }

  void kill(std::uint32_t t) {
    is_dead_[t] = 1;
    for (const std::uint32_t corner : mesh_.triangles[t]) std::erase(around_[corner], t);
  }

  bool remove_valence_3(std::uint32_t p) {
    if (is_on_lines_[p] || around_[p].size() != 3) return false;
    const Indices triangles = around_[p];
    const std::uint32_t surface = mesh_.triangle_surface[triangles[0]];
    // The ring a → b → c from the three edges opposite p.
    std::array<std::array<std::uint32_t, 2>, 3> opposite;
    Vec3 before;
    for (std::size_t i = 0; i < 3; ++i) {
      const Triangle& t = mesh_.triangles[triangles[i]];
      if (mesh_.triangle_surface[triangles[i]] != surface) return false;
      const auto k = static_cast<std::size_t>(std::find(t.begin(), t.end(), p) - t.begin());
      opposite[i] = {t[(k + 1) % 3], t[(k + 2) % 3]};
      before = before + normal(t);
    }
    if (opposite[1][0] != opposite[0][1]) std::swap(opposite[1], opposite[2]);
    if (opposite[1][0] != opposite[0][1] || opposite[2][0] != opposite[1][1] || opposite[0][0] != opposite[2][1])
      return false;
    const Triangle ring{opposite[0][0], opposite[1][0], opposite[2][0]};
    if (exists(ring[0], ring[1], ring[2]) || !(dot(normal(ring), before) > 0) || middle_on_line(ring)) return false;
    for (const std::uint32_t t : triangles) kill(t);
    add(triangles[0], ring);
    report_.done.push_back({CleanUpKind::valence_3, mesh_.points[p].site, surface});
    return true;
  }

  void add(std::uint32_t t, const Triangle& corners) {
    mesh_.triangles[t] = corners;
    is_dead_[t] = 0;
    for (const std::uint32_t corner : corners) around_[corner].push_back(t);
  }

  /// A triangle's corner between two edges on lines; they are one line unless it is a corner of the model.
  struct Middle {
    std::uint32_t before, point, after, line_before, line_after;
  };

  std::size_t place_on(std::uint32_t line, std::uint32_t point) const {
    const Indices& along = mesh_.line_points[line];
    return static_cast<std::size_t>(std::find(along.begin(), along.end(), point) - along.begin());
  }

  /// The line that an edge is on, or no_index.
  std::uint32_t line_of_edge(std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t line : lines_at_[a]) {
      if (std::find(lines_at_[b].begin(), lines_at_[b].end(), line) == lines_at_[b].end()) continue;
      const Indices& along = mesh_.line_points[line];
      for (std::size_t i = 1; i < along.size(); ++i)
        if ((along[i - 1] == a && along[i] == b) || (along[i - 1] == b && along[i] == a)) return line;
    }
    return no_index;
  }

  std::optional<Middle> middle_on_line(const Triangle& corners) const {
    for (const std::uint32_t corner : corners)
      if (!is_on_lines_[corner]) return std::nullopt;
    std::array<std::uint32_t, 3> line;
    for (std::size_t k = 0; k < 3; ++k) line[k] = line_of_edge(corners[k], corners[(k + 1) % 3]);
    for (const bool is_corner_wanted : {false, true})
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t last = (k + 2) % 3;
        if (line[last] == no_index || line[k] == no_index) continue;
        if (is_corner_wanted != (line_of_[corners[k]] == no_index)) continue;
        return Middle{corners[last], corners[k], corners[(k + 1) % 3], line[last], line[k]};
      }
    return std::nullopt;
  }

  bool flatten(std::uint32_t t) {
    const std::optional<Middle> middle = middle_on_line(mesh_.triangles[t]);
    if (!middle || !(is_straight(*middle) || is_shared(t))) return false;
    const auto [before, point, after, line, line_after] = *middle;
    if (line_of_[point] == no_index) return flatten_at_corner(t, *middle);
    if (model_.lines[line].is_free_border()) {
      // The border may pass by where the triangle is the only one at its middle and another takes over the far edge.
      if (around_[point].size() != 1 || triangles_on(before, after).size() != 2 ||
          line_of_edge(before, after) != no_index)
        return false;
      kill(t);
      forget(line, point);
      report_.done.push_back({CleanUpKind::free_border, mesh_.points[point].site, line});
      return true;
    }
    const bool is_first_better = sharpness_after(point, before) >= sharpness_after(point, after);
    // Two points that both came from tiny components meet half way; else the tiny one goes to its neighbour.
    for (const std::uint32_t other : {before, after})
      if (line_of_[other] == line && is_middle(other) && collapse(other, point, line, half_way(point, other, line)))
        return true;
    for (const std::uint32_t other : {is_first_better ? before : after, is_first_better ? after : before})
      if (collapse(other, point, line, at(other))) return true;
    if (flip(t, *middle)) return true;
    report_.refused.push_back({CleanUpKind::contact, mesh_.points[point].site, line});
    return false;
  }

  /// The corner stays: it is linked to what is behind the triangle, or one of its neighbours goes to it.
  bool flatten_at_corner(std::uint32_t t, const Middle& middle) {
    if (flip(t, middle)) return true;
    const auto [before, point, after, line_before, line_after] = middle;
    if (line_of_[before] == line_before && collapse(point, before, line_before, at(point))) return true;
    if (line_of_[after] == line_after && collapse(point, after, line_after, at(point))) return true;
    report_.refused.push_back({CleanUpKind::contact, mesh_.points[point].site, line_before});
    return false;
  }

  /// Replaces the edge opposite the middle by one from the middle to the triangle behind it.
  bool flip(std::uint32_t t, const Middle& middle) {
    const std::uint32_t surface = mesh_.triangle_surface[t];
    Indices both = triangles_on(middle.before, middle.after);
    std::erase_if(both, [&](std::uint32_t other) { return mesh_.triangle_surface[other] != surface; });
    if (both.size() != 2 || line_of_edge(middle.before, middle.after) != no_index) return false;
    const std::uint32_t behind = both[0] == t ? both[1] : both[0];
    // Where all corners are on lines a flip may make what another flip takes back, for ever.
    constexpr std::uint8_t most_flips = 8;
    if (flips_[t] >= most_flips || flips_[behind] >= most_flips) return false;
    const Triangle old = mesh_.triangles[behind];
    std::size_t k = 0;
    while (old[k] == middle.before || old[k] == middle.after) ++k;
    const std::uint32_t far = old[k];
    if (far == middle.point || has_edge(middle.point, far)) return false;
    const Triangle first{far, old[(k + 1) % 3], middle.point}, second{far, middle.point, old[(k + 2) % 3]};
    for (const Triangle& made : {first, second})
      if (signed_sharpness(at(made[0]), at(made[1]), at(made[2]), normal(old)) < flat) return false;
    ++flips_[t];
    ++flips_[behind];
    kill(t);
    kill(behind);
    add(t, first);
    add(behind, second);
    report_.done.push_back({CleanUpKind::flip, mesh_.points[middle.point].site, surface});
    return true;
  }

  /// Whether the line hardly bends at the middle point: where it does, the triangle has an area to keep.
  bool is_straight(const Middle& middle) const {
    constexpr double cosine_150_deg = -0.8660254037844386;
    const Vec3 a = at(middle.before) - at(middle.point), b = at(middle.after) - at(middle.point);
    return dot(a, b) <= cosine_150_deg * length(a) * length(b);
  }

  /// Whether another surface has the same triangle: it would close a region that both bound.
  bool is_shared(std::uint32_t t) const {
    const Triangle& corners = mesh_.triangles[t];
    return std::any_of(around_[corners[0]].begin(), around_[corners[0]].end(), [&](std::uint32_t other) {
      return other != t && has(mesh_.triangles[other], corners[1]) && has(mesh_.triangles[other], corners[2]);
    });
  }

  bool is_middle(std::uint32_t point) const {
    return std::any_of(around_[point].begin(), around_[point].end(), [&](std::uint32_t t) {
      const std::optional<Middle> middle = middle_on_line(mesh_.triangles[t]);
      return middle && middle->point == point && is_straight(*middle);
    });
  }

  Indices triangles_on(std::uint32_t a, std::uint32_t b) const {
    Indices both;
    for (const std::uint32_t t : around_[a])
      if (has(mesh_.triangles[t], b)) both.push_back(t);
    return both;
  }

  void forget(std::uint32_t line, std::uint32_t point) {
    std::erase(mesh_.line_points[line], point);
    line_of_[point] = no_index;
    lines_at_[point].clear();
  }

  /// Half way between two points of a line, on the line of the model.
  Vec3 half_way(std::uint32_t a, std::uint32_t b, std::uint32_t line) const {
    const Vec3 middle = 0.5 * (at(a) + at(b));
    const Indices& vertices = model_.lines[line].vertices;
    Vec3 nearest = middle;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < vertices.size() + (model_.lines[line].is_closed() ? 1 : 0); ++i) {
      const Vec3 x =
          nearest_on_segment(middle, model_.points[vertices[i]], model_.points[vertices[(i + 1) % vertices.size()]]);
      if (const double d = dot(x - middle, x - middle); d < smallest) {
        smallest = d;
        nearest = x;
      }
    }
    return nearest;
  }

  double sharpness_after(std::uint32_t gone, std::uint32_t kept) const {
    double worst = 1;
    for (const std::uint32_t t : around_[gone]) {
      if (has(mesh_.triangles[t], kept)) continue;
      worst = std::min(worst, sharpness_with(mesh_.triangles[t], gone, at(kept)));
    }
    return worst;
  }

  /// Of a triangle with one corner moved, against how it faces now.
  double sharpness_with(const Triangle& t, std::uint32_t moved, const Vec3& to) const {
    const auto place = [&](std::uint32_t corner) { return corner == moved ? to : at(corner); };
    return signed_sharpness(place(t[0]), place(t[1]), place(t[2]), normal(t));
  }

  bool collapse(std::uint32_t kept, std::uint32_t gone, std::uint32_t line, const Vec3& to) {
    const std::size_t fewest = model_.lines[line].is_closed() ? 5 : 3;  // a closed line lists its first point twice
    if (mesh_.line_points[line].size() < fewest || !keeps_links(kept, gone, line)) return false;
    // A triangle that is flat already says nothing about how it faces.
    for (const std::uint32_t moved : {gone, kept})
      for (const std::uint32_t t : around_[moved]) {
        const Triangle& corners = mesh_.triangles[t];
        if (has(corners, kept) && has(corners, gone)) continue;
        const double now = signed_sharpness(at(corners[0]), at(corners[1]), at(corners[2]), normal(corners));
        if (now > flat && sharpness_with(corners, moved, to) < flat) return false;
      }
    for (const std::uint32_t t : triangles_on(kept, gone)) kill(t);
    const Indices moved = around_[gone];
    for (const std::uint32_t t : moved) {
      for (std::uint32_t& corner : mesh_.triangles[t])
        if (corner == gone) corner = kept;
      around_[kept].push_back(t);
    }
    around_[gone].clear();
    mesh_.points[kept].position = to;
    forget(line, gone);
    report_.done.push_back({CleanUpKind::contact, mesh_.points[gone].site, line});
    return true;
  }

  /// Whether merging the ends of an edge of a line joins nothing but what triangles at the edge join: per neighbour of
  /// both ends, the surfaces that have it must be those of the triangle between the three. The far neighbours along
  /// the line may have more, at one of the ends.
  bool keeps_links(std::uint32_t kept, std::uint32_t gone, std::uint32_t line) const {
    const auto is_along = [&](std::uint32_t a, std::uint32_t b) {
      const Indices& along = mesh_.line_points[line];
      const std::size_t i = place_on(line, gone);
      for (std::size_t k = i > 1 ? i - 2 : 0; k < std::min(i + 2, along.size() - 1); ++k)
        if ((along[k] == a && along[k + 1] == b) || (along[k] == b && along[k + 1] == a)) return true;
      return false;
    };
    const auto surfaces_with = [&](std::uint32_t a, std::uint32_t b) {
      Indices surfaces;
      for (const std::uint32_t t : triangles_on(a, b)) surfaces.push_back(mesh_.triangle_surface[t]);
      return sorted_unique(std::move(surfaces));
    };
    const auto neighbours = [&](std::uint32_t p) {
      Indices found;
      for (const std::uint32_t t : around_[p])
        for (const std::uint32_t corner : mesh_.triangles[t])
          if (corner != p) found.push_back(corner);
      return sorted_unique(std::move(found));
    };
    const Indices of_kept = neighbours(kept), of_gone = neighbours(gone);
    for (const std::uint32_t w : of_gone) {
      if (w == kept || !std::binary_search(of_kept.begin(), of_kept.end(), w)) continue;
      Indices between;
      for (const std::uint32_t t : triangles_on(kept, gone))
        if (has(mesh_.triangles[t], w)) between.push_back(mesh_.triangle_surface[t]);
      between = sorted_unique(std::move(between));
      const Indices at_kept = surfaces_with(kept, w), at_gone = surfaces_with(gone, w);
      if (!is_along(kept, w) && at_kept != between) return false;
      if (!is_along(gone, w) && at_gone != between) return false;
      if (is_along(kept, w) && is_along(gone, w)) return false;  // a closed line of three edges
    }
    for (const std::uint32_t t : around_[gone]) {
      const Triangle& corners = mesh_.triangles[t];
      if (has(corners, kept)) continue;
      Indices others;
      for (const std::uint32_t corner : corners)
        if (corner != gone) others.push_back(corner);
      if (exists(kept, others[0], others[1])) return false;
    }
    return true;
  }

  const StructuralModel& model_;
  DualMesh& mesh_;
  std::vector<char> is_dead_, is_on_lines_;
  std::vector<std::uint8_t> flips_;  ///< per triangle
  std::vector<Indices> around_;
  Indices line_of_;
  std::vector<Indices> lines_at_;  ///< per point, ascending
  CleanUpReport report_;
};

}  // namespace

std::string_view to_string(CleanUpKind kind) {
  switch (kind) {
    case CleanUpKind::valence_3:
      return "valence_3";
    case CleanUpKind::free_border:
      return "free_border";
    case CleanUpKind::contact:
      return "contact";
    case CleanUpKind::flip:
      return "flip";
  }
  return "unknown";
}

CleanUpReport clean_up_dual(const StructuralModel& model, DualMesh& mesh) { return DualCleaning(model, mesh).run(); }

}  // namespace strataflow
