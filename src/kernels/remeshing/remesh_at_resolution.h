#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "kernels/remeshing/dual/component_points.h"
#include "kernels/remeshing/guarded/remesh_guarded.h"
#include "kernels/voronoi/optimise_sites.h"
#include "model/structural_model.h"
#include "model/triangle_soup.h"
#include "model/volume_mesh.h"

namespace strataflow {

struct RemeshAtResolutionOptions {
  MergeOptions merge;                ///< what may become one
  bool must_keep_all = false;        ///< a lost, merged, split or new element is a flaw like any other
  std::int64_t rounds = 10;          ///< ≥ 0: of adding sites where the mesh is not valid yet, or too far away
  double wanted_distance_m = 0;      ///< sites are added also where input and dual lie farther apart; 0: nowhere
  OptimiseSitesOptions reoptimise;   ///< after sites were added
  double edge_length_m = 0;          ///< > 0: for evening out the dual
  double distance_ratio = 0.001;     ///< how far evening out may move it, in diagonals of the model
  std::function<bool()> is_cancelled = {};
};

struct RemeshedAtResolution {
  RemeshGuardedResult evened;    ///< a patch per surface of the dual's model; what evening it out did
  std::vector<Change> changes;   ///< every element lost, merged, split or created, and why
  std::uint64_t added_sites = 0;
  std::uint64_t merged_points = 0;
  std::uint64_t ball_failures = 0;  ///< cells and surfaces for which the topological ball property fails
};

/// The surfaces of a model as the dual of the components of restricted Voronoi cells, what lies below the resolution
/// merged (pellerin2014 chapter 4): points, polygons, clean-up; where the result is not a valid, sealed model (or not all is kept, if asked), sites are
/// added to the cells concerned and all are optimised again. What then is valid is evened out by steps that keep it so.
/// Fails with geometry_failed, naming the first flaw, when the rounds do not suffice; where only the wanted distance is
/// not reached the change `far_from_input` says so.
Result<RemeshedAtResolution> remesh_at_resolution(const StructuralModel& model, std::vector<Vec3> sites,
                                                  const RemeshAtResolutionOptions& options);

}  // namespace strataflow
