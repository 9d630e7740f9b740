#include "stages/quantize_stage.h"

#include <numbers>

#include "kernels/quads/quantization/imprint_quantization.h"

namespace strataflow {

namespace {

/// Newton steps of the first solve before the coarse mesh is laid over the map instead.
constexpr std::int64_t solve_steps = 30;

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

Result<GridMapping> quantized(const FeatureMesh& mesh, const FrameField& field, const CornerMap& seamless,
                              const QuantizeStageOptions& options, StageContext& context) {
  QuantizeOptions integers;
  integers.coarse = options.coarse;
  FoldoverFreeOptions foldover_free;
  foldover_free.is_cancelled = [&] { return context.is_cancelled(); };
  if (options.transfer != "imprint") {
    FoldoverFreeOptions first = foldover_free;
    if (options.transfer == "auto") first.iterations = solve_steps;
    Result<GridMapping> grid = solved(mesh, field, seamless, integers, first);
    if (grid || options.transfer == "solve" || grid.failure().code == FailureCode::cancelled) return grid;
    context.warn("imprinted", "the map could not be optimised with whole numbers, so the coarse mesh is laid over it: " +
                                  grid.failure().what);
  }
  return imprinted(mesh, seamless, integers, foldover_free);
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
