#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/contacts/contact_constraints.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// In which plane a border edge is led over its controller (euler1999 §2.4.4).
enum class GuidePlaneRule : std::uint8_t {
  mean_normal,  ///< mean normal of the controller at both impacts: finds a path in concave places too
  local_dip     ///< the plane of the controlled triangle: kept for comparison, may find none or a V
};

struct ConstrainedCutOptions {
  /// Closer to a vertex or edge of the controller is on it; never more than a tenth of the shortest edge there.
  /// Absent: a millionth of the diagonal of all surfaces.
  std::optional<double> tolerance_m = std::nullopt;
  /// A path longer than this many times its border edge is none.
  double max_path_ratio = 10;
  GuidePlaneRule guide_plane = GuidePlaneRule::mean_normal;
};

/// What became of one BorderOnSurface. Failures name the entities and the place.
struct ContactReport {
  std::uint32_t border_nodes = 0;
  std::uint32_t inserted_nodes = 0;  ///< where the border crosses edges of its controller
  double max_move_m = 0;             ///< the furthest a border node went
  std::vector<std::string> failures;
};

struct ConstrainedCut {
  TriangleSoup soup;
  std::vector<ContactReport> borders;  ///< per constraint of `borders`
  std::vector<std::string> failures;   ///< of stones, and of constraints that depend on each other in a circle
};

/// Makes contacts that should be there: every constrained border is moved onto its controller and led over it in a
/// continuous line that both surfaces share vertex for vertex (euler1999 §2.4). Only triangles at constrained borders
/// are deformed; controllers are refined in place. Controllers come before what slides on them; where a stone belongs
/// to several contacts it goes to the line (or corner) these already share, so that it is one node of all of them.
/// Borders that coincide with a constrained one move with it. A border that would move too far or find no path is
/// reported and left; so is a node whose move would fold its own triangles, but not the rest of its border.
/// Fails with invalid_input for indices out of range.
Result<ConstrainedCut> cut_constrained(const TriangleSoup& soup, const ContactConstraints& constraints,
                                       const ConstrainedCutOptions& options = {});

}  // namespace strataflow
