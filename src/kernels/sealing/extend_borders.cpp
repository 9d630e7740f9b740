#include "kernels/sealing/extend_borders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/sealing/welded_soup.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {

namespace {

constexpr double least_sine = 0.02;    ///< between a border's way on and the surface it meets
constexpr double most_sine = 0.35;     ///< between a border edge and a surface it runs beside
constexpr double longest_graze = 4;    ///< times the reach, where a surface is met at a small angle …
constexpr double graze_height = 0.25;  ///< … and no further off than this share of the reach
constexpr double slit_cosine = -0.5;   ///< border edges that look away from each other end a slit
constexpr double longest_mitre = 3;

/// A border edge that stops short.
struct ShortEdge {
  std::uint32_t a = 0, b = 0;  ///< welded points
  std::uint32_t triangle = 0;
  Vec3 outward;  ///< unit: on in the plane of the triangle, or towards a surface it runs beside
  double edge_length = 0;
  double gap = -1;  ///< largest over its samples; −1: reaches nothing
  Vec3 where;
  std::uint32_t onto = no_index;
};

class BorderExtender {
 public:
  BorderExtender(const TriangleSoup& soup, const ExtendBordersOptions& options)
      : soup_(soup), options_(options), mesh_(soup) {}

  Result<void> find() {
    if (auto ok = read_reach(); !ok) return ok;
    const std::vector<FloatBox> boxes = parallel_map(
        mesh_.triangles.size(),
        [&](std::size_t t) {
          Box3 box;
          for (const std::uint32_t v : mesh_.triangles[t]) box.take(mesh_.points[v]);
          return enclosing(box);
        },
        4096);
    tree_ = BoundingVolumeTree(boxes);
    const EdgeTable table = build_edge_table(mesh_.points.size(), mesh_.triangles);
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
      const auto around = table.around(e);
      if (around.size() != 1) continue;
      const std::uint32_t t = around[0] / 3, k = around[0] % 3;
      ShortEdge edge{mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3], t, {}, 0, -1, {}, no_index};
      const Vec3 &a = mesh_.points[edge.a], &b = mesh_.points[edge.b],
                 &c = mesh_.points[mesh_.triangles[t][(k + 2) % 3]];
      const Vec3 out = cross(b - a, cross(b - a, c - a));
      const double l = length(out);
      edge.edge_length = length(b - a);
      if (!(l > 0)) continue;
      edge.outward = (1 / l) * out;
      edges_.push_back(edge);
    }
    find_held_points();
    parallel_ranges(edges_.size(), 32, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) probe(edges_[i]);
    });
    return {};
  }

  std::vector<BorderGap> gaps() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, BorderGap> by_pair;
    for (const ShortEdge& edge : edges_) {
      if (edge.gap < 0) continue;
      const std::uint32_t entity = mesh_.entity[edge.triangle];
      BorderGap& gap = by_pair.try_emplace({entity, edge.onto}, BorderGap{entity, edge.onto, -1, {}, 0}).first->second;
      ++gap.edge_count;
      if (edge.gap > gap.largest_m) {
        gap.largest_m = edge.gap;
        gap.where = edge.where;
      }
    }
    std::vector<BorderGap> list;
    for (const auto& [pair, gap] : by_pair) list.push_back(gap);
    return list;
  }

  ExtendedBorders extend() {
    ExtendedBorders result{soup_, gaps(), 0, 0};
    // The (one or more) free edges at each border point.
    std::vector<std::vector<std::uint32_t>> at(mesh_.points.size());
    std::vector<char> is_moved_border(mesh_.points.size(), 0);
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      for (const std::uint32_t v : {edges_[e].a, edges_[e].b}) {
        at[v].push_back(e);
        if (edges_[e].gap >= 0) is_moved_border[v] = 1;
      }
    std::vector<std::vector<std::uint32_t>> triangles_at(mesh_.points.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t])
        if (is_moved_border[v]) triangles_at[v].push_back(t);
    std::vector<Vec3> move(mesh_.points.size());
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (!is_moved_border[v]) continue;
      const bool is_shared = std::any_of(triangles_at[v].begin(), triangles_at[v].end(), [&](std::uint32_t t) {
        return mesh_.entity[t] != mesh_.entity[triangles_at[v].front()];
      });
      if (!is_shared) move[v] = shortened(v, way_of(v, at[v]), triangles_at[v]);
    }
    for (std::size_t p = 0; p < soup_.points.size(); ++p) {
      const Vec3& by = move[mesh_.id[p]];
      if (by == Vec3{}) continue;
      result.soup.points[p] = result.soup.points[p] + by;
    }
    for (const Vec3& by : move)
      if (!(by == Vec3{})) {
        ++result.moved_points;
        result.largest_move_m = std::max(result.largest_move_m, length(by));
      }
    // A file's records name points that have moved.
    if (result.moved_points > 0) {
      result.soup.border_stones.clear();
      result.soup.border_starts.clear();
    }
    return result;
  }

 private:
  Result<void> read_reach() {
    const auto index_of = [&](const std::string& name) -> std::uint32_t {
      for (std::uint32_t e = 0; e < soup_.entities.size(); ++e)
        if (soup_.entities[e].name == name) return e;
      return no_index;
    };
    for (const NamedContact& contact : options_.contacts) {
      const std::uint32_t entity = index_of(contact.entity), onto = index_of(contact.onto);
      for (const auto& [name, index] : {std::pair(contact.entity, entity), std::pair(contact.onto, onto)})
        if (index == no_index)
          return Failure{FailureCode::invalid_options, "no surface is called '" + name + "'",
                         "name surfaces as the input does; `strataflow check` lists them"};
      named_[{entity, onto}] = contact.distance_m;
    }
    furthest_ = options_.distance_m;
    for (const auto& [pair, distance] : named_) furthest_ = std::max(furthest_, distance);
    return {};
  }

  /// Which other entities each point of a free edge lies on.
  void find_held_points() {
    std::vector<char> is_free(mesh_.points.size(), 0);
    for (const ShortEdge& edge : edges_) is_free[edge.a] = is_free[edge.b] = 1;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t])
        if (is_free[v]) held_.push_back({v, mesh_.entity[t]});
    std::sort(held_.begin(), held_.end());
    held_.erase(std::unique(held_.begin(), held_.end()), held_.end());
  }

  /// Whether an edge rises from a surface it has an end on: the tip of a fault on a horizon that it displaces no more
  /// does not stop short of that horizon, which goes on beside it.
  bool rises_from(const ShortEdge& edge, std::uint32_t t) const {
    const auto is_on = [&](std::uint32_t v) {
      return std::binary_search(held_.begin(), held_.end(), std::pair(v, mesh_.entity[t]));
    };
    if (!is_on(edge.a) && !is_on(edge.b)) return false;
    const Triangle& v = mesh_.triangles[t];
    const Vec3 normal = cross(mesh_.points[v[1]] - mesh_.points[v[0]], mesh_.points[v[2]] - mesh_.points[v[0]]);
    return std::abs(dot(mesh_.points[edge.b] - mesh_.points[edge.a], normal)) >
           most_sine * length(normal) * edge.edge_length;
  }

  double reach(std::uint32_t entity, std::uint32_t onto) const {
    if (named_.empty()) return options_.distance_m;
    const auto found = named_.find({entity, onto});
    return found == named_.end() ? options_.distance_m : std::max(found->second, options_.distance_m);
  }

  void probe(ShortEdge& edge) const {
    probe_ahead(edge);
    if (edge.gap < 0) probe_beside(edge);
  }

  /// Follows an edge's way on from three of its points.
  void probe_ahead(ShortEdge& edge) const {
    for (const double share : {0.02, 0.5, 0.98}) {
      const Vec3 from = mesh_.points[edge.a] + share * (mesh_.points[edge.b] - mesh_.points[edge.a]);
      double nearest = std::numeric_limits<double>::infinity();
      std::uint32_t onto = no_index;
      Box3 box;
      box.take(from);
      box.take(from + longest_graze * furthest_ * edge.outward);
      tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
        if (mesh_.entity[t] == mesh_.entity[edge.triangle]) return;
        const auto [distance, height] = distance_along(from, edge.outward, mesh_.triangles[t]);
        const double most = reach(mesh_.entity[edge.triangle], mesh_.entity[t]);
        // A surface met at a small angle is near even where the way to it is long.
        if ((distance <= most || (distance <= longest_graze * most && height <= graze_height * most)) &&
            (distance < nearest || (distance == nearest && mesh_.entity[t] < onto)) && !rises_from(edge, t)) {
          nearest = distance;
          onto = mesh_.entity[t];
        }
      });
      if (onto == no_index || nearest <= edge.gap) continue;
      edge.gap = nearest;
      edge.where = from;
      edge.onto = onto;
    }
  }

  /// An edge that runs along a surface all its length, where its way on would graze it or pass it by: a branch line,
  /// an onlap.
  void probe_beside(ShortEdge& edge) const {
    const Vec3 &a = mesh_.points[edge.a], &b = mesh_.points[edge.b];
    const std::uint32_t own = mesh_.entity[edge.triangle];
    struct Near {
      double distance;
      Vec3 towards;
      std::uint32_t entity;
      bool is_parallel;
    };
    std::vector<Near> first, here;
    const auto look = [&](const Vec3& from) {
      std::vector<Near> near;
      Box3 box;
      box.take(from - Vec3{furthest_, furthest_, furthest_});
      box.take(from + Vec3{furthest_, furthest_, furthest_});
      tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
        if (mesh_.entity[t] == own) return;
        const Triangle& v = mesh_.triangles[t];
        const Vec3 normal = cross(mesh_.points[v[1]] - mesh_.points[v[0]], mesh_.points[v[2]] - mesh_.points[v[0]]);
        const double n = length(normal), height = dot(from - mesh_.points[v[0]], normal);
        // Only where the foot of the perpendicular is in the triangle: beside it, not beyond its rim.
        const Vec3 foot = from - (height / (n * n)) * normal;
        for (int k = 0; k < 3; ++k)
          if (dot(cross(mesh_.points[v[(k + 1) % 3]] - mesh_.points[v[k]], foot - mesh_.points[v[k]]), normal) < 0)
            return;
        const double distance = std::abs(height) / n;
        if (!(distance <= reach(own, mesh_.entity[t]))) return;
        const bool is_parallel = std::abs(dot(b - a, normal)) <= most_sine * n * edge.edge_length;
        const Near found{distance, (height > 0 ? -1 / n : 1 / n) * normal, mesh_.entity[t], is_parallel};
        const auto same =
            std::find_if(near.begin(), near.end(), [&](const Near& o) { return o.entity == found.entity; });
        if (same == near.end())
          near.push_back(found);
        else if (found.distance < same->distance)
          *same = found;
      });
      std::sort(near.begin(), near.end(), [](const Near& x, const Near& y) { return x.entity < y.entity; });
      return near;
    };
    first = look(a + 0.5 * (b - a));
    std::erase_if(first, [](const Near& n) { return !n.is_parallel; });
    for (const double share : {0.02, 0.98}) {
      if (first.empty()) return;
      here = look(a + share * (b - a));
      std::erase_if(first, [&](Near& n) {
        const auto same = std::find_if(here.begin(), here.end(), [&](const Near& o) { return o.entity == n.entity; });
        if (same == here.end()) return true;
        n.distance = std::max(n.distance, same->distance);
        return false;
      });
    }
    if (first.empty()) return;
    const Near& best = *std::min_element(first.begin(), first.end(), [](const Near& x, const Near& y) {
      return x.distance != y.distance ? x.distance < y.distance : x.entity < y.entity;
    });
    edge.gap = best.distance;
    edge.outward = best.towards;
    edge.where = a + 0.5 * (b - a);
    edge.onto = best.entity;
  }

  struct Hit {
    double distance, height;  ///< along the way, and off the plane that is hit
  };
  /// Where p along a unit direction meets a triangle at more than a grazing angle; infinitely far if it does not.
  Hit distance_along(const Vec3& p, const Vec3& direction, const Triangle& t) const {
    constexpr double rim = 1e-9;
    constexpr Hit none{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    const Vec3 &a = mesh_.points[t[0]], &b = mesh_.points[t[1]], &c = mesh_.points[t[2]];
    const Vec3 normal = cross(b - a, c - a);
    const double n = length(normal), steep = dot(normal, direction);
    if (!(std::abs(steep) > least_sine * n)) return none;
    const Vec3 q = cross(p - a, direction);
    const double v = dot(b - a, q) / steep, u = -dot(c - a, q) / steep;
    if (!(u >= -rim && v >= -rim && u + v <= 1 + rim)) return none;
    const double distance = dot(a - p, normal) / steep;
    return distance >= 0 ? Hit{distance, std::abs(dot(a - p, normal)) / n} : none;
  }

  double wanted(const ShortEdge& edge) const {
    return edge.gap + std::max(options_.margin_ratio * edge.gap, options_.edge_margin_ratio * edge.edge_length);
  }

  /// How a border point moves.
  Vec3 way_of(std::uint32_t v, const std::vector<std::uint32_t>& free_edges) const {
    if (free_edges.size() != 2) return {};  // borders meet in this point: something else holds it
    const ShortEdge &first = edges_[free_edges[0]], &second = edges_[free_edges[1]];
    const double turn = dot(first.outward, second.outward);
    if (first.gap >= 0 && second.gap >= 0) {
      if (turn < slit_cosine) return {};
      const double l = wanted(first), m = wanted(second);
      if (turn > 0.95) {
        const Vec3 mean = first.outward + second.outward;
        return (std::max(l, m) / length(mean)) * mean;
      }
      const double determinant = 1 - turn * turn;
      const Vec3 way = ((l - turn * m) / determinant) * first.outward + ((m - turn * l) / determinant) * second.outward;
      const double most = longest_mitre * std::max(l, m), far = length(way);
      return far > most ? (most / far) * way : way;
    }
    const ShortEdge &reaching = first.gap >= 0 ? first : second, &other = first.gap >= 0 ? second : first;
    const double l = wanted(reaching);
    // The border that stays free is prolonged.
    const Vec3 along = mesh_.points[v] - mesh_.points[other.a == v ? other.b : other.a];
    const double straight = dot(along, reaching.outward) / length(along);
    if (straight > 0.5) return (l / straight / length(along)) * along;
    return l * reaching.outward;
  }

  Vec3 shortened(std::uint32_t v, Vec3 way, const std::vector<std::uint32_t>& around) const {
    for (int attempt = 0; attempt < 4 && !(way == Vec3{}); ++attempt) {
      const bool turns = std::any_of(around.begin(), around.end(), [&](std::uint32_t t) {
        std::array<Vec3, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = mesh_.points[mesh_.triangles[t][k]];
        const Vec3 before = cross(p[1] - p[0], p[2] - p[0]);
        for (int k = 0; k < 3; ++k)
          if (mesh_.triangles[t][k] == v) p[k] = p[k] + way;
        const Vec3 after = cross(p[1] - p[0], p[2] - p[0]);
        return !(dot(before, after) > 0.5 * length(before) * length(after));
      });
      if (!turns) return way;
      way = 0.5 * way;
    }
    return {};
  }

  const TriangleSoup& soup_;
  const ExtendBordersOptions& options_;
  WeldedSoup mesh_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> named_;
  double furthest_ = 0;
  BoundingVolumeTree tree_;
  std::vector<ShortEdge> edges_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> held_;  ///< (point of a free edge, entity), sorted
};

}  // namespace

Result<std::vector<BorderGap>> find_gaps(const TriangleSoup& soup, const ExtendBordersOptions& options) {
  BorderExtender extender(soup, options);
  if (auto ok = extender.find(); !ok) return ok.failure();
  return extender.gaps();
}

Result<ExtendedBorders> extend_borders(const TriangleSoup& soup, const ExtendBordersOptions& options) {
  BorderExtender extender(soup, options);
  if (auto ok = extender.find(); !ok) return ok.failure();
  return extender.extend();
}

}  // namespace strataflow
