// Hexahedra stage by stage on growing models with a listric fault: processor time (all threads), wall time, memory at its
// peak during the stage, and how the time grows with the tetrahedra (the lines *_BigO).
// `bench_hexes --benchmark_filter=Verticalize` and the like choose; names are Stage/edge in metres/threads.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <fstream>
#include <map>
#include <memory>
#include <string>

#include "graph/parallel/schedule.h"
#include "kernels/hexes/audit/audit_hexes.h"
#include "kernels/hexes/extrude_hexes.h"
#include "kernels/hexes/live_cells.h"
#include "kernels/hexes/smooth_hexes.h"
#include "kernels/hexes/tet_models.h"

namespace {

using namespace strataflow;

/// Begins to watch the peak anew.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

double peak_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024;
  return 0;
}

/// What every stage takes, made once per size.
struct Prepared {
  VolumeMesh tets;
  UprightModel upright;
  LayeredSpace space;
  QuadMesh plan;
  ExtrudedHexes hexes;
};

LayerOptions layers() {
  LayerOptions options;
  options.layers = 5;
  return options;
}

const Prepared& prepared(std::int64_t edge_m) {
  static std::map<std::int64_t, std::unique_ptr<Prepared>> sizes;
  std::unique_ptr<Prepared>& one = sizes[edge_m];
  if (one) return *one;
  one = std::make_unique<Prepared>();
  const auto columns = listric_fault();
  const auto edge = static_cast<double>(edge_m);
  TetrahedralizeOptions filling;
  filling.max_volume_m3 = edge * edge * edge / 8;
  one->tets = support::filled(*columns, edge, filling);
  one->upright = *make_upright(one->tets);
  one->space = *build_layered_space(UprightModel(one->upright), layers());
  one->plan = support::plan_in(one->space, *columns, edge);
  one->hexes = *extrude_hexes(one->space, one->plan);
  return *one;
}

/// Times `stage` on (size, threads); what `make_input` makes is not timed.
template <class MakeInput, class Stage>
void run(benchmark::State& state, MakeInput make_input, Stage stage) {
  const Prepared& model = prepared(state.range(0));
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(state.range(1)));
  const ScheduleScope schedule(state.range(1) == 1 ? ScheduleKind::serial : ScheduleKind::threads);
  double most_mb = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto input = make_input(model);
    forget_peak();
    state.ResumeTiming();
    benchmark::DoNotOptimize(stage(model, std::move(input)));
    state.PauseTiming();
    most_mb = std::max(most_mb, peak_mb());
    state.ResumeTiming();
  }
  state.counters["tets"] = static_cast<double>(model.tets.cell_count());
  state.counters["hexes"] = static_cast<double>(model.hexes.grid.mesh.cell_count());
  state.counters["peak_MB"] = most_mb;
  state.SetComplexityN(static_cast<std::int64_t>(model.tets.cell_count()));
}

const auto nothing = [](const Prepared&) { return 0; };

void Verticalize(benchmark::State& state) {
  run(state, nothing, [](const Prepared& model, int) { return make_upright(model.tets); });
}

void StratigraphicFunction(benchmark::State& state) {
  run(
      state, [](const Prepared& model) { return model.upright; },
      [](const Prepared&, UprightModel upright) { return build_layered_space(std::move(upright), layers()); });
}

void Extrude(benchmark::State& state) {
  run(state, nothing, [](const Prepared& model, int) { return extrude_hexes(model.space, model.plan); });
}

void Smooth(benchmark::State& state) {
  run(
      state, [](const Prepared& model) { return model.hexes; },
      [](const Prepared& model, ExtrudedHexes hexes) { return smooth_hexes(hexes, model.space); });
}

void Check(benchmark::State& state) {
  run(state, nothing, [](const Prepared& model, int) {
    return analyze_volume_mesh(live_cells(model.hexes.grid).mesh).inverted +
           audit_hexes(model.hexes.grid, model.space.model)->inverted;
  });
}

void sizes(benchmark::internal::Benchmark* stage) {
  for (const int threads : {1, 2})
    for (const int edge_m : {100, 70, 50, 36}) stage->Args({edge_m, threads});
  stage->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->Iterations(1)->Complexity();
}

BENCHMARK(Verticalize)->Apply(sizes);
BENCHMARK(StratigraphicFunction)->Apply(sizes);
BENCHMARK(Extrude)->Apply(sizes);
BENCHMARK(Smooth)->Apply(sizes);
BENCHMARK(Check)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
