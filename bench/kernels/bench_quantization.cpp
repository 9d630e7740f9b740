// How quantization grows: decimation with the triangles of the map, the integer optimisation with the half-edges that
// are left, at the map's own resolution and as coarse as it can be. Surfaces of columns of many heights: one cone point
// for about eight half-edges.
#include <benchmark/benchmark.h>

#include "kernels/quads/quantization/cut_chart.h"
#include "kernels/quads/quantization/decimate_map.h"
#include "kernels/quads/quantization/imprint_quantization.h"
#include "kernels/quads/quantization/optimise_vectors.h"
#include "kernels/quads/quantization/round_map.h"
#include "tests/kernels/quads/quantization/map_shapes.h"

namespace {

using namespace strataflow;

void optimise(benchmark::State& state, double scale) {
  const auto shape = support::terrain_map(static_cast<int>(state.range(0)), 3);
  const auto flat = round_map(shape.mesh, shape.map);
  const auto decimated = decimate_map(shape.mesh, *flat, cut_chart(*flat));
  IntegerVectors result;
  for (auto _ : state) result = *optimise_vectors(decimated.mesh, targets_of(decimated.mesh, scale));
  state.counters["half_edges"] = decimated.mesh.half_edge_count();
  state.counters["doublings"] = result.doublings;
  state.counters["operations"] = result.operations;
  state.counters["searches"] = static_cast<double>(result.searches);
  state.counters["energy"] = result.energy;
  state.SetComplexityN(decimated.mesh.half_edge_count());
}
void optimise_at_resolution(benchmark::State& state) { optimise(state, 1); }
void optimise_coarse(benchmark::State& state) { optimise(state, 0.01); }

support::MapShape fine_columns(std::int64_t points) {
  auto shape = support::terrain_map(4, 3);
  support::insert_points(shape, static_cast<int>(points), 7);
  return shape;
}

void decimate(benchmark::State& state) {
  const auto shape = fine_columns(state.range(0));
  const auto flat = round_map(shape.mesh, shape.map);
  const auto cut = cut_chart(*flat);
  for (auto _ : state) benchmark::DoNotOptimize(decimate_map(shape.mesh, *flat, cut).flips);
  state.counters["triangles"] = static_cast<double>(shape.mesh.triangles.size());
  state.SetComplexityN(static_cast<std::int64_t>(shape.mesh.triangles.size()));
}

void imprint(benchmark::State& state) {
  const auto shape = fine_columns(state.range(0));
  const auto quantization = quantize_map(shape.mesh, shape.map);
  for (auto _ : state)
    benchmark::DoNotOptimize(imprint_quantization(shape.mesh, shape.map, *quantization)->map.uv.data());
  state.counters["triangles"] = static_cast<double>(shape.mesh.triangles.size());
  state.SetComplexityN(static_cast<std::int64_t>(shape.mesh.triangles.size()));
}

BENCHMARK(optimise_at_resolution)
    ->Arg(3)
    ->Arg(5)
    ->Arg(8)
    ->Arg(12)
    ->Arg(17)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK(optimise_coarse)->Arg(3)->Arg(5)->Arg(8)->Arg(12)->Arg(17)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK(decimate)->Arg(1000)->Arg(4000)->Arg(16000)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK(imprint)->Arg(1000)->Arg(4000)->Arg(16000)->Unit(benchmark::kMillisecond)->Complexity();

}  // namespace

BENCHMARK_MAIN();
