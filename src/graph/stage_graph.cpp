#include "graph/stage_graph.h"

#include <algorithm>

#include "base/internal_error.h"
#include "base/seed.h"

namespace strataflow {

namespace {

/// Everything that decides what a node computes, apart from what its files hold.
std::string identity_of(const StageNode& node, const std::string& files) {
  std::vector<std::uint32_t> inputs;
  for (const NodeId input : node.inputs) inputs.push_back(input.value);
  ArchiveWriter writer;
  writer(node.stage, node.version, node.options, inputs, node.seed, files);
  const std::vector<std::byte>& bytes = writer.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

bool StageGraph::has_stage(std::string_view stage) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const StageNode& node) { return node.stage == stage; });
}

std::vector<std::vector<NodeId>> StageGraph::consumers() const {
  std::vector<std::vector<NodeId>> result(nodes_.size());
  for (std::uint32_t id = 0; id < nodes_.size(); ++id)
    for (const NodeId input : nodes_[id].inputs) {
      std::vector<NodeId>& fed = result[input.value];
      if (fed.empty() || fed.back() != NodeId{id}) fed.push_back({id});
    }
  return result;
}

void StageGraph::check_wire(NodeId id, const std::type_info& type) const {
  STRATAFLOW_ASSERT(id.value < nodes_.size() && *nodes_[id.value].output_type == type, "a port of another graph");
}

std::uint64_t StageGraph::seed_of(std::string_view name) const { return seed_for(job_seed_, name); }

NodeId StageGraph::insert(StageNode node, const std::optional<std::string>& files) {
  const NodeId id{static_cast<std::uint32_t>(nodes_.size())};
  if (files) {
    const auto [existing, is_new] = by_identity_.try_emplace(identity_of(node, *files), id);
    if (!is_new) {
      STRATAFLOW_ASSERT(*nodes_[existing->second.value].output_type == *node.output_type,
                        "two stages are named " + node.stage);
      return existing->second;
    }
  }
  const std::string wanted = node.name;
  for (int copy = 2; !by_name_.try_emplace(node.name, id).second; ++copy)
    node.name = wanted + "#" + std::to_string(copy);
  nodes_.push_back(std::move(node));
  return id;
}

}  // namespace strataflow
