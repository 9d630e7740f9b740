#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/triangle_soup.h"

namespace strataflow {

struct SimplifyBordersOptions {
  std::int64_t passes = 3;         ///< at most so many; 2 to 3 reach the coarsest common form. ≥ 1
  double corner_angle_deg = 45.0;  ///< (0, 180]; where a contact turns by more, its node stays; 180: stones only
};

/// Why a contact keeps its nodes.
enum class BorderRefusal : std::uint8_t {
  folded,     ///< a triangle beside it would turn over or lose its area
  pinched,    ///< surfaces would meet along other edges, or at other points, than before
  emptied,    ///< a surface would vanish
  crossing,   ///< triangles would cross that did not
  reordered,  ///< the surfaces would follow one another around it in another order (§2.9.5; docs/architecture.md)
  no_gain     ///< the worst triangle beside it would be worse than now
};

struct RefusedBorder {
  Vec3 from, to;  ///< its ends; of a loop, twice its first node
  BorderRefusal reason = BorderRefusal::folded;
};

struct SimplificationReport {
  std::uint64_t border_count = 0;       ///< contacts found at first
  std::uint64_t resampled_borders = 0;  ///< summed over the passes, as all below
  std::uint64_t nodes_before = 0;       ///< inner nodes of the contacts at first
  std::uint64_t nodes_after = 0;
  std::uint64_t relaxed_nodes = 0;
  std::uint64_t passes = 0;            ///< that changed anything
  std::vector<RefusedBorder> refused;  ///< at the last pass
};

struct SimplifiedSoup {
  TriangleSoup soup;  ///< welded: equal positions are one point
  SimplificationReport report;
};

/// Gives the contacts between surfaces the coarsest common sampling and relaxes the triangles beside them (euler1999
/// §2.9). Input: surfaces that conform, edge for edge, along their contacts. All borders of a contact keep the very
/// same nodes. A contact whose simplification would break a surface, make triangles cross (decided exactly) or change
/// the order of surfaces around it is left as it was and reported. Stones do not move. Running it on a converged model
/// changes nothing.
Result<SimplifiedSoup> simplify_borders(const TriangleSoup& soup, const SimplifyBordersOptions& options = {});

}  // namespace strataflow
