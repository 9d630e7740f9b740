#include "kernels/quads/plan/refine_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <queue>

#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

namespace {

/// Unset for a triangle without area.
std::optional<Vec3> circumcentre(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double twice = 2 * cross(u, v).z;
  const Vec3 centre{a.x + (v.y * dot(u, u) - u.y * dot(v, v)) / twice,
                    a.y + (u.x * dot(v, v) - v.x * dot(u, u)) / twice, 0};
  if (!is_finite(centre)) return std::nullopt;
  return centre;
}

class PlanRefinement {
 public:
  PlanRefinement(PlaneTriangulation& mesh, SampledPlan& plan, double edge_m)
      : mesh_(mesh), plan_(plan), size_m_(plan.size_m), edge_m_(edge_m) {}

  Result<void> run(std::size_t point_limit) {
    limit_sizes();
    for (std::uint32_t t = 0; t < mesh_.triangles().size(); ++t) consider(t);
    while (!queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (mesh_.triangles()[next.triangle] != next.corners || !improve(next.triangle)) continue;
      if (mesh_.points().size() > point_limit)
        return Failure{FailureCode::invalid_options,
                       "the triangulation needs more than " + std::to_string(point_limit) + " points",
                       "choose a larger edge length"};
      for (const std::uint32_t t : mesh_.take_touched()) consider(t);
    }
    return {};
  }

 private:
  struct Candidate {
    double urgency;
    std::uint32_t triangle;
    Triangle corners;
    bool operator<(const Candidate& other) const {
      return urgency != other.urgency ? urgency < other.urgency : triangle > other.triangle;
    }
  };

  void limit_sizes() {
    constexpr int round_limit = 100;
    bool any = true;
    for (int round = 0; any && round < round_limit; ++round) {
      any = false;
      for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
        const std::uint32_t a = mesh_.origin(h), b = mesh_.target(h);
        const double reach = size_growth * length(mesh_.points()[a] - mesh_.points()[b]);
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
          if (size_m_[to] > size_m_[from] + reach) {
            size_m_[to] = size_m_[from] + reach;
            any = true;
          }
      }
    }
  }

  double size_at(std::uint32_t t, const Vec3& p) const {
    double least = edge_m_;
    for (const std::uint32_t v : mesh_.triangles()[t])
      least = std::min(least, size_m_[v] + size_growth * length(mesh_.points()[v] - p));
    return least;
  }

  void consider(std::uint32_t t) {
    const Triangle& corner = mesh_.triangles()[t];
    const Vec3 &a = mesh_.points()[corner[0]], &b = mesh_.points()[corner[1]], &c = mesh_.points()[corner[2]];
    const double ab = length(b - a), bc = length(c - b), ca = length(a - c);
    const double radius = ab * bc * ca / (2 * std::abs(cross(b - a, c - a).z));
    const double shortest = std::min({ab, bc, ca});
    const Vec3 centre = (1.0 / 3) * (a + b + c);
    constexpr double ideal_radius = 0.577, too_large = 1.3, too_flat = 1.4;  // 1.4: angles below 21°
    const double by_size = radius / (ideal_radius * too_large * size_at(t, centre));
    const double by_shape = radius / (too_flat * shortest);
    if (!(std::max(by_size, by_shape) > 1)) return;
    // A flat triangle in an acute corner would come back for ever: it counts only by its size.
    queue_.push({by_size > 1 ? by_size + 1000 : std::min(by_shape, 1000.0), t, corner});
  }

