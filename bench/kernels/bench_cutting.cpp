// The exact cutter beside CGAL in one run: the whole arrangement of a generated horizon and fault against corefinement,
// the census of intersections against self_intersections with its parallel tag, cut triangles a second on one core,
// growth from 2 × 50 k to 2 × 2 M, one thread against two, and memory. Prints the ratios after the benchmarks. Needs
// STRATAFLOW_DATA (a folder with ringmesh-A4 and scec-cfm61) for two of the lines, which are left out without it.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>

#include "graph/parallel/schedule.h"
#include "io/read_input.h"
#include "kernels/cutting/cut_surfaces.h"
#include "kernels/cutting/cut_triangles.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/topology/building/weld_points.h"

namespace {

using namespace strataflow;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

double peak_memory_mb(int whose) {
  rusage usage{};
  getrusage(whose, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Adds a surface of n × n squares of two triangles; `place` maps [0, 1]² into space.
void add_sheet(TriangleSoup& soup, const char* name, std::uint32_t n,
               const std::function<Vec3(double, double)>& place) {
  const auto base = static_cast<std::uint32_t>(soup.points.size());
  const auto patch = static_cast<std::uint32_t>(soup.patch_entity.size());
  soup.patch_entity.push_back(static_cast<std::uint32_t>(soup.entities.size()));
  soup.entities.emplace_back().name = name;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      soup.points.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / n));
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = base + i * (n + 1) + j, b = a + n + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
      soup.triangle_patch.insert(soup.triangle_patch.end(), 2, patch);
    }
}

/// A wavy horizon and a wavy dipping fault through it in a box of 1 km, about `each` triangles each.
TriangleSoup horizon_and_fault(std::int64_t each) {
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(each) / 2)));
  TriangleSoup soup;
  add_sheet(soup, "horizon", n, [](double u, double v) {
    return Vec3{1000 * u, 1000 * v, 500 + 60 * std::sin(7.1 * u + 1) * std::cos(5.3 * v)};
  });
  add_sheet(soup, "fault", n, [](double u, double v) {
    return Vec3{350 + 301.7 * v + 40 * std::sin(6.7 * u + 2 * v), 3.3 + 993.1 * u, 1000 * v};
  });
  return soup;
}

struct WeldedMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

WeldedMesh welded(const TriangleSoup& soup) {
  const WeldedPoints ids = weld_points(soup.points);
  WeldedMesh mesh;
  for (const std::uint32_t source : ids.source) mesh.points.push_back(soup.points[source]);
  for (const Triangle& t : soup.triangles) mesh.triangles.push_back({ids.id[t[0]], ids.id[t[1]], ids.id[t[2]]});
  return mesh;
}

/// The soup of a file of the shared data, read once; empty without it.
const TriangleSoup& data(const char* file) {
  static std::map<std::string, TriangleSoup> read;
  const auto [at, is_new] = read.try_emplace(file);
  const char* folder = std::getenv("STRATAFLOW_DATA");
  if (is_new && folder != nullptr)
    if (auto input = read_input(std::filesystem::path(folder) / file)) at->second = std::move(input->surfaces);
  return at->second;
}
constexpr const char* file_names[] = {"ringmesh-A4/modelA4.ml", "scec-cfm61/cfm61_native.tar.gz"};

Mesh mesh_of_patch(const TriangleSoup& soup, std::uint32_t patch) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertex(soup.points.size());
  const auto vertex_of = [&](std::uint32_t v) {
    if (!vertex[v].is_valid()) vertex[v] = mesh.add_vertex({soup.points[v].x, soup.points[v].y, soup.points[v].z});
    return vertex[v];
  };
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (soup.triangle_patch[t] == patch)
      mesh.add_face(vertex_of(soup.triangles[t][0]), vertex_of(soup.triangles[t][1]), vertex_of(soup.triangles[t][2]));
  return mesh;
}

/// All triangles as one halfedge mesh; CGAL needs it cut open where more than two meet.
Mesh whole_mesh(const TriangleSoup& soup) {
  std::vector<Mesh::Point> points;
  const WeldedMesh welded_mesh = welded(soup);
  for (const Vec3& p : welded_mesh.points) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::vector<std::size_t>> polygons;
  for (const Triangle& t : welded_mesh.triangles) polygons.push_back({t[0], t[1], t[2]});
  pmp::orient_polygon_soup(points, polygons);
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return mesh;
}

void arrange(benchmark::State& state) {
  const TriangleSoup soup = horizon_and_fault(state.range(0));
  for (auto _ : state) {
    const Result<CutResult> cut = cut_surfaces(soup);
    state.counters["out_triangles"] = static_cast<double>(cut->soup.triangles.size());
    state.counters["out_points"] = static_cast<double>(cut->soup.points.size());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(soup.triangles.size()));
}

void arrange_by_cgal(benchmark::State& state) {
  const TriangleSoup soup = horizon_and_fault(state.range(0));
  const Mesh horizon = mesh_of_patch(soup, 0), fault = mesh_of_patch(soup, 1);
  for (auto _ : state) {
    state.PauseTiming();
    Mesh a = horizon, b = fault;
    state.ResumeTiming();
    pmp::corefine(a, b);
    state.PauseTiming();
    state.counters["out_triangles"] = static_cast<double>(a.number_of_faces() + b.number_of_faces());
    state.counters["out_points"] = static_cast<double>(a.number_of_vertices() + b.number_of_vertices());
    state.ResumeTiming();
  }
}

