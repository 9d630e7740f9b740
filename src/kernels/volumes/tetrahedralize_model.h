#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/cancellation.h"
#include "base/option_field.h"
#include "base/result.h"
#include "model/structural_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// How the regions are filled. Surfaces are kept as they are: quality and sizes act on interior points only.
struct TetrahedralizeOptions {
  std::optional<double> radius_edge_ratio;             ///< ≥ 1.1; absent: tetrahedra only conform
  std::optional<double> min_dihedral_deg;              ///< [0, 20]; absent: no bound
  std::optional<double> max_volume_m3;                 ///< > 0; absent: no bound
  std::map<std::string, double> region_max_volume_m3;  ///< by region name, > 0; overrides max_volume_m3
  std::string split_surfaces = "auto";                 ///< auto, never
  double timeout_s = 300;                              ///< > 0
  std::int64_t memory_limit_mb = 8192;                 ///< ≥ 64

  std::optional<double> max_volume_in(const std::string& region) const {
    const auto own = region_max_volume_m3.find(region);
    return own != region_max_volume_m3.end() ? own->second : max_volume_m3;
  }

  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(radius_edge_ratio, OptionField{.name = "radius_edge_ratio",
                                         .description = "Largest ratio of circumradius to shortest edge; absent: the "
                                                        "tetrahedra only conform to the surfaces",
                                         .minimum = 1.1});
    visit(min_dihedral_deg, OptionField{.name = "min_dihedral_deg",
                                        .description = "Smallest dihedral angle to aim at inside regions",
                                        .minimum = 0,
                                        .maximum = 20});
    visit(max_volume_m3, OptionField{.name = "max_volume_m3",
                                     .description = "Largest volume of a tetrahedron",
                                     .minimum = 0,
                                     .exclusive_minimum = true});
    visit(region_max_volume_m3, OptionField{.name = "region_max_volume_m3",
                                            .description = "Largest volume of a tetrahedron by region name; overrides "
                                                           "max_volume_m3 there",
                                            .minimum = 0,
                                            .exclusive_minimum = true});
    visit(split_surfaces, OptionField{.name = "split_surfaces",
                                      .description = "Whether points may be inserted on surfaces of a region that "
                                                     "cannot be filled otherwise; they are listed in the changes",
                                      .words = {"auto", "never"}});
    visit(timeout_s, OptionField{.name = "timeout_s",
                                 .description = "Time limit for each region and attempt",
                                 .minimum = 0,
                                 .exclusive_minimum = true});
    visit(memory_limit_mb,
          OptionField{.name = "memory_limit_mb", .description = "Address space of each worker process", .minimum = 64});
  }
};

/// Fills every region of `model` with tetrahedra that have each triangle of each surface, dangling ones included, as
/// a face. Regions are filled one by one, in child processes side by side, and share their surface meshes exactly;
/// each is verified (faces, exact orientations, volume to 1e-9) before it is taken. Points: the model's first, with
/// their indices, then points inserted on surfaces (rare, listed in `changes`), then those inside regions, region by
/// region; cells region by region; facets in the order of the model's triangles.
/// A time-out is a failure and never the reason for another attempt: the outcome must not depend on the machine.
/// `worker`: the program that runs TetGen; empty: tet_worker beside the running program.
/// Fails with: invalid_options, invalid_input (no regions), geometry_failed, timed_out, cancelled.
Result<VolumeMesh> tetrahedralize_model(const StructuralModel& model, const TetrahedralizeOptions& options = {},
                                        const CancellationToken* cancellation = nullptr,
                                        const std::filesystem::path& worker = {});

}  // namespace strataflow
