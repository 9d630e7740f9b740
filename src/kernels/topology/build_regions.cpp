#include "kernels/topology/build_regions.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/topology/radial_order.h"
#include "kernels/topology/shell_containment.h"
#include "kernels/topology/union_find.h"
#include "base/id.h"

namespace strataflow {

namespace {

using Fan = std::vector<SurfaceSide>;  ///< around an edge: surface and whether its positive side faces rising angles

/// The cyclic order seen from the other end of the edge.
Fan reversed(const Fan& fan) {
  Fan out(fan.rbegin(), fan.rend());
  for (SurfaceSide& leaf : out) leaf.is_positive ^= 1;
  return out;
}

/// The rotation that comes first in lexicographic order: equal cyclic orders become equal sequences.
Fan rotated_to_least(const Fan& fan) {
  Fan best = fan;
  Fan turned = fan;
  for (std::size_t i = 1; i < fan.size(); ++i) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    best = std::min(best, turned);
  }
  return best;
}

struct LineLinks {
  std::vector<std::array<std::uint32_t, 2>> pairs;  ///< side ids (2·surface + positive) that look at each other
  std::uint32_t ambiguous_edges = 0;
  std::uint32_t disagreeing_edges = 0;
  std::uint32_t edge = no_index;  ///< one edge at fault
};

/// Sorts the triangles around every edge of a line. All edges of a line must show one cyclic order (rule A14).
LineLinks link_line(const StructuralModel& model, const EdgeTable& edges, const Line& line,
                    const std::vector<std::uint32_t>& along) {
  LineLinks links;
  Fan expected;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const auto around = edges.around(along[i]);
    const RadialOrder order = radial_order(model.points, model.triangles, around);
    if (order.is_ambiguous) {
      ++links.ambiguous_edges;
      links.edge = along[i];
      continue;
    }
    Fan fan;
    for (const std::uint32_t h : order.half_edges) {
      const Triangle& t = model.triangles[h / 3];
      const bool upward = t[h % 3] < t[(h % 3 + 1) % 3];
      fan.push_back({model.triangle_surface[h / 3], upward});
    }
    for (std::size_t k = 0; k < fan.size(); ++k) {
      const SurfaceSide &leaf = fan[k], &next = fan[(k + 1) % fan.size()];
      links.pairs.push_back({2 * leaf.surface + leaf.is_positive, 2 * next.surface + (next.is_positive ^ 1)});
    }
    if (edges.edges[along[i]][0] != line.vertices[i]) fan = reversed(fan);
    fan = rotated_to_least(fan);
    if (expected.empty()) expected = fan;
    if (fan != expected) {
      ++links.disagreeing_edges;
      links.edge = along[i];
    }
  }
  std::sort(links.pairs.begin(), links.pairs.end());
  links.pairs.erase(std::unique(links.pairs.begin(), links.pairs.end()), links.pairs.end());
  return links;
}

/// Σ a·(b×c)/6 over a surface, about `centre`, with compensated summation, and a bound on its error.
struct VolumeIntegral {
  double value = 0;
  double error_bound = 0;
};

VolumeIntegral integral_of(const StructuralModel& model, const Surface& surface, const Vec3& centre) {
  double sum = 0, compensation = 0, magnitude = 0;
  for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
    const Vec3 a = model.points[model.triangles[t][0]] - centre;
    const Vec3 b = model.points[model.triangles[t][1]] - centre;
    const Vec3 c = model.points[model.triangles[t][2]] - centre;
    const double term = dot(a, cross(b, c));
    const double next = sum + term;
    compensation += std::abs(sum) >= std::abs(term) ? (sum - next) + term : (term - next) + sum;
    sum = next;
    magnitude += length(a) * length(b) * length(c);
  }
  return {(sum + compensation) / 6, 32 * 0x1.0p-53 * magnitude / 6};
}

