#pragma once
#include <cstdint>
#include <span>

#include "base/option_field.h"
#include "base/result.h"
#include "model/feature_mesh.h"
#include "model/structural_model.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Which edges of a surface quads must follow.
struct SurfaceFeatureOptions {
  double edge_length_m = 0;   ///< wanted of quads, metres; 0: a hundredth of the diagonal
  double feature_deg = 40;    ///< edges where the normals differ by more are features
  double corner_deg = 45;     ///< features that turn by more have a corner there
  bool by_label = true;       ///< edges between triangles of different entities are features
  double triangle_ratio = 1;  ///< triangle edges longer than this, in edge lengths, are halved

  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(edge_length_m,
          OptionField{.name = "edge_length_m",
                      .description = "Wanted edge length of quads, metres; 0: a hundredth of the diagonal",
                      .minimum = 0});
    visit(feature_deg, OptionField{.name = "feature_deg",
                                   .description = "Edges where the normals differ by more are features",
                                   .minimum = 1,
                                   .maximum = 180});
    visit(corner_deg, OptionField{.name = "corner_deg",
                                  .description = "Where a feature turns by more it has a corner",
                                  .minimum = 20,
                                  .maximum = 90});
    visit(by_label, OptionField{.name = "by_label", .description = "Whether edges between entities are features"});
    visit(triangle_ratio, OptionField{.name = "triangle_ratio",
                                      .description = "Longer edges of triangles are halved, in edge lengths",
                                      .minimum = 0.1,
                                      .maximum = 1000});
  }
};

/// Any triangulated surface as input of the quad mesher: identical points are welded, triangles oriented coherently,
/// borders, sharp edges and edges between entities become features. Fails with invalid_input where three triangles
/// meet, the surface is pinched or cannot be oriented, or a triangle has no area; names the place.
Result<FeatureMesh> feature_mesh_of_surface(const TriangleSoup& soup, const SurfaceFeatureOptions& options);

/// The same for some surfaces of a model; its lines on them are features and its corners are corners. Where pieces of
/// them touch at a point only, each gets a point of its own.
Result<FeatureMesh> feature_mesh_of_model(const StructuralModel& model, std::span<const std::uint32_t> surfaces,
                                          const SurfaceFeatureOptions& options);

}  // namespace strataflow
