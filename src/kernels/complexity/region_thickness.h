#pragma once
#include <cstdint>
#include <vector>

#include "kernels/complexity/box_elements.h"
#include "model/structural_model.h"

namespace strataflow {

/// How thick a region is below one side of a triangle.
struct ThicknessSample {
  std::uint32_t triangle = 0;
  std::uint32_t is_positive = 0;  ///< the side looked from
  std::uint32_t region = 0;       ///< the region looked into
  Vec3 point;
  double area_m2 = 0;      ///< of the surface the sample stands for
  double thickness_m = 0;  ///< infinite: more than was looked for, or only the box beyond
  /// The surface on the other side shares a line with this one: the region is thin because it ends there.
  std::uint32_t is_wedge = 0;
};

struct ThicknessOptions {
  double spacing_m = 5;           ///< largest distance between neighbouring samples, > 0
  double reach_m = 10;            ///< how far to look, > 0
  std::uint64_t most = 4'000'000;  ///< samples a side; more than that: `spacing_m` grows
};

struct ThicknessSamples {
  std::vector<ThicknessSample> samples;  ///< by triangle, side, place
  double spacing_m = 0;                  ///< the one used
};

/// Thickness = length of the inward normal ray from the boundary of a region to its first meeting with the boundary
/// again (pellerin2014 §2.10b). Each triangle is cut into rows along its longest edge and the rows into pieces, none
/// longer or higher than the spacing; the middle of each is a sample. The box neither sends rays nor stops them: where a layer meets it is no geology.
ThicknessSamples sample_region_thickness(const StructuralModel& model, const BoxElements& box,
                                         const ThicknessOptions& options);

}  // namespace strataflow
