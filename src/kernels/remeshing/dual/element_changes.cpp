#include "kernels/remeshing/dual/element_changes.h"

#include <algorithm>
#include <array>

#include "base/id.h"
#include "kernels/topology/building/weld_points.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

using Link = std::array<std::uint32_t, 2>;  ///< old element, new element
using Indices = std::vector<std::uint32_t>;

/// Groups old and new elements that have to do with each other and tells every group but those of one and one.
void tell_changes(ElementKind element, std::size_t old_count, std::size_t new_count, const std::vector<Link>& links,
                  std::vector<ElementChange>& changes) {
  UnionFind sets(old_count + new_count);
  for (const auto& [o, n] : links) sets.unite(o, static_cast<std::uint32_t>(old_count) + n);
  std::vector<ElementChange> groups(old_count + new_count);
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    ElementChange& group = groups[sets.find(i)];
    if (i < old_count)
      group.before.push_back(i);
    else
      group.after.push_back(i - static_cast<std::uint32_t>(old_count));
  }
  for (ElementChange& group : groups) {
    group.element = element;
    if (group.before.size() + group.after.size() == 0) continue;
    if (group.before.size() == 1 && group.after.size() == 1) continue;
    group.kind = group.after.empty()        ? ChangeKind::lost
                 : group.before.empty()     ? ChangeKind::created
                 : group.before.size() == 1 ? ChangeKind::split
                                            : ChangeKind::merged;
    changes.push_back(std::move(group));
  }
}

/// Points of the new model at the places of the soup's.
Indices points_in(const StructuralModel& after, const TriangleSoup& soup) {
  std::vector<Vec3> places = after.points;
  places.insert(places.end(), soup.points.begin(), soup.points.end());
  const WeldedPoints welded = weld_points(places);
  Indices found;
  for (std::size_t p = after.points.size(); p < places.size(); ++p) {
    const std::uint32_t source = welded.source[welded.id[p]];
    found.push_back(source < after.points.size() ? source : no_index);
  }
  return found;
}