  bool improve(std::uint32_t t) {
    const Triangle corner = mesh_.triangles()[t];
    const auto centre = circumcentre(mesh_.points()[corner[0]], mesh_.points()[corner[1]], mesh_.points()[corner[2]]);
    if (!centre) return false;
    // Walk towards the centre; a piece in the way is halved instead.
    const Vec3 from = (1.0 / 3) * (mesh_.points()[corner[0]] + mesh_.points()[corner[1]] + mesh_.points()[corner[2]]);
    std::uint32_t at = t, entered = no_index;
    constexpr int step_limit = 10000;
    for (int step = 0; step < step_limit; ++step) {
      std::uint32_t leave = no_index;
      for (std::uint32_t h = 3 * at; h < 3 * at + 3 && leave == no_index; ++h) {
        const Vec3 &a = mesh_.points()[mesh_.origin(h)], &b = mesh_.points()[mesh_.target(h)];
        if (h != entered && turn(a, b, *centre) < 0 && turn(from, *centre, a) <= 0 && turn(from, *centre, b) >= 0)
          leave = h;
      }
      if (leave == no_index) break;
      if (mesh_.opposite(leave) == no_index || mesh_.is_fixed(leave)) return halve(leave);
      entered = mesh_.opposite(leave);
      at = entered / 3;
    }
    return insert(at, *centre);
  }

  bool insert(std::uint32_t at, const Vec3& centre) {
    // The triangles whose circle holds the centre, and the pieces around them.
    std::vector<std::uint32_t> cavity{at};
    double nearest = 1e300;
    for (std::size_t i = 0; i < cavity.size(); ++i) {
      const std::uint32_t t = cavity[i];
      for (const std::uint32_t v : mesh_.triangles()[t])
        nearest = std::min(nearest, length(mesh_.points()[v] - centre));
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const std::uint32_t g = mesh_.opposite(h);
        if (g == no_index || mesh_.is_fixed(h)) {
          const Vec3 &a = mesh_.points()[mesh_.origin(h)], &b = mesh_.points()[mesh_.target(h)];
          if (dot(a - centre, b - centre) < 0) {
            if (halve(h)) return true;
            if (distance_to_segment(centre, a, b) < 0.4 * length(b - a)) return false;
          }
          continue;
        }
        if (mesh_.in_circle(mesh_.triangles()[g / 3], centre) &&
            std::find(cavity.begin(), cavity.end(), g / 3) == cavity.end())
          cavity.push_back(g / 3);
      }
    }
    constexpr double closest = 0.55;
    const double size = size_at(at, centre);
    if (!(nearest >= closest * size)) return false;
    const auto before = static_cast<std::uint32_t>(mesh_.points().size());
    bool is_in = mesh_.split_triangle(at, centre);
    // On an edge, as the centre of a circle of points is.
    for (std::uint32_t h = 3 * at; !is_in && h < 3 * at + 3; ++h)
      is_in = !mesh_.is_fixed(h) && mesh_.opposite(h) != no_index &&
              turn(mesh_.points()[mesh_.origin(h)], mesh_.points()[mesh_.target(h)], centre) <= 0 &&
              mesh_.split_edge(h, centre);
    if (is_in) size_m_.resize(before + 1, size);
    return is_in;
  }

  /// Halves a piece unless its halves would be much shorter than wanted.
  bool halve(std::uint32_t h) {
    const std::uint32_t a = mesh_.origin(h), b = mesh_.target(h);
    const Vec3 middle = 0.5 * (mesh_.points()[a] + mesh_.points()[b]);
    const double size = std::min(edge_m_, 0.5 * (size_m_[a] + size_m_[b]));
    if (mesh_.is_fixed(h) && plan_.pieces[mesh_.label(h)].is_locked) return false;
    if (!(length(mesh_.points()[a] - mesh_.points()[b]) > 1.1 * size) || !mesh_.split_edge(h, middle)) return false;
    size_m_.push_back(size);
    return true;
  }

  PlaneTriangulation& mesh_;
  SampledPlan& plan_;
  std::vector<double>& size_m_;
  double edge_m_;
  std::priority_queue<Candidate> queue_;
};

double smallest_angle_measure(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return cross(b - a, c - a).z / longest;
}

