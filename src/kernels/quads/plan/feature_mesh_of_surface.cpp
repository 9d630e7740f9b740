#include "kernels/quads/plan/feature_mesh_of_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "base/id.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/building/weld_points.h"
#include "model/box3.h"

namespace strataflow {

namespace {

/// An edge that is a feature whatever its shape.
struct NamedEdge {
  std::uint32_t a, b;
  std::uint32_t name;
};

struct LabelledSurface {
  Vec3 local_origin;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> label;  ///< per triangle: index into names
  std::vector<std::string> names;
  std::vector<NamedEdge> edges;  ///< name: index into edge_names
  std::vector<std::pair<std::string, Role>> edge_names;
  std::vector<std::uint32_t> corners;
};

Failure not_a_surface(const std::string& what, const Vec3& p, const Vec3& origin) {
  const Vec3 q = p + origin;
  return Failure{FailureCode::invalid_input,
                 what + " at (" + std::to_string(q.x) + ", " + std::to_string(q.y) + ", " + std::to_string(q.z) + ")",
                 "give one surface at a time, sealed and cut where it meets others"};
}

class SurfaceFeatures {
 public:
  SurfaceFeatures(LabelledSurface surface, const SurfaceFeatureOptions& options)
      : surface_(std::move(surface)), options_(options) {}

  Result<FeatureMesh> run() {
    if (const auto failure = check()) return *failure;
    if (const auto failure = orient()) return *failure;
    find_features();
    if (const auto failure = refine()) return *failure;
    find_corners();
    result_.local_origin = surface_.local_origin;
    result_.points = std::move(surface_.points);
    result_.triangles = std::move(surface_.triangles);
    result_.edge_length_m = edge_length_m_;
    std::sort(result_.edges.begin(), result_.edges.end());
    return std::move(result_);
  }

 private:
  Failure wrong(const std::string& what, std::uint32_t p) const {
    return not_a_surface(what, surface_.points[p], surface_.local_origin);
  }

  std::optional<Failure> check() {
    if (surface_.triangles.empty())
      return Failure{FailureCode::invalid_input, "there is no triangle to mesh", "name a surface that the input has"};
    Box3 box;
    for (const Triangle& t : surface_.triangles) {
      for (const std::uint32_t p : t) {
        if (!is_finite(surface_.points[p])) return wrong("a coordinate is not finite", p);
        box.take(surface_.points[p]);
      }
      const Vec3 n =
          cross(surface_.points[t[1]] - surface_.points[t[0]], surface_.points[t[2]] - surface_.points[t[0]]);
      if (t[0] == t[1] || t[1] == t[2] || t[0] == t[2] || !(length(n) > 0))
        return wrong("a triangle has no area", t[0]);
    }
    edge_length_m_ = options_.edge_length_m > 0 ? options_.edge_length_m : box.diagonal_m() / 100;
    if (!(edge_length_m_ > 0) || !(box.diagonal_m() / edge_length_m_ < 20000))
      return Failure{FailureCode::invalid_options, "edge_length_m does not suit a surface of that size",
                     "choose an edge length above a 20 000th of the diagonal"};
    return std::nullopt;
  }

