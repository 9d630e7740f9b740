#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "model/input_data.h"

namespace strataflow {

/// A made-up fault map for benchmarks and tests.
struct GeneratedNetwork {
  std::string name;  ///< family and number
  std::vector<Polyline> lines;
  std::vector<PointSet> point_sets;
  double edge_length_m = 0;        ///< that suits it
  double smallest_angle_deg = 90;  ///< asked for between curves
};

constexpr std::uint32_t network_family_count = 10;

/// Network `index` of an endless list, the same for ever: families take turns (random faults, fans of acute crossings
/// down to 2°, near misses, ladders of T-junctions, grids of X-crossings, dying tips, closed loops, holes, wells as
/// points, curved faults in a crooked outline), with 1 to 30 faults in a domain of about a kilometre.
GeneratedNetwork generate_network(std::uint32_t index);

}  // namespace strataflow
