#pragma once
#include <cstdint>
#include <vector>

#include "kernels/complexity/box_elements.h"
#include "kernels/topology/building/edge_table.h"
#include "model/structural_model.h"

namespace strataflow {

/// How wide a surface is at its border.
struct WidthSample {
  std::uint32_t surface = 0;
  std::uint32_t line = 0;
  double length_m = 0;  ///< of the border the sample stands for
  double width_m = 0;   ///< infinite: more than was looked for, or only the box beyond
};

/// Width = length of the walk over the surface that starts across its border and goes straight, unfolded from triangle
/// to triangle, until it meets a border again (pellerin2014 §2.10b). Samples lie `spacing_m` or less apart along every
/// line that is not the box's; walks end at `reach_m`. By line, edge, half-edge.
std::vector<WidthSample> sample_surface_width(const StructuralModel& model, const BoxElements& box,
                                              const EdgeTable& edges, double spacing_m, double reach_m);

}  // namespace strataflow
