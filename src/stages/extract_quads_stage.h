#pragma once
#include <string>
#include <vector>

#include "kernels/quads/extraction/quad_quality.h"
#include "kernels/quads/extraction/smooth_quads.h"
#include "model/quad_mesh.h"
#include "stages/quantize_stage.h"

namespace strataflow {

/// Quads and how good they are.
struct MeshedQuads {
  QuadMesh mesh;
  QuadQuality quality;
  double scaled_jacobian_before = 0;     ///< the smallest before smoothing
  std::vector<std::string> missing;      ///< features_not_followed()
  std::string why_subdivided;            ///< the failure that the fallback stands in for; empty: quads of the map
  std::vector<std::string> imprinted{};  ///< curves laid into quads that the map does not align with them
  std::vector<std::uint32_t> created{};  ///< irregular points inside that come of that, not of the field
  template <class A>
  void archive(A& a) {
    a(mesh, quality, scaled_jacobian_before, missing, why_subdivided, imprinted, created);
  }
};

/// [quad]: quads.
struct ExtractQuadsOptions {
  std::int64_t smoothing_rounds = 30;
  QuadFallback fallback;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit_own(visit);
    fallback.visit_fields(visit);
  }
  template <class Visitor>
  void visit_own(Visitor& visit) {
    visit(smoothing_rounds, OptionField{.name = "smoothing_rounds",
                                        .description = "Passes of smoothing, at most; 0: none",
                                        .minimum = 0,
                                        .maximum = 10000});
  }
};

/// Quads of a grid-preserving map, smoothed with all features kept; curves that the map does not follow are laid into
/// them and every quad is divided once (imprint_curves). Fails if a feature is missing, a quad is inverted
/// or a value is not finite: never a silently wrong mesh.
struct ExtractQuads {
  static constexpr std::string_view name = "extract_quads";
  static constexpr int version = 2;
  ExtractQuadsOptions options;

  Result<MeshedQuads> operator()(const FeatureMesh& problem, const Attempt<GridMapping>& grid,
                                 StageContext& context) const;
};

}  // namespace strataflow
