#include "kernels/remeshing/remesh_at_resolution.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/quality/nearest_triangle.h"
#include "kernels/remeshing/dual/ball_property.h"
#include "kernels/remeshing/dual/cell_components.h"
#include "kernels/remeshing/dual/clean_up_dual.h"
#include "kernels/remeshing/dual/dual_polygons.h"
#include "kernels/remeshing/dual/dual_soup.h"
#include "kernels/remeshing/dual/element_changes.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/validity/check_validity.h"
#include "kernels/voronoi/line_edges.h"
#include "kernels/voronoi/restricted_diagram.h"
#include "model/soup_of_model.h"

namespace strataflow {

namespace {

/// One dual of the sites, judged.
struct Attempt {
  DualSoup dual;
  BuiltModel built;
  std::vector<BallFailure> ball_failures;
  std::uint64_t merged_points = 0;
  std::vector<std::uint32_t> bad_sites;  ///< whose cells the flaws are in; ascending
  std::vector<ElementChange> changes;
  std::string flaw;                      ///< empty: valid
  std::vector<std::uint32_t> far_sites;  ///< where a valid dual lies too far from the input; ascending
};

/// The sites in whose cells changed elements lie.
std::vector<std::uint32_t> sites_of_changes(const std::vector<ElementChange>& changes, const CellComponents& components,
                                            const std::vector<BallFailure>& failures) {
  std::vector<std::uint32_t> sites;
  for (const ElementChange& change : changes)
    for (const std::uint32_t element : change.before) {
      if (change.element == ElementKind::corner)
        sites.push_back(components.lines[components.corner_component[element]].site);
      if (change.element == ElementKind::line)
        for (std::uint32_t part = components.line_begin[element]; part < components.line_begin[element + 1]; ++part)
          sites.push_back(components.parts[part].site);
      if (change.element == ElementKind::surface)
        for (const BallFailure& failure : failures)
          if (failure.surface == element && failure.check != BallCheck::several_sheets) sites.push_back(failure.site);
    }
  return sites;
}

Result<Attempt> attempt(const StructuralModel& model, const RestrictedDiagram& diagram, std::size_t site_count,
                        const RemeshAtResolutionOptions& options, const MergeOptions& merge) {
  const Result<CellComponents> components = find_cell_components(model, diagram, site_count);
  if (!components) return components.failure();
  Attempt made;
  const ComponentPoints points = place_component_points(model, diagram, *components, merge);
  DualMesh mesh = build_dual_polygons(model, diagram, *components, points);
  clean_up_dual(model, mesh);
  made.merged_points = points.merges.size();
  made.ball_failures = check_ball_property(model, diagram, *components);
  made.dual = make_dual_soup(model, mesh);
  made.dual.soup.regions = patches_of_model(model).regions;  // for their names

  const TriangleSoup& soup = made.dual.soup;
  for (const auto& pair : find_intersections(soup.points, soup.triangles)) {
    if (made.flaw.empty()) made.flaw = "triangles of the dual cross each other";
    for (const std::uint32_t t : {pair.first, pair.second})
      for (const std::uint32_t point : soup.triangles[t]) made.bad_sites.push_back(made.dual.points[point].site);
  }
  Result<BuiltModel> built = build_structural_model(soup);
  if (!built) return built.failure();
  made.built = std::move(*built);
  if (made.flaw.empty()) {
    const ValidityReport validity = check_validity(made.built);
    if (!is_sealed(made.built.model, validity)) {
      made.flaw = "the dual is not sealed";
      for (const Violation& violation : validity.violations)
        if (violation.severity == Violation::Severity::error) made.flaw = violation.what;
    }
  }
  made.changes = compare_elements(model, made.dual, made.built.model);
  if (made.flaw.empty() && options.must_keep_all && !made.changes.empty()) {
    made.flaw = describe(made.changes.front(), model, made.built.model);
    made.bad_sites = sites_of_changes(made.changes, *components, made.ball_failures);
  }
  if (!made.flaw.empty() && made.bad_sites.empty())  // nothing crosses, yet something leaks: where cells see too much
    for (const BallFailure& failure : made.ball_failures)
      if (failure.check != BallCheck::several_sheets && failure.check != BallCheck::several_arcs)
        made.bad_sites.push_back(failure.site);
  made.bad_sites = sorted_unique(std::move(made.bad_sites));
  return made;
}

/// Sites in whose cells input and dual lie farther apart than `wanted_m`, looking from the corners of pieces and from the
/// middle of the dual's triangles.
std::vector<std::uint32_t> far_sites(const NearestTriangle& to_model, const RestrictedDiagram& diagram,
                                     const DualSoup& dual, double wanted_m) {
  const double wanted = wanted_m * wanted_m;
  const NearestTriangle to_dual({dual.soup.points, dual.soup.triangles});
  std::vector<std::uint32_t> far_pieces(diagram.piece_count(), no_index);
  std::vector<std::uint32_t> far_triangles(dual.soup.triangles.size(), no_index);
  parallel_ranges(far_pieces.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::uint32_t guess = no_index;  // corners come several times, and near one another
    for (std::size_t i = begin; i < end; ++i)
      for (const Vec3& corner : diagram.piece_points(i))
        if (!to_dual.is_within(corner, wanted, guess)) far_pieces[i] = diagram.piece_site[i];
  });
  parallel_ranges(far_triangles.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::uint32_t guess = no_index;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = dual.soup.triangles[i];
      const Vec3 middle = (1.0 / 3) * (dual.soup.points[a] + dual.soup.points[b] + dual.soup.points[c]);
      if (!to_model.is_within(middle, wanted, guess)) far_triangles[i] = dual.points[a].site;
    }
  });
  std::vector<std::uint32_t> sites;
  for (const auto* found : {&far_pieces, &far_triangles})
    for (const std::uint32_t site : *found)
      if (site != no_index) sites.push_back(site);
  return sorted_unique(std::move(sites));
}

