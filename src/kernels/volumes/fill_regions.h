#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/cancellation.h"
#include "base/result.h"
#include "kernels/volumes/region_attempt.h"
#include "kernels/volumes/region_boundary.h"
#include "kernels/volumes/region_mesh.h"
#include "kernels/volumes/tetrahedralize_model.h"
#include "model/structural_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// What is tried on each region, in this order.
struct AttemptPlan {
  std::vector<RegionAttempt> keeping = attempts_keeping_surfaces();
  std::vector<RegionAttempt> splitting = attempts_splitting_surfaces();
};

/// The regions of a model, each filled, on common surfaces.
struct FilledRegions {
  SurfaceTriangles surfaces;
  std::vector<RegionBoundary> boundaries;  ///< per region
  std::vector<RegionMesh> meshes;          ///< per region
  std::vector<Change> changes;             ///< attempts that failed, points inserted; by region, then order of work
};

/// Fills every region with the first attempt of the plan that can be verified. Regions on which all attempts that
/// keep surfaces fail are filled with points inserted on their surfaces; neighbours get the same points and are
/// filled again, until nothing changes. Fails as tetrahedralize_model.
Result<FilledRegions> fill_regions(const StructuralModel& model, const TetrahedralizeOptions& options,
                                   const AttemptPlan& plan, const std::filesystem::path& worker,
                                   const CancellationToken* cancellation);

/// One cavity filled, or every attempt that could not be verified.
struct FilledCavity {
  std::optional<RegionMesh> mesh;
  std::vector<std::string> rejected;
};

/// Fills what `boundary` encloses, `volume_m3`, with tetrahedra that keep each of its facets, which need not be a whole
/// region's. `name` stands in failures. Fails with timed_out, cancelled, or geometry_failed when there is no worker;
/// that no attempt succeeds is an outcome.
Result<FilledCavity> fill_cavity(const RegionBoundary& boundary, const std::string& name, double volume_m3,
                                 const TetrahedralizeOptions& options, const std::filesystem::path& worker,
                                 const CancellationToken* cancellation);

}  // namespace strataflow
