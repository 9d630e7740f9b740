// Restricted Voronoi diagrams and remeshing beside CGAL's sequential Delaunay triangulation of a million random points,
// in one run: one diagram with energy and gradient (facets a second, growth, one thread against two), 105 800 triangles
// to 10 000 sites, CloudSpin_fixed at 10 000 sites by steps and by cells, and memory. Prints the ratios after the
// benchmarks. Needs STRATAFLOW_DATA (a folder with cloudspin) for CloudSpin, which is left out without it.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include "base/seed.h"
#include "io/input/local_origin.h"
#include "io/read_input.h"
#include "kernels/remeshing/guarded/remesh_guarded.h"
#include "kernels/remeshing/remesh_at_resolution.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "kernels/voronoi/line_edges.h"
#include "kernels/voronoi/optimise_sites.h"
#include "kernels/voronoi/sample_sites.h"

namespace {

using namespace strataflow;

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

struct Sheet {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

/// A wavy surface of 1 km of about so many triangles.
Sheet sheet_of(std::int64_t triangles) {
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)));
  Sheet sheet;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      sheet.points.push_back({1000 * u, 1000 * v, 60 * std::sin(7.1 * u + 1) * std::cos(5.3 * v)});
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      sheet.triangles.push_back({a, b, b + 1});
      sheet.triangles.push_back({a, b + 1, a + 1});
    }
  return sheet;
}

std::vector<Vec3> sites_of(const Sheet& sheet, std::int64_t count) {
  return sample_sites(sheet.points, sheet.triangles, {}, static_cast<std::size_t>(count), 1);
}

/// CloudSpin_fixed, with the edge length at which its surfaces but the box have 10 000 vertices.
struct CloudSpin {
  StructuralModel model;
  double edge_length_m = 0, area_m2 = 0, box_area_m2 = 0;
};

const std::optional<CloudSpin>& cloudspin() {
  static const std::optional<CloudSpin> read = []() -> std::optional<CloudSpin> {
    const char* folder = std::getenv("STRATAFLOW_DATA");
    if (!folder) return {};
    Result<InputData> input = read_input(std::filesystem::path(folder) / "cloudspin/CloudSpin_fixed.ml");
    if (!input) return {};
    shift_to_local_origin(*input);
    Result<BuiltModel> built = build_structural_model(input->surfaces);
    if (!built) return {};
    CloudSpin spin{std::move(built->model)};
    for (std::size_t t = 0; t < spin.model.triangles.size(); ++t) {
      const auto [a, b, c] = spin.model.triangles[t];
      const Vec3& p = spin.model.points[a];
      const Surface& surface = spin.model.surfaces[spin.model.triangle_surface[t]];
      (spin.model.entities[surface.entity].role == Role::boundary ? spin.box_area_m2 : spin.area_m2) +=
          0.5 * length(cross(spin.model.points[b] - p, spin.model.points[c] - p));
    }
    spin.edge_length_m = edge_length_of(spin.area_m2, 10000);
    return spin;
  }();
  return read;
}

class Threads {
 public:
  explicit Threads(std::int64_t count)
      : control_(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)) {}

 private:
  oneapi::tbb::global_control control_;
};

void delaunay_by_cgal(benchmark::State& state) {
  using Delaunay = CGAL::Delaunay_triangulation_3<CGAL::Exact_predicates_inexact_constructions_kernel>;
  std::vector<Delaunay::Point> points;
  RandomStream random(1);
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    const double x = random.unit(), y = random.unit(), z = random.unit();
    points.emplace_back(x, y, z);
  }
  for (auto _ : state) benchmark::DoNotOptimize(Delaunay(points.begin(), points.end()).number_of_vertices());
}

/// Arguments: triangles; sites; threads. Sites have moved a little since the last diagram, as when they are optimised.
void energy(benchmark::State& state) {
  const Sheet sheet = sheet_of(state.range(0));
  std::vector<Vec3> sites = sites_of(sheet, state.range(1));
  const Threads threads(state.range(2));
  CvtEnergy cvt({sheet.points, sheet.triangles, {}, {}});
  CvtTerms terms;
  cvt.evaluate(sites, false, terms);
  for (auto _ : state) {
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (terms.mass[i] > 0) sites[i] = sites[i] + 0.1 * (terms.centroid[i] - sites[i]);
    cvt.evaluate(sites, false, terms);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sheet.triangles.size()));
}

void optimise(benchmark::State& state) {
  const Sheet sheet = sheet_of(105800);
  const std::vector<Vec3> sites = sites_of(sheet, 10000);
  for (auto _ : state)
    benchmark::DoNotOptimize(optimise_sites({sheet.points, sheet.triangles, {}, {}}, sites, {},
                                            {.lloyd_iterations = 5, .iterations = 30}));
}

/// From the model to the sealed, valid model of the mesh; false if it is not.
bool is_sealed_model(const TriangleSoup& soup, benchmark::State& state) {
  const Result<BuiltModel> built = build_structural_model(soup);
  if (!built) return false;
  state.counters["triangles"] = static_cast<double>(built->model.triangles.size());
  return is_sealed(built->model, check_validity(*built));
}

/// Argument: threads.
void remesh_by_steps(benchmark::State& state) {
  if (!cloudspin()) return state.SkipWithError("set STRATAFLOW_DATA");
  const Threads threads(state.range(0));
  for (auto _ : state) {
    const auto result = remesh_guarded(cloudspin()->model, {.target_edge_length_m = cloudspin()->edge_length_m,
                                                            .distance_ratio = 0.0015});
    if (!result || !is_sealed_model(result->soup, state)) return state.SkipWithError("not sealed");
  }
}

