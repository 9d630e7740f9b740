#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/cancellation.h"
#include "base/digest.h"
#include "base/failure.h"
#include "base/warning.h"
#include "graph/stage_graph.h"

namespace strataflow {

class StageStore;

enum class ExecutorKind : std::uint8_t {
  tbb,      ///< nodes and the loops inside them on threads
  serial,   ///< one after the other, in node order
  shuffled  ///< one after the other, nodes and loop chunks in a random order (for tests)
};

/// Told what happens while it happens, for people. Calls come one at a time, from any thread.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  virtual void node_started(NodeId, const StageNode&) {}
  /// `ratio` in [0, 1].
  virtual void node_progressed(NodeId, const StageNode&, double /*ratio*/) {}
  virtual void node_finished(NodeId, const StageNode&, double /*seconds*/, bool /*is_ok*/, bool /*is_cached*/) {}
};

struct RunOptions {
  ExecutorKind executor = ExecutorKind::tbb;
  int threads = 0;                 ///< tbb: ≥ 1 threads, also more than cores; 0: all cores
  std::uint64_t shuffle_seed = 0;  ///< shuffled: which order
  StageStore* store = nullptr;     ///< outputs of earlier runs; null: none
  const CancellationToken* cancellation = nullptr;
  ProgressSink* progress = nullptr;
  std::vector<NodeId> wanted = {};  ///< nodes whose outputs are there after the run; the others are released early
  std::string stop_after = {};      ///< a stage's name: only its nodes and what they need run. Empty: everything runs
};

enum class NodeStatus : std::uint8_t {
  ok,
  failed,
  skipped  ///< not run: something upstream failed, the run was cancelled, or it is not needed for `stop_after`
};
std::string_view to_string(NodeStatus status);

/// What became of a node: the same on every schedule, with and without a store.
struct NodeOutcome {
  NodeStatus status = NodeStatus::skipped;
  std::optional<Digest> digest;  ///< of the archived output; present exactly when ok
  std::vector<Warning> warnings;
  std::optional<Failure> failure;  ///< when failed; when skipped: upstream_failed (names the node) or cancelled
};

/// Facts of this one run, kept apart because they are never the same twice.
struct NodeTiming {
  double start_s = 0;  ///< since the run began
  double seconds = 0;
  bool is_cached = false;
  std::string not_stored = {};  ///< why the output did not go to the store, if it did not: costs time later, no more
};

/// What became of a run. `nodes` and `timings` are in node order.
class RunOutcome {
 public:
  std::vector<NodeOutcome> nodes;
  std::vector<NodeTiming> timings;
  double total_s = 0;
  bool is_cancelled = false;

  /// No node failed and nothing was cancelled.
  bool is_ok() const;
  /// The failed nodes in node order (skipped ones are not among them).
  std::vector<NodeId> failed_nodes() const;
  const NodeOutcome& operator[](NodeId id) const { return nodes[id.value]; }

  /// The output of a wanted node; null if it did not succeed.
  template <class T>
  std::shared_ptr<const T> output(Port<T> port) const {
    return std::static_pointer_cast<const T>(outputs[port.node().value]);
  }
  std::vector<AnyOutput> outputs;  ///< per node; null unless wanted and ok
};

/// Runs every node of `graph` once, its inputs first. Never fails as a whole: a node's failure stays with it and skips
/// what depends on it; everything else goes on. Two runs at once in one process are not allowed (ScheduleScope).
RunOutcome run_graph(const StageGraph& graph, const RunOptions& options = {});

}  // namespace strataflow
