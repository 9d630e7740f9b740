#include "stages/quantize_stage.h"

#include <algorithm>
#include <numbers>

#include "base/id.h"
#include "kernels/quads/extraction/extract_quads.h"
#include "kernels/quads/extraction/quad_quality.h"
#include "kernels/quads/extraction/smooth_quads.h"
#include "kernels/quads/quantization/imprint_quantization.h"

namespace strataflow {

namespace {

void take_report(const FeatureMesh& mesh, const Quantization& quantization, GridMapping& grid) {
  grid.half_edges = quantization.integers.vectors.size();
  grid.operations = quantization.integers.operations;
  grid.doublings = quantization.integers.doublings;
  grid.energy_before = quantization.integers.energy_before;
  grid.energy = quantization.integers.energy;
  for (const std::uint32_t feature : quantization.unmet_features)
    grid.unmet_features.push_back(mesh.features[feature].name);
}

/// Integers and a map optimised once more with them (coudert2024 S43).
Result<GridMapping> solved(const FeatureMesh& mesh, const FrameField& field, const CornerMap& seamless,
                           const QuantizeOptions& integers, const FoldoverFreeOptions& foldover_free) {
  const Result<Quantization> quantization = quantize_map(mesh, seamless, integers);
  if (!quantization) return quantization.failure();
  Result<OptimisedMap> map = optimise_map(mesh, field, quantization->constraints, &seamless, foldover_free);
  if (!map) return map.failure();
  GridMapping grid{.mesh = mesh, .map = std::move(map->map), .transfer = "solve"};
  take_report(mesh, *quantization, grid);
  return grid;
}

/// The coarse mesh laid over the map, then polished from there: valid before, so it can only get better.
Result<GridMapping> imprinted(const FeatureMesh& mesh, const CornerMap& seamless, QuantizeOptions integers,
                              const FoldoverFreeOptions& foldover_free) {
  integers.keep_shape = true;
  const Result<Quantization> quantization = quantize_map(mesh, seamless, integers);
  if (!quantization) return quantization.failure();
  Result<ImprintedMap> laid = imprint_quantization(mesh, seamless, *quantization);
  if (!laid) return laid.failure();
  GridMapping grid{.mesh = std::move(laid->mesh), .map = std::move(laid->map), .transfer = "imprint"};
  take_report(mesh, *quantization, grid);
  QuantizeOptions same;
  same.keep_shape = true;
  const Result<Quantization> again = quantize_map(grid.mesh, grid.map, same);
  if (!again) return grid;
  const FrameField field{.angles = std::vector<std::array<double, 2>>(grid.mesh.triangles.size(), {0, std::numbers::pi / 2}),
                         .turns = grid.map.turns,
                         .axes = grid.map.axes,
                         .valence = grid.map.valence};
  Result<OptimisedMap> polished = optimise_map(grid.mesh, field, again->constraints, &grid.map, foldover_free);
  if (polished) grid.map = std::move(polished->map);
  return grid;
}

Result<GridMapping> mapped(const FeatureMesh& mesh, const FrameField& field, const CornerMap& seamless,
                           const QuantizeOptions& integers, const std::string& transfer, StageContext& context) {
  FoldoverFreeOptions foldover_free;
  foldover_free.is_cancelled = [&] { return context.is_cancelled(); };
  if (transfer != "imprint") {
    FoldoverFreeOptions first = foldover_free;
    first.may_start_afresh = transfer == "solve";
    Result<GridMapping> grid = solved(mesh, field, seamless, integers, first);
    if (grid || transfer == "solve" || grid.failure().code == FailureCode::cancelled) return grid;
    context.warn("imprinted", "the map could not be optimised with whole numbers, so the coarse mesh is laid over it: " +
                                  grid.failure().what);
  }
  return imprinted(mesh, seamless, integers, foldover_free);
}

/// How many quads of the grid are turned over however they are smoothed, and the kept points they hang on.
struct Tangle {
  std::size_t quads = 0;
  std::vector<std::uint32_t> points;
};
Result<Tangle> tangle_of(const GridMapping& grid) {
  Result<QuadMesh> quads = extract_quads(grid.mesh, grid.map);
  if (!quads) return quads.failure();
  if (measure_quads(*quads).inverted == 0) return Tangle{};
  if (const Result<SmoothingReport> smoothed = smooth_quads(*quads, grid.mesh); !smoothed) return smoothed.failure();
  Tangle tangle;
  std::vector<std::uint8_t> is_near(quads->points.size(), 0);
  for (const auto& q : quads->quads) {
    const auto at = [&](std::size_t k) -> const Vec3& { return quads->points[q[k]]; };
    if (quad_shape(at(0), at(1), at(2), at(3), {0, 0, 1}).scaled_jacobian > 0) continue;
    ++tangle.quads;
    for (const std::uint32_t p : q) is_near[p] = 1;
  }
  for (std::size_t c = 0; c < quads->corner_points.size(); ++c)
    if (quads->corner_points[c] != no_index && is_near[quads->corner_points[c]])
      tangle.points.push_back(grid.mesh.corners[c]);
  return tangle;
}

/// A grid whose quads can be drawn with straight sides. Whole numbers say nothing of that: where three kept points are
/// nearly in a row, or a curve bends within a quad, more rows are asked for there; where many rows squeeze through a gap,
/// another field leads them around it.
Result<GridMapping> quantized(const FeatureMesh& mesh, const FrameField& field, const CornerMap& seamless,
                              const QuantizeStageOptions& options, StageContext& context) {
  QuantizeOptions integers;
  integers.coarse = options.coarse;
  Result<GridMapping> first = mapped(mesh, field, seamless, integers, options.transfer, context);
  const bool is_plane = std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3& p) { return p.z == 0; });
  if ((!first && first.failure().code == FailureCode::cancelled) || (first && !is_plane)) return first;
  Result<Tangle> tangle = first ? tangle_of(*first) : Result<Tangle>(first.failure());
  if (tangle && tangle->quads == 0) return first;
  constexpr int most_rounds = 4;
  for (int round = 0; tangle && !tangle->points.empty() && round < most_rounds; ++round) {
    if (context.is_cancelled()) return first;
    integers.crowded.insert(integers.crowded.end(), tangle->points.begin(), tangle->points.end());
    Result<GridMapping> next = mapped(mesh, field, seamless, integers, options.transfer, context);
    if (!next) break;
    tangle = tangle_of(*next);
    if (!tangle || tangle->quads > 0) continue;
    context.warn("crowded", "more rows of quads than asked for lie around " +
                                std::to_string(integers.crowded.size()) + " points, where curves come too near");
    return next;
  }
  integers.crowded.clear();
  FoldoverFreeOptions foldover_free;
  foldover_free.is_cancelled = [&] { return context.is_cancelled(); };
  const std::vector<FrameFieldOptions> fields = alternative_fields(options.field);
  for (std::size_t k = 1; k < fields.size() && !context.is_cancelled(); ++k) {
    const Result<FrameFieldResult> other = compute_frame_field(mesh, fields[k]);
    if (!other) continue;
    const Result<OptimisedMap> map = optimise_map(mesh, other->field, {}, nullptr, foldover_free);
    if (!map) continue;
    Result<GridMapping> next = mapped(mesh, other->field, map->map, integers, options.transfer, context);
    if (!next) continue;
    tangle = tangle_of(*next);
    if (!tangle || tangle->quads > 0) continue;
    context.warn("other_field", "another field had to be taken: quads of the first would turn over");
    return next;
  }
  return first;
}

}  // namespace

Result<Attempt<GridMapping>> Quantize::operator()(const FeatureMesh& mesh, const Attempt<FieldAndMap>& seamless,
                                                  StageContext& context) const {
  if (!seamless.why_not.empty()) return Attempt<GridMapping>{{}, seamless.why_not};
  Result<GridMapping> grid = quantized(mesh, seamless.value.field.field, seamless.value.map.map, options, context);
  if (grid)
    for (const std::string& feature : grid->unmet_features)
      context.warn("unmet_feature", "'" + feature +
                                        "' could not be given whole numbers of its own: it is not aligned, or its strip "
                                        "has another number of rows");
  return attempted(std::move(grid), options.fallback);
}

}  // namespace strataflow
