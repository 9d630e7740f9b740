#include "kernels/topology/build_structural_model.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "base/id.h"
#include "kernels/topology/build_lines.h"
#include "kernels/topology/build_regions.h"
#include "kernels/topology/build_surfaces.h"
#include "kernels/topology/compare_records.h"
#include "kernels/topology/edge_table.h"
#include "kernels/topology/weld_points.h"

namespace strataflow {

namespace {

/// Triangles over welded points, with the patch each came from.
struct WeldedTriangles {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> patch;
};

/// Drops the triangles marked, and says per entity how many.
void drop(WeldedTriangles& welded, const std::vector<char>& doomed, const TriangleSoup& soup, const char* kind,
          const char* text, std::vector<Violation>& violations) {
  std::vector<std::uint64_t> count(soup.entities.size(), 0);
  std::vector<Vec3> where(soup.entities.size());
  std::size_t kept = 0;
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    if (doomed[t]) {
      const std::uint32_t entity = soup.patch_entity[welded.patch[t]];
      if (count[entity]++ == 0) where[entity] = soup.points[welded.triangles[t][0]];
      continue;
    }
    welded.triangles[kept] = welded.triangles[t];
    welded.patch[kept++] = welded.patch[t];
  }
  welded.triangles.resize(kept);
  welded.patch.resize(kept);
  for (std::size_t e = 0; e < count.size(); ++e)
    if (count[e] > 0)
      violations.push_back({kind, Violation::Severity::error,
                            "surface '" + soup.entities[e].name + "': " + std::to_string(count[e]) + " " + text,
                            "`strataflow check --repair` and `run` drop them", where[e], count[e]});
}

/// Marks every triangle whose vertices are those of an earlier one of the same patch.
std::vector<char> find_repeated(const EdgeTable& edges, const WeldedTriangles& welded) {
  std::vector<char> repeated(welded.triangles.size(), 0);
  const auto apex = [&](std::uint32_t h) { return welded.triangles[h / 3][(h % 3 + 2) % 3]; };
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e) {
    const auto around = edges.around(e);
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = i + 1; j < around.size(); ++j)
        if (apex(around[i]) == apex(around[j]) && welded.patch[around[i] / 3] == welded.patch[around[j] / 3])
          repeated[around[j] / 3] = 1;
  }
  return repeated;
}

/// Points used by triangles, in order of use, and the triangles renumbered.
WeldedTriangles weld_triangles(const TriangleSoup& soup, StructuralModel& model, std::vector<std::uint32_t>& id_of_point,
                               std::vector<Violation>& violations) {
  const WeldedPoints points = weld_points(soup.points);
  WeldedTriangles welded;
  welded.triangles.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) welded.triangles.push_back({points.id[t[0]], points.id[t[1]], points.id[t[2]]});
  welded.patch = soup.triangle_patch;
  for (Triangle& t : welded.triangles)
    for (std::uint32_t& v : t) v = points.source[v];
  std::vector<char> collapsed(welded.triangles.size(), 0);
  bool any = false;
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    const Triangle& v = welded.triangles[t];
    collapsed[t] = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
    any = any || collapsed[t];
  }
  if (any) drop(welded, collapsed, soup, "degenerate_triangle", "triangles with a repeated vertex", violations);

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
  for (const PointProperty& property : soup.properties) {
    PointProperty kept{property.name, property.unit, property.width, {}};
    kept.values.reserve(source.size() * property.width);
    for (const std::size_t v : source) {
      const auto first = property.values.begin() + static_cast<std::ptrdiff_t>(v * property.width);
      kept.values.insert(kept.values.end(), first, first + property.width);
    }
    model.properties.push_back(std::move(kept));
  }
  return welded;
}

/// Puts the triangles of each surface together, turned coherently; returns the patch of each surface.
std::vector<std::uint32_t> group_by_surface(StructuralModel& model, const WeldedTriangles& welded,
                                            const SurfacePartition& partition, const TriangleSoup& soup) {
  std::vector<std::uint32_t> first(partition.surface_count + 1, 0);
  for (const std::uint32_t s : partition.surface_of) ++first[s + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  std::vector<std::uint32_t> patch_of_surface(partition.surface_count);
  model.triangles.resize(welded.triangles.size());
  model.triangle_surface.resize(welded.triangles.size());
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    const std::uint32_t s = partition.surface_of[t];
    patch_of_surface[s] = welded.patch[t];
    Triangle v = welded.triangles[t];
    if (partition.is_flipped[t]) std::swap(v[1], v[2]);
    model.triangle_surface[next[s]] = s;
    model.triangles[next[s]++] = v;
  }
  model.surfaces.resize(partition.surface_count);
  for (std::uint32_t s = 0; s < partition.surface_count; ++s) {
    Surface& surface = model.surfaces[s];
    surface.entity = soup.patch_entity[patch_of_surface[s]];
    surface.all_entities = {surface.entity};
    surface.first_triangle = first[s];
    surface.end_triangle = first[s + 1];
  }
  return patch_of_surface;
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
  return std::none_of(model.surfaces.begin(), model.surfaces.end(), [](const Surface& s) {
    return s.region_plus == universe && s.region_minus == universe;
  });
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
  const std::vector<char> repeated = find_repeated(edges, welded);
  if (std::find(repeated.begin(), repeated.end(), 1) != repeated.end()) {
    drop(welded, repeated, soup, "duplicate_triangle", "triangles given twice", built.violations);
    edges = build_edge_table(model.points.size(), welded.triangles);
  }
  for (const Vec3& p : model.points) model.box.take(p);

  const SurfacePartition partition = build_surfaces(edges, welded.triangles, welded.patch);
  const std::vector<std::uint32_t> patch_of_surface = group_by_surface(model, welded, partition, soup);
  for (const std::uint32_t s : partition.non_orientable)
    built.violations.push_back({"non_orientable_surface", Violation::Severity::error,
                                "surface '" + model.entities[model.surfaces[s].entity].name + "' has only one side",
                                "cut it open: a Moebius strip cannot bound a region",
                                model.points[model.triangles[model.surfaces[s].first_triangle][0]], 1});
  edges = build_edge_table(model.points.size(), model.triangles);  // triangles have moved and turned
  std::vector<char> is_feature(edges.edge_count());
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e) is_feature[e] = is_feature_edge(edges, e, model.triangle_surface);
  LineNetwork network = build_lines(edges, is_feature, model.triangle_surface, model.points.size());
  model.corners = std::move(network.corners);
  model.lines = std::move(network.lines);
  mark_lines_and_corners(model);

  const auto add = [&](std::vector<Violation> more) {
    built.violations.insert(built.violations.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  add(build_regions(model, edges, network.line_edges));
  model.is_sealed = is_shell_closed(model);
  name_regions(model, soup, patch_of_surface);
  add(compare_borders(model, edges, soup, id_of_point));
  add(compare_region_records(model, soup, patch_of_surface));
  return built;
}

}  // namespace strataflow
