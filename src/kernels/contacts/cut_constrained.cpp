#include "kernels/contacts/cut_constrained.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "base/option_field.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/contacts/contact_mesh.h"
#include "kernels/contacts/guide_path.h"
#include "kernels/contacts/surface_search.h"

namespace strataflow {

namespace {

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g m", value);
  return text;
}

/// Surfaces bent by more than 30° have a crease there, like the edges of a box.
constexpr double crease_cosine = 0.866;

/// A place that surfaces share is far from a node: this many times further than the surfaces are, and than where they
/// cross.
constexpr double far_ratio = 1.5;

/// A border node with everything it must lie on.
struct Node {
  std::uint32_t vertex = 0;
  std::vector<std::uint32_t> borders;       ///< constraints it belongs to, ascending
  std::vector<Vec3> outward;                ///< per border: where it goes on to, not of length 1
  std::vector<std::uint32_t> controllers;   ///< their controllers, ascending
  std::vector<std::uint32_t> free_borders;  ///< entities along whose border it slides
  double limit_m = std::numeric_limits<double>::infinity();
  std::optional<Vec3> target;
  std::string failure;
  bool goes_beside = false;  ///< going straight on folded a triangle: to the nearest place instead
  bool stays = false;        ///< that did, too
};

class Cutter {
 public:
  Cutter(const TriangleSoup& soup, const ContactConstraints& constraints, const ConstrainedCutOptions& options)
      : soup_(soup), constraints_(constraints), options_(options), mesh_(soup), searches_(soup.entities.size()) {
    tolerance_m_ = options.tolerance_m.value_or(1e-6 * mesh_.diagonal_m());
    cut_.borders.resize(constraints.borders.size());
    is_dropped_.assign(constraints.borders.size(), 0);
  }

  ConstrainedCut run() {
    for (const std::uint32_t entity : controllers_first()) cut_entity(entity);
    cut_.soup = mesh_.soup_like(soup_);
    return std::move(cut_);
  }

 private:
  const std::string& name(std::uint32_t entity) const { return soup_.entities[entity].name; }
  std::string place(const Vec3& p) const {
    const Vec3 q = p + soup_.local_origin;
    return "(" + OptionPrinter::literal(q.x) + ", " + OptionPrinter::literal(q.y) + ", " + OptionPrinter::literal(q.z) +
           ")";
  }

  /// Controlled entities, each after those it slides on; a circle is entered at its lowest entity and reported.
  std::vector<std::uint32_t> controllers_first() {
    const std::size_t count = soup_.entities.size();
    std::vector<std::vector<std::uint32_t>> needs(count);
    std::vector<char> is_controlled(count, 0);
    for (const auto& c : constraints_.borders) {
      needs[c.entity].push_back(c.controller);
      is_controlled[c.entity] = 1;
    }
    for (const auto& c : constraints_.stones) needs[c.entity].push_back(c.controller);
    std::vector<std::uint32_t> order;
    std::vector<char> is_done(count, 0);
    for (std::uint32_t e = 0; e < count; ++e) is_done[e] = !is_controlled[e];
    const auto is_ready = [&](std::uint32_t e) {
      return std::all_of(needs[e].begin(), needs[e].end(), [&](std::uint32_t n) { return is_done[n]; });
    };
    for (;;) {
      std::uint32_t next = no_index, first_left = no_index;
      for (std::uint32_t e = 0; e < count && next == no_index; ++e) {
        if (is_done[e]) continue;
        if (first_left == no_index) first_left = e;
        if (is_ready(e)) next = e;
      }
      if (first_left == no_index) return order;
      if (next == no_index) {
        // What is left waits for a circle: follow needs from the lowest until an entity comes again.
        std::vector<std::uint32_t> way{first_left};
        for (;;) {
          for (const std::uint32_t n : needs[way.back()])
            if (!is_done[n]) {
              way.push_back(n);
              break;
            }
          const auto again = std::find(way.begin(), way.end() - 1, way.back());
          if (again == way.end() - 1) continue;
          way.erase(way.begin(), again);
          break;
        }
        std::string circle;
        for (const std::uint32_t e : way) circle += (circle.empty() ? "" : " -> ") + name(e);
        cut_.failures.push_back("contacts in a circle: " + circle);
        next = *std::min_element(way.begin(), way.end());
      }
      is_done[next] = 1;
      order.push_back(next);
    }
  }

