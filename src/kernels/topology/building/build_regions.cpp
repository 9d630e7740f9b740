#include "kernels/topology/building/build_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/topology/building/radial_order.h"
#include "kernels/topology/building/shell_containment.h"
#include "kernels/topology/union_find.h"

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
  for (const SurfaceSide side : closed_shell_of(frontier.sides)) {  // both sides of a surface cancel exactly
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
    for (std::uint32_t t = model.surfaces[side.surface].first_triangle; t < model.surfaces[side.surface].end_triangle;
         ++t)
      for (const std::uint32_t v : model.triangles[t]) box.take(model.points[v]);
  return box;
}

bool contains(const Box3& outer, const Box3& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
         outer.high.x >= inner.high.x && outer.high.y >= inner.high.y && outer.high.z >= inner.high.z;
}

/// Asked of the interior of the frontier's triangles, in order, until one is not on the shell itself: its vertices may
/// all be.
bool lies_inside(const StructuralModel& model, const Frontier& inner, const Frontier& shell) {
  const std::vector<SurfaceSide> closed_shell = closed_shell_of(shell.sides);
  for (const SurfaceSide side : inner.sides)
    for (std::uint32_t t = model.surfaces[side.surface].first_triangle; t < model.surfaces[side.surface].end_triangle;
         ++t) {
      const auto [a, b, c] = model.triangles[t];
      const int place =
          place_in_shell(model, closed_shell, std::array{model.points[a], model.points[b], model.points[c]});
      if (place != 0) return place > 0;
    }
  return false;
}

/// What nesting needs to know of every frontier.
struct FrontierExtent {
  Box3 box;
  std::uint32_t body;  ///< surfaces joined by lines form one; its sides face the outside of its own shells
  bool is_undecided;   ///< it has a surface on a line whose order is unknown: sides may be missing or too many
};

/// Cavities and dangling pieces go to the innermost region around them (euler1999 §2.2.4 step 3 and its traps).
void nest_internal_frontiers(StructuralModel& model, const std::vector<FrontierExtent>& extents) {
  const auto owners = parallel_map(model.frontiers.size(), [&](std::size_t f) {
    const Frontier& inner = model.frontiers[f];
    std::uint32_t best = universe;
    if (inner.volume_sign > 0) return best;
    for (std::uint32_t r = 0; r < model.regions.size(); ++r) {
      const FrontierExtent& around = extents[model.regions[r].external_frontier];
      const Frontier& shell = model.frontiers[model.regions[r].external_frontier];
      if (around.body == extents[f].body) continue;
      if (best != universe &&
          model.frontiers[model.regions[best].external_frontier].signed_volume_m3 <= shell.signed_volume_m3)
        continue;
      if (contains(around.box, extents[f].box) && lies_inside(model, inner, shell)) best = r;
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

/// A region is not known when its shell is undecided, or when an undecided frontier may lie in it.
void forget_undecided_volumes(StructuralModel& model, const std::vector<FrontierExtent>& extents) {
  for (Region& region : model.regions) {
    const FrontierExtent& shell = extents[region.external_frontier];
    const bool is_unknown = std::any_of(extents.begin(), extents.end(), [&](const FrontierExtent& other) {
      return other.is_undecided && (&other == &shell || (other.body != shell.body && contains(shell.box, other.box)));
    });
    if (is_unknown) region.volume_m3 = std::numeric_limits<double>::quiet_NaN();
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
  std::vector<char> is_undecided(model.surfaces.size(), 0);
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
    const bool is_unsorted = links[line].ambiguous_edges == line_edges[line].size();
    if (is_unsorted)
      report("unsorted_contact", links[line].ambiguous_edges, "the order of the surfaces around it cannot be told");
    if (links[line].disagreeing_edges > 0)
      report("radial_order_changes", links[line].disagreeing_edges, "the order of the surfaces around it changes");
    if (is_unsorted || links[line].disagreeing_edges > 0)
      for (const std::uint32_t s : model.lines[line].surfaces) is_undecided[s] = 1;
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
  std::vector<FrontierExtent> extents;
  for (const Frontier& frontier : model.frontiers)
    extents.push_back({box_of(model, frontier), body.find(frontier.sides[0].surface),
                       std::any_of(frontier.sides.begin(), frontier.sides.end(),
                                   [&](const SurfaceSide side) { return is_undecided[side.surface] != 0; })});
  nest_internal_frontiers(model, extents);
  forget_undecided_volumes(model, extents);
  for (const Frontier& frontier : model.frontiers)
    for (const SurfaceSide side : frontier.sides)
      (side.is_positive ? model.surfaces[side.surface].region_plus : model.surfaces[side.surface].region_minus) =
          frontier.region;
  return violations;
}

}  // namespace strataflow
