#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

struct SharedSitesOptions {
  std::vector<double> surface_edge_length_m;  ///< per surface, > 0
  std::vector<double> crowding = {};          ///< per point, in proportion to sites per area; empty: 1 everywhere
  double thin_ratio = 0.75;  ///< ≥ 0: what is thinner than this many edges has common sites; 0.8 is where a
                             ///< tessellation of two sheets stops being at rest with them
  std::uint64_t seed = 1;
};

/// Where sites start so that surfaces that face each other across thin layers get common ones.
struct SharedSites {
  std::vector<Vec3> sites;
  std::vector<char> is_on_box;  ///< per site: all it stands for are surfaces of role boundary
  std::vector<std::vector<std::uint32_t>>
      stacks;                       ///< per site: the surfaces of its sheets, ascending; empty for one sheet
  std::uint64_t across_layers = 0;  ///< sites that stand for two sheets and more
  std::vector<char> is_pinned;      ///< per site: it stays where it is; those beyond the end move
};

/// Draws `count` points on all surfaces (sample_sites), looks from each along the normal of its triangle, both ways,
/// for sheets it faces across regions, and takes together those that lie within thin_ratio edges of one another,
/// nearest first. One sheet of each such stack keeps its points, moved to the middle of the stack; the points of the
/// others are left out, so fewer than `count` sites come back where there are thin layers.
SharedSites draw_shared_sites(const StructuralModel& model, std::size_t count, const SharedSitesOptions& options);

}  // namespace strataflow
