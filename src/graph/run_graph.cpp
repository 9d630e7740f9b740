#include "graph/run_graph.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <new>
#include <span>

#include "graph/executors/serial_executor.h"
#include "graph/executors/shuffled_executor.h"
#include "graph/executors/tbb_executor.h"
#include "graph/stage_store.h"

namespace strataflow {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

Failure cancelled_failure() {
  return {FailureCode::cancelled, "the run was cancelled", "run it again to go on from there"};
}

/// The nodes that `stop_after` leaves: all, or its nodes and everything they need.
std::vector<char> needed_nodes(const StageGraph& graph, const std::string& stop_after) {
  std::vector<char> is_needed(graph.node_count(), stop_after.empty());
  for (std::size_t id = graph.node_count(); id-- > 0;) {
    const StageNode& node = graph.nodes()[id];
    if (!stop_after.empty() && node.stage == stop_after) is_needed[id] = 1;
    if (is_needed[id])
      for (const NodeId input : node.inputs) is_needed[input.value] = 1;
  }
  return is_needed;
}

/// What a node's output is made of. Equal keys: equal outputs.
Digest key_of(const StageNode& node, const std::vector<Digest>& inputs, const Digest& files) {
  ArchiveWriter writer;
  writer(stage_store_format, node.stage, node.version, node.options, node.seed, files.high, files.low);
  for (const Digest& input : inputs) writer(input.high, input.low);
  return digest_of(writer.bytes());
}

/// One run. Each node is handled by one task, after its inputs' tasks; a task writes its own outcome, timing and slot
/// only. The output in a slot may later be released, or read again from the store, under the slot's lock.
class GraphRun {
 public:
  GraphRun(const StageGraph& graph, const RunOptions& options)
      : graph_(graph),
        options_(options),
        slots_(graph.node_count()),
        is_needed_(needed_nodes(graph, options.stop_after)),
        begin_(Clock::now()) {
    outcome_.nodes.resize(graph.node_count());
    outcome_.timings.resize(graph.node_count());
    outcome_.outputs.resize(graph.node_count());
    order_.input_count.resize(graph.node_count());
    order_.consumers.resize(graph.node_count());
    const auto consumers = graph.consumers();
    for (std::size_t id = 0; id < consumers.size(); ++id) {
      slots_[id].uses_left = consumers[id].size();
      for (const NodeId consumer : consumers[id]) {
        order_.consumers[id].push_back(consumer.value);
        ++order_.input_count[consumer.value];
      }
    }
    for (const NodeId id : options.wanted) {
      Slot& slot = slots_[id.value];
      if (!slot.is_wanted) ++slot.uses_left;
      slot.is_wanted = true;
    }
  }

  RunOutcome run() {
    auto task = [this](std::size_t id) { handle(static_cast<std::uint32_t>(id)); };
    switch (options_.executor) {
      case ExecutorKind::serial:
        run_tasks_in_order(order_, task);
        break;
      case ExecutorKind::shuffled:
        run_tasks_shuffled(order_, options_.shuffle_seed, task);
        break;
      case ExecutorKind::tbb:
        run_tasks_on_threads(order_, options_.threads, task);
        break;
    }
    for (const NodeId id : options_.wanted)
      if (outcome_[id].status == NodeStatus::ok) outcome_.outputs[id.value] = slots_[id.value].output;
    outcome_.is_cancelled = std::any_of(outcome_.nodes.begin(), outcome_.nodes.end(), [](const NodeOutcome& node) {
      return node.failure && node.failure->code == FailureCode::cancelled;
    });
    if (options_.store && has_saved_) options_.store->evict();
    outcome_.total_s = seconds_between(begin_, Clock::now());
    return std::move(outcome_);
  }

 private:
  struct Slot {
    std::mutex mutex;
    AnyOutput output;           ///< null: not made, released, or not read from the store yet
    std::size_t uses_left = 0;  ///< consumers that are not through, and one if wanted
    bool is_wanted = false;
    // Written by the node's own task, before its consumers start.
    std::optional<Digest> key;           ///< absent: no store, or its files could not be read
    std::optional<StoredOutput> stored;  ///< present when the output can be read from the store
    std::uint32_t cause = 0;             ///< the node whose failure made this one fail or be skipped
  };

