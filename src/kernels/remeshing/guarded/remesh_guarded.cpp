#include "kernels/remeshing/guarded/remesh_guarded.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "kernels/remeshing/guarded/feature_sizes.h"
#include "kernels/remeshing/guarded/relax_guarded.h"

namespace strataflow {

namespace {

constexpr double shaken_share = 0.3;

/// Why triangle t has an angle below 5°.
BadTriangleReason reason_of(const GuardedMesh& mesh, const FeatureSizes& features, std::uint32_t t) {
  const Triangle& c = mesh.triangle(t);
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.kind(c[k]) == VertexKind::surface) continue;
    if (features.at(mesh, c[k]) < 0.5 * mesh.size_m(c[k])) return BadTriangleReason::touches_small_feature;
    // Two lines that enclose the triangle: its angle at the corner is the model's.
    const std::uint32_t one = mesh.line_of_edge(c[k], c[(k + 1) % 3]), other = mesh.line_of_edge(c[k], c[(k + 2) % 3]);
    if (mesh.kind(c[k]) == VertexKind::corner && one != no_index && other != no_index)
      return BadTriangleReason::touches_small_feature;
  }
  return BadTriangleReason::kept_input;
}

}  // namespace

double edge_length_of(double area_m2, double sites) { return std::sqrt(2 * area_m2 / (std::numbers::sqrt3 * sites)); }

Result<RemeshGuardedResult> remesh_guarded(const StructuralModel& model, const RemeshGuardedOptions& options) {
  std::vector<double> size_m = options.surface_edge_length_m;
  if (size_m.empty()) size_m.assign(model.surfaces.size(), options.target_edge_length_m);
  if (size_m.size() != model.surfaces.size())
    return Failure{FailureCode::invalid_options,
                   "surface_edge_length_m has " + std::to_string(size_m.size()) + " values for " +
                       std::to_string(model.surfaces.size()) + " surfaces",
                   "give one length per surface"};
  if (!std::all_of(size_m.begin(), size_m.end(), [](double s) { return s > 0 && std::isfinite(s); }))
    return Failure{FailureCode::invalid_options, "an edge length is not positive", "give lengths in metres, > 0"};
  if (!(options.distance_ratio > 0) || !(options.turn_angle_deg > 0 && options.turn_angle_deg < 90) ||
      !(options.smallest_size_ratio > 0 && options.smallest_size_ratio <= 1) || !(options.size_growth_ratio > 0))
    return Failure{
        FailureCode::invalid_options, "an option of the guarded remeshing is out of its domain",
        "distance_ratio > 0, turn_angle_deg in (0, 90), smallest_size_ratio in (0, 1], size_growth_ratio > 0"};
  if (model.triangles.empty())
    return Failure{FailureCode::invalid_input, "the model has no triangles", "give surfaces"};

  const InputSurfaces inputs(model);
  Box3 box;
  for (const Vec3& p : model.points) box.take(p);
  GuardedMesh mesh(inputs, {.distance_m = options.distance_ratio * box.diagonal_m(),
                            .turn_angle_deg = options.turn_angle_deg,
                            .cell_m = *std::min_element(size_m.begin(), size_m.end()),
                            .is_cancelled = options.is_cancelled});
  const FeatureSizes features(inputs, *std::max_element(size_m.begin(), size_m.end()));

  RemeshGuardedReport report;
  for (std::int64_t round = 0; round < options.rounds && !mesh.is_stopped(); ++round) {
    set_graded_sizes(mesh, features, size_m, options.smallest_size_ratio, options.size_growth_ratio);
    report.collapses += collapse_short_edges(mesh);
    report.flips += flip_edges(mesh);
    report.splits += split_long_edges(mesh);
    report.collapses += collapse_short_edges(mesh);
    mesh.renumber();
    if (round == 0) report.moves += shake(mesh, shaken_share);
    // Regular vertices first, the best angles last.
    const bool is_last = round + 1 == options.rounds;
    for (std::uint32_t sweep = 0, since = 0; sweep < 2; ++sweep) {
      const std::uint32_t start = mesh.step_count() + 1;
      report.flips += is_last ? flip_edges(mesh, since) : even_valences(mesh, since);
      report.moves += even_out(mesh, since);
      since = start;
    }
  }
  std::uint32_t since = 0;
  for (std::int64_t round = 0; round < options.mending_rounds; ++round) {
    const std::uint32_t start = mesh.step_count() + 1;
    const std::uint64_t mended = mend_bad_triangles(mesh, since);
    report.mended += mended;
    report.flips += flip_edges(mesh, since);
    since = start;
    if (mended == 0) break;
  }
  since = 0;
  for (std::int64_t round = 0; round < options.shape_rounds; ++round) {
    const std::uint32_t start = mesh.step_count() + 1;
    report.moves += even_out(mesh, since);
    report.mended += raise_mean_shape(mesh, since);
    since = start;
  }
  if (mesh.is_stopped()) return Failure{FailureCode::cancelled, "remeshing was stopped", "run it again"};
  report.verdicts = mesh.verdicts();
  const std::vector<std::uint32_t> order = mesh.triangles_in_order();
  const double sine_5_deg = std::sin(5 * std::numbers::pi / 180);
  for (std::uint32_t k = 0; k < order.size(); ++k)
    if (const double q = mesh.quality(order[k]); q < sine_5_deg)
      report.bad_triangles.push_back({k, std::asin(q) * 180 / std::numbers::pi, reason_of(mesh, features, order[k])});
  return RemeshGuardedResult{mesh.soup(), std::move(report)};
}

}  // namespace strataflow
