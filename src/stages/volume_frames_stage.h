#pragma once
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/cell_field.h"
#include "model/input_data.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// [frames]
struct VolumeFramesOptions {
  double orthogonality = 4.5;
  std::int64_t iterations = 30;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(orthogonality,
          OptionField{.name = "orthogonality",
                      .description = "How strongly frames keep right angles: small lets singular curves go to the "
                                     "boundary, large makes crosses",
                      .minimum = 0});
    visit(iterations,
          OptionField{.name = "iterations", .description = "Diffusion steps, at most", .minimum = 1, .maximum = 1000});
  }
};

/// Tetrahedra with a frame each, and the curves around which frames do not close.
struct FramedMesh {
  VolumeMesh mesh;
  std::vector<CellField> directions;  ///< direction_0 … direction_2: unit vectors per cell
  std::vector<Polyline> singular;     ///< relative to mesh.local_origin
  double energy = 0;
  std::int64_t iterations = 0;
  double smallest_determinant = 1;
  template <class A>
  void archive(A& a) {
    a(mesh, directions, singular, energy, iterations, smallest_determinant);
  }
};

/// A smooth frame field on tetrahedra and its singularity graph (coudert2024 S32, S33). No hexahedra are promised from it.
struct FindVolumeFrames {
  static constexpr std::string_view name = "volume_frames";
  static constexpr int version = 1;
  VolumeFramesOptions options;

  Result<FramedMesh> operator()(const VolumeMesh& mesh, StageContext& context) const;
};

}  // namespace strataflow
