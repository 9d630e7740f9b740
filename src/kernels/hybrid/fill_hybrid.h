#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/cancellation.h"
#include "base/result.h"
#include "kernels/hybrid/thin_zone.h"
#include "kernels/hybrid/vertex_duals.h"
#include "kernels/volumes/improve_cells.h"
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
  std::uint64_t cells_from_segments = 0;  ///< between facing triangles: duals of segments of Voronoi edges
  std::uint64_t cells_from_vertices = 0;  ///< tetrahedra that are duals of Voronoi vertices, at the end
  std::uint64_t cells_from_fill = 0;      ///< other tetrahedra
  std::uint64_t cells_from_voronoi() const { return cells_from_segments + cells_from_vertices; }
  FacingCounts facing;            ///< candidates, and those that are no cells
  DroppedPairs dropped;           ///< of facing.pairs, by cause
  VertexDualCounts vertex_duals;  ///< candidates beside the thin zones, and those that are no cells, before improvement
  std::uint64_t interior_sites_asked = 0;  ///< of the tessellations inside
  std::uint64_t interior_sites = 0;        ///< that are points of the mesh; the others would have made worse cells
  /// With interior_sites, every point of the mesh by its cause.
  std::uint64_t surface_points = 0, layer_points = 0, centre_points = 0, apex_points = 0, fill_points = 0;
  /// Of prisms, base edge to height.
  double min_anisotropy_ratio = 0, mean_anisotropy_ratio = 0, max_anisotropy_ratio = 0;
  CellImprovement improvement;        ///< of all regions; its added points are fill points
  std::vector<HybridRegion> regions;  ///< as in the model
  template <class A>
  void archive(A& a) {
    a(cells_from_segments, cells_from_vertices, cells_from_fill, facing, dropped, vertex_duals, interior_sites_asked,
      interior_sites, surface_points, layer_points, centre_points, apex_points, fill_points, min_anisotropy_ratio,
      mean_anisotropy_ratio, max_anisotropy_ratio, improvement, regions);
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
  /// ≥ 0: sites inside all regions together, shared out by how many the spacing of the surfaces asks for in each.
  /// Absent: as many as that.
  std::optional<std::int64_t> interior_sites{};
  std::int64_t lloyd_iterations = 10;  ///< ≥ 0: of the sites inside
};

/// Fills every region of `model` with prisms, pyramids and tetrahedra between triangles that face each other with the
/// same sites, and what is left with tetrahedra that keep all surfaces, between sites inside that are a centroidal
/// Voronoi tessellation; the worst are made better (improve_cells), every step verified (pellerin2014 §2.11, §5 (ii)).
/// Tetrahedra that are duals of Voronoi vertices are counted as such, the rest as fill. Where a region cannot be filled
/// around its prisms it is filled without, which is counted. Points: the model's first; then region by region those of
/// layers, of middles, of the fill. Cells region by region. `point_site`: per point of the model, no_index for none.
/// Fails as tetrahedralize_model.
Result<HybridMesh> fill_hybrid(const StructuralModel& model, const std::vector<std::uint32_t>& point_site,
                               const FillHybridOptions& options = {}, const CancellationToken* cancellation = nullptr,
                               const std::filesystem::path& worker = {});

}  // namespace strataflow