  SurfaceSearch& search(std::uint32_t entity) {
    if (!searches_[entity] || searches_[entity]->is_stale())
      searches_[entity] = std::make_unique<SurfaceSearch>(mesh_, entity);
    return *searches_[entity];
  }

  /// The border's outward direction at one of its edges: in the triangle, away from its third corner.
  Vec3 outward_of(std::uint32_t entity, std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t t : mesh_.triangles_at(a, b)) {
      if (mesh_.entity_of(t) != entity) continue;
      const Vec3 p = mesh_.point(a), along = mesh_.point(b) - p, in = mesh_.point(mesh_.apex(t, a, b)) - p;
      const Vec3 out = (dot(in, along) / dot(along, along)) * along - in;
      const double size = length(out);
      return size > 0 ? (1 / size) * out : Vec3{};
    }
    return {};
  }

  template <class Visit>
  void visit_edges(const BorderOnSurface& c, Visit&& visit) const {
    for (std::size_t i = 0; i + (c.is_closed ? 0 : 1) < c.points.size(); ++i) {
      const std::uint32_t a = mesh_.vertex_of_input(c.points[i]);
      const std::uint32_t b = mesh_.vertex_of_input(c.points[(i + 1) % c.points.size()]);
      if (a != b) visit(a, b);
    }
  }

  std::vector<Node> nodes_of(std::uint32_t entity) {
    std::vector<Node> nodes;
    std::vector<std::uint32_t> number(mesh_.vertex_count(), no_index);
    const auto node_at = [&](std::uint32_t vertex) -> Node& {
      if (number[vertex] == no_index) {
        number[vertex] = static_cast<std::uint32_t>(nodes.size());
        nodes.emplace_back().vertex = vertex;
      }
      return nodes[number[vertex]];
    };
    for (std::uint32_t i = 0; i < constraints_.borders.size(); ++i) {
      const BorderOnSurface& c = constraints_.borders[i];
      if (c.entity != entity) continue;
      for (const std::uint32_t p : c.points) {
        Node& node = node_at(mesh_.vertex_of_input(p));
        if (node.borders.empty() || node.borders.back() != i) {
          node.borders.push_back(i);
          node.outward.emplace_back();
        }
        node.limit_m = std::min(node.limit_m, c.max_move_m);
      }
      visit_edges(c, [&](std::uint32_t a, std::uint32_t b) {
        const Vec3 out = length(c.direction) > 0 ? c.direction : outward_of(entity, a, b);
        for (Node* node : {&node_at(a), &node_at(b)}) node->outward.back() = node->outward.back() + out;
      });
    }
    for (const StoneOnBorder& stone : constraints_.stones) {
      if (stone.entity != entity) continue;
      const std::uint32_t vertex = mesh_.vertex_of_input(stone.point);
      if (number[vertex] == no_index)
        cut_.failures.push_back("the stone of " + name(entity) + " at " + place(mesh_.point(vertex)) +
                                " is on no constrained border");
      else
        node_at(vertex).free_borders.push_back(stone.controller);
    }
    for (Node& node : nodes) renew_controllers(node);
    return nodes;
  }

  void renew_controllers(Node& node) const {
    node.controllers.clear();
    for (const std::uint32_t i : node.borders)
      if (!is_dropped_[i]) node.controllers.push_back(constraints_.borders[i].controller);
    std::sort(node.controllers.begin(), node.controllers.end());
    node.controllers.erase(std::unique(node.controllers.begin(), node.controllers.end()), node.controllers.end());
  }

