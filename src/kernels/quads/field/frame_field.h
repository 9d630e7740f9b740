#pragma once
#include <cstdint>
#include <string>

#include "base/option_field.h"
#include "base/result.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow {

struct FrameFieldOptions {
  std::string kind = "fast";
  double lambda = 1.5;
  std::int64_t iterations = 10;
  std::int64_t diffusions = 4;
  double cancel_cost = 6;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(kind, OptionField{.name = "field",
                            .description = "fast: crosses in one sparse solve; polynomial: directions that need not be "
                                           "orthogonal (chapter 3 of the thesis); polyvector: for comparison",
                            .words = {"fast", "polynomial", "polyvector"}});
    visit(lambda,
          OptionField{.name = "orthogonality",
                      .description = "How strongly a polynomial field keeps its angle: small lets singular points go "
                                     "to the boundary, large makes crosses",
                      .minimum = 0});
    visit(iterations, OptionField{.name = "field_iterations",
                                  .description = "Diffusion steps of a polynomial field",
                                  .minimum = 0,
                                  .maximum = 1000});
    visit(diffusions, OptionField{.name = "field_diffusions",
                                  .description = "Diffusion steps of a fast field",
                                  .minimum = 0,
                                  .maximum = 1000});
    visit(cancel_cost,
          OptionField{.name = "cancel_cost",
                      .description = "Pairs of singular points cancel when that turns the field by no more than "
                                     "so many right angles, squared and summed along the way between them",
                      .minimum = 0});
  }
};

/// What the report says of a field.
struct FrameFieldReport {
  std::int64_t valence_3 = 0, valence_5 = 0, valence_other = 0;  ///< points inside, off features
  std::int64_t feature_irregular = 0;  ///< points of features, not on the boundary, of valence other than 4
  std::int64_t off_features = 0, spread = 0, cancelled = 0;  ///< field_topology.h
  std::int64_t index_sum = 0, euler = 0;
  std::int64_t iterations = 0;  ///< of the polynomial field
  double energy = 0;            ///< of the polynomial field
  template <class A>
  void archive(A& a) {
    a(valence_3, valence_5, valence_other, feature_irregular, off_features, spread, cancelled, index_sum, euler,
      iterations, energy);
  }
};

struct FrameFieldResult {
  FrameField field;
  FrameFieldReport report;
  template <class A>
  void archive(A& a) {
    a(field, report);
  }
};

/// A frame field whose directions stand on every feature edge, without singular points on features (coudert2024 S5,
/// S11, S30). The mesh comes from separate_features. In the plane or on a curved surface, where neighbours are compared
/// over the edge. Fails with invalid_input for a mesh that is not manifold or not separated, geometry_failed when a
/// compartment has no room for the singular points it needs; both name the place.
Result<FrameFieldResult> compute_frame_field(const FeatureMesh& mesh, const FrameFieldOptions& options = {});

}  // namespace strataflow
