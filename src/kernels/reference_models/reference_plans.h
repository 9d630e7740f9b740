#pragma once
#include <cmath>
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
/// Five layers whose thickness varies strongly, 8 m at the thinnest, 2000 × 1500 × 600 m (pellerin2014 §4.1 X16).
std::unique_ptr<ColumnModel> variable_layers();
/// Classes of pellerin2014 Table 4.1: fourteen thin steep veins through a horizon (10.2 × 1.3 × 0.28 km); thin layers
/// that end on a basin at grazing angles (110 × 65 × 40 m); 33 listric faults through eight horizons as in a model of
/// sand (3.5 × 3 × 0.5 km).
std::unique_ptr<ColumnModel> veins();
std::unique_ptr<ColumnModel> onlap();
std::unique_ptr<ColumnModel> sandbox();
/// 24 faults with small throws that cross, abut and die out in four horizons (12 × 10.3 × 1.7 km). It has no raw
/// surfaces.
std::unique_ptr<ColumnModel> fault_network();
/// Shapes like machine parts, curved and sharp (pellerin2014 §4.1 X16), one entity per kind of face: a plate with an
/// upright, a rib and four holes, 200 × 120 × 100 m; a hub with a bore and seven twisted blades, 80 m long. They have
/// no raw surfaces.
std::unique_ptr<ColumnModel> bracket();
std::unique_ptr<ColumnModel> impeller();

/// 1 at 0, smoothly down to 0 at ±1 and beyond: (1 − u²)².
constexpr double bump(double u) {
  const double inside = 1 - u * u;
  return inside > 0 ? inside * inside : 0.0;
}

/// 0 at multiples of 2, smooth, between −1 and 1: a sine made of the four operations, the same on every machine.
inline double wave(double u) {
  const double turn = u - 2 * std::floor(u / 2), half = turn < 1 ? turn : turn - 1;
  return (turn < 1 ? 4 : -4) * half * (1 - half);
}

}  // namespace strataflow
