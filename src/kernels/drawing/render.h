#pragma once
#include <cstdint>
#include <optional>

#include "kernels/drawing/image.h"
#include "kernels/drawing/scene.h"

namespace strataflow {

/// An orthographic view of the whole scene.
struct ViewOptions {
  std::uint32_t width = 1200;  ///< pixels, 1 … 8192
  std::uint32_t height = 800;  ///< pixels, 1 … 8192
  double azimuth_deg = -60;    ///< where the eye stands: 0 looks from +x (east), 90 from +y (north)
  double elevation_deg = 30;   ///< 90 looks straight down
  std::optional<double> vertical_exaggeration = std::nullopt;  ///< > 0; absent: automatic_exaggeration
  bool draws_mesh_edges = true;  ///< thin lines; they fade where the mesh is finer than the pixels
  bool draws_lines = true;       ///< the bold lines of the scene
  bool opens_front = false;      ///< leave out outer walls that are seen from outside, to look into the model
  Colour background{255, 255, 255};
};

/// 1 unless the scene is flatter than a quarter of its width; then the largest of 2, 3, 5, 10, 20, … that makes it no
/// higher than that. A picture should state the factor.
double automatic_exaggeration(const Scene& scene);

/// Draws the scene with hidden surfaces removed, four samples a pixel. Of triangles at one depth the first in the list
/// is seen. The same bytes for any schedule.
Image render(const Scene& scene, const ViewOptions& options = {});

}  // namespace strataflow
