#include "stages/optimise_sites_stage.h"

#include <algorithm>
#include <cmath>

#include "kernels/voronoi/line_edges.h"
#include "kernels/voronoi/optimise_sites.h"
#include "kernels/voronoi/sample_sites.h"
#include "kernels/voronoi/site_density.h"

namespace strataflow {

namespace {

constexpr double default_sites = 10000;

DensityKind density_kind(const std::string& word) {
  if (word == "corners") return DensityKind::near_corners;
  if (word == "lines") return DensityKind::near_lines;
  if (word == "curvature") return DensityKind::curvature;
  return word == "property" ? DensityKind::property : DensityKind::uniform;
}

}  // namespace

Result<SitePlan> plan_sites(const StructuralModel& model, const SiteOptions& options) {
  std::vector<double> area(model.surfaces.size(), 0);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const Vec3& a = model.points[model.triangles[t][0]];
    area[model.triangle_surface[t]] +=
        0.5 * length(cross(model.points[model.triangles[t][1]] - a, model.points[model.triangles[t][2]] - a));
  }
  SitePlan plan;
  std::vector<double> own(model.surfaces.size(), 0);
  for (const auto& [name, edge] : options.entity_edge_length_m) {
    bool is_known = false;
    for (std::size_t s = 0; s < model.surfaces.size(); ++s)
      for (const std::uint32_t entity : model.surfaces[s].all_entities)
        if (model.entities[entity].name == name) {
          own[s] = own[s] > 0 ? std::min(own[s], edge) : edge;
          is_known = true;
        }
    if (!is_known)
      return Failure{FailureCode::invalid_input, "remesh.entity_edge_length_m names '" + name + "', which has no surface",
                     "use the names that `strataflow check` prints"};
  }
  const auto is_box = [&](std::size_t s) { return model.entities[model.surfaces[s].entity].role == Role::boundary; };
  double inner = 0, box = 0;  // areas of what has no edge length of its own
  double inner_sites = 0, box_sites = 0;  // of what has
  const double per_area = 2 / std::sqrt(3.0);
  bool has_inner = false;
  for (std::size_t s = 0; s < area.size(); ++s) {
    has_inner = has_inner || !is_box(s);
    double& sum = own[s] > 0 ? (is_box(s) ? box_sites : inner_sites) : (is_box(s) ? box : inner);
    sum += own[s] > 0 ? per_area * area[s] / (own[s] * own[s]) : area[s];
  }
  if (!has_inner) {  // nothing but a box: it counts
    std::swap(inner, box);
    std::swap(inner_sites, box_sites);
  }
  if (!(inner + box + inner_sites + box_sites > 0))
    return Failure{FailureCode::invalid_input, "the model's surfaces have no area", "check the input"};
  if (options.target_edge_length_m) {
    plan.edge_length_m = *options.target_edge_length_m;
  } else {
    const double asked = options.sites ? static_cast<double>(*options.sites) : default_sites;
    const double left = std::max(asked - inner_sites, 4.0);
    plan.edge_length_m = std::sqrt(per_area * (inner > 0 ? inner : box) / left);
  }
  const double square = plan.edge_length_m * plan.edge_length_m;
  plan.sites = static_cast<std::size_t>(std::llround(std::max(per_area * inner / square + inner_sites, 1.0)));
  plan.sites_on_box = static_cast<std::size_t>(std::llround(per_area * box / square + box_sites));
  if (plan.sites + plan.sites_on_box > 100000000)
    return Failure{FailureCode::invalid_input, "remesh.target_edge_length_m asks for more than 100 million sites",
                   "ask for longer edges"};
  if (!options.entity_edge_length_m.empty()) {
    plan.surface_edge_length_m = own;
    for (double& edge : plan.surface_edge_length_m)
      if (!(edge > 0)) edge = plan.edge_length_m;
  }
  return plan;
}

Result<SiteSet> OptimiseSites::operator()(const BuiltModel& built, StageContext& context) const {
  const StructuralModel& model = built.model;
  const Result<SitePlan> plan = plan_sites(model, options);
  if (!plan) return plan.failure();
  const Result<std::vector<double>> density =
      site_density(model, {.kind = density_kind(options.density),
                           .property = options.density_property.value_or(""),
                           .surface_edge_length_m = plan->surface_edge_length_m,
                           .edge_length_m = plan->edge_length_m});
  if (!density) return density.failure();

  // Sites are drawn in proportion to the square root of the density: the spacing that a tessellation of it ends with.
  std::vector<double> crowding = *density;
  for (double& value : crowding) value = std::sqrt(value);
  const std::size_t count = plan->sites + plan->sites_on_box;
  const std::vector<LineEdge> lines = line_edges(model);
  OptimisedSites optimised = optimise_sites(
      {model.points, model.triangles, *density, lines},
      sample_sites(model.points, model.triangles, crowding, count, context.seed()), {},
      {.lloyd_iterations = static_cast<std::size_t>(options.lloyd_iterations),
       .iterations = static_cast<std::size_t>(options.iterations),
       .line_attraction = options.line_attraction,
       .is_cancelled = [&] { return context.is_cancelled(); }});
  if (context.is_cancelled()) return Failure{FailureCode::cancelled, "cancelled", "run again to go on"};

  SiteSet set;
  set.local_origin = model.local_origin;
  set.sites = std::move(optimised.sites);
  set.sites_on_box = plan->sites_on_box;
  set.edge_length_m = plan->edge_length_m;
  set.line_attraction = optimised.line_attraction;
  set.lloyd_steps = std::move(optimised.lloyd_steps);
  set.newton_steps = std::move(optimised.newton_steps);
  set.evaluations = optimised.evaluations;
  set.replanted = optimised.replanted_sites;
  set.stopped_by = std::move(optimised.stopped_by);
  return set;
}

}  // namespace strataflow
