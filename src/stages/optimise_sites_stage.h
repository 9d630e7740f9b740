#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/built_model.h"
#include "model/site_set.h"

namespace strataflow {

/// How many sites a model gets, and where they crowd: shared by the stages of [remesh].
struct SiteOptions {
  std::optional<std::int64_t> sites{};
  std::optional<double> target_edge_length_m{};
  std::map<std::string, double> entity_edge_length_m{};
  std::string density = "uniform";
  std::optional<std::string> density_property{};
  std::int64_t lloyd_iterations = 5;
  std::int64_t iterations = 100;
  std::optional<double> line_attraction{};
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(sites, OptionField{.name = "sites",
                             .description = "Number of sites on all surfaces but the box, which gets as many more as "
                                            "the same spacing takes; absent: 10000, or what target_edge_length_m asks",
                             .minimum = 4,
                             .maximum = 1e8});
    visit(target_edge_length_m, OptionField{.name = "target_edge_length_m",
                                            .description = "Instead of sites: the mean length of edges",
                                            .minimum = 0,
                                            .exclusive_minimum = true});
    visit(entity_edge_length_m,
          OptionField{.name = "entity_edge_length_m",
                      .description = "Length of edges on the surfaces of single entities, by name: { H1 = 50.0 }",
                      .minimum = 0,
                      .exclusive_minimum = true});
    visit(density, OptionField{.name = "density",
                               .description = "Where sites crowd: nowhere, near corners or lines as (1 - d / d_max)^4, "
                                              "where surfaces bend, or by a property of the input's points",
                               .words = {"uniform", "corners", "lines", "curvature", "property"}});
    visit(density_property,
          OptionField{.name = "density_property", .description = "The property's name, if density is property"});
    visit(lloyd_iterations, OptionField{.name = "lloyd_iterations",
                                        .description = "Steps to the centroids of the cells before the optimisation",
                                        .minimum = 0,
                                        .maximum = 10000});
    visit(iterations, OptionField{.name = "iterations",
                                  .description = "Quasi-Newton steps of the optimisation of sites, at most",
                                  .minimum = 0,
                                  .maximum = 100000});
    visit(line_attraction, OptionField{.name = "line_attraction",
                                       .description = "Weight of what draws sites onto lines against their even "
                                                      "spread; absent: both pull alike at the start",
                                       .minimum = 0,
                                       .maximum = 0.999});
  }
};

/// How many sites [remesh] asks for on this model, at which spacing.
struct SitePlan {
  double edge_length_m = 0;
  std::size_t sites = 0;         ///< on all surfaces but the box
  std::size_t sites_on_box = 0;  ///< further ones, on the surfaces of role boundary
  std::vector<double> surface_edge_length_m;  ///< per surface; empty: the same everywhere
};

/// n = 2 A / (√3 L²) sites make equilateral triangles of edge L on an area A. Fails with invalid_input when the model
/// has no area or no entity of a name in entity_edge_length_m.
Result<SitePlan> plan_sites(const StructuralModel& model, const SiteOptions& options);

/// Spreads sites over all surfaces of a model as a centroidal Voronoi tessellation (pellerin2014 §2.4, 2.5).
struct OptimiseSites {
  static constexpr std::string_view name = "optimise_sites";
  static constexpr int version = 1;
  static constexpr bool uses_seed = true;
  SiteOptions options;

  Result<SiteSet> operator()(const BuiltModel& built, StageContext& context) const;
};

}  // namespace strataflow
