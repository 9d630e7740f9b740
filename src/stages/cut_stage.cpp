#include "stages/cut_stage.h"

#include "kernels/cutting/cut_surfaces.h"
#include "model/box3.h"

namespace strataflow {

Result<CutResult> Cut::operator()(const CutResult& joined, const SealingNeed& need, StageContext& context) const {
  if (!need.is_needed) return joined;
  Box3 box;
  for (const Vec3& p : joined.soup.points) box.take(p);
  Result<CutResult> cut =
      cut_surfaces(joined.soup, {.cut = options.cut,
                                 .cutting = options.cutting,
                                 .tolerance_m = options.tolerance_m,
                                 .intersection_tolerance_m = options.intersection_tolerance_ratio * box.diagonal_m(),
                                 .mark_inserted = options.mark_inserted});
  if (!cut) return cut;
  for (const Change& change : cut->changes) context.warn(change.kind, change.what + ": " + change.why);
  if (cut->report.pairs_left > 0)
    context.warn("pairs_left", std::to_string(cut->report.pairs_left) + " pairs of triangles still meet improperly");
  cut->changes.insert(cut->changes.begin(), joined.changes.begin(), joined.changes.end());
  return cut;
}

}  // namespace strataflow
