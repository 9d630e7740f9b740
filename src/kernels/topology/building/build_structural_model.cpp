#include "kernels/topology/building/build_structural_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <string>

#include "base/id.h"
#include "kernels/topology/building/build_lines.h"
#include "kernels/topology/building/build_regions.h"
#include "kernels/topology/building/build_surfaces.h"
#include "kernels/topology/validity/compare_records.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/building/weld_points.h"

namespace strataflow {

namespace {

/// Triangles over welded points, labelled with what they came from.
struct WeldedTriangles {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> label;                    ///< per triangle: index into `patches_of`
  std::vector<std::vector<std::uint32_t>> patches_of;  ///< per label: one patch, beyond those sets that coincide
  std::vector<TriangleCopy> copies;                    ///< of triangles that are kept

  void erase(const std::vector<char>& doomed) {
    std::vector<std::uint32_t> place(triangles.size());
    std::uint32_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      place[t] = kept;
      if (doomed[t]) continue;
      triangles[kept] = triangles[t];
      label[kept++] = label[t];
    }
    triangles.resize(kept);
    label.resize(kept);
    for (TriangleCopy& copy : copies) copy.triangle = place[copy.triangle];
  }
};

/// Says per entity how many triangles are dropped. `points`: where the triangles' indices point.
void report_dropped(const WeldedTriangles& welded, const std::vector<char>& doomed, const std::vector<Vec3>& points,
                    const TriangleSoup& soup, const char* kind, const char* text, std::vector<Violation>& violations) {
  std::vector<std::uint64_t> count(soup.entities.size(), 0);
  std::vector<Vec3> where(soup.entities.size());
  for (std::size_t t = 0; t < doomed.size(); ++t) {
    if (!doomed[t]) continue;
    const std::uint32_t entity = soup.patch_entity[welded.patches_of[welded.label[t]][0]];
    if (count[entity]++ == 0) where[entity] = points[welded.triangles[t][0]];
  }
  for (std::size_t e = 0; e < count.size(); ++e)
    if (count[e] > 0)
      violations.push_back({kind, Violation::Severity::error,
                            "surface '" + soup.entities[e].name + "': " + std::to_string(count[e]) + " " + text,
                            "`strataflow check --repair` and `run` drop them", where[e], count[e], true});
}

/// Where the same entities coincide.
struct Coincidence {
  std::uint64_t triangles = 0;
  double area_m2 = 0;
  Vec3 where;
};

/// Of identical triangles only the first stays. Where they are of different entities it stands for all of them, under
/// a label of its own (patches of each entity); one that adds no entity is a duplicate. Returns whether any was dropped.
bool merge_identical(WeldedTriangles& welded, const EdgeTable& edges, const StructuralModel& model,
                     const TriangleSoup& soup, std::vector<Violation>& violations) {
  std::vector<char> repeated(welded.triangles.size(), 0), merged(welded.triangles.size(), 0);
  bool any_repeated = false;
  std::map<std::vector<std::uint32_t>, std::uint32_t> label_of_patches;
  std::map<std::vector<std::uint32_t>, Coincidence> coincidences;  // by entities
  std::vector<std::array<std::uint32_t, 2>> fan;                   // apex and triangle
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e) {
    const auto around = edges.around(e);
    if (around.size() < 2) continue;
    fan.clear();
    for (const std::uint32_t h : around) {
      const std::uint32_t apex = welded.triangles[h / 3][(h % 3 + 2) % 3];
      if (apex > edges.edges[e][1]) fan.push_back({apex, h / 3});  // identical ones are met once, at their lowest edge
    }
    std::sort(fan.begin(), fan.end());
    for (std::size_t begin = 0, end = 0; begin < fan.size(); begin = end) {
      for (end = begin + 1; end < fan.size() && fan[end][0] == fan[begin][0];) ++end;
      if (end - begin < 2) continue;
      const std::uint32_t first = fan[begin][1];
      std::vector<std::uint32_t> patches, entities;
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t t = fan[i][1], patch = welded.patches_of[welded.label[t]][0];
        const std::size_t known = entities.size();
        const std::vector<std::uint32_t> own = soup.entities_of(patch);
        entities.insert(entities.end(), own.begin(), own.end());
        entities = sorted_unique(std::move(entities));
        const bool is_new = entities.size() > known;
        any_repeated = any_repeated || !is_new;
        repeated[t] = !is_new;
        merged[t] = i > begin;
        welded.copies.push_back({first, soup.patch_entity[patch]});
        if (is_new) patches.push_back(patch);
      }
      if (patches.size() < 2) continue;
      patches = sorted_unique(std::move(patches));
      const auto [place, is_first] =
          label_of_patches.try_emplace(patches, static_cast<std::uint32_t>(welded.patches_of.size()));
      if (is_first) welded.patches_of.push_back(patches);
      welded.label[first] = place->second;
      const auto [a, b, c] = welded.triangles[first];
      Coincidence& found = coincidences[entities];
      if (found.triangles++ == 0) found.where = model.points[a];
      found.area_m2 += 0.5 * length(cross(model.points[b] - model.points[a], model.points[c] - model.points[a]));
    }
  }
  if (any_repeated)
    report_dropped(welded, repeated, model.points, soup, "duplicate_triangle", "triangles given twice", violations);
  for (const auto& [entities, found] : coincidences) {
    std::string names;
    for (const std::uint32_t entity : entities)
      names += (names.empty() ? "'" : entity == entities.back() ? " and '" : ", '") + soup.entities[entity].name + "'";
    violations.push_back({"coincident_surfaces", Violation::Severity::warning,
                          names + " coincide on " + std::to_string(found.triangles) + " triangles, " +
                              std::to_string(found.area_m2) + " m2, which become one surface of '" +
                              soup.entities[youngest_of(soup.entities, entities)].name + "'",
                          "nothing, if nothing should lie between them there", found.where, found.triangles});
  }
  if (!any_repeated && coincidences.empty()) return false;
  welded.erase(merged);
  return true;
}

