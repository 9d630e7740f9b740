#include "kernels/sealing/find_doubts.h"

#include <algorithm>
#include <cstdio>

#include "base/id.h"
#include "base/option_field.h"
#include "kernels/sealing/without_surfaces.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

constexpr double least_thickness_ratio = 0.08;

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

class DoubtFinder {
 public:
  DoubtFinder(const StructuralModel& model, double distance_m, const std::vector<NamedContact>& contacts)
      : model_(model), distance_m_(distance_m), contacts_(contacts) {}

  std::vector<Doubt> run() {
    for (std::uint32_t s = 0; s < model_.surfaces.size(); ++s)
      if (model_.surfaces[s].is_dangling() && model_.surfaces[s].region_plus != universe) look_at_jut(s);
    look_at_slivers();
    return std::move(doubts_);
  }

 private:
  const std::string& name(std::uint32_t entity) const { return model_.entities[entity].name; }

  bool should_end_on(std::uint32_t entity, std::uint32_t onto) const {
    const Role role = model_.entities[entity].role;
    return role == Role::horizon || role == Role::unconformity ||
           std::any_of(contacts_.begin(), contacts_.end(),
                       [&](const NamedContact& c) { return c.entity == name(entity) && c.onto == name(onto); });
  }

  /// The entity along `line` that surface `s` should end on but goes on behind, or no_index.
  std::uint32_t passed_along(std::uint32_t line, std::uint32_t s) const {
    const std::uint32_t entity = model_.surfaces[s].entity;
    bool goes_on = false;
    std::uint32_t passed = no_index;
    for (const std::uint32_t other : model_.lines[line].surfaces) {
      if (other == s) continue;
      const std::uint32_t e = model_.surfaces[other].entity;
      goes_on |= e == entity;
      if (e != entity && passed == no_index && should_end_on(entity, e)) passed = e;
    }
    return goes_on ? passed : no_index;
  }

  void look_at_jut(std::uint32_t s) {
    const Surface& surface = model_.surfaces[s];
    std::uint32_t passed = no_index;
    std::vector<std::uint32_t> contact, border;  // vertices
    for (const std::uint32_t line : surface.lines) {
      const bool is_free = model_.lines[line].is_free_border();
      const std::uint32_t onto = is_free ? no_index : passed_along(line, s);
      if (passed == no_index) passed = onto;
      auto& into = is_free ? border : contact;
      if (is_free || onto != no_index)
        into.insert(into.end(), model_.lines[line].vertices.begin(), model_.lines[line].vertices.end());
    }
    if (passed == no_index || border.empty()) return;
    double extent_m = 0;
    Vec3 where = model_.points[border.front()];
    for (const std::uint32_t b : border) {
      double nearest_m = length(model_.points[contact.front()] - model_.points[b]);
      for (const std::uint32_t c : contact)
        nearest_m = std::min(nearest_m, length(model_.points[c] - model_.points[b]));
      if (!(nearest_m > extent_m)) continue;
      extent_m = nearest_m;
      where = model_.points[b];
    }
    const std::string from = name(surface.entity), onto = name(passed);
    doubts_.push_back({from + " juts " + digits(extent_m) + " m past " + onto + " at " + place(where),
                       "seal.contacts = [\"" + from + " -> " + onto + " within " + digits(1.1 * extent_m) + "\"]"});
  }

  /// Whether an entity ends along a line on one that goes on there, neither of them the boundary: a contact that may
  /// have been made, unlike a crossing.
  bool is_end(const Line& line) const {
    std::vector<std::uint32_t> entities;
    for (const std::uint32_t s : line.surfaces)
      for (const std::uint32_t e : model_.surfaces[s].all_entities)
        if (model_.entities[e].role != Role::boundary) entities.push_back(e);
    const auto times = [&](std::uint32_t e) { return std::count(entities.begin(), entities.end(), e); };
    return std::any_of(entities.begin(), entities.end(), [&](std::uint32_t e) { return times(e) == 1; }) &&
           std::any_of(entities.begin(), entities.end(), [&](std::uint32_t e) { return times(e) > 1; });
  }

  void look_at_slivers() {
    std::vector<char> has_end(model_.regions.size(), 0);
    std::vector<double> frontier_m2(model_.regions.size(), 0);
    std::vector<std::vector<std::uint32_t>> around(model_.regions.size());
    std::vector<std::uint32_t> first(model_.regions.size(), no_index);
    for (std::uint32_t s = 0; s < model_.surfaces.size(); ++s) {
      const Surface& surface = model_.surfaces[s];
      if (surface.is_dangling()) continue;
      const double area = area_m2(model_, surface);
      const bool ends = std::any_of(surface.lines.begin(), surface.lines.end(),
                                    [&](std::uint32_t line) { return is_end(model_.lines[line]); });
      for (const std::uint32_t r : {surface.region_plus, surface.region_minus}) {
        if (r == universe) continue;
        frontier_m2[r] += area;
        around[r].push_back(surface.entity);
        first[r] = std::min(first[r], s);
        has_end[r] |= ends;
      }
    }
    for (std::uint32_t r = 0; r < model_.regions.size(); ++r) {
      const double volume = model_.regions[r].volume_m3, thickness = 2 * volume / frontier_m2[r];
      const double cube_m3 = distance_m_ * distance_m_ * distance_m_;
      if (!has_end[r] || !(volume < cube_m3 && thickness < least_thickness_ratio * distance_m_)) continue;
      std::string names;
      for (const std::uint32_t e : sorted_unique(std::move(around[r]))) names += (names.empty() ? "" : ", ") + name(e);
      const Vec3 where = model_.points[model_.triangles[model_.surfaces[first[r]].first_triangle][0]];
      doubts_.push_back({"a sliver of " + digits(volume) + " m3 between " + names + ", " + digits(thickness) +
                             " m thick on average, at " + place(where),
                         "seal.micro_region_volume_m3 = " + digits(1.1 * volume) + " to merge it"});
    }
  }

  std::string place(const Vec3& p) const {
    const Vec3 q = p + model_.local_origin;
    return "(" + OptionPrinter::literal(q.x) + ", " + OptionPrinter::literal(q.y) + ", " + OptionPrinter::literal(q.z) +
           ")";
  }

  const StructuralModel& model_;
  double distance_m_;
  const std::vector<NamedContact>& contacts_;
  std::vector<Doubt> doubts_;
};

}  // namespace

Result<std::vector<Doubt>> find_doubts(const TriangleSoup& soup, double distance_m,
                                       const std::vector<NamedContact>& contacts) {
  if (soup.triangles.empty()) return std::vector<Doubt>{};
  const Result<BuiltModel> built = build_structural_model(soup);
  if (!built) return built.failure();
  return DoubtFinder(built->model, distance_m, contacts).run();
}

}  // namespace strataflow