/// Per site: whether no triangle of the model lies both in its cell and in one of these.
std::vector<char> away_from(const RestrictedDiagram& diagram, const std::vector<std::uint32_t>& cells,
                            std::size_t site_count, std::size_t triangle_count) {
  std::vector<char> is_away(site_count, 1), is_touched(triangle_count, 0);
  for (const std::uint32_t site : cells) is_away[site] = 0;
  for (std::size_t i = 0; i < diagram.piece_count(); ++i)
    if (std::binary_search(cells.begin(), cells.end(), diagram.piece_site[i]))
      is_touched[diagram.piece_triangle[i]] = 1;
  for (std::size_t i = 0; i < diagram.piece_count(); ++i)
    if (is_touched[diagram.piece_triangle[i]]) is_away[diagram.piece_site[i]] = 0;
  return is_away;
}

/// One more site in each of these cells, at the corner of its pieces farthest from the site; `unmerged` (per site) is
/// carried on to it.
void add_sites(const RestrictedDiagram& diagram, const std::vector<std::uint32_t>& cells, std::vector<Vec3>& sites,
               std::vector<char>& unmerged) {
  std::vector<double> farthest(cells.size(), 0);
  std::vector<Vec3> place(cells.size());
  for (std::size_t i = 0; i < diagram.piece_count(); ++i) {
    const auto found = std::lower_bound(cells.begin(), cells.end(), diagram.piece_site[i]);
    if (found == cells.end() || *found != diagram.piece_site[i]) continue;
    const auto k = static_cast<std::size_t>(found - cells.begin());
    for (const Vec3& corner : diagram.piece_points(i))
      if (const double d = length(corner - sites[*found]); d > farthest[k]) {
        farthest[k] = d;
        place[k] = corner;
      }
  }
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (farthest[k] > 0) {
      sites.push_back(place[k]);
      unmerged.push_back(unmerged[cells[k]]);
    }
}

}  // namespace

