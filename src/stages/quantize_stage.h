#pragma once
#include <string>
#include <vector>

#include "stages/seamless_map_stage.h"

namespace strataflow {

/// A grid-preserving map, on the problem's mesh or on a refinement of it.
struct GridMapping {
  FeatureMesh mesh;
  CornerMap map;
  std::uint64_t half_edges = 0;  ///< of the decimated mesh
  std::uint64_t operations = 0;  ///< of the integer optimisation
  std::int64_t doublings = 0;
  double energy_before = 0, energy = 0;
  std::string transfer;                       ///< solve or imprint
  std::vector<std::string> unmet_features{};  ///< that no integers could align, or give their rows
  std::vector<FeatureEdge> loose_edges{};     ///< edges of the mesh that the map does not follow; not in mesh.edges
  template <class A>
  void archive(A& a) {
    a(mesh, map, half_edges, operations, doublings, energy_before, energy, transfer, unmet_features, loose_edges);
  }
};

/// [quad]: integers.
struct QuantizeStageOptions {
  bool coarse = false;
  std::string transfer = "auto";
  QuadFallback fallback;
  FrameFieldOptions field;  ///< as asked for: other fields, where quads would turn over, are variants of it
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit_own(visit);
    fallback.visit_fields(visit);
    field.visit_fields(visit);
  }
  template <class Visitor>
  void visit_own(Visitor& visit) {
    visit(coarse, OptionField{.name = "coarse", .description = "As few quads as a valid map allows"});
    visit(transfer, OptionField{.name = "transfer",
                                .description = "How integers reach the map: solve optimises it once more with them, "
                                               "imprint lays the coarse mesh over it; auto: solve, and imprint if "
                                               "that fails",
                                .words = {"auto", "solve", "imprint"}});
  }
};

/// Whole numbers for the map: quads between features and singular points (coudert2024 S36–S43). Loose features are
/// aligned where the descent can; if some are not, the grid is made half as fine, for imprint_curves divides it once.
struct Quantize {
  static constexpr std::string_view name = "quantize";
  static constexpr int version = 3;
  QuantizeStageOptions options;

  Result<Attempt<GridMapping>> operator()(const FeatureMesh& mesh, const Attempt<FieldAndMap>& seamless,
                                          StageContext& context) const;
};

}  // namespace strataflow