  /// Where a node must go (euler1999 §2.4.1, 2.4.7). Searches of all its surfaces exist.
  void aim(Node& node) const {
    node.target.reset();
    node.failure.clear();
    if (node.stays || node.controllers.empty()) return;
    const Vec3 p = mesh_.point(node.vertex);
    std::vector<std::uint32_t> surfaces = node.controllers;
    for (const std::uint32_t e : node.free_borders)
      if (std::find(surfaces.begin(), surfaces.end(), e) == surfaces.end()) surfaces.push_back(e);
    double furthest_m = 0;
    std::vector<Impact> impacts;
    for (const std::uint32_t e : surfaces) {
      const std::optional<Impact> impact = searches_[e]->nearest(p, std::numeric_limits<double>::infinity());
      if (!impact) {
        node.failure = name(e) + " has no triangles";
        return;
      }
      impacts.push_back(*impact);
      furthest_m = std::max(furthest_m, impact->distance_m);
    }
    if (surfaces.size() == 1 && node.free_borders.empty()) {
      node.target = place_ahead(p, node, surfaces[0], impacts[0]);
    } else {
      // The border a stone slides on may be further than the surfaces themselves.
      double radius_m = 10 * furthest_m + 2 * tolerance_m_;
      node.target = shared_place(p, node, surfaces, radius_m);
      for (; !node.target && !node.free_borders.empty() && radius_m < 2 * mesh_.diagonal_m(); radius_m *= 4)
        node.target = shared_place(p, node, surfaces, 4 * radius_m);
      // What they share may be a corner that another contact made elsewhere, while they cross here.
      const double shared_m = node.target ? length(*node.target - p) : std::numeric_limits<double>::infinity();
      if (shared_m > far_ratio * furthest_m && (!node.target || node.free_borders.empty())) {
        const auto meeting = meeting_place(p, surfaces);
        if (meeting && (!node.target || far_ratio * length(*meeting - p) < shared_m)) node.target = meeting;
      }
      if (!node.target) {
        node.failure = "the surfaces it must lie on do not meet near " + place(p);
        return;
      }
    }
    const double move_m = length(*node.target - p);
    if (!(move_m <= node.limit_m)) {
      node.failure = metres(move_m) + " to go at " + place(p) + ", more than the " + metres(node.limit_m) + " allowed";
      node.target.reset();
    }
  }

  /// Straight on, unless the surface is nearly parallel to that and much closer beside. Where two borders of the node
  /// go on to two sides of a crease, the crease.
  Vec3 place_ahead(const Vec3& p, const Node& node, std::uint32_t entity, const Impact& nearest) const {
    if (!(nearest.distance_m > tolerance_m_)) return nearest.point;
    const auto ahead = [&](const Vec3& outward) {
      const double size = length(outward);
      const auto hit =
          size > 0 ? searches_[entity]->along(p, (1 / size) * outward, std::min(4 * nearest.distance_m, node.limit_m))
                   : std::nullopt;
      return hit.value_or(nearest);
    };
    Vec3 all;
    std::vector<Vec3> normals;
    bool is_at_crease = false;
    const auto is_bent = [](const Vec3& n, const Vec3& m) {
      return std::abs(dot(n, m)) < crease_cosine * length(n) * length(m);
    };
    for (std::size_t i = 0; i < node.borders.size(); ++i) {
      if (is_dropped_[node.borders[i]]) continue;
      all = all + node.outward[i];
      normals.push_back(mesh_.normal_m2(ahead(node.outward[i]).triangle));
      is_at_crease |= is_bent(normals.front(), normals.back());
    }
    if (node.goes_beside) return dot(all, nearest.point - p) > 0 ? nearest.point : p;
    if (!is_at_crease) return ahead(all).point;
    Vec3 best = ahead(all).point;
    double best_m = 10 * nearest.distance_m;
    searches_[entity]->visit_near(p, best_m, [&](std::uint32_t t) {
      const Triangle& tri = mesh_.triangle(t);
      for (int k = 0; k < 3; ++k)
        for (const std::uint32_t other : mesh_.triangles_at(tri[k], tri[(k + 1) % 3])) {
          if (mesh_.entity_of(other) != entity || !is_bent(mesh_.normal_m2(t), mesh_.normal_m2(other))) continue;
          const Vec3 q = nearest_on_segment(p, mesh_.point(tri[k]), mesh_.point(tri[(k + 1) % 3]));
          const double d = length(q - p);
          if (d < best_m || (d == best_m && lexicographically_less(q, best))) {
            best_m = d;
            best = q;
          }
        }
    });
    return best;
  }