  std::optional<Failure> orient() {
    const EdgeTable table = build_edge_table(surface_.points.size(), surface_.triangles);
    for (std::uint32_t e = 0; e < table.edge_count(); ++e)
      if (table.around(e).size() > 2) return wrong("more than two triangles meet at an edge", table.edges[e][0]);
    const auto origin = [&](std::uint32_t h) { return surface_.triangles[h / 3][h % 3]; };
    std::vector<std::int8_t> turn(surface_.triangles.size(), 0);  // 1: as it is, −1: to be turned over
    std::vector<std::uint32_t> stack;
    for (std::uint32_t seed = 0; seed < turn.size(); ++seed) {
      if (turn[seed] != 0) continue;
      turn[seed] = 1;
      stack.push_back(seed);
      while (!stack.empty()) {
        const std::uint32_t t = stack.back();
        stack.pop_back();
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
          for (const std::uint32_t g : table.around(table.edge_of[h])) {
            if (g == h) continue;
            const auto want = static_cast<std::int8_t>(origin(g) != origin(h) ? turn[t] : -turn[t]);
            if (turn[g / 3] == 0) {
              turn[g / 3] = want;
              stack.push_back(g / 3);
            } else if (turn[g / 3] != want) {
              return wrong("the surface cannot be oriented", origin(h));
            }
          }
      }
    }
    for (std::size_t t = 0; t < turn.size(); ++t)
      if (turn[t] < 0) std::swap(surface_.triangles[t][1], surface_.triangles[t][2]);
    // One fan per point: as many triangles as a walk around it meets.
    std::vector<std::uint32_t> count(surface_.points.size(), 0), open(surface_.points.size(), 0);
    for (const Triangle& t : surface_.triangles)
      for (const std::uint32_t p : t) ++count[p];
    const EdgeTable turned = build_edge_table(surface_.points.size(), surface_.triangles);
    std::vector<char> is_done(surface_.points.size(), 0);
    for (std::uint32_t e = 0; e < turned.edge_count(); ++e)
      if (turned.around(e).size() == 1)
        for (const std::uint32_t p : turned.edges[e])
          if (++open[p] > 2) return wrong("the border of the surface meets itself", p);
    for (std::uint32_t h = 0; h < 3 * surface_.triangles.size(); ++h) {
      const std::uint32_t p = surface_.triangles[h / 3][h % 3];
      if (is_done[p] || (open[p] > 0 && turned.around(turned.edge_of[h]).size() == 2)) continue;
      is_done[p] = 1;
      std::uint32_t met = 0;
      for (std::uint32_t at = h; at != no_index && met <= count[p];) {
        ++met;
        const std::uint32_t incoming = at % 3 == 0 ? at + 2 : at - 1;
        const auto around = turned.around(turned.edge_of[incoming]);
        at = around.size() == 2 ? (around[0] == incoming ? around[1] : around[0]) : no_index;
        if (at == h) break;
      }
      if (met != count[p]) return wrong("two parts of the surface touch in a point", p);
    }
    return std::nullopt;
  }

  Vec3 normal(std::uint32_t t) const {
    const Triangle& c = surface_.triangles[t];
    const Vec3 n = cross(surface_.points[c[1]] - surface_.points[c[0]], surface_.points[c[2]] - surface_.points[c[0]]);
    return (1 / length(n)) * n;
  }

  std::uint32_t feature(const std::string& name, Role role) {
    for (std::uint32_t f = 0; f < result_.features.size(); ++f)
      if (result_.features[f].name == name) return f;
    result_.features.push_back({name, role, 0, -1});
    return static_cast<std::uint32_t>(result_.features.size() - 1);
  }

  void find_features() {
    const EdgeTable table = build_edge_table(surface_.points.size(), surface_.triangles);
    const double cosine = std::cos(options_.feature_deg * std::numbers::pi / 180);
    std::vector<std::vector<std::uint32_t>> features(table.edge_count());
    const auto add = [&](std::uint32_t e, std::uint32_t f) {
      if (std::find(features[e].begin(), features[e].end(), f) == features[e].end()) features[e].push_back(f);
    };
    for (const NamedEdge& named : surface_.edges) {
      const std::uint32_t e = find_edge(table, named.a, named.b);
      const auto& [name, role] = surface_.edge_names[named.name];
      if (e != no_index) add(e, feature(name, role));
    }
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
      const auto around = table.around(e);
      const std::uint32_t one = surface_.label[around[0] / 3];
      if (around.size() == 1) {
        if (features[e].empty()) add(e, feature("border of " + surface_.names[one], Role::outline));
        continue;
      }
      const std::uint32_t two = surface_.label[around[1] / 3];
      if (options_.by_label && one != two && features[e].empty())
        add(e, feature(surface_.names[std::min(one, two)] + " | " + surface_.names[std::max(one, two)], Role::curve));
      if (features[e].empty() && dot(normal(around[0] / 3), normal(around[1] / 3)) < cosine)
        add(e, feature("sharp edges", Role::curve));
    }
    for (std::uint32_t e = 0; e < table.edge_count(); ++e)
      for (const std::uint32_t f : features[e]) result_.edges.push_back({table.edges[e][0], table.edges[e][1], f});
  }

