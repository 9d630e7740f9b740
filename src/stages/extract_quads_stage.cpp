#include "stages/extract_quads_stage.h"

#include <algorithm>
#include <cmath>

#include "kernels/quads/extraction/check_features.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/extract_quads.h"
#include "kernels/quads/extraction/subdivide_mesh.h"

namespace strataflow {

namespace {

Result<MeshedQuads> quads_of_map(const GridMapping& grid, std::int64_t rounds) {
  Result<QuadMesh> extracted = extract_quads(grid.mesh, grid.map);
  if (!extracted) return extracted.failure();
  MeshedQuads quads;
  quads.mesh = std::move(*extracted);
  quads.scaled_jacobian_before = measure_quads(quads.mesh).scaled_jacobian.minimum;
  if (rounds > 0) {
    QuadSmoothing smoothing;
    smoothing.rounds = rounds;
    if (const Result<SmoothingReport> smoothed = smooth_quads(quads.mesh, grid.mesh, smoothing); !smoothed)
      return smoothed.failure();
  }
  return quads;
}

Result<void> check(const FeatureMesh& problem, MeshedQuads& quads) {
  if (const Result<void> sound = check_quads(quads.mesh); !sound) return sound.failure();
  for (const Vec3& p : quads.mesh.points)
    if (!is_finite(p))
      return Failure{FailureCode::internal_error, "a vertex of the quads is not a finite point", "please report the job"};
  quads.quality = measure_quads(quads.mesh);
  quads.missing = features_not_followed(problem, quads.mesh);
  if (!quads.missing.empty())
    return Failure{FailureCode::geometry_failed, "the quads lack a feature: " + quads.missing[0],
                   "ask for smaller quads, or leave that feature out"};
  if (quads.quality.inverted > 0) {
    const Vec3 at = quads.mesh.points[quads.mesh.quads[quads.quality.worst_quad][0]] + quads.mesh.local_origin;
    return Failure{FailureCode::geometry_failed,
                   std::to_string(quads.quality.inverted) + " quads are inverted, one near (" +
                       OptionPrinter::literal(at.x) + ", " + OptionPrinter::literal(at.y) + ", " +
                       OptionPrinter::literal(at.z) + ")",
                   "ask for smaller quads, more quad.smoothing_rounds, or quad.fallback = \"subdivide\""};
  }
  return {};
}

}  // namespace

Result<MeshedQuads> ExtractQuads::operator()(const FeatureMesh& problem, const Attempt<GridMapping>& grid,
                                             StageContext& context) const {
  std::string why_not = grid.why_not;
  if (why_not.empty()) {
    Result<MeshedQuads> quads = quads_of_map(grid.value, options.smoothing_rounds);
    if (quads)
      if (const Result<void> checked = check(problem, *quads); !checked) quads = checked.failure();
    if (quads) return quads;
    if (!options.fallback.may_fail() || quads.failure().code == FailureCode::internal_error) return quads.failure();
    why_not = quads.failure().what;
  }
  MeshedQuads quads;
  quads.mesh = subdivide_mesh(problem);
  quads.mesh.changes = problem.changes;
  quads.mesh.changes.push_back({"subdivided", "every triangle became three quads", why_not});
  quads.why_subdivided = why_not;
  context.warn("subdivided", "every triangle became three quads, for no map was found: " + why_not);
  quads.scaled_jacobian_before = measure_quads(quads.mesh).scaled_jacobian.minimum;
  if (const Result<void> checked = check(problem, quads); !checked) return checked.failure();
  return quads;
}

}  // namespace strataflow
