#include "stages/extract_quads_stage.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kernels/quads/extraction/check_features.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/extract_quads.h"
#include "kernels/quads/extraction/imprint_curves.h"
#include "kernels/quads/extraction/subdivide_mesh.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

Result<void> smooth(MeshedQuads& quads, const FeatureMesh& mesh, std::int64_t rounds) {
  quads.scaled_jacobian_before = measure_quads(quads.mesh).scaled_jacobian.minimum;
  if (rounds == 0) return {};
  QuadSmoothing smoothing;
  smoothing.rounds = rounds;
  const Result<SmoothingReport> smoothed = smooth_quads(quads.mesh, mesh, smoothing);
  if (!smoothed) return smoothed.failure();
  return {};
}

Result<MeshedQuads> quads_of_map(const GridMapping& grid, std::int64_t rounds) {
  Result<QuadMesh> extracted = extract_quads(grid.mesh, grid.map);
  if (!extracted) return extracted.failure();
  MeshedQuads quads;
  quads.mesh = std::move(*extracted);
  if (const Result<void> smoothed = smooth(quads, grid.mesh, rounds); !smoothed) return smoothed.failure();
  return quads;
}

/// The same where curves are to be laid into the quads. How far vertices may go to meet a curve is tried from far to
/// near: the further, the rounder the cells, but where curves are close the fewer such moves fit.
Result<MeshedQuads> quads_with_curves(const GridMapping& grid, std::int64_t rounds) {
  FeatureMesh whole = grid.mesh;
  whole.edges.insert(whole.edges.end(), grid.loose_edges.begin(), grid.loose_edges.end());
  std::sort(whole.edges.begin(), whole.edges.end());
  const Result<QuadsOnGrid> on_grid = extract_quads_on_grid(grid.mesh, grid.map);
  if (!on_grid) return on_grid.failure();
  std::optional<Result<MeshedQuads>> best;
  double best_jacobian = -2;
  for (const double snap : {0.45, 0.35, 0.2, 0.0}) {
    Result<ImprintedCurves> made = imprint_curves(grid.mesh, *on_grid, grid.loose_edges, snap);
    if (!made) {
      if (!best) best = made.failure();
      continue;
    }
    MeshedQuads quads;
    quads.mesh = std::move(made->quads);
    quads.created = std::move(made->created);
    if (const Result<void> smoothed = smooth(quads, whole, rounds); !smoothed) return smoothed.failure();
    const double jacobian = measure_quads(quads.mesh).scaled_jacobian.minimum;
    if (jacobian <= best_jacobian) continue;
    best_jacobian = jacobian;
    best = std::move(quads);
  }
  if (!*best) return best->failure();
  MeshedQuads& quads = **best;
  std::vector<std::uint32_t> features;
  for (const FeatureEdge& e : grid.loose_edges) features.push_back(e.feature);
  for (const std::uint32_t f : sorted_unique(std::move(features))) {
    quads.imprinted.push_back(grid.mesh.features[f].name);
    quads.mesh.changes.push_back({"imprinted", "'" + quads.imprinted.back() + "'",
                                  "no map follows it: it was laid into the quads, which were divided once"});
  }
  return std::move(quads);
}

Result<void> check(const FeatureMesh& problem, MeshedQuads& quads) {
  if (const Result<void> sound = check_quads(quads.mesh); !sound) return sound.failure();
  for (const Vec3& p : quads.mesh.points)
    if (!is_finite(p))
      return Failure{FailureCode::internal_error, "a vertex of the quads is not a finite point",
                     "please report the job"};
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
    Result<MeshedQuads> quads = grid.value.loose_edges.empty()
                                    ? quads_of_map(grid.value, options.smoothing_rounds)
                                    : quads_with_curves(grid.value, options.smoothing_rounds);
    if (quads)
      if (const Result<void> checked = check(problem, *quads); !checked) quads = checked.failure();
    if (quads) {
      for (const std::string& curve : quads->imprinted)
        context.warn("imprinted_curve", "'" + curve + "' was laid into the quads, for no map follows it");
      return quads;
    }
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