/// Argument: threads. 100 quasi-Newton iterations, the box sampled on top.
void remesh_by_cells(benchmark::State& state) {
  if (!cloudspin()) return state.SkipWithError("set STRATAFLOW_DATA");
  const Threads threads(state.range(0));
  const StructuralModel& model = cloudspin()->model;
  const auto count = static_cast<std::size_t>(10000 * (1 + cloudspin()->box_area_m2 / cloudspin()->area_m2));
  const std::vector<LineEdge> lines = line_edges(model);
  for (auto _ : state) {
    const OptimisedSites sites =
        optimise_sites({model.points, model.triangles, {}, lines},
                       sample_sites(model.points, model.triangles, {}, count, 1), {}, {.iterations = 100});
    RemeshAtResolutionOptions options;
    options.merge.merges_linked_corners = options.merge.merges_beyond_two_points = false;
    options.merge.follows_bends = true;
    options.merge.resolution_m = options.merge.most_move_m = 20;
    options.edge_length_m = cloudspin()->edge_length_m;
    options.reoptimise.lloyd_iterations = 2;
    options.reoptimise.iterations = 6;
    const auto result = remesh_at_resolution(model, sites.sites, options);
    if (!result || !is_sealed_model(result->evened.soup, state)) return state.SkipWithError("not sealed");
  }
}

#define STRATAFLOW_TIMED ->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK(delaunay_by_cgal)->Arg(1000000) STRATAFLOW_TIMED;
BENCHMARK(energy)
    ->Args({1000000, 10000, 1})
    ->Args({1000000, 10000, 2})
    ->Args({100000, 10000, 2})
    ->Args({1000000, 1000, 2})
    ->Args({1000000, 100000, 2})
    ->Args({2000000, 1000000, 2}) STRATAFLOW_TIMED;
BENCHMARK(optimise) STRATAFLOW_TIMED;
BENCHMARK(remesh_by_steps)->Arg(1)->Arg(2) STRATAFLOW_TIMED;
BENCHMARK(remesh_by_cells)->Arg(1)->Arg(2) STRATAFLOW_TIMED;

/// Prints as usual and keeps the best time of each benchmark: other work on the machine only ever adds.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
      const std::string& args = run.run_name.args;
      Times& best = best_.try_emplace(run.run_name.function_name + (args.empty() ? "" : "/" + args)).first->second;
      best.real = std::min(best.real, run.GetAdjustedRealTime());
      best.cpu = std::min(best.cpu, run.GetAdjustedCPUTime());
    }
  }

  void print_ratios() const {
    std::printf("\n%-64s %9s  wanted\n", "ratio (best of repetitions; wall clock, in brackets CPU)", "measured");
    const char* delaunay = "delaunay_by_cgal/1000000";
    ratio("CloudSpin by steps, 10 000 sites, two threads / Delaunay", "remesh_by_steps/2", delaunay, "<= 0.7");
    ratio("CloudSpin by cells, 100 iterations, two threads / Delaunay", "remesh_by_cells/2", delaunay, "<= 0.7");
    ratio("105 800 triangles to 10 000 sites, 5 + 30 / Delaunay", "optimise", delaunay, "<= 0.33");
    ratio("diagram and energy: one thread / two", "energy/1000000/10000/1", "energy/1000000/10000/2", ">= 1.8");
    ratio("CloudSpin by steps: one thread / two", "remesh_by_steps/1", "remesh_by_steps/2", ">= 1.5");
    ratio("CloudSpin by cells: one thread / two", "remesh_by_cells/1", "remesh_by_cells/2", ">= 1.5");
    ratio("growth, 1 M / 100 k triangles, 10 000 sites", "energy/1000000/10000/2", "energy/100000/10000/2", "~ 10");
    ratio("growth, 100 000 / 1 000 sites, 1 M triangles", "energy/1000000/100000/2", "energy/1000000/1000/2", "near 1");
    ratio("growth, 1 M sites on 2 M / 100 000 on 1 M", "energy/2000000/1000000/2", "energy/1000000/100000/2", "2 to 10");
  }

 private:
  struct Times {
    double real = 1e300, cpu = 1e300;
  };
  void ratio(const char* what, const char* over, const char* under, const char* wanted) const {
    const auto a = best_.find(over), b = best_.find(under);
    if (a == best_.end() || b == best_.end()) return;
    std::printf("%-64s %6.2f [%.2f]  %s\n", what, a->second.real / b->second.real, a->second.cpu / b->second.cpu,
                wanted);
  }
  std::map<std::string, Times> best_;
};

/// Memory in a child of its own: the peak of a process never falls again. A few steps of both kinds, to the end.
void print_memory(std::int64_t triangles, std::int64_t site_count) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const Sheet sheet = sheet_of(triangles);
    const double before = peak_memory_mb();
    const OptimisedSites sites = optimise_sites({sheet.points, sheet.triangles, {}, {}}, sites_of(sheet, site_count),
                                                {}, {.lloyd_iterations = 1, .iterations = 3});
    std::printf("%lld sites on %lld triangles: peak %.0f MB, of them %.0f the input\n",
                static_cast<long long>(site_count), static_cast<long long>(triangles), peak_memory_mb(), before);
    std::fflush(stdout);
    _exit(sites.sites.empty() ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  print_memory(1000000, 100000);  // before there are threads that a fork would lose
  print_memory(2000000, 1000000);
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print_ratios();
  return 0;
}