  /// Halves edges that are the longest of all their triangles, while they are too long.
  std::optional<Failure> refine() {
    const double limit_m = options_.triangle_ratio * edge_length_m_;
    double area = 0;
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      const Triangle& c = surface_.triangles[t];
      area += 0.5 * length(cross(surface_.points[c[1]] - surface_.points[c[0]],
                                 surface_.points[c[2]] - surface_.points[c[0]]));
    }
    constexpr double triangle_limit = 2e7;
    if (!(8 * area / (limit_m * limit_m) < triangle_limit))
      return Failure{FailureCode::invalid_options, "the edge length would make more than 20 million triangles",
                     "choose a larger edge length"};
    for (bool any = true; any;) {
      any = false;
      const EdgeTable table = build_edge_table(surface_.points.size(), surface_.triangles);
      std::vector<double> size(table.edge_count());
      for (std::uint32_t e = 0; e < table.edge_count(); ++e)
        size[e] = length(surface_.points[table.edges[e][0]] - surface_.points[table.edges[e][1]]);
      const auto longest = [&](std::uint32_t t) {
        std::uint32_t best = table.edge_of[3 * t];
        for (std::uint32_t h = 3 * t + 1; h < 3 * t + 3; ++h) {
          const std::uint32_t e = table.edge_of[h];
          if (size[e] > size[best] || (size[e] == size[best] && e < best)) best = e;
        }
        return best;
      };
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
      for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
        const auto around = table.around(e);
        if (!(size[e] > limit_m) ||
            !std::all_of(around.begin(), around.end(), [&](std::uint32_t h) { return longest(h / 3) == e; }))
          continue;
        const auto m = static_cast<std::uint32_t>(surface_.points.size());
        surface_.points.push_back(0.5 * (surface_.points[table.edges[e][0]] + surface_.points[table.edges[e][1]]));
        middle[{table.edges[e][0], table.edges[e][1]}] = m;
        for (const std::uint32_t h : around) {
          const std::uint32_t t = h / 3, k = h % 3;
          const Triangle c = surface_.triangles[t];
          surface_.triangles[t][(k + 1) % 3] = m;
          surface_.triangles.push_back({m, c[(k + 1) % 3], c[(k + 2) % 3]});
          surface_.label.push_back(surface_.label[t]);
        }
        any = true;
      }
      const std::size_t count = result_.edges.size();
      for (std::size_t i = 0; i < count; ++i) {
        FeatureEdge& e = result_.edges[i];
        const auto at = middle.find({e.a, e.b});
        if (at == middle.end()) continue;
        const FeatureEdge far{e.b, at->second, e.feature};
        e.b = at->second;
        result_.edges.push_back(far);
      }
    }
    return std::nullopt;
  }

  void find_corners() {
    // Per point: its feature edges, each once, with the other end and the features there.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> features_of;
    for (const FeatureEdge& e : result_.edges) features_of[{e.a, e.b}].push_back(e.feature);
    struct Arm {
      std::uint32_t other;
      const std::vector<std::uint32_t>* features;
    };
    std::map<std::uint32_t, std::vector<Arm>> arms;
    for (auto& [ends, features] : features_of) {
      std::sort(features.begin(), features.end());
      arms[ends.first].push_back({ends.second, &features});
      arms[ends.second].push_back({ends.first, &features});
    }
    const double cosine = std::cos(options_.corner_deg * std::numbers::pi / 180);
    result_.corners = surface_.corners;
    for (const auto& [p, around] : arms) {
      bool is_corner = around.size() != 2;
      if (!is_corner) {
        const Vec3 u = surface_.points[p] - surface_.points[around[0].other];
        const Vec3 v = surface_.points[around[1].other] - surface_.points[p];
        is_corner = *around[0].features != *around[1].features || dot(u, v) < cosine * length(u) * length(v);
      }
      if (is_corner) result_.corners.push_back(p);
    }
    std::sort(result_.corners.begin(), result_.corners.end());
    result_.corners.erase(std::unique(result_.corners.begin(), result_.corners.end()), result_.corners.end());
  }

  LabelledSurface surface_;
  const SurfaceFeatureOptions& options_;
  double edge_length_m_ = 0;
  FeatureMesh result_;
};

