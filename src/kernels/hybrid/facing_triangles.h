#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// Two triangles of surfaces that face each other across a region, corner by corner: the cell dual to the segment of a
/// Voronoi edge between the two places where it pierces them (pellerin2014 §2.11.4).
struct FacingPair {
  std::uint32_t region = 0;
  Triangle bottom{};                         ///< its normal points into the region
  Triangle top{};                            ///< top[k] faces bottom[k]; the same point where the surfaces meet
  std::array<std::uint32_t, 2> triangles{};  ///< of the model: bottom's and top's
  static constexpr bool is_flat = true;
};

/// Pairs of triangles of the same three sites, and those of them that are no cells.
struct FacingCounts {
  std::uint64_t pairs = 0;     ///< that make a cell
  std::uint64_t turned = 0;    ///< whose corners go round the same way seen from both sides
  std::uint64_t inverted = 0;  ///< not positive at every corner
  std::uint64_t flat = 0;      ///< positive, but with a scaled Jacobian below 1e-3
  std::uint64_t unequal = 0;   ///< triangles left alone because others of the same sites made a pair
  template <class A>
  void archive(A& a) {
    a(pairs, turned, inverted, flat, unequal);
  }
};

/// Finds for every region the pairs of triangles whose corners have the same sites and that enclose a prism, pyramid
/// or tetrahedron positive at all corners (exactly). `point_site`: per point of the model, no_index for none. Each side
/// of a triangle is in one pair at most; where several fit, the lowest wins. Ascending by region, then by triangle.
std::vector<FacingPair> find_facing_triangles(const StructuralModel& model,
                                              const std::vector<std::uint32_t>& point_site, FacingCounts& counts);

}  // namespace strataflow