  /// One node from start to end. Never throws.
  void handle(std::uint32_t id) {
    NodeOutcome& outcome = outcome_.nodes[id];
    NodeTiming& timing = outcome_.timings[id];
    const Clock::time_point start = Clock::now();
    timing.start_s = seconds_between(begin_, start);
    if (is_needed_[id] && !is_skipped(id)) {
      tell([&](ProgressSink& sink) { sink.node_started({id}, graph_.nodes()[id]); });
      const Result<void> result = guarded(id, [&] { return produce(id); });
      outcome.status = result ? NodeStatus::ok : NodeStatus::failed;
      if (!result) {
        outcome.failure = result.failure();
        outcome.digest.reset();
        slots_[id].cause = id;
      }
      timing.seconds = seconds_between(start, Clock::now());
      tell([&](ProgressSink& sink) {
        sink.node_finished({id}, graph_.nodes()[id], timing.seconds, outcome.status == NodeStatus::ok,
                           timing.is_cached);
      });
    }
    release_inputs(id);
  }

  /// Decides that a node cannot run: because of the first of its failed inputs' causes, or of a cancellation.
  bool is_skipped(std::uint32_t id) {
    NodeOutcome& outcome = outcome_.nodes[id];
    std::optional<std::uint32_t> cause;
    for (const NodeId input : graph_.nodes()[id].inputs)
      if (outcome_[input].status != NodeStatus::ok)
        cause = std::min(cause.value_or(slots_[input.value].cause), slots_[input.value].cause);
    if (!cause && !(options_.cancellation && options_.cancellation->is_cancelled())) return false;
    slots_[id].cause = cause.value_or(id);
    if (!cause || outcome_.nodes[*cause].failure->code == FailureCode::cancelled)
      outcome.failure = cancelled_failure();
    else
      outcome.failure = Failure{FailureCode::upstream_failed, "stage " + graph_.nodes()[*cause].name + " failed",
                                "see the failure of " + graph_.nodes()[*cause].name};
    return true;
  }

  /// The one place where exceptions of a stage end.
  template <class Work>
  Result<void> guarded(std::uint32_t id, Work work) {
    const std::string& name = graph_.nodes()[id].name;
    try {
      return work();
    } catch (const std::bad_alloc&) {
      return Failure{FailureCode::geometry_failed, name + ": out of memory", "use fewer threads or a coarser mesh"};
    } catch (const std::exception& error) {
      return Failure{FailureCode::internal_error, name + ": " + error.what(), "please report this with the job file"};
    }
  }

  /// Finds the output in the store, or makes it.
  Result<void> produce(std::uint32_t id) {
    NodeOutcome& outcome = outcome_.nodes[id];
    Slot& slot = slots_[id];
    if (options_.store) {
      slot.key = key(id);
      if (slot.key) slot.stored = options_.store->find(*slot.key);
    }
    if (slot.stored) {
      outcome_.timings[id].is_cached = true;
      outcome.digest = slot.stored->digest;
      outcome.warnings = slot.stored->warnings;
      if (!slot.is_wanted) return {};
      const auto output = output_of(id);
      if (!output) return output.failure();
      return {};
    }
    auto made = make(id);
    if (!made) return made.failure();
    const std::lock_guard lock(slot.mutex);
    if (slot.uses_left > 0) slot.output = *std::move(made);
    return {};
  }

  /// Absent when the stage's files cannot be read: then the stage itself says so.
  std::optional<Digest> key(std::uint32_t id) const {
    const StageNode& node = graph_.nodes()[id];
    Digest files;
    if (node.external_digest) {
      const Result<Digest> digest = node.external_digest();
      if (!digest) return std::nullopt;
      files = *digest;
    }
    std::vector<Digest> inputs;
    for (const NodeId input : node.inputs) inputs.push_back(*outcome_[input].digest);
    return key_of(node, inputs, files);
  }

