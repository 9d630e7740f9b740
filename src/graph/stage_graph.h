#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "base/archive.h"
#include "base/digest.h"
#include "base/option_field.h"
#include "graph/stage_signature.h"

namespace strataflow {

/// One stage in a graph, with its types erased.
struct StageNode {
  std::string name;   ///< unique in the graph
  std::string stage;  ///< Stage::name
  int version = 0;
  std::string options;                ///< printed_options
  std::vector<NodeId> inputs;         ///< in the order of the stage's parameters
  std::optional<std::uint64_t> seed;  ///< absent for stages that draw no random numbers
  const std::type_info* output_type = nullptr;
  std::function<Result<Digest>()> external_digest;  ///< empty for stages that read no files
  std::function<Result<AnyOutput>(const std::vector<AnyOutput>& inputs, StageContext&)> run;
  std::vector<std::byte> (*serialise)(const void* output) = nullptr;
  AnyOutput (*deserialise)(std::span<const std::byte> bytes) = nullptr;  ///< null when the bytes are damaged
};

/// What is to be done: stages as nodes, their data as edges. A stage is a struct with
///   static constexpr std::string_view name;
///   static constexpr int version;
///   an `options` aggregate (NoOptions if it has none),
///   Result<Output> operator()(const Input&…, StageContext&) const   (`const std::vector<const Input*>&`: any number)
/// and, where it applies, `static constexpr bool uses_seed = true;`, `Result<Digest> external_digest() const` and
/// `std::string external_identity() const` (stage_signature.h). Output takes part in base/archive.h.
class StageGraph {
 public:
  explicit StageGraph(std::uint64_t job_seed = 1) : job_seed_(job_seed) {}

  /// Nodes added from now on draw from this seed: jobs with different seeds share one graph.
  void set_job_seed(std::uint64_t job_seed) { job_seed_ = job_seed; }

  /// Adds a node fed by `wires`: a Port<T> for each `const T&`, a std::vector<Port<T>> for each vector parameter of the
  /// stage. A node that would do the same as one that exists (same stage, version, options, inputs, files, and seed if
  /// it uses one) is that node: jobs and sweeps share their common stages. A `name` that another node has gets "#2",
  /// "#3" …; the seed follows from the name as given, so the members of a sweep draw alike.
  template <class Stage, class... Wires>
  // clang-format off
    requires WiresFit<Stage, Wires...>
  // clang-format on
  Port<typename StageSignature<Stage>::Output> add(std::string name, Stage stage, const Wires&... wires) {
    using Signature = StageSignature<Stage>;
    using Output = typename Signature::Output;
    StageNode node;
    node.name = std::move(name);
    node.stage = std::string(Stage::name);
    node.version = Stage::version;
    node.options = printed_options(stage.options);
    if (uses_seed<Stage>()) node.seed = seed_of(node.name);
    node.output_type = &typeid(Output);
    node.serialise = [](const void* output) { return archived(*static_cast<const Output*>(output)); };
    node.deserialise = [](std::span<const std::byte> bytes) -> AnyOutput {
      auto output = std::make_shared<Output>();
      ArchiveReader reader(bytes);
      reader(*output);
      return reader.is_complete() ? std::move(output) : nullptr;
    };
    std::vector<std::size_t> counts;
    (connect(node, counts, wires), ...);
    std::optional<std::string> files = "";
    if constexpr (ReadsFiles<Stage>) {
      node.external_digest = [stage] { return stage.external_digest(); };
      files.reset();
    }
    if constexpr (NamesFiles<Stage>) files = stage.external_identity();
    node.run = [stage = std::move(stage), counts = std::move(counts)](const std::vector<AnyOutput>& inputs,
                                                                      StageContext& context) -> Result<AnyOutput> {
      Result<Output> output = Signature::call(stage, inputs, counts, context);
      if (!output) return output.failure();
      return AnyOutput(std::make_shared<const Output>(*std::move(output)));
    };
    return Port<Output>(insert(std::move(node), files));
  }

  std::size_t node_count() const { return nodes_.size(); }
  const StageNode& node(NodeId id) const { return nodes_[id.value]; }
  const std::vector<StageNode>& nodes() const { return nodes_; }
  /// True if a node runs the stage of that name.
  bool has_stage(std::string_view stage) const;
  /// Per node: the nodes it feeds, ascending, each once.
  std::vector<std::vector<NodeId>> consumers() const;

 private:
  template <class T>
  void connect(StageNode& node, std::vector<std::size_t>& counts, const Port<T>& port) const {
    check_wire(port.node(), typeid(T));
    node.inputs.push_back(port.node());
    counts.push_back(1);
  }
  template <class T>
  void connect(StageNode& node, std::vector<std::size_t>& counts, const std::vector<Port<T>>& ports) const {
    for (const Port<T>& port : ports) {
      check_wire(port.node(), typeid(T));
      node.inputs.push_back(port.node());
    }
    counts.push_back(ports.size());
  }
  /// A port of another graph is our bug.
  void check_wire(NodeId id, const std::type_info& type) const;
  std::uint64_t seed_of(std::string_view name) const;
  /// `files`: which files the stage reads; absent when it does not say, then it is never shared.
  NodeId insert(StageNode node, const std::optional<std::string>& files);

  std::uint64_t job_seed_;
  std::vector<StageNode> nodes_;
  std::map<std::string, NodeId> by_identity_;
  std::map<std::string, NodeId> by_name_;
};

}  // namespace strataflow