  /// The nearest place on an edge that all the surfaces share, or on a corner if they share no edge.
  std::optional<Vec3> shared_place(const Vec3& p, const Node& node, const std::vector<std::uint32_t>& surfaces,
                                   double radius_m) const {
    const std::uint32_t base = node.free_borders.empty() ? surfaces[0] : node.free_borders[0];
    struct Best {
      double distance_m = std::numeric_limits<double>::infinity();
      Vec3 point;
      void take(const Vec3& p, const Vec3& q) {
        const double d = length(q - p);
        if (d < distance_m || (d == distance_m && lexicographically_less(q, point))) *this = {d, q};
      }
    } on_all, on_free_borders, corner;
    const auto is_at = [&](std::uint32_t v, std::uint32_t entity) {
      bool found = false;
      mesh_.visit_triangles_at(v, [&](std::uint32_t t) { found |= mesh_.entity_of(t) == entity; });
      return found;
    };
    searches_[base]->visit_near(p, radius_m, [&](std::uint32_t t) {
      const Triangle& tri = mesh_.triangle(t);
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = tri[k], b = tri[(k + 1) % 3];
        const Vec3 q = nearest_on_segment(p, mesh_.point(a), mesh_.point(b));
        if (length(q - p) <= radius_m) {
          const auto is_free = [&](std::uint32_t e) { return mesh_.count_at(a, b, e) == 1; };
          const bool on_free = std::all_of(node.free_borders.begin(), node.free_borders.end(), is_free);
          const auto has = [&](std::uint32_t e) { return mesh_.has_edge(a, b, e); };
          if (on_free && std::all_of(surfaces.begin(), surfaces.end(), has)) on_all.take(p, q);
          if (on_free && !node.free_borders.empty()) on_free_borders.take(p, q);
        }
        if (length(mesh_.point(a) - p) <= radius_m &&
            std::all_of(surfaces.begin(), surfaces.end(), [&](std::uint32_t e) { return is_at(a, e); }))
          corner.take(p, mesh_.point(a));
      }
    });
    for (const Best& best : {on_all, corner, on_free_borders})
      if (std::isfinite(best.distance_m)) return best.point;
    return std::nullopt;
  }

  /// Where up to three surfaces that cross meet, near p: Newton steps on their tangent planes.
  std::optional<Vec3> meeting_place(const Vec3& p, const std::vector<std::uint32_t>& surfaces) const {
    if (surfaces.size() > 3) return std::nullopt;
    Vec3 x = p;
    for (int step = 0; step < 50; ++step) {
      std::array<Vec3, 3> n{};
      std::array<double, 3> gap{};
      std::size_t count = 0;
      double worst_m = 0;
      for (const std::uint32_t e : surfaces) {
        const auto impact = searches_[e]->nearest(x, std::numeric_limits<double>::infinity());
        const Vec3 normal = mesh_.normal_m2(impact->triangle);
        const double size = length(normal);
        worst_m = std::max(worst_m, impact->distance_m);
        if (!(size > 0)) return std::nullopt;
        n[count] = (1 / size) * normal;
        gap[count] = dot(n[count], impact->point - x);
        ++count;
      }
      if (worst_m <= 1e-3 * tolerance_m_) return x;
      Vec3 move;
      if (count == 1) {
        move = gap[0] * n[0];
      } else if (count == 2) {
        const double c = dot(n[0], n[1]), det = 1 - c * c;
        if (!(det > 1e-6)) return std::nullopt;
        move = ((gap[0] - c * gap[1]) / det) * n[0] + ((gap[1] - c * gap[0]) / det) * n[1];
      } else {
        const double det = dot(n[0], cross(n[1], n[2]));
        if (!(std::abs(det) > 1e-6)) return std::nullopt;
        move = (gap[0] / det) * cross(n[1], n[2]) + (gap[1] / det) * cross(n[2], n[0]) +
               (gap[2] / det) * cross(n[0], n[1]);
      }
      x = x + move;
    }
    return std::nullopt;
  }

  void fail(std::uint32_t border, const std::string& why) {
    const BorderOnSurface& c = constraints_.borders[border];
    cut_.borders[border].failures.push_back(name(c.entity) + " on " + name(c.controller) + ": " + why);
  }
  void drop(std::uint32_t border, const std::string& why) {
    if (is_dropped_[border]) return;
    is_dropped_[border] = 1;
    fail(border, why);
  }

  /// Aims all nodes; borders that cannot be moved as a whole are dropped until the rest can.
  void aim_all(std::vector<Node>& nodes) {
    for (bool is_settled = false; !is_settled;) {
      is_settled = true;
      parallel_ranges(nodes.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) aim(nodes[i]);
      });
      std::vector<std::uint32_t> number(mesh_.vertex_count(), no_index);
      for (std::uint32_t i = 0; i < nodes.size(); ++i) number[nodes[i].vertex] = i;
      shrink_short_borders(nodes, number);
      for (const Node& node : nodes)
        if (!node.failure.empty())
          for (const std::uint32_t border : node.borders) {
            is_settled &= is_dropped_[border] != 0;
            drop(border, node.failure);
          }
      if (is_settled) is_settled = !leave_folds(nodes, number);
      for (Node& node : nodes) renew_controllers(node);
    }
  }

  /// A border shorter than the way its ends have to go, like the blunt tip of a wedge, becomes a point.
  void shrink_short_borders(std::vector<Node>& nodes, const std::vector<std::uint32_t>& number) const {
    for (std::uint32_t i = 0; i < constraints_.borders.size(); ++i) {
      const BorderOnSurface& c = constraints_.borders[i];
      const std::uint32_t first = mesh_.vertex_of_input(c.points.front()),
                          last = mesh_.vertex_of_input(c.points.back());
      if (is_dropped_[i] || c.is_closed || first == last || number[first] == no_index || number[last] == no_index)
        continue;
      const Node &begin = nodes[number[first]], &end = nodes[number[last]];
      if (!begin.target || !end.target) continue;
      double border_m = 0;
      visit_edges(c, [&](std::uint32_t a, std::uint32_t b) { border_m += length(mesh_.point(b) - mesh_.point(a)); });
      const double begin_m = length(*begin.target - mesh_.point(first)),
                   end_m = length(*end.target - mesh_.point(last));
      if (!(border_m < std::min(begin_m, end_m))) continue;
      const Vec3 point = end.controllers.size() > begin.controllers.size() ? *end.target : *begin.target;
      for (const std::uint32_t p : c.points) nodes[number[mesh_.vertex_of_input(p)]].target = point;
    }
  }

  /// Nodes whose move would fold a triangle stay where they are; the rest of their borders is led all the same.
  bool leave_folds(std::vector<Node>& nodes, const std::vector<std::uint32_t>& number) {
    std::vector<std::uint32_t> folding;
    const auto place_of = [&](std::uint32_t v) {
      return number[v] != no_index && nodes[number[v]].target ? *nodes[number[v]].target : mesh_.point(v);
    };
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      if (!nodes[i].target) continue;
      // Overshooting and nowhere to go to.
      bool folds = nodes[i].goes_beside && *nodes[i].target == mesh_.point(nodes[i].vertex);
      mesh_.visit_triangles_at(nodes[i].vertex, [&](std::uint32_t t) {
        const Triangle& tri = mesh_.triangle(t);
        const Vec3 a = place_of(tri[0]);
        folds |= !(dot(cross(place_of(tri[1]) - a, place_of(tri[2]) - a), mesh_.normal_m2(t)) >= 0);
      });
      if (folds) folding.push_back(i);
    }
    for (const std::uint32_t i : folding) {
      Node& node = nodes[i];
      if (!node.goes_beside && node.controllers.size() == 1 && node.free_borders.empty()) {
        node.goes_beside = true;
        continue;
      }
      node.stays = true;
      for (const std::uint32_t border : nodes[i].borders)
        if (!is_dropped_[border] && cut_.borders[border].failures.empty())
          fail(border, "it overshoots by more than its last triangles at " + place(mesh_.point(nodes[i].vertex)) +
                           "; cut it there instead");
    }
    return !folding.empty();
  }

  double tolerance_at(std::uint32_t t) const {
    double shortest = std::numeric_limits<double>::infinity();
    const Triangle& tri = mesh_.triangle(t);
    for (int k = 0; k < 3; ++k)
      shortest = std::min(shortest, length(mesh_.point(tri[(k + 1) % 3]) - mesh_.point(tri[k])));
    return std::min(tolerance_m_, 0.1 * shortest);
  }

  /// Makes p a vertex of an entity, by priority one that is there, one on an edge, one inside a triangle (euler1999
  /// §2.4.3). `given`, if any, is the vertex to use; it may be merged into one that is there.
  std::uint32_t put_on(std::uint32_t entity, const Vec3& p, std::uint32_t given) {
    if (given != no_index) {
      bool is_there = false;
      mesh_.visit_triangles_at(given, [&](std::uint32_t t) { is_there |= mesh_.entity_of(t) == entity; });
      if (is_there) return given;
    }
    const Impact impact = *search(entity).nearest(p, std::numeric_limits<double>::infinity());
    const Triangle tri = mesh_.triangle(impact.triangle);
    const double tolerance = tolerance_at(impact.triangle);
    std::uint32_t vertex = no_index;
    double best_m = tolerance;
    for (const std::uint32_t v : tri)
      if (const double d = length(mesh_.point(v) - p); d <= best_m) {
        best_m = d;
        vertex = v;
      }
    if (vertex != no_index) {
      if (given != no_index) mesh_.merge(given, vertex, tolerance_m_);
      return vertex;
    }
    int edge = -1;
    best_m = tolerance;
    for (int k = 0; k < 3; ++k) {
      const Vec3 q = nearest_on_segment(p, mesh_.point(tri[k]), mesh_.point(tri[(k + 1) % 3]));
      if (const double d = length(q - p); d <= best_m) {
        best_m = d;
        edge = k;
      }
    }
    if (edge >= 0) {
      const std::uint32_t a = tri[edge], b = tri[(edge + 1) % 3];
      if (given == no_index) given = mesh_.add_vertex(nearest_on_segment(p, mesh_.point(a), mesh_.point(b)));
      mesh_.split_edge(a, b, given);
    } else {
      if (given == no_index) given = mesh_.add_vertex(impact.point);
      mesh_.split_triangle(impact.triangle, given);
    }
    return given;
  }

  void move(const Node& node) {
    const std::uint32_t vertex = mesh_.current(node.vertex);
    const Vec3 before = mesh_.point(vertex);
    std::uint32_t place = no_index;
    // A vertex of a controller is already where it must be.
    for (const std::uint32_t e : node.controllers)
      mesh_.visit_triangles_at(vertex, [&](std::uint32_t t) {
        if (mesh_.entity_of(t) == e && length(*node.target - before) <= tolerance_m_) place = vertex;
      });
    for (const std::uint32_t e : node.free_borders) place = put_on(e, *node.target, place);
    for (const std::uint32_t e : node.controllers) place = put_on(e, *node.target, place);
    mesh_.merge(vertex, place, tolerance_m_);
    for (const std::uint32_t border : node.borders)
      if (!is_dropped_[border])
        cut_.borders[border].max_move_m =
            std::max(cut_.borders[border].max_move_m, length(mesh_.point(place) - before));
  }

  /// Third points for guide planes through u and v, best first.
  std::vector<Vec3> guides(std::uint32_t border, std::uint32_t u, std::uint32_t v) const {
    const BorderOnSurface& c = constraints_.borders[border];
    const Vec3 along = mesh_.point(v) - mesh_.point(u);
    const double size = length(along);
    const Vec3 n = mesh_.unit_normal_at(u, c.controller), m = mesh_.unit_normal_at(v, c.controller);
    const Vec3 dip = outward_of(c.entity, u, v);
    std::vector<Vec3> directions;
    if (options_.guide_plane == GuidePlaneRule::local_dip)
      directions = {dip};
    else
      directions = {n + m, n - m, c.direction, n, m, dip};
    std::vector<Vec3> points;
    for (const Vec3& d : directions) {
      const double norm = length(d);
      // ~0, or along the edge: no plane.
      if (norm > 1e-6 && length(cross(d, along)) > 1e-3 * norm * size)
        points.push_back(mesh_.point(u) + (size / norm) * d);
    }
    return points;
  }

  /// Leads u → v over the controller; the vertices between, or nothing if there is no path.
  std::optional<std::vector<std::uint32_t>> lead(std::uint32_t border, std::uint32_t u, std::uint32_t v) {
    const std::uint32_t entity = constraints_.borders[border].controller;
    std::vector<std::uint32_t> chain;
    if (mesh_.has_edge(u, v, entity)) return chain;
    const double reach = options_.max_path_ratio * length(mesh_.point(v) - mesh_.point(u));
    std::optional<std::vector<PathNode>> path;
    for (const Vec3& third : guides(border, u, v)) {
      path = find_guide_path(mesh_, entity, u, v, {mesh_.point(u), mesh_.point(v), third}, reach);
      if (path) break;
    }
    if (!path) return std::nullopt;
    // Close to a vertex is through it; then the edges of that vertex are crossed there as well.
    for (PathNode& node : *path) {
      if (node.is_vertex()) continue;
      const double size = length(mesh_.point(node.a) - mesh_.point(node.b));
      const double to_a = length(mesh_.point(node.a) - node.point), to_b = length(mesh_.point(node.b) - node.point);
      if (std::min(to_a, to_b) > std::min(tolerance_m_, 0.1 * size)) continue;
      node.a = node.b = to_a <= to_b ? node.a : node.b;
    }
    std::vector<PathNode> kept{{u, u, mesh_.point(u)}};
    const auto touches = [](const PathNode& node, const PathNode& vertex) {
      return vertex.is_vertex() && (node.a == vertex.a || node.b == vertex.a);
    };
    path->push_back({v, v, mesh_.point(v)});
    for (const PathNode& node : *path) {
      if (node.is_vertex())
        while (kept.size() > 1 && touches(kept.back(), node)) kept.pop_back();
      if (!touches(node, kept.back())) kept.push_back(node);
    }
    std::vector<char> is_soft(kept.size(), 0);
    for (std::size_t i = 0; i < kept.size(); ++i)
      is_soft[i] = !kept[i].is_vertex() && mesh_.is_soft(kept[i].a, kept[i].b);
    std::uint32_t last = u;
    for (std::size_t i = 1; i < kept.size(); ++i) {
      if (is_soft[i]) continue;
      std::uint32_t next = kept[i].a;
      if (!kept[i].is_vertex()) {
        next = mesh_.add_vertex(kept[i].point);
        mesh_.split_edge(kept[i].a, kept[i].b, next);
      }
      if (!join(entity, last, next, chain, border)) return std::nullopt;
      if (next != v) chain.push_back(next);
      last = next;
    }
    return chain;
  }

  /// Makes u–v a chain of edges: inside one plane by flipping, else by splitting every edge between.
  bool join(std::uint32_t entity, std::uint32_t u, std::uint32_t v, std::vector<std::uint32_t>& chain,
            std::uint32_t border) {
    std::vector<std::uint32_t> passed;
    const bool is_joined = mesh_.insert_segment(u, v, entity, passed);
    chain.insert(chain.end(), passed.begin(), passed.end());
    if (is_joined) return true;
    if (!passed.empty()) u = passed.back();
    const double reach = options_.max_path_ratio * length(mesh_.point(v) - mesh_.point(u));
    for (const Vec3& third : guides(border, u, v)) {
      const auto path = find_guide_path(mesh_, entity, u, v, {mesh_.point(u), mesh_.point(v), third}, reach);
      if (!path) continue;
      for (const PathNode& node : *path) {
        std::uint32_t next = node.a;
        if (!node.is_vertex()) {
          next = mesh_.add_vertex(node.point);
          mesh_.split_edge(node.a, node.b, next);
        }
        chain.push_back(next);
      }
      return true;
    }
    return false;
  }

  void cut_entity(std::uint32_t entity) {
    std::vector<Node> nodes = nodes_of(entity);
    for (const Node& node : nodes) {
      for (const std::uint32_t e : node.controllers) search(e);
      for (const std::uint32_t e : node.free_borders) search(e);
    }
    aim_all(nodes);
    std::vector<char> stays(mesh_.vertex_count(), 0);
    for (const Node& node : nodes) {
      stays[node.vertex] = node.stays;
      if (node.target) move(node);
    }
    for (std::uint32_t i = 0; i < constraints_.borders.size(); ++i) {
      const BorderOnSurface& c = constraints_.borders[i];
      if (c.entity != entity) continue;
      cut_.borders[i].border_nodes = static_cast<std::uint32_t>(c.points.size());
      if (is_dropped_[i]) continue;
      visit_edges(c, [&](std::uint32_t u, std::uint32_t v) {
        if ((u < stays.size() && stays[u]) || (v < stays.size() && stays[v])) return;
        const auto chain = lead(i, u, v);
        if (!chain) {
          fail(i, "no path on it from " + place(mesh_.point(u)) + " to " + place(mesh_.point(v)));
          return;
        }
        if (chain->empty()) return;
        cut_.borders[i].inserted_nodes += static_cast<std::uint32_t>(chain->size());
        for (const std::uint32_t t : mesh_.triangles_at(u, v))
          if (mesh_.entity_of(t) != c.controller) mesh_.deform_edge(t, u, v, *chain);
      });
    }
    mesh_.widen_angles();
  }

  const TriangleSoup& soup_;
  const ContactConstraints& constraints_;
  const ConstrainedCutOptions& options_;
  ContactMesh mesh_;
  std::vector<std::unique_ptr<SurfaceSearch>> searches_;
  double tolerance_m_ = 0;
  std::vector<char> is_dropped_;
  ConstrainedCut cut_;
};

}  // namespace

Result<ConstrainedCut> cut_constrained(const TriangleSoup& soup, const ContactConstraints& constraints,
                                       const ConstrainedCutOptions& options) {
  const auto invalid = [](const std::string& what) {
    return Failure{FailureCode::invalid_input, what, "name contacts of this model"};
  };
  for (const BorderOnSurface& c : constraints.borders) {
    if (c.entity >= soup.entities.size() || c.controller >= soup.entities.size())
      return invalid("a contact of an entity that does not exist");
    if (c.entity == c.controller) return invalid("a contact of " + soup.entities[c.entity].name + " with itself");
    if (c.points.size() < 2)
      return invalid("a contact of " + soup.entities[c.entity].name + " along less than one edge");
    for (const std::uint32_t p : c.points)
      if (p >= soup.points.size())
        return invalid("a contact of " + soup.entities[c.entity].name + " at a point that does not exist");
  }
  for (const StoneOnBorder& c : constraints.stones)
    if (c.entity >= soup.entities.size() || c.controller >= soup.entities.size() || c.point >= soup.points.size() ||
        c.entity == c.controller)
      return invalid("a stone that slides on nothing");
  return Cutter(soup, constraints, options).run();
}

}  // namespace strataflow