int exact_volume_sign(const StructuralModel& model, const Frontier& frontier) {
  std::vector<Triangle> outward;
  for (std::size_t i = 0; i < frontier.sides.size(); ++i) {
    const SurfaceSide side = frontier.sides[i];
    const bool both = (i > 0 && frontier.sides[i - 1].surface == side.surface) ||
                      (i + 1 < frontier.sides.size() && frontier.sides[i + 1].surface == side.surface);
    if (both) continue;  // the two sides cancel exactly
    const Surface& surface = model.surfaces[side.surface];
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
      const Triangle& v = model.triangles[t];
      outward.push_back(side.is_positive ? Triangle{v[0], v[2], v[1]} : v);
    }
  }
  return outward.empty() ? 0 : exact::signed_volume_sign(model.points, outward);
}

void build_frontiers(StructuralModel& model, UnionFind& linked) {
  const auto side_count = static_cast<std::uint32_t>(2 * model.surfaces.size());
  std::vector<std::uint32_t> frontier_of(side_count, no_index);
  for (std::uint32_t side = 0; side < side_count; ++side) {
    const std::uint32_t root = linked.find(side);
    if (frontier_of[root] == no_index) {
      frontier_of[root] = static_cast<std::uint32_t>(model.frontiers.size());
      model.frontiers.emplace_back();
    }
    model.frontiers[frontier_of[root]].sides.push_back({side / 2, side % 2});
  }
  const Vec3 centre = model.box.centre();
  const auto integrals =
      parallel_map(model.surfaces.size(), [&](std::size_t s) { return integral_of(model, model.surfaces[s], centre); });
  for (Frontier& frontier : model.frontiers) {
    double volume = 0, bound = 0;
    for (const SurfaceSide side : frontier.sides) {
      volume += side.is_positive ? -integrals[side.surface].value : integrals[side.surface].value;
      bound += integrals[side.surface].error_bound;
    }
    frontier.signed_volume_m3 = volume;
    frontier.volume_sign = std::abs(volume) > bound ? (volume > 0 ? 1 : -1) : exact_volume_sign(model, frontier);
    if (frontier.volume_sign == 0) frontier.signed_volume_m3 = 0;
  }
}

Box3 box_of(const StructuralModel& model, const Frontier& frontier) {
  Box3 box;
  for (const SurfaceSide side : frontier.sides)
    for (std::uint32_t t = model.surfaces[side.surface].first_triangle; t < model.surfaces[side.surface].end_triangle; ++t)
      for (const std::uint32_t v : model.triangles[t]) box.take(model.points[v]);
  return box;
}

/// +1 inside, −1 outside: asked of the frontier's points, lowest first, until one is not on the shell itself.
bool lies_inside(const StructuralModel& model, const Frontier& inner, const Frontier& shell) {
  std::vector<std::uint32_t> vertices;
  for (const SurfaceSide side : inner.sides)
    for (std::uint32_t t = model.surfaces[side.surface].first_triangle; t < model.surfaces[side.surface].end_triangle; ++t)
      vertices.insert(vertices.end(), model.triangles[t].begin(), model.triangles[t].end());
  std::sort(vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
    return model.points[a].z != model.points[b].z ? model.points[a].z < model.points[b].z : a < b;
  });
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const std::uint32_t v : vertices) {
    const int place = place_in_shell(model, shell.sides, model.points[v]);
    if (place != 0) return place > 0;
  }
  return false;
}

