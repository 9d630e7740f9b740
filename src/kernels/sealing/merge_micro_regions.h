#pragma once
#include <vector>

#include "base/result.h"
#include "model/triangle_soup.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// Which regions are too small to mean anything: those below `volume_m3`, and slivers, below a share of the whole
/// volume and on average thinner than `sliver_thickness_m` (volume over half the area of the frontier).
struct MicroRegions {
  double volume_m3 = 0;
  double sliver_volume_ratio = 0;
  double sliver_thickness_m = 0;
};

struct MergedRegions {
  TriangleSoup soup;
  std::vector<Change> changes;  ///< one per region merged
};

/// Merges micro-regions with a neighbour by deleting one of their surfaces, smallest region first,
/// until none is left (euler1999 §2.11.4): never a boundary surface, never one with the region on both of its sides;
/// rather a surface that is neither fault nor intrusion, rather a horizon than a fault, then the one of largest area,
/// then the first. A region with no such surface stays. The surfaces conform vertex for vertex.
Result<MergedRegions> merge_micro_regions(const TriangleSoup& soup, const MicroRegions& micro);

}  // namespace strataflow
