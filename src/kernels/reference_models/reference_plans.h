#pragma once
#include <memory>
#include <string_view>

#include "kernels/reference_models/column_model.h"

namespace strataflow {

/// A1 … A6 of pellerin2014 §4.2: a cylindrical anticline of three horizons, 1600 × 930 × 500 m, and its faults.
/// `name` must be one of them.
std::unique_ptr<ColumnModel> anticline_model(std::string_view name);
/// B: a fault leaves a flat décollement (H2) at 15°, steepens and stops inside the top layer.
std::unique_ptr<ColumnModel> fault_propagation_fold();
/// C: two flat horizons over a folded one (U); the lower ends on it.
std::unique_ptr<ColumnModel> onlap_on_fold();
/// D: a diapir through three layers of a 120 m cube. It reaches the bottom of the box.
std::unique_ptr<ColumnModel> diapir();

/// 1 at 0, smoothly down to 0 at ±1 and beyond: (1 − u²)².
constexpr double bump(double u) {
  const double inside = 1 - u * u;
  return inside > 0 ? inside * inside : 0.0;
}

}  // namespace strataflow
