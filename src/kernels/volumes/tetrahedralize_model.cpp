#include "kernels/volumes/tetrahedralize_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "base/child_process.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/volumes/fill_regions.h"
#include "kernels/volumes/improve_cells.h"
#include "kernels/volumes/merge_regions.h"

namespace strataflow {

namespace {

std::optional<Failure> check(const StructuralModel& model, const TetrahedralizeOptions& options) {
  const auto bad = [](std::string what, std::string remedy) {
    return Failure{FailureCode::invalid_options, std::move(what), std::move(remedy)};
  };
  if (options.radius_edge_ratio && !(*options.radius_edge_ratio >= 1.1))
    return bad("radius_edge_ratio must be at least 1.1", "raise it; 1.4 is a good mesh, 2 an easy one");
  if (options.min_dihedral_deg && !(*options.min_dihedral_deg >= 0 && *options.min_dihedral_deg <= 20))
    return bad("min_dihedral_deg must lie in [0, 20]", "change it");
  if (options.max_volume_m3 && !(*options.max_volume_m3 > 0)) return bad("max_volume_m3 must be > 0", "raise it");
  if (!(options.timeout_s > 0)) return bad("timeout_s must be > 0", "raise it");
  if (options.memory_limit_mb < 64) return bad("memory_limit_mb must be at least 64", "raise it");
  if (options.split_surfaces != "auto" && options.split_surfaces != "never")
    return bad("split_surfaces must be auto or never", "change it");
  for (const auto& [name, volume] : options.region_max_volume_m3) {
    if (!(volume > 0)) return bad("region_max_volume_m3 of '" + name + "' must be > 0", "raise it");
    const auto is_named = [&wanted = name](const Region& region) { return region.name == wanted; };
    if (std::any_of(model.regions.begin(), model.regions.end(), is_named)) continue;
    std::string known;
    for (const Region& region : model.regions) known += (known.empty() ? "" : ", ") + region.name;
    return bad("region_max_volume_m3 names a region '" + name + "' that the model does not have",
               "known regions: " + known);
  }
  constexpr double most_cells = 1e8;  // more than any machine holds; faces are counted in 31 bits (tet_faces.h)
  for (const Region& region : model.regions) {
    const std::optional<double> largest = options.max_volume_in(region.name);
    if (largest && region.volume_m3 > most_cells * *largest)
      return bad("the largest volume asked for makes more than 100 million tetrahedra of region '" + region.name + "'",
                 "raise max_volume_m3 or region_max_volume_m3");
  }
  if (model.regions.empty())
    return Failure{FailureCode::invalid_input, "the model encloses no region",
                   "close its surfaces: strataflow check names the leaks"};
  return std::nullopt;
}

/// Makes the worst dihedral angles of a region better, without its surfaces. What cannot be verified is left as it was.
void improve(const RegionBoundary& boundary, double volume_m3, double min_dihedral_deg, RegionMesh& mesh) {
  ImprovableCells cells = improvable_cells(boundary, mesh);
  cells.measure = TetMeasure::smallest_sine;
  cells.worth_a_point = std::sin(min_dihedral_deg * std::numbers::pi / 180);
  cells.good_enough = 2 * cells.worth_a_point;
  improve_cells(cells);
  auto verdict = verified_region_mesh(boundary, cells.points, cells.tets, volume_m3);
  if (RegionMesh* better = std::get_if<RegionMesh>(&verdict)) mesh = std::move(*better);
}

}  // namespace

Result<VolumeMesh> tetrahedralize_model(const StructuralModel& model, const TetrahedralizeOptions& options,
                                        const CancellationToken* cancellation, const std::filesystem::path& worker) {
  if (auto problem = check(model, options)) return *problem;
  Result<FilledRegions> filled = fill_regions(model, options, AttemptPlan{},
                                              worker.empty() ? program_folder() / "tet_worker" : worker, cancellation);
  if (!filled) return filled.failure();
  if (options.min_dihedral_deg)
    parallel_ranges(model.regions.size(), 1, [&](std::size_t r, std::size_t) {
      improve(filled->boundaries[r], model.regions[r].volume_m3, *options.min_dihedral_deg, filled->meshes[r]);
    });
  return merged_regions(model, std::move(*filled));
}

}  // namespace strataflow
