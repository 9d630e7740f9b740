#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Per half-edge 3·triangle + k, the half-edge beyond the edge where exactly two triangles of one patch meet by index;
/// no_index on the borders of patches.
std::vector<std::uint32_t> find_mates(std::size_t point_count, const std::vector<Triangle>& triangles,
                                      const std::vector<std::uint32_t>& triangle_patch);

/// Two lips to be sewn: border half-edges that coincide, of one entity, facing each other.
struct LipPair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;  ///< > first
  double deviation_rad = 0;  ///< from lying in one plane
};

/// Why a lip on a selected split line found no partner.
enum class LipRefusal : std::uint8_t {
  fold,         ///< no other lip within (π/2)/n of its plane
  orientation,  ///< the one in its plane has the opposite normal
  taken,        ///< the ones in its plane found better partners
  pinch         ///< sewing it would glue, by their ends, two other edges that are to stay apart
};

struct RefusedLip {
  std::uint32_t half_edge = 0;
  LipRefusal reason = LipRefusal::fold;
};

struct PairedBorders {
  std::vector<LipPair> pairs;       ///< ascending by first
  std::vector<RefusedLip> refused;  ///< ascending by half-edge
};

/// An edge given by its two ends' positions, in any order.
using EdgePlace = std::array<Vec3, 2>;

/// Pairs border edges that coincide (euler1999 §2.5.1): in a group of n, two lips whose angle differs from π by at most
/// (π/2)/n, the flattest first, ties by half-edge, each at most once. Empty `split_edges`: every place where border
/// edges coincide is a split line. Triangles have three different points.
PairedBorders pair_borders(const TriangleSoup& soup, const std::vector<std::uint32_t>& mates,
                           const std::vector<EdgePlace>& split_edges);

}  // namespace strataflow