/// Identical points become one; unused ones are dropped.
void weld(LabelledSurface& surface) {
  const WeldedPoints welded = weld_points(surface.points);
  std::vector<std::uint32_t> number(welded.source.size(), no_index);
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t p : t) number[welded.id[p]] = 0;
  std::vector<Vec3> kept;
  for (std::uint32_t id = 0; id < number.size(); ++id) {
    if (number[id] == no_index) continue;
    number[id] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(surface.points[welded.source[id]]);
  }
  const auto renumber = [&](std::uint32_t& p) { p = number[welded.id[p]]; };
  for (Triangle& t : surface.triangles)
    for (std::uint32_t& p : t) renumber(p);
  for (NamedEdge& e : surface.edges) {
    renumber(e.a);
    renumber(e.b);
  }
  std::erase_if(surface.edges, [](const NamedEdge& e) { return e.a == no_index || e.b == no_index; });
  for (std::uint32_t& p : surface.corners) renumber(p);
  std::erase(surface.corners, no_index);
  surface.points = std::move(kept);
}

/// Where pieces of a surface touch at a point only (two faults that cut a horizon meet there), each gets its own.
void separate_fans(LabelledSurface& surface) {
  std::vector<std::uint32_t> fan(3 * surface.triangles.size());  // per corner, the least corner of its fan in the end
  std::iota(fan.begin(), fan.end(), 0u);
  const auto least = [&](std::uint32_t c) {
    while (fan[c] != c) c = fan[c] = fan[fan[c]];
    return c;
  };
  const auto corner_at = [&](std::uint32_t t, std::uint32_t p) {
    const Triangle& c = surface.triangles[t];
    return 3 * t + static_cast<std::uint32_t>(std::find(c.begin(), c.end(), p) - c.begin());
  };
  const EdgeTable table = build_edge_table(surface.points.size(), surface.triangles);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
    const auto around = table.around(e);
    if (around.size() != 2) continue;
    for (const std::uint32_t p : table.edges[e]) {
      const std::uint32_t a = least(corner_at(around[0] / 3, p)), b = least(corner_at(around[1] / 3, p));
      fan[std::max(a, b)] = std::min(a, b);
    }
  }
  const std::size_t before = surface.points.size();
  std::vector<std::uint32_t> first_fan(before, no_index), of_copy;
  std::map<std::uint32_t, std::uint32_t> copy;  // fan → point
  const std::vector<Triangle> was = surface.triangles;
  for (std::uint32_t c = 0; c < fan.size(); ++c) {
    const std::uint32_t p = was[c / 3][c % 3], f = least(c);
    if (first_fan[p] == no_index) first_fan[p] = f;
    if (first_fan[p] == f) continue;
    const auto [found, is_new] = copy.try_emplace(f, static_cast<std::uint32_t>(surface.points.size()));
    if (is_new) {
      surface.points.push_back(surface.points[p]);
      of_copy.push_back(p);
    }
    surface.triangles[c / 3][c % 3] = found->second;
  }
  if (of_copy.empty()) return;
  // Named edges and corners follow to every triangle that had them.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> names;
  for (const NamedEdge& e : surface.edges) names[std::minmax(e.a, e.b)].push_back(e.name);
  surface.edges.clear();
  for (std::size_t t = 0; t < was.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto found = names.find(std::minmax(was[t][k], was[t][(k + 1) % 3])); found != names.end())
        for (const std::uint32_t name : found->second)
          surface.edges.push_back({surface.triangles[t][k], surface.triangles[t][(k + 1) % 3], name});
  for (NamedEdge& e : surface.edges)
    if (e.a > e.b) std::swap(e.a, e.b);
  const auto key = [](const NamedEdge& e) { return std::tie(e.name, e.a, e.b); };
  std::sort(surface.edges.begin(), surface.edges.end(),
            [&](const NamedEdge& x, const NamedEdge& y) { return key(x) < key(y); });
  surface.edges.erase(std::unique(surface.edges.begin(), surface.edges.end(),
                                  [&](const NamedEdge& x, const NamedEdge& y) { return key(x) == key(y); }),
                      surface.edges.end());
  const std::vector<std::uint32_t> corners = surface.corners;
  for (std::size_t i = 0; i < of_copy.size(); ++i)
    if (std::find(corners.begin(), corners.end(), of_copy[i]) != corners.end())
      surface.corners.push_back(static_cast<std::uint32_t>(before + i));
}

}  // namespace

