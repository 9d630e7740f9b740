#include "stages/extrude_stage.h"

#include "kernels/hexes/audit/audit_hexes.h"

namespace strataflow {

Result<ExtrudedHexes> Extrude::operator()(const LayeredSpace& space, const MeshedQuads& plan,
                                          StageContext& context) const {
  Result<ExtrudedHexes> hexes = extrude_hexes(space, plan.mesh);
  if (hexes && hexes->report.unreached > 0)
    context.warn("unreached_corners", std::to_string(hexes->report.unreached) +
                                          " corners on faults took the nearest tetrahedron for their side");
  if (hexes && hexes->report.bridged > 0)
    context.warn("bridged_levels", std::to_string(hexes->report.bridged) +
                                       " vertices beside faults that need not be followed lie evenly between horizons, "
                                       "up to " +
                                       OptionPrinter::literal(hexes->report.largest_bridged_m) +
                                       " m from where their layers are");
  return hexes;
}

Result<SmoothedHexes> SmoothHexes::operator()(const LayeredSpace& space, const ExtrudedHexes& hexes,
                                              StageContext&) const {
  SmoothedHexes smoothed{hexes, {}};
  SmoothHexesOptions smoothing;
  smoothing.sweeps = options.smoothing_sweeps;
  Result<HexSmoothing> done = smooth_hexes(smoothed.hexes, space, smoothing);
  if (!done) return done.failure();
  smoothed.smoothing = *done;
  return smoothed;
}

Result<CheckedHexes> CheckHexes::operator()(const SmoothedHexes& smoothed, const LayeredSpace& space,
                                            const MeshedQuads& plan, StageContext& context) const {
  CheckedHexes checked;
  Result<HexAudit> audit = audit_hexes(smoothed.hexes.grid, space.model);
  if (!audit) return audit.failure();
  checked.audit = *std::move(audit);
  checked.live = live_cells(smoothed.hexes.grid);
  checked.singular_vertices = plan.quality.interior_irregular;
  checked.quality = analyze_volume_mesh(checked.live.mesh);
  // The audit knows that layers may close, and that faces on faults need not match.
  const CellDiagnosis& diagnosis = checked.audit.diagnosis;
  checked.quality.inverted = checked.audit.inverted;
  checked.quality.nonconforming_faces = diagnosis.nonconforming_faces.elsewhere;
  checked.quality.min_scaled_jacobian = checked.audit.min_scaled_jacobian;
  checked.quality.mean_scaled_jacobian = checked.audit.mean_scaled_jacobian;
  std::string defects;
  const auto count = [&](std::uint64_t number, const std::string& what) {
    if (number > 0) defects += "\n  " + std::to_string(number) + " " + what;
  };
  count(checked.audit.inverted, "inverted cells");
  count(diagnosis.nonpositive_volumes, "cells without volume that layers do not explain");
  count(diagnosis.nonconforming_faces.elsewhere, "faces away from faults that do not conform");
  if (checked.live.mesh.cell_count() == 0) defects += "\n  no cell has a volume";
  if (!defects.empty())
    return Failure{FailureCode::geometry_failed, "the hexahedra are not valid:" + defects,
                   "ask for shorter hex.edge_length_m, more hex.smoothing_sweeps, or name a fault that leans far in "
                   "hex.drop_alignment"};
  for (const RegionVolumeAudit& region : checked.audit.regions)
    if (!region.is_within)
      context.warn("region_volume", "region " + region.name + " has " + OptionPrinter::literal(region.grid_m3) +
                                        " m3 of cells, the model " + OptionPrinter::literal(region.model_m3) +
                                        "; shorter edges come nearer");
  return checked;
}

Result<VolumeMesh> TakeHexCells::operator()(const CheckedHexes& hexes, StageContext&) const { return hexes.live.mesh; }

}  // namespace strataflow
