// Generated fault networks through the whole quad mesher: what succeeds, how good the quads are, where the time goes.
// `bench_quads [COUNT] [FIRST] [FIELD]` meshes COUNT networks (300) from number FIRST (0) on without fallback, those
// that fail once more with it, tells why, and prints a table by family. FIELD is that of [quad]: fast, polynomial or
// polyvector. `bench_quads FILE EDGE_M [FIELD] [THREADS]` meshes the lines of a file instead and tells the time of each
// stage: Branets at 7 has the 36 000 triangles of the thesis' largest plan.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include <tbb/global_control.h>

#include "graph/parallel/schedule.h"
#include "io/read_input.h"
#include "support/quad_network.h"

namespace {

using namespace strataflow;
using support::NetworkOutcome;

struct Tally {
  std::size_t networks = 0, without_fallback = 0, with_fallback = 0, inverted = 0;
  std::size_t other_fields = 0, imprints = 0, unmet = 0, triangles = 0, quads = 0, irregular = 0;
  double smallest_jacobian = 1, sum_jacobian = 0, slowest_s = 0;
  std::array<double, NetworkOutcome::stage_names.size()> cpu_s{};

  void add(const NetworkOutcome& plain, const NetworkOutcome& last) {
    ++networks;
    without_fallback += plain.succeeded();
    with_fallback += last.succeeded();
    inverted += last.inverted;
    other_fields += plain.took_other_field;
    imprints += plain.was_imprinted;
    unmet += plain.has_unmet;
    triangles += plain.triangles;
    double all = 0;
    for (std::size_t s = 0; s < cpu_s.size(); ++s) {
      cpu_s[s] += plain.cpu_s[s];
      all += plain.cpu_s[s];
    }
    slowest_s = std::max(slowest_s, all);
    if (!plain.succeeded()) return;
    quads += plain.quads;
    irregular += plain.irregular;
    smallest_jacobian = std::min(smallest_jacobian, plain.smallest_jacobian);
    sum_jacobian += plain.mean_jacobian * static_cast<double>(plain.quads);
  }

  void print(const std::string& name) const {
    std::printf("| %-15s | %4zu | %4zu | %4zu | %3zu | %3zu | %3zu | %3zu | %7zu | %7zu | %6zu | %6.3f | %5.3f |",
                name.c_str(), networks, without_fallback, with_fallback, inverted, other_fields, imprints, unmet,
                triangles, quads, irregular, smallest_jacobian,
                quads > 0 ? sum_jacobian / static_cast<double>(quads) : 0);
    for (const double s : cpu_s) std::printf(" %6.2f |", s);
    std::printf(" %5.2f |\n", slowest_s);
  }
};

int mesh_file(const std::string& file, double edge_m, const FrameFieldOptions& field, std::size_t threads) {
  const Result<InputData> input = read_input(file);
  if (!input) {
    std::fprintf(stderr, "%s\n", input.failure().what.c_str());
    return EXIT_FAILURE;
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const ScheduleScope schedule(threads > 1 ? ScheduleKind::threads : ScheduleKind::serial);
  const NetworkOutcome outcome =
      support::mesh_network({file, input->lines, input->point_sets, edge_m}, "none", field);
  double cpu_s = 0, wall_s = 0;
  for (std::size_t s = 0; s < outcome.cpu_s.size(); ++s) {
    std::printf("%-8s %6.2f s, %6.2f s of processors\n", NetworkOutcome::stage_names[s], outcome.wall_s[s], outcome.cpu_s[s]);
    cpu_s += outcome.cpu_s[s];
    wall_s += outcome.wall_s[s];
  }
  std::printf("%-8s %6.2f s, %6.2f s of processors, %zu threads\n", "all", wall_s, cpu_s, threads);
  std::printf("%zu triangles, %zu quads, %zu irregular, %zu inverted, scaled Jacobian %.3f, mean %.3f%s%s\n",
              outcome.triangles, outcome.quads, outcome.irregular, outcome.inverted, outcome.smallest_jacobian,
              outcome.mean_jacobian, outcome.succeeded() ? "" : ": ", outcome.failure.c_str());
  return outcome.succeeded() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int count, char** arguments) {
  const auto number = [&](int i, unsigned long otherwise) {
    return static_cast<std::uint32_t>(count > i ? std::strtoul(arguments[i], nullptr, 10) : otherwise);
  };
  const std::uint32_t networks = number(1, 300), first = number(2, 0);
  FrameFieldOptions field;
  if (count > 3) field.kind = arguments[3];
  if (count > 2 && std::filesystem::exists(arguments[1]))
    return mesh_file(arguments[1], std::strtod(arguments[2], nullptr), field, number(4, 1));
  std::map<std::string, Tally> families;
  Tally total;
  for (std::uint32_t n = first; n < first + networks; ++n) {
    const GeneratedNetwork network = generate_network(n);
    const NetworkOutcome plain = support::mesh_network(network, "none", field);
    NetworkOutcome last = plain;
    if (!plain.succeeded()) {
      last = support::mesh_network(network, "subdivide", field);
      std::fprintf(stderr, "network %u (%s): %s%s\n", n, network.name.c_str(), plain.failure.c_str(),
                   last.succeeded() ? "" : ("; with fallback: " + last.failure).c_str());
    }
    if (networks == 1)
      std::printf("%zu triangles, %zu half-edges left of them, scaled Jacobian %g\n", plain.triangles, plain.half_edges,
                  plain.smallest_jacobian);
    const std::string family = network.name.substr(0, network.name.find_last_of(' '));
    families[family].add(plain, last);
    total.add(plain, last);
  }
  std::puts(
      "| family | networks | without fallback | with it | inverted | other field | imprinted | unmet strips | triangles "
      "| quads | irregular | scaled Jacobian, smallest | mean | plan s | field s | map s | quantize s | extract s "
      "| slowest s |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const auto& [name, tally] : families) tally.print(name);
  total.print("all");
  return total.without_fallback * 100 >= total.networks * 99 && total.with_fallback == total.networks &&
                 total.inverted == 0
             ? EXIT_SUCCESS
             : EXIT_FAILURE;
}