Result<FeatureMesh> feature_mesh_of_surface(const TriangleSoup& soup, const SurfaceFeatureOptions& options) {
  LabelledSurface surface;
  surface.local_origin = soup.local_origin;
  surface.points = soup.points;
  surface.triangles = soup.triangles;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    surface.label.push_back(soup.triangle_patch.empty() ? 0 : soup.patch_entity[soup.triangle_patch[t]]);
  for (const Entity& entity : soup.entities) surface.names.push_back(entity.name);
  if (surface.names.empty()) surface.names.push_back("surface");
  weld(surface);
  return SurfaceFeatures(std::move(surface), options).run();
}

Result<FeatureMesh> feature_mesh_of_model(const StructuralModel& model, std::span<const std::uint32_t> surfaces,
                                          const SurfaceFeatureOptions& options) {
  LabelledSurface surface;
  surface.local_origin = model.local_origin;
  surface.points = model.points;
  for (const Entity& entity : model.entities) surface.names.push_back(entity.name);
  for (const std::uint32_t s : surfaces) {
    if (s >= model.surfaces.size())
      return Failure{FailureCode::invalid_usage, "the model has no surface " + std::to_string(s), "name one it has"};
    for (std::uint32_t t = model.surfaces[s].first_triangle; t < model.surfaces[s].end_triangle; ++t) {
      surface.triangles.push_back(model.triangles[t]);
      surface.label.push_back(model.surfaces[s].entity);
    }
  }
  for (std::uint32_t l = 0; l < model.lines.size(); ++l) {
    const Line& line = model.lines[l];
    std::string name;
    std::vector<std::uint32_t> named;
    Role role = Role::curve;
    for (const std::uint32_t s : line.surfaces) {
      const std::uint32_t entity = model.surfaces[s].entity;
      if (std::find(named.begin(), named.end(), entity) != named.end()) continue;
      named.push_back(entity);
      name += (name.empty() ? "" : " | ") + model.entities[entity].name;
      if (model.entities[entity].role == Role::fault) role = Role::fault;
    }
    surface.edge_names.emplace_back(name, role);
    const std::size_t count = line.vertices.size();
    for (std::size_t i = 0; i + (line.is_closed() ? 0 : 1) < count; ++i)
      surface.edges.push_back({line.vertices[i], line.vertices[(i + 1) % count], l});
  }
  for (const Corner& corner : model.corners) surface.corners.push_back(corner.vertex);
  weld(surface);
  separate_fans(surface);
  return SurfaceFeatures(std::move(surface), options).run();
}

}  // namespace strataflow