Result<RemeshedAtResolution> remesh_at_resolution(const StructuralModel& model, std::vector<Vec3> sites,
                                                  const RemeshAtResolutionOptions& options) {
  if (sites.empty()) return Failure{FailureCode::invalid_input, "there are no sites", "ask for more sites"};
  const std::vector<LineEdge> lines = line_edges(model);
  const CvtDomain domain{model.points, model.triangles, {}, lines};
  const NearestTriangle to_model({model.points, model.triangles});
  const std::size_t asked = sites.size();
  std::optional<Attempt> best;  // the valid one with the fewest cells too far away
  std::size_t best_sites = 0;
  MergeOptions merge = options.merge;
  merge.unmerged_sites.assign(sites.size(), 0);
  for (std::int64_t round = 0, flawed = 0, idle = 0;; ++round) {
    SiteNeighbours neighbours;
    neighbours.move_to(sites);
    const RestrictedDiagram diagram = restrict_to_triangles(model.points, model.triangles, neighbours);
    Result<Attempt> made = attempt(model, diagram, sites.size(), options, merge);
    if (!made) return made.failure();
    if (options.is_cancelled && options.is_cancelled())
      return Failure{FailureCode::cancelled, "cancelled", "run again to go on"};
    const std::string flaw = made->flaw;
    std::vector<std::uint32_t> poor = made->bad_sites;
    if (flaw.empty()) {
      if (options.wanted_distance_m > 0)
        poor = made->far_sites = far_sites(to_model, diagram, made->dual, options.wanted_distance_m);
      // Adding sites pays as long as a tenth of the far cells goes.
      idle = best && 10 * poor.size() > 9 * best->far_sites.size() ? idle + 1 : 0;
      if (!best || poor.size() < best->far_sites.size()) {
        best = std::move(*made);
        best_sites = sites.size();
      }
    } else if (++flawed > 1) {  // what a further site did not mend is not merged any more
      for (const std::uint32_t site : poor) merge.unmerged_sites[site] = 1;
    }
    const std::size_t before = sites.size();
    if (round < options.rounds && idle < 3) add_sites(diagram, poor, sites, merge.unmerged_sites);
    if (sites.size() == before && best) break;
    if (sites.size() == before)
      return Failure{FailureCode::geometry_failed,
                     "after " + std::to_string(round) + " rounds of adding sites the dual is still not valid: " + flaw,
                     "ask for more sites, another d_resolution_m, or preserve = \"all\""};
    // What is good stays: only sites around the poor cells move.
    std::vector<char> fixed = away_from(diagram, poor, before, model.triangles.size());
    fixed.resize(sites.size(), 0);
    sites = optimise_sites(domain, std::move(sites), fixed, options.reoptimise).sites;
  }

  RemeshedAtResolution result;
  result.added_sites = best_sites - asked;
  result.merged_points = best->merged_points;
  result.ball_failures = best->ball_failures.size();
  for (const ElementChange& change : best->changes)
    result.changes.push_back({std::string(to_string(change.element)) + "_" + std::string(to_string(change.kind)),
                              describe(change, model, best->built.model),
                              "smaller than a cell, or nearer than d_resolution_m"});
  if (!best->far_sites.empty())
    result.changes.push_back({"far_from_input", std::to_string(best->far_sites.size()) + " cells",
                              "the rounds of adding sites did not bring the mesh nearer"});
  RemeshGuardedOptions guarded;
  guarded.target_edge_length_m = options.edge_length_m;
  guarded.distance_ratio = options.distance_ratio;
  guarded.is_cancelled = options.is_cancelled;
  Result<RemeshGuardedResult> evened = remesh_guarded(best->built.model, guarded);
  if (!evened) return evened.failure();
  result.evened = std::move(*evened);
  return result;
}

}  // namespace strataflow
