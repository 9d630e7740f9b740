#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A contact the user names: the borders of one entity end on another, even if the gap is larger than elsewhere.
struct NamedContact {
  std::string entity;  ///< whose borders stop short
  std::string onto;    ///< what they should reach
  double distance_m = 0;
};

struct ExtendBordersOptions {
  double distance_m = 0;                    ///< gaps up to this are closed
  std::vector<NamedContact> contacts = {};  ///< gaps closed up to their own distance
  double margin_ratio = 0.25;               ///< how far past the contact a border goes, as a share of the gap …
  double edge_margin_ratio = 0.05;          ///< … and at least this share of its edge: contacts bend between points
};

/// A gap between the free border of an entity and the surface it should reach.
struct BorderGap {
  std::uint32_t entity = 0;
  std::uint32_t onto = 0;
  double largest_m = 0;
  Vec3 where;                    ///< on the border, where the gap is largest
  std::uint64_t edge_count = 0;  ///< border edges that stop short
};

/// Finds where free borders stop short: edges with one triangle from which, going on in the plane of that triangle, a
/// surface of another entity is met within the distance and not at a grazing angle (less than about 1°). Ordered by
/// entity, then by what it should reach. Fails with invalid_options for a name that is no entity.
Result<std::vector<BorderGap>> find_gaps(const TriangleSoup& soup, const ExtendBordersOptions& options);

struct ExtendedBorders {
  TriangleSoup soup;
  std::vector<BorderGap> gaps;
  std::uint64_t moved_points = 0;
  double largest_move_m = 0;
};

/// Moves free borders that stop short past what they should reach: each border point in the plane of its border
/// triangles, mitred where the border turns, so that a clean cut makes the contact and `trim_overshoot` takes what is
/// beyond (the near contacts of euler1999 §2.4, with triple points left to the exact cut). The end of a slit (where the
/// border turns back) stays, so a fault that dies inside a horizon goes on dying there. Border triangles are deformed;
/// a move that would turn one over is shortened.
Result<ExtendedBorders> extend_borders(const TriangleSoup& soup, const ExtendBordersOptions& options);

}  // namespace strataflow