/// The properties of welded points: of the copies of a point, the first that has data counts. Copies that say
/// otherwise are reported. `source`: per welded point, its first copy; `id_of_point`: per point of the soup.
void keep_properties(StructuralModel& model, const TriangleSoup& soup, const std::vector<std::uint32_t>& source,
                     const std::vector<std::uint32_t>& id_of_point, std::vector<Violation>& violations) {
  for (const PointProperty& property : soup.properties) {
    const auto values_of = [&](std::uint32_t point) {
      return std::span(property.values).subspan(std::size_t{point} * property.width, property.width);
    };
    const auto is_number = [](double value) { return !std::isnan(value); };
    const auto has_data = [&](std::uint32_t point) {
      const auto values = values_of(point);
      return std::any_of(values.begin(), values.end(), is_number);
    };
    const auto differ = [&](std::uint32_t p, std::uint32_t q) {
      const auto a = values_of(p), b = values_of(q);
      return !std::equal(a.begin(), a.end(), b.begin(),
                         [&](double x, double y) { return x == y || !(is_number(x) || is_number(y)); });
    };
    std::vector<std::uint32_t> chosen = source;
    std::vector<char> is_torn(source.size(), 0);
    std::uint64_t torn = 0;
    Vec3 where;
    for (std::uint32_t i = 0; i < soup.points.size(); ++i) {
      const std::uint32_t v = id_of_point[i];
      if (v == no_index || i == chosen[v] || !has_data(i)) continue;
      if (!has_data(chosen[v])) {
        chosen[v] = i;
      } else if (!is_torn[v] && differ(i, chosen[v])) {
        is_torn[v] = 1;
        if (torn++ == 0) where = soup.points[i];
      }
    }
    PointProperty kept{property.name, property.unit, property.width, {}};
    kept.values.reserve(source.size() * property.width);
    for (const std::uint32_t point : chosen)
      kept.values.insert(kept.values.end(), values_of(point).begin(), values_of(point).end());
    model.properties.push_back(std::move(kept));
    if (torn > 0)
      violations.push_back({"torn_property", Violation::Severity::warning,
                            "property '" + property.name + "': " + std::to_string(torn) +
                                " points have copies with different values, of which the first is kept",
                            "nothing, unless the property jumps across a surface and both values matter", where, torn});
  }
}

