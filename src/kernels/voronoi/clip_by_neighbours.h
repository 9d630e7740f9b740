#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/voronoi/site_neighbours.h"
#include "model/vector3.h"

namespace strataflow {

constexpr double half_ulp = 0x1.0p-53;
/// Times the reach of a piece: a site farther from the owner than twice the reach comes nearer to no point of it.
constexpr double security = 2 * (1 + 1e-6);
/// Weights this many times their error place a corner to within `security`.
constexpr double well_known = 1e8;

inline double squared_distance(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return dot(d, d);
}

/// Clips the piece of a cell by the bisectors of its owner with all sites that may cut it, nearest first: `reach()` is
/// the distance of the owner to the piece's farthest point, `clip(site)` says whether the piece became smaller,
/// `is_empty()` ends it, `is_beside(site)` whether the piece already ends at that site's bisector. False: nothing is left.
template <class Reach, class Clip, class IsEmpty, class IsBeside>
bool clip_by_neighbours(const SiteNeighbours& neighbours, std::uint32_t owner, std::vector<NearSite>& beyond,
                        Reach&& reach, Clip&& clip, IsEmpty&& is_empty, IsBeside&& is_beside) {
  double trusted = security * reach() + neighbours.slack();
  const auto clip_all = [&](std::span<const NearSite> others, const auto& is_done) {  // whether the rest is too far
    for (const NearSite& other : others) {
      if (other.distance > trusted) return true;
      if (is_done(other)) continue;
      if (!clip(other.site)) continue;
      if (is_empty()) return true;
      trusted = security * reach() + neighbours.slack();
    }
    return false;
  };
  const auto near = neighbours.near(owner);
  const bool is_settled = clip_all(near, [](const NearSite&) { return false; }) || neighbours.lists_hold_all();
  if (!is_settled) {
    neighbours.find_within(owner, security * reach(), beyond);
    clip_all(beyond, [&](const NearSite& other) {
      return other.distance < near.back().distance || is_beside(other.site);
    });
  }
  return !is_empty();
}

}  // namespace strataflow
