// What the graph itself costs: nodes per second of run_graph with stages that do next to nothing, and the speed at
// which outputs go to the stage store and come back.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/seed.h"
#include "graph/run_graph.h"
#include "graph/stage_store.h"

namespace {

using namespace strataflow;
namespace fs = std::filesystem;

struct Count {
  std::uint64_t value = 0;
  template <class A>
  void archive(A& a) {
    a(value);
  }
};

struct Start {
  static constexpr std::string_view name = "start";
  static constexpr int version = 1;
  struct Options {
    std::int64_t value = 0;
    template <class Visitor>
    void visit_fields(Visitor& visit) {
      visit(value, OptionField{.name = "value", .description = "what it puts out"});
    }
  } options;
  Result<Count> operator()(StageContext&) const { return Count{static_cast<std::uint64_t>(options.value)}; }
};

struct Add {
  static constexpr std::string_view name = "add";
  static constexpr int version = 1;
  NoOptions options;
  Result<Count> operator()(const Count& a, const Count& b, StageContext&) const { return Count{mix64(a.value) + b.value}; }
};

/// About `nodes` nodes in rows of ten; each adds its two neighbours in the row above.
StageGraph grid(std::int64_t nodes) {
  constexpr std::size_t width = 10;
  StageGraph graph;
  std::vector<Port<Count>> row;
  // Different values: equal nodes would become one.
  for (std::size_t i = 0; i < width; ++i)
    row.push_back(graph.add("start/" + std::to_string(i), Start{{static_cast<std::int64_t>(i)}}));
  for (std::int64_t r = 1; r < nodes / static_cast<std::int64_t>(width); ++r) {
    std::vector<Port<Count>> next;
    for (std::size_t i = 0; i < width; ++i)
      next.push_back(
          graph.add("add/" + std::to_string(r) + "/" + std::to_string(i), Add{}, row[i], row[(i + 1) % width]));
    row = std::move(next);
  }
  return graph;
}

/// The rate counter is nodes per second. Arguments: nodes; threads, 0 for the serial executor.
void run_empty_stages(benchmark::State& state) {
  const StageGraph graph = grid(state.range(0));
  RunOptions options;
  options.executor = state.range(1) == 0 ? ExecutorKind::serial : ExecutorKind::tbb;
  options.threads = static_cast<int>(state.range(1));
  for (auto _ : state)
    if (!run_graph(graph, options).is_ok()) state.SkipWithError("the run failed");
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(graph.node_count()));
}
BENCHMARK(run_empty_stages)
    ->ArgsProduct({{100, 1000, 10000}, {0, 1, 2, 4}})
    ->ArgNames({"nodes", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// A stage store in a folder of its own, removed at the end. TMPDIR says on which disk.
class ScratchStore {
 public:
  ScratchStore()
      : folder_(fs::temp_directory_path() / ("strataflow_bench_" + std::to_string(::getpid()))),
        store_(*StageStore::open(folder_)) {}
  ~ScratchStore() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  StageStore* operator->() const { return store_.get(); }

 private:
  fs::path folder_;
  std::unique_ptr<StageStore> store_;
};

std::vector<std::byte> random_bytes(std::int64_t count) {
  RandomStream random(1);
  std::vector<std::byte> bytes;
  for (std::int64_t i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>(random.below(256)));
  return bytes;
}

/// One entry over and over, its digest included: what run_graph does for an output.
void write_to_store(benchmark::State& state) {
  const ScratchStore store;
  const std::vector<std::byte> payload = random_bytes(state.range(0));
  const Digest key = digest_of(payload);
  for (auto _ : state)
    if (!store->save(key, digest_of(payload), {}, payload)) state.SkipWithError("not stored");
  state.SetBytesProcessed(state.iterations() * state.range(0));
}

/// Found, read and checked against its digest.
void read_from_store(benchmark::State& state) {
  const ScratchStore store;
  const std::vector<std::byte> payload = random_bytes(state.range(0));
  const Digest key = digest_of(payload);
  if (!store->save(key, key, {}, payload)) state.SkipWithError("not stored");
  for (auto _ : state) {
    const auto found = store->find(key);
    if (!found || !store->load(key, *found)) state.SkipWithError("not found");
  }
  state.SetBytesProcessed(state.iterations() * state.range(0));
}
#define STRATAFLOW_SIZES ->Arg(1 << 10)->Arg(1 << 16)->Arg(1 << 22)->Arg(1 << 26)->ArgName("bytes")->UseRealTime()
BENCHMARK(write_to_store) STRATAFLOW_SIZES;
BENCHMARK(read_from_store) STRATAFLOW_SIZES;

}  // namespace

BENCHMARK_MAIN();
