#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "kernels/reference_models/column_model.h"

namespace strataflow {

// Models that hexahedra in layers can follow (coudert2024 S8, experiments T1–T9). None has raw surfaces.

/// Three horizons and the first `faults` (0 … 12) of twelve vertical faults that go through, abut (T), cross (X) and
/// die out, 1600 × 1200 × 400 m. All run along lines of a grid, bent if `is_bent`.
std::unique_ptr<ColumnModel> vertical_faults(std::uint32_t faults, bool is_bent);

/// Two horizons and parallel planar faults, one per cotangent of a dip, side by side in a box 2000 × 1000 × 400 m;
/// each drops what lies east of it by `throw_m`.
std::unique_ptr<ColumnModel> dipping_faults(std::span<const double> cot_dips, double throw_m);

/// Two horizons and one fault that dips 80° at the top and 20° at the bottom (T6), 2000 × 1000 × 400 m.
std::unique_ptr<ColumnModel> listric_fault();

/// Tilted horizons H1 … H3 of which the erosion E cuts off H2 and H3 (T8), H4 above, and on demand a steep fault that
/// ends at E; 1600 × 1000 × 540 m.
std::unique_ptr<ColumnModel> unconformity(bool has_fault);

/// Horizons 1 m, 10 cm and 1 cm apart and a vertical fault with a throw of 5 m, 1000 × 1000 × 300 m.
std::unique_ptr<ColumnModel> thin_layers();

}  // namespace strataflow