/// The line of each edge that lies on one, as (lower vertex, higher vertex, line), ascending.
std::vector<Triangle> edges_of_lines(const StructuralModel& model) {
  std::vector<Triangle> edges;
  for (std::uint32_t l = 0; l < model.lines.size(); ++l) {
    const Line& line = model.lines[l];
    for (std::size_t i = 0; i + 1 < line.vertices.size() + (line.is_closed() ? 1 : 0); ++i) {
      const std::uint32_t a = line.vertices[i], b = line.vertices[(i + 1) % line.vertices.size()];
      edges.push_back({std::min(a, b), std::max(a, b), l});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::string names_of(const StructuralModel& model, ElementKind kind, const Indices& elements) {
  std::string names;
  for (const std::uint32_t e : elements) {
    if (!names.empty()) names += ", ";
    names += std::to_string(e);
    Indices entities;
    if (kind == ElementKind::surface) entities = model.surfaces[e].all_entities;
    if (kind == ElementKind::line)
      for (const std::uint32_t s : model.lines[e].surfaces) entities.push_back(model.surfaces[s].entity);
    if (kind == ElementKind::corner)
      for (const Line& line : model.lines)
        if (!line.is_closed() && (line.corners[0] == e || line.corners[1] == e))
          for (const std::uint32_t s : line.surfaces) entities.push_back(model.surfaces[s].entity);
    std::string of;
    for (const std::uint32_t entity : sorted_unique(std::move(entities)))
      of += (of.empty() ? "" : " × ") + model.entities[entity].name;
    if (kind == ElementKind::region) of = model.regions[e].name;
    if (!of.empty()) names += " (" + of + ")";
  }
  return names;
}

}  // namespace

std::string_view to_string(ElementKind kind) {
  switch (kind) {
    case ElementKind::corner:
      return "corner";
    case ElementKind::line:
      return "line";
    case ElementKind::surface:
      return "surface";
    case ElementKind::region:
      return "region";
  }
  return "unknown";
}

std::string_view to_string(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::lost:
      return "lost";
    case ChangeKind::merged:
      return "merged";
    case ChangeKind::split:
      return "split";
    case ChangeKind::created:
      return "created";
  }
  return "unknown";
}

std::string describe(const ElementChange& change, const StructuralModel& before, const StructuralModel& after) {
  std::string text = std::string(to_string(change.element)) + " " + std::string(to_string(change.kind)) + ":";
  if (!change.before.empty()) text += " " + names_of(before, change.element, change.before);
  if (!change.after.empty()) text += " → " + names_of(after, change.element, change.after);
  return text;
}

std::vector<ElementChange> compare_elements(const StructuralModel& before, const DualSoup& dual,
                                            const StructuralModel& after) {
  std::vector<ElementChange> changes;
  const Indices point_of = points_in(after, dual.soup);
  std::vector<Link> links;

  for (std::uint32_t c = 0; c < dual.corner_point.size(); ++c) {
    if (dual.corner_point[c] == no_index || point_of[dual.corner_point[c]] == no_index) continue;
    const std::int32_t corner = after.point_corner[point_of[dual.corner_point[c]]];
    if (corner >= 0) links.push_back({c, static_cast<std::uint32_t>(corner)});
  }
  tell_changes(ElementKind::corner, before.corners.size(), after.corners.size(), links, changes);

  links.clear();
  const std::vector<Triangle> line_edges = edges_of_lines(after);
  for (std::uint32_t l = 0; l < dual.line_points.size(); ++l)
    for (std::size_t i = 1; i < dual.line_points[l].size(); ++i) {
      const std::uint32_t a = point_of[dual.line_points[l][i - 1]], b = point_of[dual.line_points[l][i]];
      const Triangle lowest{std::min(a, b), std::max(a, b), 0};
      const auto found = std::lower_bound(line_edges.begin(), line_edges.end(), lowest);
      if (found != line_edges.end() && (*found)[0] == lowest[0] && (*found)[1] == lowest[1])
        links.push_back({l, (*found)[2]});
    }
  tell_changes(ElementKind::line, before.lines.size(), after.lines.size(), links, changes);

  // Which old surfaces a new one stands for: those of the patches its triangles came from.
  links.clear();
  std::vector<Link> turned;  // the same links, where the new triangles face the other way
  std::vector<std::array<std::uint32_t, 5>> soup_triangles;  // sorted points, patch, parity
  const auto sorted_with_parity = [](Triangle t) {
    std::uint32_t parity = 0;
    for (const std::size_t i : {0u, 1u, 0u})
      if (t[i] > t[i + 1]) {
        std::swap(t[i], t[i + 1]);
        parity ^= 1;
      }
    return std::pair(t, parity);
  };
  for (std::size_t t = 0; t < dual.soup.triangles.size(); ++t) {
    Triangle corners = dual.soup.triangles[t];
    for (std::uint32_t& corner : corners) corner = point_of[corner];
    const auto [sorted, parity] = sorted_with_parity(corners);
    soup_triangles.push_back({sorted[0], sorted[1], sorted[2], dual.soup.triangle_patch[t], parity});
  }
  std::sort(soup_triangles.begin(), soup_triangles.end());
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    const auto [sorted, parity] = sorted_with_parity(after.triangles[t]);
    auto found = std::lower_bound(soup_triangles.begin(), soup_triangles.end(),
                                  std::array<std::uint32_t, 5>{sorted[0], sorted[1], sorted[2], 0, 0});
    for (; found != soup_triangles.end() && std::equal(sorted.begin(), sorted.end(), found->begin()); ++found)
      for (const std::uint32_t s : dual.patch_surfaces[(*found)[3]])
        ((*found)[4] == parity ? links : turned).push_back({s, after.triangle_surface[t]});
  }
  const auto make_unique = [](std::vector<Link>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  make_unique(links);
  make_unique(turned);
  std::vector<Link> regions, all = links;
  all.insert(all.end(), turned.begin(), turned.end());
  tell_changes(ElementKind::surface, before.surfaces.size(), after.surfaces.size(), all, changes);

  // A side of a new surface that stands for one old one looks at what became of the region there.
  Indices stands_for(after.surfaces.size(), 0);
  make_unique(all);
  for (const auto& [o, n] : all) ++stands_for[n];
  const auto link_regions = [&](const std::vector<Link>& list, bool is_turned) {
    for (const auto& [o, n] : list) {
      if (stands_for[n] != 1) continue;
      for (const bool is_positive : {false, true}) {
        const std::uint32_t old_region = is_positive ? before.surfaces[o].region_plus : before.surfaces[o].region_minus;
        const std::uint32_t new_region =
            is_positive != is_turned ? after.surfaces[n].region_plus : after.surfaces[n].region_minus;
        if (old_region != universe && new_region != universe) regions.push_back({old_region, new_region});
      }
    }
  };
  link_regions(links, false);
  link_regions(turned, true);
  tell_changes(ElementKind::region, before.regions.size(), after.regions.size(), regions, changes);

  std::stable_sort(changes.begin(), changes.end(), [](const ElementChange& a, const ElementChange& b) {
    return a.element != b.element ? a.element < b.element : a.kind < b.kind;
  });
  return changes;
}

}  // namespace strataflow
