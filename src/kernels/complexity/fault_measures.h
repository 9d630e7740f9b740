#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernels/complexity/contact_wedges.h"
#include "model/structural_model.h"

namespace strataflow {

/// How a quantity is spread along lines, weighted by length. All zero where there is nothing to measure.
struct LengthDistribution {
  double length_m = 0;
  double minimum = 0, q50 = 0, q90 = 0, maximum = 0, mean = 0;
  static constexpr bool is_flat = true;
};

/// Values and the lengths they hold for, in any order.
LengthDistribution distribution_of(std::vector<std::pair<double, double>> values_and_lengths);

/// What one fault does to the layers (pellerin2014 §5, wanted for chapter 3).
struct FaultMeasures {
  std::string name;
  double area_m2 = 0;
  double strike_deg = 0;  ///< azimuth of the mean plane, clockwise from +y, the plane dipping to the right; [0, 360)
  double dip_deg = 0;     ///< of the mean plane; [0, 90]
  std::vector<std::string> horizons;  ///< horizons and unconformities that meet it, in the order of the model
  /// Layers it cuts or ends in: one more than the horizons that meet it, since each of them separates two.
  std::uint32_t layers_affected = 0;
  /// Height between the two cut-offs of one horizon, at the same place along strike. 0 where a horizon passes through.
  LengthDistribution throw_m;
  /// Horizon traces with no cut-off of the same horizon on the other side, as far as the fault's sampling tells.
  double unmatched_m = 0;
  LengthDistribution horizon_angle_deg;  ///< acute, between the fault and horizons along their contacts
  std::vector<std::string> faults;       ///< that meet it
  LengthDistribution fault_angle_deg;
  double free_border_m = 0;  ///< length of border that ends inside a region
  template <class A>
  void archive(A& a) {
    a(name, area_m2, strike_deg, dip_deg, horizons, layers_affected, throw_m, unmatched_m, horizon_angle_deg, faults,
      fault_angle_deg, free_border_m);
  }
};

/// All faults together.
struct FaultNetworkMeasures {
  std::uint32_t faults = 0;
  std::uint32_t contacts = 0;  ///< pairs of faults that meet
  std::uint32_t dying = 0;     ///< faults with a free border
  double contact_length_m = 0;
  double smallest_angle_deg = 0;       ///< between two faults that meet; 0 if none do
  /// 1 − largest eigenvalue of the mean of n nᵀ over the faults' triangles by area: 0 all parallel, 2/3 all directions.
  double orientation_variation = 0;
  template <class A>
  void archive(A& a) {
    a(faults, contacts, dying, contact_length_m, smallest_angle_deg, orientation_variation);
  }
};

struct FaultReport {
  std::vector<FaultMeasures> faults;  ///< entities with the role fault that have surfaces, in the order of the model
  FaultNetworkMeasures network;
  template <class A>
  void archive(A& a) {
    a(faults, network);
  }
};

/// Throws compare cut-offs by their place along the strike of the fault's mean plane, so they mean most for faults that
/// are not strongly bent; of several cut-offs on the other side the one of the same horizon that is nearest counts.
FaultReport measure_faults(const StructuralModel& model, const EdgeTable& edges);

}  // namespace strataflow
