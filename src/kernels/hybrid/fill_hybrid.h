#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/cancellation.h"
#include "base/result.h"
#include "kernels/hybrid/improve_cells.h"
#include "kernels/hybrid/thin_zone.h"
#include "kernels/volumes/tetrahedralize_model.h"
#include "model/structural_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// One region of a hybrid mesh.
struct HybridRegion {
  std::uint64_t tetrahedra = 0, pyramids = 0, prisms = 0;
  double volume_m3 = 0, prism_volume_m3 = 0;
  template <class A>
  void archive(A& a) {
    a(tetrahedra, pyramids, prisms, volume_m3, prism_volume_m3);
  }
};

/// Where the cells and points of a hybrid mesh come from, and what was not possible (pellerin2014 §3 rules H7, H8).
struct HybridReport {
  std::uint64_t cells_from_voronoi = 0;  ///< between facing triangles: duals of segments of Voronoi edges
  std::uint64_t cells_from_fill = 0;     ///< tetrahedra in what is left
  FacingCounts facing;                   ///< candidates, and those that are no cells
  DroppedPairs dropped;                  ///< of facing.pairs, by cause
  std::uint64_t surface_points = 0, layer_points = 0, centre_points = 0, apex_points = 0, fill_points = 0;
  /// Of prisms, base edge to height.
  double min_anisotropy_ratio = 0, mean_anisotropy_ratio = 0, max_anisotropy_ratio = 0;
  CellImprovement improvement;        ///< of all regions; its added points are fill points
  std::vector<HybridRegion> regions;  ///< as in the model
  template <class A>
  void archive(A& a) {
    a(cells_from_voronoi, cells_from_fill, facing, dropped, surface_points, layer_points, centre_points, apex_points,
      fill_points, min_anisotropy_ratio, mean_anisotropy_ratio, max_anisotropy_ratio, improvement,
      regions);
  }
};

struct HybridMesh {
  VolumeMesh mesh;
  HybridReport report;
  template <class A>
  void archive(A& a) {
    a(mesh, report);
  }
};

struct FillHybridOptions {
  std::int64_t layers_through_thin = 1;  ///< ≥ 1: prisms from surface to surface
  TetrahedralizeOptions fill{};          ///< of what no cell between facing triangles fills
};

/// Fills every region of `model` with prisms, pyramids and tetrahedra between triangles that face each other with the
/// same sites, and what is left with tetrahedra that keep all surfaces, the worst of which are made better
/// (improve_cells); every step verified (pellerin2014 §2.11, §5 (ii)). Where a region cannot be filled around its prisms it is filled without, which is counted. Points: the
/// model's first; then region by region those of layers, of middles, of the fill. Cells region by region.
/// `point_site`: per point of the model, no_index for none.
/// Fails as tetrahedralize_model.
Result<HybridMesh> fill_hybrid(const StructuralModel& model, const std::vector<std::uint32_t>& point_site,
                               const FillHybridOptions& options = {}, const CancellationToken* cancellation = nullptr,
                               const std::filesystem::path& worker = {});

}  // namespace strataflow
