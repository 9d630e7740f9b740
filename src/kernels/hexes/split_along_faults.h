#pragma once
#include <cstdint>
#include <vector>

#include "kernels/hexes/labelled_tets.h"

namespace strataflow {

/// Tetrahedra that let go of each other at faults. Copies are numbered by original point, then by the first
/// tetrahedron that has them.
struct FaultSplit {
  std::vector<Tet> tets;                ///< vertices are copies
  std::vector<std::uint32_t> original;  ///< per copy: its point
};

/// Every point gets as many copies as its star has components when fault facets must not be crossed: one at tips, two
/// beside a fault, more where faults meet (coudert2024 S13a, R7).
FaultSplit split_along_faults(const LabelledTets& tets);

}  // namespace strataflow
