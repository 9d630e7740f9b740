#pragma once
#include <optional>

#include "kernels/drawing/scene.h"
#include "model/structural_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

enum class ColourBy : std::uint8_t { entity, region };

/// Cells whose centroid lies on the side of the plane that `normal` points to are taken away.
struct CutPlane {
  Vec3 point;
  Vec3 normal;
};

/// The upright plane through the middle of `mesh`, across x or y, that opens the half towards an eye at `azimuth_deg`
/// (as in ViewOptions).
CutPlane middle_cut(const VolumeMesh& mesh, double azimuth_deg);

/// All surfaces and lines of a model. By region, a surface has the colour of the region behind it, so that a closed
/// model looks solid.
Scene scene_of_model(const StructuralModel& model, ColourBy colour_by);

/// Every region inside its own copy of its surfaces, coloured by region and moved away from the middle of the model by
/// `factor` ≥ 0 times its distance from there.
Scene scene_of_exploded_regions(const StructuralModel& model, double factor = 0.4);

/// The outer faces of the cells that `cut` leaves, coloured by region (by cell type when the mesh has no regions).
/// Bold lines: where two colours meet, and the rims of the surfaces the mesh's facets name.
Scene scene_of_volume_mesh(const VolumeMesh& mesh, const std::optional<CutPlane>& cut = std::nullopt);

}  // namespace strataflow