/// Cavities and dangling pieces go to the innermost region around them (euler1999 §2.2.4 step 3 and its traps).
void nest_internal_frontiers(StructuralModel& model, const std::vector<std::uint32_t>& body_of) {
  std::vector<Box3> boxes(model.frontiers.size());
  for (std::size_t f = 0; f < model.frontiers.size(); ++f) boxes[f] = box_of(model, model.frontiers[f]);
  const auto contains = [](const Box3& outer, const Box3& inner) {
    return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
           outer.high.x >= inner.high.x && outer.high.y >= inner.high.y && outer.high.z >= inner.high.z;
  };
  const auto owners = parallel_map(model.frontiers.size(), [&](std::size_t f) {
    const Frontier& inner = model.frontiers[f];
    std::uint32_t best = universe;
    if (inner.volume_sign > 0) return best;
    for (std::uint32_t r = 0; r < model.regions.size(); ++r) {
      const Frontier& shell = model.frontiers[model.regions[r].external_frontier];
      // The sides of one connected body face the outside of its own shells.
      if (body_of[inner.sides[0].surface] == body_of[shell.sides[0].surface]) continue;
      if (best != universe && model.frontiers[model.regions[best].external_frontier].signed_volume_m3 <= shell.signed_volume_m3)
        continue;
      if (!contains(boxes[model.regions[r].external_frontier], boxes[f]) || !lies_inside(model, inner, shell)) continue;
      best = r;
    }
    return best;
  });
  for (std::uint32_t f = 0; f < model.frontiers.size(); ++f) {
    Frontier& frontier = model.frontiers[f];
    if (frontier.volume_sign > 0) continue;
    frontier.region = owners[f];
    if (owners[f] == universe) continue;
    Region& region = model.regions[owners[f]];
    region.internal_frontiers.push_back(f);
    region.volume_m3 += frontier.signed_volume_m3;  // cavities count negative
  }
}

}  // namespace

std::vector<Violation> build_regions(StructuralModel& model, const EdgeTable& edges,
                                     const std::vector<std::vector<std::uint32_t>>& line_edges) {
  std::vector<Violation> violations;
  const auto links = parallel_map(model.lines.size(), [&](std::size_t line) {
    return link_line(model, edges, model.lines[line], line_edges[line]);
  });
  UnionFind linked(2 * model.surfaces.size());
  UnionFind body(model.surfaces.size());
  for (std::size_t line = 0; line < links.size(); ++line) {
    for (const auto& [a, b] : links[line].pairs) linked.unite(a, b);
    for (const std::uint32_t s : model.lines[line].surfaces) body.unite(s, model.lines[line].surfaces[0]);
    const auto report = [&](const char* kind, std::uint32_t count, const std::string& text) {
      violations.push_back({kind, Violation::Severity::error,
                            "line " + std::to_string(line) + ": " + text + " on " + std::to_string(count) + " of " +
                                std::to_string(line_edges[line].size()) + " edges",
                            "look for triangles that coincide, have no area or cross there",
                            model.points[edges.edges[links[line].edge][0]], count});
    };
    if (links[line].ambiguous_edges == line_edges[line].size())
      report("unsorted_contact", links[line].ambiguous_edges, "the order of the surfaces around it cannot be told");
    if (links[line].disagreeing_edges > 0)
      report("radial_order_changes", links[line].disagreeing_edges, "the order of the surfaces around it changes");
  }
  build_frontiers(model, linked);
  for (std::uint32_t f = 0; f < model.frontiers.size(); ++f) {
    if (model.frontiers[f].volume_sign <= 0) continue;
    model.frontiers[f].region = static_cast<std::uint32_t>(model.regions.size());
    Region region;
    region.external_frontier = f;
    region.volume_m3 = model.frontiers[f].signed_volume_m3;
    model.regions.push_back(std::move(region));
  }
  std::vector<std::uint32_t> body_of(model.surfaces.size());
  for (std::uint32_t s = 0; s < body_of.size(); ++s) body_of[s] = body.find(s);
  nest_internal_frontiers(model, body_of);
  for (const Frontier& frontier : model.frontiers)
    for (const SurfaceSide side : frontier.sides)
      (side.is_positive ? model.surfaces[side.surface].region_plus : model.surfaces[side.surface].region_minus) =
          frontier.region;
  return violations;
}

}  // namespace strataflow
