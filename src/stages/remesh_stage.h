#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/quality/analyze_surface_mesh.h"
#include "kernels/quality/hausdorff_distance.h"
#include "kernels/quality/topology_invariants.h"
#include "model/built_model.h"
#include "model/validity_report.h"
#include "stages/optimise_sites_stage.h"

namespace strataflow {

/// Triangles below 5° that stay, with the reason.
struct KeptTriangle {
  std::uint32_t triangle = 0;  ///< of the remeshed soup
  double smallest_angle_deg = 0;
  std::uint8_t touches_small_feature = 0;  ///< else: every step that would mend it was refused
  std::array<std::uint8_t, 3> zero{};      // no padding: the bytes are digested
  static constexpr bool is_flat = true;
};

/// Surfaces at a chosen resolution, one patch per surface they came from.
struct RemeshedSurfaces {
  TriangleSoup soup;
  double edge_length_m = 0;                                             ///< asked for, where no entity has its own
  std::uint64_t sites_asked = 0;                                        ///< on surfaces but the box
  std::uint64_t added_sites = 0, merged_points = 0, ball_failures = 0;  ///< where the dual of cells was taken
  std::uint64_t splits = 0, collapses = 0, flips = 0, moves = 0;
  std::vector<KeptTriangle> kept;
  std::vector<Change> changes;
  template <class A>
  void archive(A& a) {
    a(soup, edge_length_m, sites_asked, added_sites, merged_points, ball_failures, splits, collapses, flips, moves,
      kept, changes);
  }
};

struct RemeshStageOptions {
  SiteOptions sites;
  std::string preserve = "all";
  std::string method = "auto";
  std::optional<double> d_resolution_m;
  double hausdorff_ratio = 0.0015;
  bool uses_cells() const { return method == "cells" || preserve == "resolution"; }
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    sites.visit_fields(visit);
    visit(preserve, OptionField{.name = "preserve",
                                .description = "What the mesh keeps: all corners, lines, surfaces and regions, or what "
                                               "the resolution leaves of them, every change told",
                                .words = {"all", "resolution"}});
    visit(method,
          OptionField{.name = "method",
                      .description = "How: by steps from the input's triangles, or as the dual of Voronoi cells; "
                                     "auto: steps if all is to be kept, cells otherwise",
                      .words = {"auto", "steps", "cells"}});
    visit(d_resolution_m, OptionField{.name = "d_resolution_m",
                                      .description = "With preserve = resolution: what lies nearer together is merged",
                                      .minimum = 0,
                                      .exclusive_minimum = true});
    visit(hausdorff_ratio, OptionField{.name = "hausdorff_ratio",
                                       .description = "How far input and mesh may lie apart, in diagonals of the model",
                                       .minimum = 0,
                                       .maximum = 0.1,
                                       .exclusive_minimum = true});
  }
};

/// Remeshes all surfaces of a sealed model at a chosen resolution by steps from the input's triangles, each of which
/// keeps all and leaves the mesh valid.
struct Remesh {
  static constexpr std::string_view name = "remesh";
  static constexpr int version = 6;
  RemeshStageOptions options;

  Result<RemeshedSurfaces> operator()(const BuiltModel& built, const ValidityReport& validity,
                                      StageContext& context) const;
};

/// The same as the dual of the cells of sites (pellerin2014 chapter 4), which are added until the dual is valid, near
/// the input and, if asked, keeps all. Where all is to be kept and the dual does not get there, `Remesh` takes over.
struct RemeshByCells {
  static constexpr std::string_view name = "remesh_by_cells";
  static constexpr int version = 6;
  RemeshStageOptions options;

  Result<RemeshedSurfaces> operator()(const BuiltModel& built, const ValidityReport& validity, const SiteSet& sites,
                                      StageContext& context) const;
};

/// The structural model of remeshed surfaces, with the regions' names.
struct BuildSurfaces {
  static constexpr std::string_view name = "build_surfaces";
  static constexpr int version = 1;
  NoOptions options;

  Result<BuiltModel> operator()(const RemeshedSurfaces& remeshed, StageContext& context) const;
};

/// How remeshed surfaces compare with those they came from.
struct SurfacesReport {
  SurfaceMeshReport before, after;
  ModelTopology topology_before, topology_after;
  HausdorffDistance hausdorff;
  std::vector<EntityDistance> by_entity;
  template <class A>
  void archive(A& a) {
    a(before, after, topology_before, topology_after, hausdorff, by_entity);
  }
};

/// Measures remeshed surfaces and holds them against the model. Fails with geometry_failed when, though all was to be
/// preserved, a corner, line, surface or region is gone or new: such a mesh is not written.
struct CompareSurfaces {
  static constexpr std::string_view name = "compare_surfaces";
  static constexpr int version = 3;
  struct Options {
    bool must_preserve_all = true;
    template <class Visitor>
    void visit_fields(Visitor& visit) {
      visit(must_preserve_all, OptionField{.name = "must_preserve_all",
                                           .description = "Fail on a lost or new entity; follows from preserve",
                                           .is_internal = true});
    }
  };
  Options options;

  Result<SurfacesReport> operator()(const BuiltModel& before, const BuiltModel& after, StageContext& context) const;
};

}  // namespace strataflow
