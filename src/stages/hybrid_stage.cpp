#include "stages/hybrid_stage.h"

#include <algorithm>
#include <cmath>

#include "kernels/hybrid/shared_surfaces.h"
#include "kernels/voronoi/site_density.h"
#include "stages/check_validity_stage.h"

namespace strataflow {

namespace {

/// The plan of sites with the lengths of regions in it.
Result<SitePlan> plan_hybrid_sites(const StructuralModel& model, const HybridOptions& options) {
  Result<SitePlan> plan = plan_sites(model, options.site_options());
  if (!plan) return plan;
  std::vector<double>& own = plan->surface_edge_length_m;
  if (own.empty()) own.assign(model.surfaces.size(), plan->edge_length_m);
  for (const auto& [name, edge] : options.region_edge_length_m) {
    bool is_known = false;
    for (const Surface& surface : model.surfaces)
      for (const std::uint32_t region : {surface.region_minus, surface.region_plus}) {
        if (region == universe || model.regions[region].name != name) continue;
        double& length_m = own[static_cast<std::size_t>(&surface - model.surfaces.data())];
        length_m = std::min(length_m, edge);
        is_known = true;
      }
    if (!is_known)
      return Failure{FailureCode::invalid_input, "hybrid.region_edge_length_m names '" + name + "', which is no region",
                     "use the names that `strataflow check` prints"};
  }
  return plan;
}

double sites_for(const StructuralModel& model, const std::vector<double>& edge_length_m) {
  double sites = 0;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const auto& [a, b, c] = model.triangles[t];
    const double edge = edge_length_m[model.triangle_surface[t]];
    sites += length(cross(model.points[b] - model.points[a], model.points[c] - model.points[a])) /
             (std::sqrt(3.0) * edge * edge);
  }
  return sites;
}

/// Draws sites; where a number was asked for, with the spacing at which about that many come about.
Result<SharedSites> draw_sites(const StructuralModel& model, const HybridOptions& options, std::uint64_t seed,
                               SitePlan& plan, std::vector<double>& density) {
  constexpr int most_tries = 6;
  constexpr double near_enough = 0.03;
  double low = 0, high = 0;  // factors that gave too few sites and too many
  double factor = 1;
  const std::vector<double> planned = plan.surface_edge_length_m;
  for (int tries = 1;; ++tries) {
    for (std::size_t s = 0; s < planned.size(); ++s) plan.surface_edge_length_m[s] = factor * planned[s];
    const double count = sites_for(model, plan.surface_edge_length_m);
    if (!(count <= 1e8))
      return Failure{FailureCode::invalid_input, "[hybrid] asks for more than 100 million sites",
                     "ask for longer edges"};
    DensityOptions by_surface;
    by_surface.surface_edge_length_m = plan.surface_edge_length_m;
    by_surface.edge_length_m = factor * plan.edge_length_m;
    const bool is_even = std::all_of(planned.begin(), planned.end(), [&](double e) { return e == plan.edge_length_m; });
    Result<std::vector<double>> dense = is_even ? std::vector<double>{} : site_density(model, by_surface);
    if (!dense) return dense.failure();
    density = std::move(*dense);
    SharedSitesOptions drawing{plan.surface_edge_length_m, density, options.thin_ratio, seed};
    for (double& value : drawing.crowding) value = std::sqrt(value);
    SharedSites shared =
        draw_shared_sites(model, static_cast<std::size_t>(std::llround(std::max(count, 4.0))), drawing);
    if (!options.sites || tries == most_tries) {
      plan.edge_length_m *= factor;
      return shared;
    }
    const auto on_box = static_cast<double>(std::count(shared.is_on_box.begin(), shared.is_on_box.end(), 1));
    const double all = static_cast<double>(shared.sites.size());
    const double got = std::max(on_box < all ? all - on_box : all, 1.0), asked = static_cast<double>(*options.sites);
    if (std::abs(got - asked) <= near_enough * asked) {
      plan.edge_length_m *= factor;
      return shared;
    }
    (got < asked ? high : low) = factor;
    factor *= std::sqrt(got / asked);
    if (low > 0 && high > 0 && !(factor > low && factor < high)) factor = std::sqrt(low * high);
  }
}

}  // namespace

Result<RemeshedSurfaces> RemeshHybrid::operator()(const BuiltModel& built, const ValidityReport& validity,
                                                  StageContext& context) const {
  if (std::optional<Failure> failure = why_not_sealed(built.model, validity)) return *failure;
  Result<SitePlan> plan = plan_hybrid_sites(built.model, options);
  if (!plan) return plan.failure();
  SharedSurfacesOptions sharing;
  Result<SharedSites> shared = draw_sites(built.model, options, context.seed(), *plan, sharing.density);
  if (!shared) return shared.failure();
  sharing.settle.optimise.iterations =
      static_cast<std::size_t>(options.iterations) / std::max<std::size_t>(sharing.settle.rounds, 1);
  sharing.settle.optimise.is_cancelled = [&] { return context.is_cancelled(); };
  sharing.must_keep_all = options.preserve == "all";
  const std::uint64_t drawn = shared->sites.size();
  Result<SharedSurfaces> surfaces = remesh_on_shared_sites(built.model, std::move(*shared), sharing);
  if (!surfaces && surfaces.failure().code == FailureCode::geometry_failed) {
    // Steps that start from the input's triangles cannot fail, but no two sheets get the same triangles that way.
    context.warn("no_common_sites",
                 surfaces.failure().what + "; surfaces are remeshed each for itself, without prisms");
    RemeshStageOptions alone;
    alone.sites = options.site_options();
    return Remesh{alone}(built, validity, context);
  }
  if (!surfaces) return surfaces.failure();
  RemeshedSurfaces remeshed;
  remeshed.soup = std::move(surfaces->soup);
  remeshed.edge_length_m = plan->edge_length_m;
  remeshed.sites_asked = drawn;
  remeshed.added_sites = surfaces->added_sites;
  remeshed.ball_failures = surfaces->ball_failures;
  for (const std::string& change : surfaces->changes)
    remeshed.changes.push_back({"element_change", change, "smaller than a cell"});
  return remeshed;
}

Result<HybridMesh> FillHybrid::operator()(const BuiltModel& surfaces, const ValidityReport& validity,
                                          StageContext& context) const {
  if (std::optional<Failure> failure = why_not_sealed(surfaces.model, validity)) return *failure;
  FillHybridOptions filling;
  filling.layers_through_thin = options.layers_through_thin;
  filling.fill = options.fill_options();
  filling.interior_sites = options.interior_sites;
  Result<HybridMesh> hybrid =
      fill_hybrid(surfaces.model, sites_of_points(surfaces.model), filling, context.cancellation());
  if (hybrid)
    for (const Change& change : hybrid->mesh.changes) context.warn(change.kind, change.what + ": " + change.why);
  return hybrid;
}

Result<VolumeMesh> TakeHybridCells::operator()(const HybridMesh& hybrid, StageContext&) const { return hybrid.mesh; }

}  // namespace strataflow
