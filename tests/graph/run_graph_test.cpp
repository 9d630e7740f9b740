#include "graph/run_graph.h"

#include <gtest/gtest.h>

#include "graph/number_stages.h"

namespace strataflow {
namespace {

using namespace support;

TEST(RunGraph, a_diamond_gives_the_same_digests_on_every_schedule) {
  const StageGraph graph = diamond();
  const auto expected = facts(run_graph(graph, serial()));
  ASSERT_EQ(expected[1].substr(expected[1].find('[')), "[negative_factor: scale]");
  for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(facts(run_graph(graph, on_threads(threads))), expected) << threads;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    EXPECT_EQ(facts(run_graph(graph, shuffled(seed))), expected) << "seed " << seed;
}

TEST(RunGraph, a_wide_graph_gives_the_same_digests_on_every_schedule) {
  const StageGraph graph = wide(12);
  const auto expected = facts(run_graph(graph, serial()));
  for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(facts(run_graph(graph, on_threads(threads))), expected) << threads;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    EXPECT_EQ(facts(run_graph(graph, shuffled(seed))), expected) << "seed " << seed;
}

TEST(RunGraph, another_seed_gives_other_digests) {
  EXPECT_NE(facts(run_graph(diamond(1), serial())), facts(run_graph(diamond(2), serial())));
}

/// Leans on the order of its loop: what the shuffled executor is for.
struct LeanOnOrder {
  static constexpr std::string_view name = "lean_on_order";
  static constexpr int version = 1;
  NoOptions options;
  Result<Numbers> operator()(StageContext&) const {
    std::vector<double> seen;
    parallel_ranges(20, 1, [&](std::size_t begin, std::size_t) { seen.push_back(static_cast<double>(begin)); });
    return Numbers{seen};
  }
};

TEST(RunGraph, the_shuffled_executor_finds_a_stage_that_leans_on_the_order_of_its_loop) {
  StageGraph graph;
  graph.add("lean", LeanOnOrder{});
  EXPECT_NE(facts(run_graph(graph, shuffled(1))), facts(run_graph(graph, serial())));
}

TEST(RunGraph, wanted_outputs_are_there_and_the_others_are_not) {
  StageGraph graph;
  const auto drawn = graph.add("draw", DrawNumbers{{.count = 3}});
  const auto dot = graph.add("dot", DotNumbers{}, drawn, drawn);
  RunOptions options = serial();
  options.wanted = {dot.node(), dot.node()};
  const RunOutcome outcome = run_graph(graph, options);
  EXPECT_EQ(outcome.output(drawn), nullptr);
  ASSERT_NE(outcome.output(dot), nullptr);
  EXPECT_GT(outcome.output(dot)->value, 0.0);
  EXPECT_TRUE(outcome.is_ok());
}

/// Counts how many of it are alive.
struct Tracked {
  static inline std::atomic<int> alive{0};
  static inline std::atomic<int> most_alive{0};
  int value = 0;
  Tracked() { count(); }
  Tracked(const Tracked& other) : value(other.value) { count(); }
  ~Tracked() { --alive; }
  static void count() { most_alive = std::max(most_alive.load(), ++alive); }
  template <class A>
  void archive(A& a) {
    a(value);
  }
};
struct StartTracked {
  static constexpr std::string_view name = "start_tracked";
  static constexpr int version = 1;
  NoOptions options;
  Result<Tracked> operator()(StageContext&) const { return Tracked{}; }
};
struct PassTracked {
  static constexpr std::string_view name = "pass_tracked";
  static constexpr int version = 1;
  NoOptions options;
  Result<Tracked> operator()(const Tracked& tracked, StageContext&) const { return tracked; }
};

TEST(RunGraph, an_output_is_released_when_its_last_consumer_has_run) {
  StageGraph graph;
  auto port = graph.add("start", StartTracked{});
  for (int i = 0; i < 50; ++i) port = graph.add("pass/" + std::to_string(i), PassTracked{}, port);
  Tracked::most_alive = 0;
  ASSERT_TRUE(run_graph(graph, on_threads(2)).is_ok());
  EXPECT_LE(Tracked::most_alive, 6);
  EXPECT_EQ(Tracked::alive, 0);
}

TEST(RunGraph, a_failure_skips_what_depends_on_it_and_nothing_else) {
  StageGraph graph;
  const auto drawn = graph.add("draw", DrawNumbers{{.count = 5}});
  const auto refused_late = graph.add("refuse 1", RefuseNumbers{}, drawn);
  const auto scaled = graph.add("scale", ScaleNumbers{{.factor = 7}}, drawn);
  const auto refused = graph.add("refuse 2", RefuseNumbers{}, scaled);
  const auto after = graph.add("sort", SortNumbers{}, refused);
  const auto join = graph.add("dot", DotNumbers{}, after, refused_late);
  const auto other = graph.add("dot", DotNumbers{}, drawn, scaled);
  const RunOutcome outcome = run_graph(graph, serial());
  EXPECT_EQ(outcome[refused.node()].status, NodeStatus::failed);
  EXPECT_EQ(outcome[refused.node()].failure->what, "refuse 2 refuses");
  EXPECT_EQ(outcome[after.node()].status, NodeStatus::skipped);
  EXPECT_EQ(outcome[after.node()].failure->code, FailureCode::upstream_failed);
  EXPECT_EQ(outcome[after.node()].failure->what, "stage refuse 2 failed");
  EXPECT_EQ(outcome[join.node()].failure->what, "stage refuse 1 failed");  // the first in node order
  EXPECT_EQ(outcome[other.node()].status, NodeStatus::ok);
  EXPECT_FALSE(outcome.is_ok());
  EXPECT_FALSE(outcome.is_cancelled);
  EXPECT_EQ(outcome.failed_nodes(), (std::vector<NodeId>{{1}, {3}}));
  for (std::uint64_t seed = 0; seed < 50; ++seed) EXPECT_EQ(facts(run_graph(graph, shuffled(seed))), facts(outcome));
  for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(facts(run_graph(graph, on_threads(threads))), facts(outcome));
}

struct BreakPromise {
  static constexpr std::string_view name = "break_promise";
  static constexpr int version = 1;
  NoOptions options;
  Result<Numbers> operator()(const Numbers& numbers, StageContext&) const {
    return Numbers{parallel_map(numbers.values.size(), [](std::size_t i) {
      STRATAFLOW_ASSERT(i < 3, "item " + std::to_string(i));
      return 0.0;
    })};
  }
};

struct DrawUndeclared {
  static constexpr std::string_view name = "draw_undeclared";
  static constexpr int version = 1;
  NoOptions options;
  Result<Total> operator()(StageContext& context) const { return Total{static_cast<double>(context.seed())}; }
};

TEST(RunGraph, a_bug_of_ours_becomes_the_failure_of_its_node) {
  StageGraph graph;
  const auto drawn = graph.add("draw", DrawNumbers{{.count = 9}});
  const auto broken = graph.add("break", BreakPromise{}, drawn);
  const auto undeclared = graph.add("undeclared", DrawUndeclared{});
  const RunOutcome outcome = run_graph(graph, on_threads(2));
  EXPECT_EQ(outcome[broken.node()].failure->code, FailureCode::internal_error);
  EXPECT_NE(outcome[broken.node()].failure->what.find("item 3"), std::string::npos)
      << outcome[broken.node()].failure->what;
  EXPECT_EQ(outcome[undeclared.node()].failure->code, FailureCode::internal_error);
}

struct CancelRun {
  static constexpr std::string_view name = "cancel_run";
  static constexpr int version = 1;
  NoOptions options;
  CancellationToken* token;
  Result<Numbers> operator()(const Numbers& numbers, StageContext& context) const {
    token->cancel();
    if (context.is_cancelled()) return Failure{FailureCode::cancelled, "stopped half-way", "run it again"};
    return numbers;
  }
};

TEST(RunGraph, after_a_cancellation_nothing_new_starts) {
  StageGraph graph;
  CancellationToken token;
  const auto drawn = graph.add("draw", DrawNumbers{{.count = 9}});
  const auto cancelling = graph.add("cancel", CancelRun{{}, &token}, drawn);
  const auto dependent = graph.add("sort", SortNumbers{}, cancelling);
  const auto independent = graph.add("scale", ScaleNumbers{}, drawn);
  RunOptions options = serial();
  options.cancellation = &token;
  const RunOutcome outcome = run_graph(graph, options);
  EXPECT_EQ(outcome[drawn.node()].status, NodeStatus::ok);
  EXPECT_EQ(outcome[cancelling.node()].status, NodeStatus::failed);
  EXPECT_EQ(outcome[dependent.node()].failure->code, FailureCode::cancelled);
  EXPECT_EQ(outcome[independent.node()].status, NodeStatus::skipped);
  EXPECT_EQ(outcome[independent.node()].failure->code, FailureCode::cancelled);
  EXPECT_TRUE(outcome.is_cancelled);
}

TEST(RunGraph, stop_after_runs_a_stage_and_what_it_needs) {
  RunOptions options = serial();
  options.stop_after = "scale_numbers";
  const RunOutcome outcome = run_graph(diamond(), options);
  EXPECT_EQ(outcome.nodes[0].status, NodeStatus::ok);
  EXPECT_EQ(outcome.nodes[1].status, NodeStatus::ok);
  EXPECT_EQ(outcome.nodes[2].status, NodeStatus::skipped);
  EXPECT_EQ(outcome.nodes[3].status, NodeStatus::skipped);
  EXPECT_TRUE(outcome.is_ok());
}

struct Listener : ProgressSink {
  std::vector<std::string> lines;
  void node_started(NodeId, const StageNode& node) override { lines.push_back("start " + node.name); }
  void node_progressed(NodeId, const StageNode&, double ratio) override { lines.push_back(std::to_string(ratio)); }
  void node_finished(NodeId, const StageNode& node, double, bool is_ok, bool is_cached) override {
    lines.push_back((is_ok ? "ok " : "failed ") + node.name + (is_cached ? " cached" : ""));
  }
};
struct ReportHalf {
  static constexpr std::string_view name = "report_half";
  static constexpr int version = 1;
  NoOptions options;
  Result<Total> operator()(StageContext& context) const {
    context.report_progress(0.5);
    return Total{};
  }
};

TEST(RunGraph, progress_is_told) {
  StageGraph graph;
  graph.add("half", ReportHalf{});
  Listener listener;
  RunOptions options = serial();
  options.progress = &listener;
  const RunOutcome outcome = run_graph(graph, options);
  EXPECT_EQ(listener.lines, (std::vector<std::string>{"start half", "0.500000", "ok half"}));
  EXPECT_GE(outcome.timings[0].seconds, 0.0);
  EXPECT_GE(outcome.total_s, outcome.timings[0].start_s + outcome.timings[0].seconds);
}

TEST(RunGraph, an_empty_graph_is_done_at_once) { EXPECT_TRUE(run_graph(StageGraph{}, on_threads(2)).is_ok()); }

}  // namespace
}  // namespace strataflow
