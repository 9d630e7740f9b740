#include "kernels/topology/validity/check_validity.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {

namespace {

using Severity = Violation::Severity;

std::string name_of(const StructuralModel& model, std::uint32_t surface) {
  return "'" + model.entities[model.surfaces[surface].entity].name + "'";
}

/// Improper meetings, gathered per pair of entities and kind.
struct EntityMeeting {
  std::uint32_t first, second;
  PairMeeting meeting;
  std::uint32_t triangle;
};

/// Counts pairs of input triangles: where the model's triangle stands for several identical ones, each of these.
void report_intersections(const BuiltModel& built, ValidityReport& report) {
  const StructuralModel& model = built.model;
  const auto entities_of = [&](std::uint32_t t, std::vector<std::uint32_t>& entities) {
    entities.clear();
    const auto is_before = [](const TriangleCopy& copy, std::uint32_t triangle) { return copy.triangle < triangle; };
    for (auto copy = std::lower_bound(built.copies.begin(), built.copies.end(), t, is_before);
         copy != built.copies.end() && copy->triangle == t; ++copy)
      entities.push_back(copy->entity);
    if (entities.empty()) entities.push_back(model.surfaces[model.triangle_surface[t]].entity);
  };
  const std::vector<IntersectingPair> pairs = find_intersections(model.points, model.triangles);
  std::vector<EntityMeeting> meetings;
  meetings.reserve(pairs.size());
  std::vector<std::uint32_t> first_entities, second_entities;
  for (const IntersectingPair& pair : pairs) {
    entities_of(pair.first, first_entities);
    entities_of(pair.second, second_entities);
    for (const std::uint32_t a : first_entities)
      for (const std::uint32_t b : second_entities) {
        report.self_intersecting_pairs += a == b;
        meetings.push_back({std::min(a, b), std::max(a, b), pair.meeting, pair.first});
      }
  }
  for (std::size_t i = 0; i < built.copies.size(); ++i)
    for (std::size_t j = i; j-- > 0 && built.copies[j].triangle == built.copies[i].triangle;) {
      ++report.identical_triangle_pairs;
      report.self_intersecting_pairs += built.copies[i].entity == built.copies[j].entity;
    }
  report.intersecting_triangle_pairs = meetings.size() + report.identical_triangle_pairs;
  sort_total_order(meetings, [](const EntityMeeting& x, const EntityMeeting& y) {
    if (x.first != y.first) return x.first < y.first;
    if (x.second != y.second) return x.second < y.second;
    if (x.meeting != y.meeting) return x.meeting < y.meeting;
    return x.triangle < y.triangle;
  });
  for (std::size_t begin = 0; begin < meetings.size();) {
    const EntityMeeting& m = meetings[begin];
    std::size_t end = begin;
    while (end < meetings.size() && meetings[end].first == m.first && meetings[end].second == m.second &&
           meetings[end].meeting == m.meeting)
      ++end;
    const std::string count = std::to_string(end - begin);
    const std::string first = "'" + model.entities[m.first].name + "'",
                      second = "'" + model.entities[m.second].name + "'";
    const std::string names = m.first == m.second ? first + " with itself" : first + " and " + second;
    const Vec3 where = model.points[model.triangles[m.triangle][0]];
    if (m.meeting == PairMeeting::touching)
      report.violations.push_back(
          {"non_conforming_contact", Severity::error,
           names + ": " + count + " pairs of triangles touch without sharing vertices",
           "cut the surfaces against each other so that both have the same vertices along the contact", where,
           end - begin});
    else
      report.violations.push_back({"improper_intersection", Severity::error,
                                   names + ": " + count + " pairs of triangles cross",
                                   "cut the surfaces against each other", where, end - begin});
    begin = end;
  }
}

void report_degenerate(const StructuralModel& model, ValidityReport& report) {
  const std::vector<char> flat = parallel_map(
      model.triangles.size(),
      [&](std::size_t t) { return static_cast<char>(is_degenerate(model.points, model.triangles[t])); }, 16384);
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    std::uint64_t count = 0;
    std::uint32_t first = 0;
    for (std::uint32_t t = model.surfaces[s].first_triangle; t < model.surfaces[s].end_triangle; ++t)
      if (flat[t] && count++ == 0) first = t;
    if (count > 0)
      report.violations.push_back(
          {"degenerate_triangle", Severity::error,
           "surface " + name_of(model, s) + ": " + std::to_string(count) + " triangles have no area",
           "remesh the surface there", model.points[model.triangles[first][0]], count});
  }
}

void report_shell(const StructuralModel& model, ValidityReport& report) {
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    if (!surface.is_dangling()) continue;
    std::uint64_t free_edges = 0;
    Vec3 where = model.points[model.triangles[surface.first_triangle][0]];
    for (const std::uint32_t l : surface.lines)
      if (model.lines[l].is_free_border()) {
        const Line& line = model.lines[l];
        if (free_edges == 0) where = model.points[line.vertices[0]];
        free_edges += line.is_closed() ? line.vertices.size() : line.vertices.size() - 1;
      }
    const std::string label = "surface " + std::to_string(s) + " of " + name_of(model, s);
    if (surface.region_plus != universe) {
      report.violations.push_back({"dangling_surface", Severity::warning,
                                   label + " ends inside region '" + model.regions[surface.region_plus].name + "' (" +
                                       std::to_string(free_edges) + " free edges)",
                                   "nothing, if it is meant to die out there", where, free_edges});
    } else {
      report.violations.push_back(
          {"open_shell", Severity::error,
           label + " has the outside on both of its sides (" + std::to_string(free_edges) + " free edges)",
           "close the boundary: its border must be shared with other surfaces, vertex for vertex", where, free_edges});
    }
  }
  if (model.regions.empty())
    report.violations.push_back({"open_shell", Severity::error, "the surfaces enclose no region",
                                 "add the boundary surfaces, or cut and seal the model", model.box.centre(), 1});
}

