// How reading apart, the cost of a model grows with its triangles: building the boundary representation and the exact
// validity census. Reports seconds, triangles per second and the peak memory of the process so far.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>

#include "kernels/intersection/find_intersections.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"

namespace {

using namespace strataflow;

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Reference model A1 with about `wanted` triangles: cost of a resolution grows with the inverse square of its edge.
TriangleSoup model_of_size(std::int64_t wanted) {
  ReferenceModelOptions options;
  options.resolution_m = 60.0;
  const auto coarse = generate_reference_model("A1", options);
  options.resolution_m = 60.0 * std::sqrt(static_cast<double>(coarse->triangles.size()) / static_cast<double>(wanted));
  return *generate_reference_model("A1", options);
}

void build_model(benchmark::State& state) {
  const TriangleSoup soup = model_of_size(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(build_structural_model(soup));
  state.counters["triangles"] = static_cast<double>(soup.triangles.size());
  state.counters["peak_MB"] = peak_memory_mb();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(soup.triangles.size()));
}

void find_all_intersections(benchmark::State& state) {
  const TriangleSoup soup = model_of_size(state.range(0));
  const StructuralModel model = build_structural_model(soup)->model;
  for (auto _ : state) benchmark::DoNotOptimize(find_intersections(model.points, model.triangles));
  state.counters["triangles"] = static_cast<double>(soup.triangles.size());
  state.counters["peak_MB"] = peak_memory_mb();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(soup.triangles.size()));
}

void check_whole_validity(benchmark::State& state) {
  const TriangleSoup soup = model_of_size(state.range(0));
  const BuiltModel built = *build_structural_model(soup);
  for (auto _ : state) benchmark::DoNotOptimize(check_validity(built));
  state.counters["triangles"] = static_cast<double>(soup.triangles.size());
  state.counters["peak_MB"] = peak_memory_mb();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(soup.triangles.size()));
}

// Ascending sizes, so that the peak belongs to the size it is printed beside.
#define STRATAFLOW_SIZES \
  ->Arg(30000)->Arg(100000)->Arg(300000)->Arg(1000000)->Arg(3000000)->Unit(benchmark::kMillisecond)->UseRealTime()
BENCHMARK(build_model) STRATAFLOW_SIZES;
BENCHMARK(find_all_intersections) STRATAFLOW_SIZES;
BENCHMARK(check_whole_validity) STRATAFLOW_SIZES;

}  // namespace

BENCHMARK_MAIN();