  /// Runs the stage and stores its output. The first time it fills in the node's outcome; when a stored output turned
  /// out to be damaged, it must find the same digest again.
  Result<AnyOutput> make(std::uint32_t id) {
    const StageNode& node = graph_.nodes()[id];
    NodeOutcome& outcome = outcome_.nodes[id];
    std::vector<AnyOutput> inputs;
    for (const NodeId input : node.inputs) {
      auto output = output_of(input.value);
      if (!output) return output.failure();
      inputs.push_back(*std::move(output));
    }
    StageContext context(node.name, node.seed, options_.cancellation, [this, id](double ratio) {
      tell([&](ProgressSink& sink) { sink.node_progressed({id}, graph_.nodes()[id], ratio); });
    });
    auto output = node.run(inputs, context);
    const bool is_first_time = !outcome.digest;
    if (is_first_time) outcome.warnings = context.warnings();
    if (!output) return output.failure();
    const std::vector<std::byte> bytes = node.serialise(output->get());
    const Digest digest = digest_of(bytes);
    if (node.external_digest && slots_[id].key && key(id) != slots_[id].key)
      return Failure{FailureCode::unreadable_file, node.name + ": its files changed while they were read",
                     "run it again"};
    STRATAFLOW_ASSERT(is_first_time || *outcome.digest == digest, node.stage + " made two outputs of the same inputs");
    outcome.digest = digest;
    if (slots_[id].key) save(id, bytes);
    return output;
  }

  /// The output of a node that succeeded: from its slot, from the store, or made again if its entry is damaged. Locks
  /// are taken from higher to lower nodes, and the task that holds one starts no other (tbb_executor.cpp).
  Result<AnyOutput> output_of(std::uint32_t id) {
    Slot& slot = slots_[id];
    const std::lock_guard lock(slot.mutex);
    if (slot.output) return slot.output;
    AnyOutput output;
    if (slot.stored) {
      if (const auto payload = options_.store->load(*slot.key, *slot.stored)) {
        output = graph_.nodes()[id].deserialise(*payload);
        if (!output) options_.store->drop(*slot.key);
      }
    }
    if (!output) {
      auto made = make(id);
      if (!made) return made.failure();
      output = *std::move(made);
    }
    if (slot.uses_left > 0) slot.output = output;
    return output;
  }

  void save(std::uint32_t id, std::span<const std::byte> bytes) {
    const NodeOutcome& outcome = outcome_.nodes[id];
    const auto saved = options_.store->save(*slots_[id].key, *outcome.digest, outcome.warnings, bytes);
    if (saved) {
      has_saved_ = true;
    } else {
      outcome_.timings[id].not_stored = saved.failure().what;
    }
  }

  void release_inputs(std::uint32_t id) {
    std::vector<NodeId> inputs = graph_.nodes()[id].inputs;
    std::sort(inputs.begin(), inputs.end());
    inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
    for (const NodeId input : inputs) {
      Slot& slot = slots_[input.value];
      AnyOutput last;  // destroyed after the lock is given back
      const std::lock_guard lock(slot.mutex);
      if (--slot.uses_left == 0) last = std::move(slot.output);
    }
  }

  template <class Call>
  void tell(Call call) {
    if (!options_.progress) return;
    const std::lock_guard lock(progress_mutex_);
    call(*options_.progress);
  }

  const StageGraph& graph_;
  const RunOptions& options_;
  std::vector<Slot> slots_;
  std::vector<char> is_needed_;
  TaskOrder order_;
  RunOutcome outcome_;
  Clock::time_point begin_;
  std::mutex progress_mutex_;
  std::atomic<bool> has_saved_{false};
};

}  // namespace

std::string_view to_string(NodeStatus status) {
  switch (status) {
    case NodeStatus::ok:
      return "ok";
    case NodeStatus::failed:
      return "failed";
    case NodeStatus::skipped:
      return "skipped";
  }
  return "skipped";
}

bool RunOutcome::is_ok() const {
  return std::none_of(nodes.begin(), nodes.end(), [](const NodeOutcome& node) { return node.failure.has_value(); });
}

std::vector<NodeId> RunOutcome::failed_nodes() const {
  std::vector<NodeId> failed;
  for (std::uint32_t id = 0; id < nodes.size(); ++id)
    if (nodes[id].status == NodeStatus::failed) failed.push_back({id});
  return failed;
}

RunOutcome run_graph(const StageGraph& graph, const RunOptions& options) { return GraphRun(graph, options).run(); }

}  // namespace strataflow
