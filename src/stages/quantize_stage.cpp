#include "stages/quantize_stage.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <tuple>

#include "base/id.h"
#include "kernels/quads/extraction/extract_quads.h"
#include "kernels/quads/extraction/quad_quality.h"
#include "kernels/quads/extraction/smooth_quads.h"
#include "kernels/quads/map/loosen_features.h"
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

/// A seamless map, the mesh that it follows, and edges of the mesh that it need not follow.
struct MapToQuantize {
  FeatureMesh mesh;
  FrameField field;
  CornerMap map;
  std::vector<FeatureEdge> loose{};
};

/// Integers and a map optimised once more with them (coudert2024 S43).
Result<GridMapping> solved(const MapToQuantize& input, const QuantizeOptions& integers,
                           const FoldoverFreeOptions& foldover_free) {
  const Result<Quantization> quantization = quantize_map(input.mesh, input.map, integers);
  if (!quantization) return quantization.failure();
  Result<OptimisedMap> map =
      optimise_map(input.mesh, input.field, quantization->constraints, &input.map, foldover_free);
  if (!map) return map.failure();
  GridMapping grid{.mesh = input.mesh, .map = std::move(map->map), .transfer = "solve"};
  take_report(input.mesh, *quantization, grid);
  grid.loose_edges = input.loose;
  return grid;
}

/// Edges of a mesh as they are on the refinement that a map was laid over.
std::vector<FeatureEdge> split_edges(const std::vector<FeatureEdge>& edges, const ImprintedMap& laid) {
  const std::vector<Vec3>& points = laid.mesh.points;
  const std::size_t before = points.size() - laid.on_edge.size();
  std::vector<FeatureEdge> split;
  for (const FeatureEdge& e : edges) {
    std::vector<std::pair<double, std::uint32_t>> between;
    for (std::size_t k = 0; k < laid.on_edge.size(); ++k)
      if (std::minmax(laid.on_edge[k][0], laid.on_edge[k][1]) == std::minmax(e.a, e.b))
        between.emplace_back(length(points[before + k] - points[e.a]), static_cast<std::uint32_t>(before + k));
    std::sort(between.begin(), between.end());
    between.emplace_back(0, e.b);
    std::uint32_t from = e.a;
    for (const auto& [away, p] : between) {
      split.push_back({std::min(from, p), std::max(from, p), e.feature});
      from = p;
    }
  }
  std::sort(split.begin(), split.end());
  return split;
}

/// The coarse mesh laid over the map, then polished from there: valid before, so it can only get better.
Result<GridMapping> imprinted(const MapToQuantize& input, QuantizeOptions integers,
                              const FoldoverFreeOptions& foldover_free) {
  integers.keep_shape = true;
  const Result<Quantization> quantization = quantize_map(input.mesh, input.map, integers);
  if (!quantization) return quantization.failure();
  Result<ImprintedMap> laid = imprint_quantization(input.mesh, input.map, *quantization);
  if (!laid) return laid.failure();
  std::vector<FeatureEdge> loose = split_edges(input.loose, *laid);
  GridMapping grid{.mesh = std::move(laid->mesh), .map = std::move(laid->map), .transfer = "imprint"};
  take_report(input.mesh, *quantization, grid);
  grid.loose_edges = std::move(loose);
  QuantizeOptions same;
  same.keep_shape = true;
  const Result<Quantization> again = quantize_map(grid.mesh, grid.map, same);
  if (!again) return grid;
  const FrameField field{
      .angles = std::vector<std::array<double, 2>>(grid.mesh.triangles.size(), {0, std::numbers::pi / 2}),
      .turns = grid.map.turns,
      .axes = grid.map.axes,
      .valence = grid.map.valence};
  Result<OptimisedMap> polished = optimise_map(grid.mesh, field, again->constraints, &grid.map, foldover_free);
  if (polished) grid.map = std::move(polished->map);
  return grid;
}

Result<GridMapping> mapped(const MapToQuantize& input, const QuantizeOptions& integers, const std::string& transfer,
                           StageContext& context) {
  FoldoverFreeOptions foldover_free;
  foldover_free.is_cancelled = [&] { return context.is_cancelled(); };
  if (transfer != "imprint") {
    FoldoverFreeOptions first = foldover_free;
    first.may_start_afresh = transfer == "solve";
    Result<GridMapping> grid = solved(input, integers, first);
    if (grid || transfer == "solve" || grid.failure().code == FailureCode::cancelled) return grid;
    context.warn("imprinted",
                 "the map could not be optimised with whole numbers, so the coarse mesh is laid over it: " +
                     grid.failure().what);
  }
  return imprinted(input, integers, foldover_free);
}

/// How good the quads of a grid get however they are smoothed, and the kept points that the poor ones hang on.
struct Tangle {
  double scaled_jacobian = 1;  ///< the smallest; 1 where quads are good before smoothing
  std::vector<std::uint32_t> points{};
};
constexpr double poor_jacobian = 0.2;

Result<Tangle> tangle_of(const GridMapping& grid) {
  Result<QuadMesh> quads = extract_quads(grid.mesh, grid.map);
  if (!quads) return quads.failure();
  if (measure_quads(*quads).scaled_jacobian.minimum >= poor_jacobian) return Tangle{};
  const Result<SmoothingReport> smoothed = smooth_quads(*quads, grid.mesh);
  if (!smoothed) return smoothed.failure();
  Tangle tangle{.scaled_jacobian = smoothed->after};
  std::vector<std::uint8_t> is_near(quads->points.size(), 0);
  for (const auto& q : quads->quads) {
    const auto at = [&](std::size_t k) -> const Vec3& { return quads->points[q[k]]; };
    if (quad_shape(at(0), at(1), at(2), at(3), {0, 0, 1}).scaled_jacobian >= poor_jacobian) continue;
    for (const std::uint32_t p : q) is_near[p] = 1;
  }
  for (std::size_t c = 0; c < quads->corner_points.size(); ++c)
    if (quads->corner_points[c] != no_index && is_near[quads->corner_points[c]])
      tangle.points.push_back(grid.mesh.corners[c]);
  return tangle;
}

