#pragma once
#include <cstdint>
#include <vector>

#include "kernels/intersection/triangle_pair.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Two triangles that meet in more than their shared vertices or edge.
struct IntersectingPair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;  ///< > first
  PairMeeting meeting = PairMeeting::crossing;
};

/// Every pair of triangles that meet improperly, exactly and ascending: rule A4 of euler1999 §3, equal to testing all
/// pairs by brute force. Points are welded; triangles of zero area are left out (they are violations of their own).
/// Near-linear in the number of triangles, parallel, independent of the schedule.
std::vector<IntersectingPair> find_intersections(const std::vector<Vec3>& points,
                                                 const std::vector<Triangle>& triangles);

/// The same pairs, restricted to those with a triangle marked in `is_changed`: what to ask after a local change.
std::vector<IntersectingPair> find_intersections_of(const std::vector<Vec3>& points,
                                                    const std::vector<Triangle>& triangles,
                                                    const std::vector<char>& is_changed);

/// Whether a triangle has zero area, decided exactly.
bool is_degenerate(const std::vector<Vec3>& points, const Triangle& triangle);

}  // namespace strataflow
