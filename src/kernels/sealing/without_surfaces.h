#pragma once
#include <cstdint>
#include <vector>

#include "model/structural_model.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Sum of the areas of a surface's triangles.
double area_m2(const StructuralModel& model, const Surface& surface);

/// The soup without the triangles of some surfaces of the model that was built from it. Triangles are recognised by
/// the positions of their corners, so every copy goes.
TriangleSoup without_surfaces(const TriangleSoup& soup, const StructuralModel& model,
                              const std::vector<std::uint32_t>& surfaces);

}  // namespace strataflow
