#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// One step of an optimisation of sites.
struct CvtStep {
  double energy = 0;         ///< (1 − α) quantization + α attraction of lines, m⁴
  double gradient_norm = 0;  ///< of that energy, m³; 0 where the step was Lloyd's, which does not need it
  static constexpr bool is_flat = true;
};

/// Sites of a centroidal Voronoi tessellation restricted to a model, and how they came about.
struct SiteSet {
  Vec3 local_origin;
  std::vector<Vec3> sites;          ///< metres relative to local_origin; near the surfaces, not on them
  std::uint64_t sites_on_box = 0;   ///< of these: those that the box adds to the number asked for
  double edge_length_m = 0;         ///< between neighbours, where the density is even
  double line_attraction = 0;       ///< α as used
  std::vector<CvtStep> lloyd_steps, newton_steps;
  std::uint64_t evaluations = 0;    ///< of the restricted diagram
  std::uint64_t replanted = 0;      ///< sites that had lost their cells
  std::string stopped_by;
  template <class A>
  void archive(A& a) {
    a(local_origin, sites, sites_on_box, edge_length_m, line_attraction, lloyd_steps, newton_steps, evaluations,
      replanted, stopped_by);
  }
};

}  // namespace strataflow