/// Points used by triangles, in order of use, and the triangles renumbered.
WeldedTriangles weld_triangles(const TriangleSoup& soup, StructuralModel& model,
                               std::vector<std::uint32_t>& id_of_point, std::vector<Violation>& violations) {
  const WeldedPoints points = weld_points(soup.points);
  WeldedTriangles welded;
  welded.triangles.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles)
    welded.triangles.push_back({points.id[t[0]], points.id[t[1]], points.id[t[2]]});
  welded.label = soup.triangle_patch;
  for (std::uint32_t patch = 0; patch < soup.patch_entity.size(); ++patch) welded.patches_of.push_back({patch});
  for (Triangle& t : welded.triangles)
    for (std::uint32_t& v : t) v = points.source[v];
  std::vector<char> collapsed(welded.triangles.size(), 0);
  bool any = false;
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    const Triangle& v = welded.triangles[t];
    collapsed[t] = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
    any = any || collapsed[t];
  }
  if (any) {
    report_dropped(welded, collapsed, soup.points, soup, "degenerate_triangle", "triangles with a repeated vertex",
                   violations);
    welded.erase(collapsed);
  }

  std::vector<std::uint32_t> renumbered(soup.points.size(), no_index);
  std::vector<std::uint32_t> source;
  for (Triangle& t : welded.triangles)
    for (std::uint32_t& v : t) {
      if (renumbered[v] == no_index) {
        renumbered[v] = static_cast<std::uint32_t>(source.size());
        source.push_back(v);
      }
      v = renumbered[v];
    }
  model.points.reserve(source.size());
  for (const std::uint32_t v : source) model.points.push_back(soup.points[v]);
  id_of_point.resize(soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) id_of_point[i] = renumbered[points.source[points.id[i]]];
  keep_properties(model, soup, source, id_of_point, violations);
  return welded;
}

/// Puts the triangles of each surface together, turned coherently; returns the label of each surface.
std::vector<std::uint32_t> group_by_surface(StructuralModel& model, WeldedTriangles& welded,
                                            const SurfacePartition& partition, const TriangleSoup& soup) {
  std::vector<std::uint32_t> first(partition.surface_count + 1, 0);
  for (const std::uint32_t s : partition.surface_of) ++first[s + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  std::vector<std::uint32_t> label_of_surface(partition.surface_count), place(welded.triangles.size());
  model.triangles.resize(welded.triangles.size());
  model.triangle_surface.resize(welded.triangles.size());
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    const std::uint32_t s = partition.surface_of[t];
    label_of_surface[s] = welded.label[t];
    Triangle v = welded.triangles[t];
    if (partition.is_flipped[t]) std::swap(v[1], v[2]);
    model.triangle_surface[next[s]] = s;
    place[t] = next[s];
    model.triangles[next[s]++] = v;
  }
  for (TriangleCopy& copy : welded.copies) copy.triangle = place[copy.triangle];
  std::sort(welded.copies.begin(), welded.copies.end(), [](const TriangleCopy& a, const TriangleCopy& b) {
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.entity < b.entity;
  });
  model.surfaces.resize(partition.surface_count);
  for (std::uint32_t s = 0; s < partition.surface_count; ++s) {
    Surface& surface = model.surfaces[s];
    for (const std::uint32_t patch : welded.patches_of[label_of_surface[s]]) {
      const std::vector<std::uint32_t> own = soup.entities_of(patch);
      surface.all_entities.insert(surface.all_entities.end(), own.begin(), own.end());
    }
    surface.all_entities = sorted_unique(std::move(surface.all_entities));
    surface.entity = youngest_of(soup.entities, surface.all_entities);
    surface.first_triangle = first[s];
    surface.end_triangle = first[s + 1];
  }
  return label_of_surface;
}