/// Moves free points to the middle of their neighbours where the worst triangle around gets no worse.
void even_out(PlaneTriangulation& mesh, std::size_t node_count) {
  std::vector<char> is_free(mesh.points().size(), 1);
  std::fill_n(is_free.begin(), node_count, 0);
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.is_fixed(h) || mesh.opposite(h) == no_index) is_free[mesh.origin(h)] = is_free[mesh.target(h)] = 0;
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    for (std::uint32_t p = 0; p < mesh.points().size(); ++p) {
      if (!is_free[p]) continue;
      const auto out = mesh.half_edges_from(p);
      if (out.empty()) continue;
      Vec3 middle;
      for (const std::uint32_t h : out) middle = middle + mesh.points()[mesh.target(h)];
      middle = (1.0 / static_cast<double>(out.size())) * middle;
      const auto worst = [&](const Vec3& at) {
        double least = 1e300;
        for (const std::uint32_t h : out)
          least =
              std::min(least, smallest_angle_measure(at, mesh.points()[mesh.target(h)], mesh.points()[mesh.apex(h)]));
        return least;
      };
      if (worst(middle) >= worst(mesh.points()[p])) mesh.move(p, middle);
    }
    std::vector<std::uint32_t> all(mesh.half_edge_count());
    for (std::uint32_t h = 0; h < all.size(); ++h) all[h] = h;
    mesh.make_delaunay(std::move(all));
  }
}

double angle_at(const PlaneTriangulation& mesh, std::uint32_t h) {
  const Vec3 &n = mesh.points()[mesh.origin(h)], &a = mesh.points()[mesh.target(h)], &b = mesh.points()[mesh.apex(h)];
  return std::atan2(cross(a - n, b - n).z, dot(a - n, b - n)) * 180 / std::numbers::pi;
}

/// Calls visit(half-edges of a sector) for the sectors between fixed edges around a point.
template <class Visit>
void visit_sectors(const PlaneTriangulation& mesh, std::uint32_t point, Visit&& visit) {
  auto out = mesh.half_edges_from(point);
  const auto first = std::find_if(out.begin(), out.end(), [&](std::uint32_t h) { return mesh.is_fixed(h); });
  if (first == out.end()) return;
  if (mesh.opposite(out.front()) != no_index) std::rotate(out.begin(), first, out.end());
  for (std::size_t i = 0; i < out.size();) {
    std::size_t j = i + 1;
    while (j < out.size() && !mesh.is_fixed(out[j])) ++j;
    if (!visit(std::vector<std::uint32_t>(out.begin() + static_cast<std::ptrdiff_t>(i),
                                          out.begin() + static_cast<std::ptrdiff_t>(j))))
      return;
    i = j;
  }
}

/// One more triangle in each sector that is wider than a quarter turn and has too few for its map not to be flat.
bool widen_sectors(PlaneTriangulation& mesh, std::vector<double>& size_m) {
  bool any = false;
  const auto count = static_cast<std::uint32_t>(mesh.points().size());
  for (std::uint32_t p = 0; p < count; ++p) {
    bool is_split = true;
    for (int tries = 0; is_split && tries < 4; ++tries) {
      is_split = false;
      visit_sectors(mesh, p, [&](const std::vector<std::uint32_t>& sector) {
        double angle = 0;
        for (const std::uint32_t h : sector) angle += angle_at(mesh, h);
        const std::size_t wanted = angle > 290 ? 4 : angle > 200 ? 3 : angle > 75 ? 2 : 1;
        if (sector.size() >= wanted) return true;
        const std::uint32_t widest =
            *std::max_element(sector.begin(), sector.end(),
                              [&](std::uint32_t a, std::uint32_t b) { return angle_at(mesh, a) < angle_at(mesh, b); });
        const std::uint32_t far = PlaneTriangulation::next(widest);
        const Vec3 a = mesh.points()[mesh.origin(far)], b = mesh.points()[mesh.target(far)];
        const bool on_edge = !mesh.is_fixed(far) && mesh.opposite(far) != no_index;
        is_split = on_edge ? mesh.split_edge(far, 0.5 * (a + b))
                           : mesh.split_triangle(widest / 3, (1.0 / 3) * (a + b + mesh.points()[p]));
        if (is_split) size_m.push_back(0.5 * length(b - a));
        return !is_split;
      });
      any = any || is_split;
    }
  }
  return any;
}

