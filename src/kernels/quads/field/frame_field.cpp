#include "kernels/quads/field/frame_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/id.h"
#include "kernels/quads/field/corner_quads.h"
#include "kernels/quads/field/cross_field.h"
#include "kernels/quads/field/feature_layout.h"
#include "kernels/quads/field/field_topology.h"
#include "kernels/quads/field/polynomial_field.h"
#include "kernels/quads/field/smooth_frames.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

Result<FrameFieldResult> compute_frame_field(const FeatureMesh& mesh, const FrameFieldOptions& options) {
  const Result<FeatureLayout> built = build_feature_layout(mesh);
  if (!built) return built.failure();
  const FeatureLayout& layout = *built;
  const auto count = static_cast<std::uint32_t>(layout.triangle_count());
  const std::vector<std::uint8_t> corner_quads = choose_corner_quads(mesh, layout);

  const bool fast = options.kind == "fast";
  const Result<std::vector<double>> angle = fast ? straighten_angles(mesh, layout, corner_quads) : layout.angle;
  if (!angle) return angle.failure();
  const auto alpha = smooth_cross_field(mesh, layout, *angle, {.diffusions = options.diffusions});
  if (!alpha) return alpha.failure();
  FrameFieldResult result;
  std::vector<std::array<double, 2>> frames(count);
  if (fast) {
    for (std::uint32_t t = 0; t < count; ++t) frames[t] = {(*alpha)[t], (*alpha)[t] + pi / 2};
  } else {
    PolynomialField polynomial = compute_polynomial_field(
        layout, *alpha,
        {.distance = options.kind == "polyvector" ? FrameDistance::polyvector : FrameDistance::polynomial,
         .lambda = options.lambda,
         .iterations = options.iterations});
    frames = std::move(polynomial.frames);
    result.report.iterations = polynomial.iterations;
    result.report.energy = polynomial.energy;
  }
  FieldTopology topology = match_frames(layout, *angle, frames);
  const auto settled = settle_singularities(mesh, layout, corner_quads, options.cancel_cost, topology);
  if (!settled) return settled.failure();

  FrameField& field = result.field;
  field.turns = topology.turns;
  field.axes.assign(3 * count, MapAxis::none);
  for (std::uint32_t h = 0; h < 3 * count; ++h)
    if (topology.label[h] >= 0) field.axes[h] = topology.label[h] % 2 ? MapAxis::imaginary : MapAxis::real;
  if (fast) {
    Result<std::vector<std::array<double, 2>>> smooth = smooth_frames(mesh, layout, *angle, *alpha, topology);
    if (!smooth) return smooth.failure();
    field.angles = std::move(*smooth);
  } else {
    field.angles = std::move(frames);
  }
  for (const auto& [a, b] : field.angles) field.smallest_sine = std::min(field.smallest_sine, std::sin(b - a));

  FrameFieldReport& report = result.report;
  field.valence.assign(mesh.points.size(), 0);
  std::vector<std::uint8_t> on_boundary(mesh.points.size(), 0);
  for (std::uint32_t h = 0; h < 3 * count; ++h)
    if (layout.opposite[h] == no_index) on_boundary[mesh.triangles[h / 3][h % 3]] = 1;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    std::int64_t valence = 0;
    const auto nodes = layout.nodes_of(p);
    for (const std::uint32_t n : nodes) valence += topology.quads[n];
    field.valence[p] = static_cast<std::int8_t>(std::clamp<std::int64_t>(valence, 0, 127));
    if (nodes.empty() || on_boundary[p] || valence == 4) continue;
    if (layout.node_kind[nodes[0]] != NodeKind::inside)
      ++report.feature_irregular;
    else if (valence == 3)
      ++report.valence_3;
    else if (valence == 5)
      ++report.valence_5;
    else
      ++report.valence_other;
  }
  report.off_features = settled->off_features;
  report.spread = settled->spread;
  report.cancelled = settled->cancelled;
  report.index_sum = index_sum(mesh, layout, topology);
  report.euler = euler_characteristic(mesh, layout);
  return result;
}

}  // namespace strataflow