/// Argument: file; threads.
void census(benchmark::State& state) {
  const TriangleSoup& soup = data(file_names[state.range(0)]);
  if (soup.triangles.empty()) return state.SkipWithError("set STRATAFLOW_DATA");
  const WeldedMesh mesh = welded(soup);
  for (auto _ : state)
    state.counters["pairs"] = static_cast<double>(find_intersections(mesh.points, mesh.triangles).size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.triangles.size()));
}

void census_by_cgal(benchmark::State& state) {
  const TriangleSoup& soup = data(file_names[state.range(0)]);
  if (soup.triangles.empty()) return state.SkipWithError("set STRATAFLOW_DATA");
  const Mesh mesh = whole_mesh(soup);
  using Face = Mesh::Face_index;
  for (auto _ : state) {
    std::vector<std::pair<Face, Face>> pairs;
    pmp::self_intersections<CGAL::Parallel_tag>(mesh, std::back_inserter(pairs));
    state.counters["pairs"] = static_cast<double>(pairs.size());
  }
}

/// One core. The argument: 0 the generated pair, 1 CFM native.
void cut_on_one_core(benchmark::State& state) {
  const TriangleSoup& soup = state.range(0) == 1 ? data(file_names[1]) : horizon_and_fault(500000);
  if (soup.triangles.empty()) return state.SkipWithError("set STRATAFLOW_DATA");
  const WeldedMesh mesh = welded(soup);
  const auto pairs = find_intersections(mesh.points, mesh.triangles);
  const ScheduleScope one(ScheduleKind::serial);
  std::uint64_t count = 0;
  for (auto _ : state) count += cut_triangles(mesh.points, mesh.triangles, pairs)->cut_triangle_count;
  state.SetItemsProcessed(static_cast<std::int64_t>(count));
}

/// Arguments: triangles of each; threads.
void find_pairs(benchmark::State& state) {
  const WeldedMesh mesh = welded(horizon_and_fault(state.range(0)));
  const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(find_intersections(mesh.points, mesh.triangles));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.triangles.size()));
}

#define STRATAFLOW_TIMED ->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()
BENCHMARK(arrange)->Arg(50000)->Arg(150000)->Arg(500000)->Arg(2000000) STRATAFLOW_TIMED;
BENCHMARK(arrange_by_cgal)->Arg(500000) STRATAFLOW_TIMED;
BENCHMARK(census)->Arg(0)->Arg(1) STRATAFLOW_TIMED;
BENCHMARK(census_by_cgal)->Arg(0)->Arg(1) STRATAFLOW_TIMED;
BENCHMARK(cut_on_one_core)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(find_pairs)->Args({500000, 1})->Args({500000, 2}) STRATAFLOW_TIMED;

/// Prints as usual and keeps the best time of each benchmark: other work on the machine only ever adds.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
      const std::string name = run.run_name.function_name + "/" + run.run_name.args;
      Times& best = best_.try_emplace(name).first->second;
      best.real = std::min(best.real, run.GetAdjustedRealTime());
      best.cpu = std::min(best.cpu, run.GetAdjustedCPUTime());
      if (run.counters.count("items_per_second"))
        best.rate = std::max(best.rate, run.counters.at("items_per_second").value);
    }
  }

  void print_ratios() const {
    std::printf("\n%-64s %9s  wanted\n", "ratio (best of repetitions; wall clock, in brackets CPU)", "measured");
    ratio("arrangement of 500 k + 500 k: CGAL corefine / ours", "arrange_by_cgal/500000", "arrange/500000", ">= 1.5");
    ratio("census of A4: CGAL self_intersections, parallel / ours", "census_by_cgal/0", "census/0", ">= 3");
    ratio("census of CFM native: the same", "census_by_cgal/1", "census/1", ">= 3");
    ratio("pair search of 500 k + 500 k: one thread / two", "find_pairs/500000/1", "find_pairs/500000/2", ">= 1.7");
    ratio("growth of arrangement, 2 x 500 k / 2 x 50 k (x 10)", "arrange/500000", "arrange/50000", "~ 10");
    ratio("growth of arrangement, 2 x 2 M / 2 x 500 k (x 4)", "arrange/2000000", "arrange/500000", "~ 4");
    for (const char* which : {"cut_on_one_core/0", "cut_on_one_core/1"})
      if (const auto at = best_.find(which); at != best_.end())
        std::printf("%-64s %9.0f  >= 60000\n", (std::string("cut triangles a second on one core, ") + which).c_str(),
                    at->second.rate);
  }

 private:
  struct Times {
    double real = 1e300, cpu = 1e300, rate = 0;
  };
  void ratio(const char* what, const char* over, const char* under, const char* wanted) const {
    const auto a = best_.find(over), b = best_.find(under);
    if (a == best_.end() || b == best_.end()) return;
    std::printf("%-64s %6.2f [%.2f]  %s\n", what, a->second.real / b->second.real, a->second.cpu / b->second.cpu,
                wanted);
  }
  std::map<std::string, Times> best_;
};

/// Memory in a child of its own: the peak of a process never falls again.
void print_memory(std::int64_t each) {
  const pid_t child = fork();
  if (child == 0) {
    const TriangleSoup soup = horizon_and_fault(each);
    const double before = peak_memory_mb(RUSAGE_SELF);
    const bool is_cut = static_cast<bool>(cut_surfaces(soup));
    const double million = static_cast<double>(soup.triangles.size()) * 1e-6, after = peak_memory_mb(RUSAGE_SELF);
    std::printf("%-64s %9.0f  < 400 (of them %.0f are the input)\n",
                ("peak MB per million triangles, 2 x " + std::to_string(each)).c_str(), after / million,
                before / million);
    std::fflush(stdout);
    _exit(is_cut ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  print_memory(500000);  // before there are threads that a fork would lose
  print_memory(2000000);
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print_ratios();
  return 0;
}
