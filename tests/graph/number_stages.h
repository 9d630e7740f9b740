#pragma once
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "base/seed.h"
#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "graph/run_graph.h"

// Small stages that use every parallel loop, and graphs made of them.
namespace strataflow::support {

/// How many stages ran (rather than being taken from the store).
inline std::atomic<int> stages_run{0};

struct Numbers {
  std::vector<double> values;
  template <class A>
  void archive(A& a) {
    a(values);
  }
};
struct Total {
  double value = 0;
  template <class A>
  void archive(A& a) {
    a(value);
  }
};

struct DrawNumbers {
  static constexpr std::string_view name = "draw_numbers";
  static constexpr int version = 1;
  static constexpr bool uses_seed = true;
  struct Options {
    std::int64_t count = 30000;
    template <class Visitor>
    void visit_fields(Visitor& visit) {
      visit(count, OptionField{.name = "count", .description = "how many"});
    }
  } options;
  Result<Numbers> operator()(StageContext& context) const {
    ++stages_run;
    const std::uint64_t seed = context.seed();
    return Numbers{parallel_map(
        static_cast<std::size_t>(options.count), [&](std::size_t i) { return RandomStream(mix64(seed + i)).unit(); },
        64)};
  }
};

struct ScaleNumbers {
  static constexpr std::string_view name = "scale_numbers";
  static constexpr int version = 1;
  struct Options {
    double factor = 1.0;
    template <class Visitor>
    void visit_fields(Visitor& visit) {
      visit(factor, OptionField{.name = "factor", .description = "multiplied with each number"});
    }
  } options;
  Result<Numbers> operator()(const Numbers& numbers, StageContext& context) const {
    ++stages_run;
    if (options.factor < 0) context.warn("negative_factor", context.node_name());
    return Numbers{parallel_map(
        numbers.values.size(), [&](std::size_t i) { return std::fma(numbers.values[i], options.factor, 1e-3); }, 100)};
  }
};

struct SortNumbers {
  static constexpr std::string_view name = "sort_numbers";
  static constexpr int version = 1;
  NoOptions options;
  Result<Numbers> operator()(const Numbers& numbers, StageContext&) const {
    ++stages_run;
    struct Entry {
      double rounded;
      std::size_t index;
    };
    std::vector<Entry> entries(numbers.values.size());  // rounding makes ties
    for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = {std::floor(numbers.values[i] * 100), i};
    sort_total_order(entries, [](const Entry& a, const Entry& b) {
      return a.rounded != b.rounded ? a.rounded < b.rounded : a.index < b.index;
    });
    return Numbers{parallel_map(
        entries.size(), [&](std::size_t i) { return numbers.values[entries[i].index]; }, 500)};
  }
};

struct DotNumbers {
  static constexpr std::string_view name = "dot_numbers";
  static constexpr int version = 1;
  NoOptions options;
  Result<Total> operator()(const Numbers& a, const Numbers& b, StageContext&) const {
    ++stages_run;
    return Total{ordered_reduce(
        a.values.size(), 0.0, [&](std::size_t i) { return a.values[i] * b.values[i]; },
        [](double left, double right) { return left + right; })};
  }
};

struct AddTotals {
  static constexpr std::string_view name = "add_totals";
  static constexpr int version = 1;
  NoOptions options;
  Result<Total> operator()(const std::vector<const Total*>& totals, StageContext&) const {
    ++stages_run;
    Total sum;
    for (const Total* total : totals) sum.value += total->value;
    return sum;
  }
};

/// Always fails.
struct RefuseNumbers {
  static constexpr std::string_view name = "refuse_numbers";
  static constexpr int version = 1;
  NoOptions options;
  Result<Numbers> operator()(const Numbers&, StageContext& context) const {
    return Failure{FailureCode::geometry_failed, context.node_name() + " refuses", "ask something else"};
  }
};

/// draw → scale, sort → dot: the smallest graph with a fork and a join.
inline StageGraph diamond(std::uint64_t seed = 1) {
  StageGraph graph(seed);
  const auto drawn = graph.add("draw", DrawNumbers{});
  const auto scaled = graph.add("scale", ScaleNumbers{{.factor = -0.1}}, drawn);
  const auto sorted = graph.add("sort", SortNumbers{}, drawn);
  graph.add("dot", DotNumbers{}, scaled, sorted);
  return graph;
}

/// One source, `width` branches of three stages, one sink.
inline StageGraph wide(int width, std::int64_t count = 5000) {
  StageGraph graph;
  const auto drawn = graph.add("draw", DrawNumbers{{.count = count}});
  std::vector<Port<Total>> totals;
  for (int i = 0; i < width; ++i) {
    const std::string branch = "/" + std::to_string(i);
    const auto scaled = graph.add("scale" + branch, ScaleNumbers{{.factor = 0.1 * i}}, drawn);
    const auto sorted = graph.add("sort" + branch, SortNumbers{}, scaled);
    totals.push_back(graph.add("dot" + branch, DotNumbers{}, scaled, sorted));
  }
  graph.add("sum", AddTotals{}, totals);
  return graph;
}

/// One line per node: everything a report may show of a run.
inline std::vector<std::string> facts(const RunOutcome& outcome) {
  std::vector<std::string> lines;
  for (const NodeOutcome& node : outcome.nodes) {
    std::string line = std::string(to_string(node.status)) + (node.digest ? " " + node.digest->hex() : "");
    for (const Warning& warning : node.warnings) line += " [" + warning.kind + ": " + warning.what + "]";
    if (node.failure) line += " " + std::string(to_string(node.failure->code)) + " " + describe(*node.failure);
    lines.push_back(line);
  }
  return lines;
}

inline RunOptions serial() { return {.executor = ExecutorKind::serial}; }
inline RunOptions on_threads(int threads) { return {.executor = ExecutorKind::tbb, .threads = threads}; }
inline RunOptions shuffled(std::uint64_t seed) { return {.executor = ExecutorKind::shuffled, .shuffle_seed = seed}; }

}  // namespace strataflow::support
