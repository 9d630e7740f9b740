#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/hybrid/fill_hybrid.h"
#include "model/built_model.h"
#include "model/validity_report.h"
#include "stages/remesh_stage.h"

namespace strataflow {

/// Options of [hybrid], shared by its stages.
struct HybridOptions {
  std::optional<std::int64_t> sites{};
  std::optional<double> target_edge_length_m{};
  std::map<std::string, double> entity_edge_length_m{};
  std::map<std::string, double> region_edge_length_m{};
  std::string preserve = "all";
  double thin_ratio = 1.0;
  std::int64_t layers_through_thin = 1;
  std::int64_t iterations = 100;
  std::optional<std::int64_t> interior_sites{};
  std::optional<double> radius_edge_ratio{};
  std::optional<double> max_volume_m3{};
  std::map<std::string, double> region_max_volume_m3{};
  double timeout_s = 300;

  SiteOptions site_options() const {
    SiteOptions options;
    options.sites = sites;
    options.target_edge_length_m = target_edge_length_m;
    options.entity_edge_length_m = entity_edge_length_m;
    return options;
  }
  TetrahedralizeOptions fill_options() const {
    TetrahedralizeOptions options;
    options.radius_edge_ratio = radius_edge_ratio;
    options.max_volume_m3 = max_volume_m3;
    options.region_max_volume_m3 = region_max_volume_m3;
    options.timeout_s = timeout_s;
    return options;
  }

  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(sites, OptionField{.name = "sites",
                             .description = "Number of sites on all surfaces but the box, which gets as many more as "
                                            "the same spacing takes; surfaces on both sides of a thin layer have "
                                            "theirs in common. Absent: 10000, or what target_edge_length_m asks",
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
    visit(region_edge_length_m,
          OptionField{.name = "region_edge_length_m",
                      .description = "Length of edges on all surfaces around single regions, by name; where several "
                                     "lengths are asked for the shortest counts",
                      .minimum = 0,
                      .exclusive_minimum = true});
    visit(preserve,
          OptionField{.name = "preserve",
                      .description = "What the surfaces keep: all corners, lines, surfaces and regions, or what "
                                     "the sites leave of them, every change told",
                      .words = {"all", "resolution"}});
    visit(thin_ratio, OptionField{.name = "thin_ratio",
                                  .description = "Layers thinner than this many edges are thin: their two surfaces get "
                                                 "the same triangles, with prisms between",
                                  .minimum = 0,
                                  .maximum = 1.5});
    visit(layers_through_thin, OptionField{.name = "layers_through_thin",
                                           .description = "Number of prisms through the thickness of a thin layer",
                                           .minimum = 1,
                                           .maximum = 1000});
    visit(iterations, OptionField{.name = "iterations",
                                  .description = "Quasi-Newton steps of the optimisation of sites, at most",
                                  .minimum = 0,
                                  .maximum = 100000});
    visit(interior_sites, OptionField{.name = "interior_sites",
                                      .description = "Number of sites inside all regions together, beside the thin "
                                                     "layers; 0: none. Absent: as many as the edges of the surfaces "
                                                     "around each region ask for",
                                      .minimum = 0,
                                      .maximum = 1e8});
    visit(radius_edge_ratio, OptionField{.name = "radius_edge_ratio",
                                         .description = "Largest ratio of circumradius to shortest edge of tetrahedra "
                                                        "beside the thin layers; absent: they only conform",
                                         .minimum = 1.1});
    visit(max_volume_m3, OptionField{.name = "max_volume_m3",
                                     .description = "Largest volume of a tetrahedron beside the thin layers",
                                     .minimum = 0,
                                     .exclusive_minimum = true});
    visit(region_max_volume_m3, OptionField{.name = "region_max_volume_m3",
                                            .description = "The same by region name; overrides max_volume_m3 there",
                                            .minimum = 0,
                                            .exclusive_minimum = true});
    visit(timeout_s, OptionField{.name = "timeout_s",
                                 .description = "Time limit for each region and attempt",
                                 .minimum = 0,
                                 .exclusive_minimum = true});
  }
};

/// Remeshes all surfaces of a sealed model as the dual of cells that thin layers have in common (pellerin2014 §2.11.1),
/// keeping all corners, lines, surfaces and regions. The soup's property "site" says which points face each other.
/// Where that dual is not valid after sites were added, the surfaces are remeshed as `Remesh` does, without common
/// sites.
struct RemeshHybrid {
  static constexpr std::string_view name = "remesh_hybrid";
  static constexpr int version = 3;
  static constexpr bool uses_seed = true;
  HybridOptions options;

  Result<RemeshedSurfaces> operator()(const BuiltModel& built, const ValidityReport& validity,
                                      StageContext& context) const;
};

/// Fills the regions of remeshed surfaces with prisms between triangles that face each other, pyramids and tetrahedra
/// (pellerin2014 §2.11).
struct FillHybrid {
  static constexpr std::string_view name = "fill_hybrid";
  static constexpr int version = 3;
  HybridOptions options;

  Result<HybridMesh> operator()(const BuiltModel& surfaces, const ValidityReport& validity,
                                StageContext& context) const;
};

/// The cells of a hybrid mesh alone, for what works on any volume mesh.
struct TakeHybridCells {
  static constexpr std::string_view name = "take_hybrid_cells";
  static constexpr int version = 1;
  NoOptions options;

  Result<VolumeMesh> operator()(const HybridMesh& hybrid, StageContext& context) const;
};

}  // namespace strataflow