/// A grid whose quads can be drawn with straight sides, and well. Whole numbers say nothing of that: where three kept
/// points are nearly in a row, or a curve bends within a quad, more rows are asked for there; where quads turn over all
/// the same, because many rows squeeze through a gap, another field leads them around it.
Result<GridMapping> quantized(const MapToQuantize& input, const QuantizeStageOptions& options, StageContext& context) {
  const FeatureMesh& mesh = input.mesh;
  QuantizeOptions integers;
  integers.coarse = options.coarse;
  Result<GridMapping> best = mapped(input, integers, options.transfer, context);
  const bool is_plane = std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3& p) { return p.z == 0; });
  if ((!best && best.failure().code == FailureCode::cancelled) || (best && !is_plane)) return best;
  Result<Tangle> tangle = best ? tangle_of(*best) : Result<Tangle>(best.failure());
  double best_jacobian = tangle ? tangle->scaled_jacobian : -1;
  constexpr int most_rounds = 4;
  std::size_t crowded = 0;
  for (int round = 0; tangle && best_jacobian < poor_jacobian && !tangle->points.empty() && round < most_rounds;
       ++round) {
    if (context.is_cancelled()) return best;
    integers.crowded.insert(integers.crowded.end(), tangle->points.begin(), tangle->points.end());
    Result<GridMapping> next = mapped(input, integers, options.transfer, context);
    if (!next) break;
    tangle = tangle_of(*next);
    if (!tangle || tangle->scaled_jacobian <= best_jacobian) continue;
    best_jacobian = tangle->scaled_jacobian;
    best = std::move(next);
    crowded = integers.crowded.size();
  }
  if (best_jacobian > 0) {
    if (crowded > 0)
      context.warn("crowded", "more rows of quads than asked for lie around " + std::to_string(crowded) +
                                  " points, where curves come too near");
    return best;
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
    Result<GridMapping> next = mapped({mesh, other->field, map->map, input.loose}, integers, options.transfer, context);
    if (!next) continue;
    tangle = tangle_of(*next);
    if (!tangle || tangle->scaled_jacobian <= 0) continue;
    context.warn("other_field", "another field had to be taken: quads of the first would turn over");
    return next;
  }
  return best;
}

/// The map with `scale` times as many quads along each edge. With `align`, loose features that whole numbers can align
/// get their axes and are loose no more (S43).
MapToQuantize loosely_scaled(const FeatureMesh& mesh, const FieldAndMap& seamless, double scale, bool align) {
  FeatureMesh scaled = mesh;
  scaled.edge_length_m /= scale;
  CornerMap map = seamless.map.map;
  for (auto& [u, v] : map.uv) {
    u *= scale;
    v *= scale;
  }
  std::vector<std::uint32_t> wanted = align ? seamless.loose : std::vector<std::uint32_t>();
  for (;;) {
    MapToQuantize result{{}, seamless.field.field, map};
    const std::vector<std::uint32_t> near = take_near_axes(mesh, wanted, result.map);
    std::vector<std::uint32_t> loose;
    std::set_difference(seamless.loose.begin(), seamless.loose.end(), near.begin(), near.end(),
                        std::back_inserter(loose));
    result.mesh = without_features(scaled, loose);
    result.field.axes = result.map.axes;
    result.loose = edges_of_features(mesh, loose);
    if (near.empty()) return result;
    const Result<Quantization> tried = quantize_map(result.mesh, result.map);
    if (tried && tried->unaligned_features.empty()) return result;
    wanted.clear();
    if (tried)
      std::set_difference(near.begin(), near.end(), tried->unaligned_features.begin(), tried->unaligned_features.end(),
                          std::back_inserter(wanted));
    if (wanted.size() == near.size()) wanted.clear();  // others stand in the way
  }
}

Result<GridMapping> loosely_quantized(const FeatureMesh& mesh, const FieldAndMap& seamless,
                                      const QuantizeStageOptions& options, StageContext& context) {
  const MapToQuantize fine = loosely_scaled(mesh, seamless, 1, true);
  if (fine.loose.empty())
    if (Result<GridMapping> grid = quantized(fine, options, context)) return grid;
  if (Result<GridMapping> grid = quantized(loosely_scaled(mesh, seamless, 0.5, true), options, context)) return grid;
  return quantized(loosely_scaled(mesh, seamless, 0.5, false), options, context);
}

}  // namespace

Result<Attempt<GridMapping>> Quantize::operator()(const FeatureMesh& mesh, const Attempt<FieldAndMap>& seamless,
                                                  StageContext& context) const {
  if (!seamless.why_not.empty()) return Attempt<GridMapping>{{}, seamless.why_not};
  const FieldAndMap& found = seamless.value;
  Result<GridMapping> grid = found.loose.empty() ? quantized({mesh, found.field.field, found.map.map}, options, context)
                                                 : loosely_quantized(mesh, found, options, context);
  if (grid)
    for (const std::string& feature : grid->unmet_features)
      context.warn("unmet_feature",
                   "'" + feature +
                       "' could not be given whole numbers of its own: its strip has another number of "
                       "rows");
  return attempted(std::move(grid), options.fallback);
}

}  // namespace strataflow
