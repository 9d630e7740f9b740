#include "stages/remesh_stage.h"

#include "kernels/remeshing/guarded/remesh_guarded.h"
#include "kernels/remeshing/interpolate_properties.h"
#include "kernels/remeshing/remesh_at_resolution.h"
#include "kernels/topology/building/build_structural_model.h"
#include "stages/check_validity_stage.h"

namespace strataflow {

namespace {

/// Samples of distances a triangle may take on average. Where meshes are as fine as one another ten do.
constexpr std::uint64_t samples_per_triangle = 20;

RemeshedSurfaces surfaces_of(const StructuralModel& model, RemeshGuardedResult result) {
  RemeshedSurfaces remeshed;
  remeshed.soup = std::move(result.soup);
  remeshed.soup.properties = interpolate_properties(model, remeshed.soup.points);
  remeshed.splits = result.report.splits;
  remeshed.collapses = result.report.collapses;
  remeshed.flips = result.report.flips;
  remeshed.moves = result.report.moves;
  for (const BadTriangle& bad : result.report.bad_triangles)
    remeshed.kept.push_back({bad.triangle, bad.smallest_angle_deg,
                             static_cast<std::uint8_t>(bad.reason == BadTriangleReason::touches_small_feature), {}});
  return remeshed;
}

/// The first corner, line, surface, region or contact that is gone or new.
std::optional<Failure> why_not_preserved(const SurfaceMeshReport& before, const SurfaceMeshReport& after) {
  std::string what;
  const auto count = [&](std::uint64_t was, std::uint64_t is, const char* elements) {
    if (was != is && what.empty())
      what = std::to_string(was) + " " + elements + " became " + std::to_string(is);
  };
  if (const std::vector<Change> contacts = contact_changes(before, after); !contacts.empty())
    what = contacts.front().what;
  count(before.corners, after.corners, "corners");
  count(before.lines, after.lines, "lines");
  count(before.surfaces, after.surfaces, "surfaces");
  count(before.regions, after.regions, "regions");
  if (what.empty()) return {};
  return Failure{FailureCode::geometry_failed, "remeshing changed what it was to preserve: " + what,
                 "this is a defect of the remesher: please report the model; preserve = \"resolution\" allows it"};
}

}  // namespace

Result<RemeshedSurfaces> Remesh::operator()(const BuiltModel& built, const ValidityReport& validity,
                                            StageContext& context) const {
  if (std::optional<Failure> failure = why_not_sealed(built.model, validity)) return *failure;
  const Result<SitePlan> plan = plan_sites(built.model, options.sites);
  if (!plan) return plan.failure();
  RemeshGuardedOptions guarded;
  guarded.target_edge_length_m = plan->edge_length_m;
  guarded.surface_edge_length_m = plan->surface_edge_length_m;
  guarded.distance_ratio = options.hausdorff_ratio;
  guarded.is_cancelled = [&] { return context.is_cancelled(); };
  Result<RemeshGuardedResult> result = remesh_guarded(built.model, guarded);
  if (!result) return result.failure();
  RemeshedSurfaces remeshed = surfaces_of(built.model, std::move(*result));
  remeshed.edge_length_m = plan->edge_length_m;
  remeshed.sites_asked = plan->sites;
  return remeshed;
}

Result<RemeshedSurfaces> RemeshByCells::operator()(const BuiltModel& built, const ValidityReport& validity,
                                                   const SiteSet& sites, StageContext& context) const {
  if (std::optional<Failure> failure = why_not_sealed(built.model, validity)) return *failure;
  RemeshAtResolutionOptions dual;
  // Only what lies nearer than d_resolution_m is merged: merging all that one cell sees moves borders by half a cell.
  dual.merge.merges_linked_corners = dual.merge.merges_beyond_two_points = false;
  dual.merge.follows_bends = true;
  dual.merge.resolution_m = options.d_resolution_m.value_or(0);
  dual.merge.most_move_m =
      std::max(options.hausdorff_ratio * built.model.box.diagonal_m(), options.d_resolution_m.value_or(0));
  dual.must_keep_all = options.preserve == "all";
  dual.edge_length_m = sites.edge_length_m;
  dual.distance_ratio = 0.5 * options.hausdorff_ratio;
  dual.wanted_distance_m = dual.merge.most_move_m;
  // Few steps: more would spread again what was put where it is needed.
  dual.reoptimise.lloyd_iterations = 2;
  dual.reoptimise.iterations = std::min<std::size_t>(6, static_cast<std::size_t>(options.sites.iterations));
  dual.reoptimise.line_attraction = sites.line_attraction;
  dual.is_cancelled = dual.reoptimise.is_cancelled = [&] { return context.is_cancelled(); };
  Result<RemeshedAtResolution> result = remesh_at_resolution(built.model, sites.sites, dual);
  if (!result && result.failure().code == FailureCode::geometry_failed) {
    // Steps that start from the input's triangles cannot fail: what they cannot improve stays.
    context.warn("kept_triangulation", result.failure().what + "; remeshed by steps from the input's triangles instead");
    Result<RemeshedSurfaces> kept = Remesh{options}(built, validity, context);
    if (kept && !dual.must_keep_all)
      kept->changes.push_back({"nothing_merged", "all corners, lines and surfaces are kept", result.failure().what});
    return kept;
  }
  if (!result) return result.failure();
  RemeshedSurfaces remeshed = surfaces_of(built.model, std::move(result->evened));
  remeshed.added_sites = result->added_sites;
  remeshed.merged_points = result->merged_points;
  remeshed.ball_failures = result->ball_failures;
  remeshed.changes = std::move(result->changes);
  remeshed.edge_length_m = sites.edge_length_m;
  remeshed.sites_asked = sites.sites.size() - sites.sites_on_box;
  return remeshed;
}

Result<BuiltModel> BuildSurfaces::operator()(const RemeshedSurfaces& remeshed, StageContext&) const {
  return build_structural_model(remeshed.soup);
}

Result<SurfacesReport> CompareSurfaces::operator()(const BuiltModel& before, const BuiltModel& after,
                                                   StageContext& context) const {
  SurfacesReport report;
  const auto is_cancelled = [&] { return context.is_cancelled(); };
  report.before = analyze_surface_mesh(before.model);
  report.after = analyze_surface_mesh(after.model);
  if (options.must_preserve_all)
    if (std::optional<Failure> failure = why_not_preserved(report.before, report.after)) return *failure;
  report.topology_before = topology_of(before.model);
  report.topology_after = topology_of(after.model);
  const std::uint64_t triangles = before.model.triangles.size() + after.model.triangles.size();
  Result<HausdorffDistance> distance = hausdorff_distance(
      {before.model.points, before.model.triangles}, {after.model.points, after.model.triangles},
      {.error_ratio = 3e-4, .samples = samples_per_triangle * triangles, .is_cancelled = is_cancelled});
  if (!distance) return distance.failure();
  report.hausdorff = *distance;
  Result<std::vector<EntityDistance>> by_entity = hausdorff_by_entity(
      before.model, after.model,
      {.error_ratio = 1e-3, .samples = triangles, .is_cancelled = is_cancelled});
  if (!by_entity) return by_entity.failure();
  report.by_entity = std::move(*by_entity);
  return report;
}

}  // namespace strataflow