/// Splits edges that join two points of one curve without being part of it.
bool split_chords(PlaneTriangulation& mesh, SampledPlan& plan, const std::vector<std::uint32_t>& group_of_segment) {
  std::vector<std::vector<std::uint32_t>> groups(mesh.points().size());
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) {
    if (!mesh.is_fixed(h)) continue;
    const std::uint32_t g = group_of_segment[plan.pieces[mesh.label(h)].segment];
    for (const std::uint32_t p : {mesh.origin(h), mesh.target(h)})
      if (std::find(groups[p].begin(), groups[p].end(), g) == groups[p].end()) groups[p].push_back(g);
  }
  // Its ends lie on two sides of a quad of the map, even where these sides are one curve's.
  const auto fills_acute_corner = [&](std::uint32_t h) {
    const std::uint32_t back = PlaneTriangulation::previous(h);
    return mesh.is_fixed(PlaneTriangulation::next(h)) && mesh.is_fixed(back) && angle_at(mesh, back) <= acute_angle_deg;
  };
  bool any = false;
  const std::uint32_t count = mesh.half_edge_count();
  const std::size_t known = groups.size();
  for (std::uint32_t h = 0; h < count; ++h) {
    const std::uint32_t a = mesh.origin(h), b = mesh.target(h);
    if (mesh.is_fixed(h) || a > b || b >= known || mesh.opposite(h) == no_index) continue;
    const bool is_chord = std::any_of(groups[a].begin(), groups[a].end(), [&](std::uint32_t g) {
      return std::find(groups[b].begin(), groups[b].end(), g) != groups[b].end();
    });
    const double l = length(mesh.points()[a] - mesh.points()[b]);
    if (!is_chord || fills_acute_corner(h) || fills_acute_corner(mesh.opposite(h)) ||
        !mesh.split_edge(h, 0.5 * (mesh.points()[a] + mesh.points()[b])))
      continue;
    plan.size_m.push_back(0.5 * l);
    any = true;
  }
  return any;
}

}  // namespace

Result<void> refine_plan(PlaneTriangulation& mesh, SampledPlan& plan, double triangle_edge_m, std::size_t point_limit) {
  const Result<void> refined = PlanRefinement(mesh, plan, triangle_edge_m).run(point_limit);
  if (refined) even_out(mesh, plan.node_count);
  return refined;
}

void fit_triangles_to_features(PlaneTriangulation& mesh, SampledPlan& plan, const PlanGraph& graph,
                               const std::vector<std::uint32_t>& group_of_segment) {
  constexpr int round_limit = 4;
  bool any = true;
  for (int round = 0; any && round < round_limit; ++round) {
    any = widen_sectors(mesh, plan.size_m);
    any = split_chords(mesh, plan, group_of_segment) || any;
  }
  for (std::uint32_t p = 0; p < graph.points.size(); ++p) {
    bool is_flipped = true;
    for (int tries = 0; is_flipped && tries < 100; ++tries) {
      is_flipped = false;
      visit_sectors(mesh, p, [&](const std::vector<std::uint32_t>& sector) {
        double angle = 0;
        for (const std::uint32_t h : sector) angle += angle_at(mesh, h);
        if (angle > acute_angle_deg) return true;
        for (std::size_t i = 1; i < sector.size() && !is_flipped; ++i) is_flipped = mesh.flip(sector[i]);
        return !is_flipped;
      });
    }
  }
}

}  // namespace strataflow