/// A vertex whose triangles of one surface form several fans although no line passes (rule A2, F2).
void report_pinches(const StructuralModel& model, ValidityReport& report) {
  // Triangles around each vertex, as one list with starts.
  std::vector<std::uint32_t> first(model.points.size() + 1, 0);
  for (const Triangle& t : model.triangles)
    for (const std::uint32_t v : t) ++first[v + 1];
  for (std::size_t v = 0; v < model.points.size(); ++v) first[v + 1] += first[v];
  std::vector<std::uint32_t> around(first.back()), next(first.begin(), first.end() - 1);
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t)
    for (const std::uint32_t v : model.triangles[t]) around[next[v]++] = t;
  const auto pinched = parallel_map(
      model.points.size(),
      [&](std::size_t v) {
        if (model.point_line[v] >= 0 || model.point_corner[v] >= 0 || first[v] == first[v + 1]) return char{0};
        // Walk one fan across edges at v; an inner vertex is fine when that fan holds every triangle.
        const std::uint32_t count = first[v + 1] - first[v];
        std::uint32_t visited = 0, t = around[first[v]];
        const std::uint32_t start = t;
        do {
          const Triangle& tri = model.triangles[t];
          const int k = tri[0] == v ? 0 : tri[1] == v ? 1 : 2;
          const std::uint32_t leaving = tri[(k + 1) % 3];
          std::uint32_t following = t;
          for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) {
            const Triangle& other = model.triangles[around[i]];
            const int m = other[0] == v ? 0 : other[1] == v ? 1 : 2;
            if (other[(m + 2) % 3] == leaving) following = around[i];
          }
          t = following;
          ++visited;
        } while (t != start && visited < count);
        return static_cast<char>(t != start || visited != count);
      },
      4096);
  for (std::size_t v = 0; v < pinched.size(); ++v)
    if (pinched[v])
      report.violations.push_back({"pinched_surface", Severity::warning,
                                   "surface " + name_of(model, model.triangle_surface[around[first[v]]]) +
                                       " touches itself or another surface in one vertex",
                                   "split the vertex if the surface should not be pinched there", model.points[v], 1});
}

/// Names the regions whose volumes the surfaces do not tell (rule A10).
void report_unknown_volumes(const StructuralModel& model, ValidityReport& report) {
  std::string names;
  std::uint64_t count = 0;
  for (const Region& region : model.regions)
    if (std::isnan(region.volume_m3)) names += (count++ == 0 ? "'" : ", '") + region.name + "'";
  if (count > 0)
    report.violations.push_back(
        {"unknown_volume", Severity::error,
         "extent and volume are unknown of " + names + ": the order of the surfaces around a line there is",
         "mend the lines named under unsorted_contact and radial_order_changes", model.box.centre(), count});
}

/// Region volumes add up to what the universe's frontiers enclose (rule A12), but for rounding: each is a sum of
/// tetrahedra from the box's centre, which may be far larger than the regions.
void report_volume_balance(const StructuralModel& model, ValidityReport& report) {
  double regions = 0, enclosed = 0;
  for (const Region& region : model.regions) regions += region.volume_m3;
  for (const Frontier& frontier : model.frontiers)
    if (frontier.region == universe) enclosed -= frontier.signed_volume_m3;
  if (std::isnan(regions)) return;  // unknown ones are reported on their own
  const Vec3 centre = model.box.centre();
  double summed = 0;
  for (const Triangle& t : model.triangles)
    summed += length(model.points[t[0]] - centre) * length(model.points[t[1]] - centre) *
              length(model.points[t[2]] - centre) / 6;
  if (!(std::abs(regions - enclosed) <= 1e-12 * summed))
    report.violations.push_back({"volume_imbalance", Severity::error,
                                 "the regions' volumes add up to " + std::to_string(regions) +
                                     " m3, the outer shell encloses " + std::to_string(enclosed) + " m3",
                                 "look for surfaces that cross or overlap", model.box.centre(), 1});
}

}  // namespace

ValidityReport check_validity(const BuiltModel& built) {
  ValidityReport report;
  report.violations = built.violations;
  report_degenerate(built.model, report);
  report_shell(built.model, report);
  report_pinches(built.model, report);
  report_unknown_volumes(built.model, report);
  report_volume_balance(built.model, report);
  report_intersections(built, report);
  std::stable_sort(report.violations.begin(), report.violations.end(),
                   [](const Violation& a, const Violation& b) { return a.kind < b.kind; });
  return report;
}

bool is_sealed(const StructuralModel& model, const ValidityReport& report) {
  return model.is_sealed && report.intersecting_triangle_pairs == report.identical_triangle_pairs;
}

}  // namespace strataflow
