#pragma once
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// How two triangles of a welded mesh meet, beyond what neighbours may share.
enum class PairMeeting : std::uint8_t {
  proper,    ///< not at all, or exactly in their shared vertex or edge
  touching,  ///< in points or edges only: a contact whose two sides are not triangulated alike
  crossing   ///< one passes through the other, or they overlap in a common plane (identical triangles too)
};

/// Decides exactly how triangles `first` and `second` meet (euler1999 §3 rule A4, pellerin2014 §3 rule I2).
/// Points are welded: equal positions have equal indices. Neither triangle may have zero area.
PairMeeting meeting_of(const std::vector<Vec3>& points, const Triangle& first, const Triangle& second);

}  // namespace strataflow
