#pragma once
#include <string>

#include "graph/stage_graph.h"

namespace strataflow {

/// The graph as text, nodes in node order, edges in input order. Names are escaped.
std::string to_dot(const StageGraph& graph);
std::string to_mermaid(const StageGraph& graph);
/// {"nodes": [{"id", "node", "stage", "version", "inputs": [ids], "options": {"key": "value as TOML"}}]}
std::string to_json(const StageGraph& graph);

}  // namespace strataflow