void mark_lines_and_corners(StructuralModel& model) {
  model.point_line.assign(model.points.size(), -1);
  model.point_corner.assign(model.points.size(), -1);
  for (std::size_t l = 0; l < model.lines.size(); ++l) {
    for (const std::uint32_t v : model.lines[l].vertices) model.point_line[v] = static_cast<std::int32_t>(l);
    for (std::size_t i = 0; i < model.lines[l].surfaces.size(); ++i) {
      std::vector<std::uint32_t>& lines = model.surfaces[model.lines[l].surfaces[i]].lines;
      if (lines.empty() || lines.back() != l) lines.push_back(static_cast<std::uint32_t>(l));
    }
  }
  for (std::size_t c = 0; c < model.corners.size(); ++c) {
    model.point_corner[model.corners[c].vertex] = static_cast<std::int32_t>(c);
    model.point_line[model.corners[c].vertex] = -1;
  }
}

/// Regions exist, and no surface stands with both sides in the universe.
bool is_shell_closed(const StructuralModel& model) {
  if (model.regions.empty()) return false;
  return std::none_of(model.surfaces.begin(), model.surfaces.end(),
                      [](const Surface& s) { return s.region_plus == universe && s.region_minus == universe; });
}

}  // namespace

Result<BuiltModel> build_structural_model(const TriangleSoup& soup) {
  if (soup.triangles.empty())
    return Failure{FailureCode::invalid_input, "the input holds no triangle", "give triangulated surfaces as input"};
  if (soup.triangles.size() >= no_index / 3 || soup.points.size() >= no_index)  // half-edges are counted in 32 bits
    return Failure{FailureCode::unsupported, "the input holds more triangles or points than 32-bit indices can count",
                   "split it, or coarsen its surfaces"};
  BuiltModel built;
  StructuralModel& model = built.model;
  model.local_origin = soup.local_origin;
  model.entities = soup.entities;

  std::vector<std::uint32_t> id_of_point;
  WeldedTriangles welded = weld_triangles(soup, model, id_of_point, built.violations);
  if (welded.triangles.empty())
    return Failure{FailureCode::invalid_input, "every triangle of the input has a repeated vertex",
                   "check that the file's coordinates kept their digits"};
  EdgeTable edges = build_edge_table(model.points.size(), welded.triangles);
  if (merge_identical(welded, edges, model, soup, built.violations))
    edges = build_edge_table(model.points.size(), welded.triangles);
  for (const Vec3& p : model.points) model.box.take(p);

  const SurfacePartition partition = build_surfaces(edges, welded.triangles, welded.label);
  const std::vector<std::uint32_t> label_of_surface = group_by_surface(model, welded, partition, soup);
  built.copies = std::move(welded.copies);
  std::vector<std::vector<std::uint32_t>> patches_of_surface;
  for (const std::uint32_t label : label_of_surface) patches_of_surface.push_back(welded.patches_of[label]);
  for (const std::uint32_t s : partition.non_orientable)
    built.violations.push_back({"non_orientable_surface", Violation::Severity::error,
                                "surface '" + model.entities[model.surfaces[s].entity].name + "' has only one side",
                                "cut it open: a Moebius strip cannot bound a region",
                                model.points[model.triangles[model.surfaces[s].first_triangle][0]], 1});
  edges = build_edge_table(model.points.size(), model.triangles);  // triangles have moved and turned
  std::vector<char> is_feature(edges.edge_count());
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e)
    is_feature[e] = is_feature_edge(edges, e, model.triangle_surface);
  LineNetwork network = build_lines(edges, is_feature, model.triangle_surface, model.points.size());
  model.corners = std::move(network.corners);
  model.lines = std::move(network.lines);
  mark_lines_and_corners(model);

  const auto add = [&](std::vector<Violation> more) {
    built.violations.insert(built.violations.end(), std::make_move_iterator(more.begin()),
                            std::make_move_iterator(more.end()));
  };
  add(build_regions(model, edges, network.line_edges));
  model.is_sealed = is_shell_closed(model);
  name_regions(model, soup, patches_of_surface);
  add(compare_borders(model, edges, soup, id_of_point));
  add(compare_region_records(model, soup, patches_of_surface));
  return built;
}

}  // namespace strataflow
