#include "kernels/sealing/find_leaks.h"

#include <algorithm>

#include "base/id.h"
#include "base/internal_error.h"
#include "base/option_field.h"
#include "kernels/contacts/find_contacts.h"
#include "kernels/sealing/extend_borders.h"
#include "kernels/sealing/welded_soup.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

std::vector<Leak> find_leaks(const TriangleSoup& soup, double sealing_distance_m, double search_distance_m) {
  const FoundContacts contacts = find_contacts(soup, {.distance_m = search_distance_m});
  const WeldedSoup mesh(soup);
  const EdgeTable edges = build_edge_table(mesh.points.size(), mesh.triangles);
  std::vector<Leak> leaks;
  for (std::size_t i = 0; i < contacts.gaps.size(); ++i) {
    const BorderOnSurface& border = contacts.constraints.borders[i];
    const ContactGap& gap = contacts.gaps[i];
    // Faults may die where they are.
    const double most = gap.overshoots ? sealing_distance_m : 0.3 * search_distance_m;
    if (soup.entities[border.entity].role == Role::fault && gap.max_gap_m > most) continue;
    std::size_t free = 0, count = 0;
    for (std::size_t k = 0; k + 1 < border.points.size(); ++k) {
      const std::uint32_t e = find_edge(edges, mesh.id[border.points[k]], mesh.id[border.points[k + 1]]);
      ++count;
      if (e != no_index && edges.around(e).size() == 1) ++free;
    }
    if (2 * free <= count) continue;
    leaks.push_back({border.entity, border.controller, gap.max_gap_m, describe(soup, border, gap)});
  }
  // Horizons do not die inside: even a short free border of theirs, beside a surface, parts nothing where it should.
  const Result<std::vector<BorderGap>> gaps = find_gaps(soup, {.distance_m = sealing_distance_m});
  STRATAFLOW_ASSERT(static_cast<bool>(gaps), "gaps without named contacts cannot be asked for wrongly");
  for (const BorderGap& gap : *gaps) {
    const Role role = soup.entities[gap.entity].role;
    const bool is_named = std::any_of(leaks.begin(), leaks.end(), [&](const Leak& leak) {
      return leak.entity == gap.entity && leak.onto == gap.onto;
    });
    if (is_named || (role != Role::horizon && role != Role::unconformity)) continue;
    const Vec3 where = gap.where + soup.local_origin;
    leaks.push_back({gap.entity, gap.onto, gap.largest_m,
                     soup.entities[gap.entity].name + " stops up to " + OptionPrinter::literal(gap.largest_m) +
                         " m short of " + soup.entities[gap.onto].name + " along " + std::to_string(gap.edge_count) +
                         " border edges near (" + OptionPrinter::literal(where.x) + ", " +
                         OptionPrinter::literal(where.y) + ", " + OptionPrinter::literal(where.z) + ")"});
  }
  return leaks;
}

std::vector<std::uint32_t> find_loose_entities(const TriangleSoup& soup) {
  const WeldedSoup mesh(soup);
  const EdgeTable edges = build_edge_table(mesh.points.size(), mesh.triangles);
  UnionFind pieces(mesh.triangles.size());
  const auto is_inner = [&](std::span<const std::uint32_t> around) {
    return around.size() == 2 && mesh.entity[around[0] / 3] == mesh.entity[around[1] / 3];
  };
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e)
    if (const auto around = edges.around(e); is_inner(around)) pieces.unite(around[0] / 3, around[1] / 3);
  std::vector<char> touches(mesh.triangles.size(), 0);
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e)
    if (const auto around = edges.around(e); around.size() > 1 && !is_inner(around))
      for (const std::uint32_t h : around) touches[pieces.find(h / 3)] = 1;
  std::vector<std::uint32_t> loose;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (pieces.find(t) == t && !touches[t]) loose.push_back(mesh.entity[t]);
  return sorted_unique(std::move(loose));
}

}  // namespace strataflow
