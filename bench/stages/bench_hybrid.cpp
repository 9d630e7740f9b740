// Hybrid meshes of layers of variable thickness: sites against time (processor and wall), peak memory and cells, on one
// thread and two. Each run is a process of its own, so that its peak memory is its own.
// On a busy machine take the best of several: --benchmark_repetitions=5. `wall` is what `threads` is to shorten; `cpu`
// does not depend on who else runs. Prints the growth from size to size and the speed-up, by the best repetition, after
// the benchmarks.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "kernels/hybrid/fill_hybrid.h"
#include "kernels/hybrid/shared_surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"

namespace {

using namespace strataflow;

struct Run {
  double wall_s = 0, cpu_s = 0, surfaces_s = 0, fill_s = 0;
  double peak_mb = 0;
  std::uint64_t sites = 0, triangles = 0, cells = 0, prisms = 0;
};

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Surfaces with `sites` sites and what they enclose, filled; nothing is checked here that the mesher does not check.
Run mesh(const StructuralModel& model, std::size_t sites) {
  double area_m2 = 0;
  for (const Triangle& t : model.triangles)
    area_m2 += 0.5 * length(cross(model.points[t[1]] - model.points[t[0]], model.points[t[2]] - model.points[t[0]]));
  SharedSitesOptions drawing;
  drawing.thin_ratio = 1;
  drawing.surface_edge_length_m.assign(model.surfaces.size(),
                                       std::sqrt(2 * area_m2 / (std::sqrt(3.0) * static_cast<double>(sites))));
  Run run;
  const double start = now_s();
  Result<SharedSurfaces> surfaces = remesh_on_shared_sites(model, draw_shared_sites(model, sites, drawing));
  if (!surfaces) return {};
  const double middle = now_s();
  const StructuralModel& remeshed = surfaces->built.model;
  const Result<HybridMesh> hybrid = fill_hybrid(remeshed, sites_of_points(remeshed), {}, nullptr,
                                                std::filesystem::path(STRATAFLOW_BINARY_DIR) / "bin/tet_worker");
  if (!hybrid) return {};
  run.surfaces_s = middle - start;
  run.fill_s = now_s() - middle;
  run.wall_s = now_s() - start;
  run.sites = surfaces->sites;
  run.triangles = remeshed.triangles.size();
  run.cells = hybrid->mesh.cell_count();
  for (const HybridRegion& region : hybrid->report.regions) run.prisms += region.prisms;
  return run;
}

/// `mesh` in a child with so many threads; it has no threads yet when it starts, and neither has the parent.
Run mesh_in_child(std::size_t sites, std::size_t threads) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    const Run run = mesh(build_structural_model(*generate_reference_model("variable-layers"))->model, sites);
    const bool is_told = write(ends[1], &run, sizeof run) == sizeof run;
    _exit(is_told && run.cells > 0 ? 0 : 1);
  }
  Run run;
  const bool is_told = read(ends[0], &run, sizeof run) == sizeof run;
  close(ends[0]);
  close(ends[1]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);  // with the workers it waited for
  if (!is_told || status != 0) return {};
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  run.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  run.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  return run;
}

std::map<std::pair<std::int64_t, std::int64_t>, Run> best;  ///< by threads and sites asked for

/// Arguments: sites; threads.
void hybrid(benchmark::State& state) {
  for (auto _ : state) {
    const Run run =
        mesh_in_child(static_cast<std::size_t>(state.range(0)), static_cast<std::size_t>(state.range(1)));
    if (run.cells == 0) {
      state.SkipWithError("no mesh");
      return;
    }
    state.SetIterationTime(run.wall_s);
    state.counters["cpu_s"] = run.cpu_s;
    state.counters["surfaces_s"] = run.surfaces_s;
    state.counters["fill_s"] = run.fill_s;
    state.counters["peak_MB"] = run.peak_mb;
    state.counters["sites"] = static_cast<double>(run.sites);
    state.counters["cells"] = static_cast<double>(run.cells);
    state.counters["prisms"] = static_cast<double>(run.prisms);
    Run& kept = best[{state.range(1), state.range(0)}];
    const Run before = kept;
    if (kept.cells == 0) kept = run;
    if (before.cells > 0) {
      kept.wall_s = std::min(before.wall_s, run.wall_s);
      kept.cpu_s = std::min(before.cpu_s, run.cpu_s);
    }
  }
}

}  // namespace

BENCHMARK(hybrid)
    ->ArgsProduct({{500, 1000, 2000, 4000, 8000}, {1, 2}})
    ->Unit(benchmark::kSecond)
    ->UseManualTime()
    ->Iterations(1);

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  benchmark::RunSpecifiedBenchmarks();
  const Run* last = nullptr;
  for (const auto& [key, run] : best) {
    const auto& [threads, sites] = key;
    std::printf("%5lld sites, %lld threads: %llu sites, %llu triangles, %llu cells; %.2f s processor, %.2f s wall, %.0f MB",
                static_cast<long long>(sites), static_cast<long long>(threads),
                static_cast<unsigned long long>(run.sites), static_cast<unsigned long long>(run.triangles),
                static_cast<unsigned long long>(run.cells), run.cpu_s, run.wall_s, run.peak_mb);
    if (threads == 1 && last && last->cells < run.cells)
      std::printf("; grows as cells to the power of %.2f",
                  std::log(run.cpu_s / last->cpu_s) /
                      std::log(static_cast<double>(run.cells) / static_cast<double>(last->cells)));
    if (const auto one = best.find({1, sites}); threads == 2 && one != best.end())
      std::printf("; %.2f times as fast on two threads", one->second.wall_s / run.wall_s);
    std::printf("\n");
    last = &run;
  }
}
