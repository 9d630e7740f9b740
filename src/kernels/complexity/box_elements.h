#pragma once
#include <cstdint>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// Which surfaces, lines and corners belong to the box around the volume of interest rather than to the geology. No
/// complexity measure counts them (pellerin2014 §2.10).
struct BoxElements {
  std::vector<char> surfaces, lines, corners;
};

/// A surface is the box's if one of its features has the role boundary; where no feature of the model has it, if the
/// universe lies on one side only. A line or corner is the box's if one of its surfaces is.
BoxElements find_box_elements(const StructuralModel& model);

/// How many there are, without the box's (pellerin2014 §2.10a).
struct ElementCounts {
  std::uint64_t regions = 0, surfaces = 0, lines = 0, corners = 0;
  std::uint64_t total() const { return regions + surfaces + lines + corners; }
  template <class A>
  void archive(A& a) {
    a(regions, surfaces, lines, corners);
  }
};

ElementCounts count_elements(const StructuralModel& model, const BoxElements& box);

}  // namespace strataflow
