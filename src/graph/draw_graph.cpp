#include "graph/draw_graph.h"

#include <array>

namespace strataflow {

namespace {

/// Inside double quotes, for DOT and JSON alike (DOT takes the other JSON escapes literally, which is harmless).
std::string quoted(const std::string& text) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += std::string("\\u00") + digits[(c >> 4) & 15] + digits[c & 15];
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// Mermaid has entities instead of escapes.
std::string mermaid_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '#' || c == '<' || c == '>' || c == '&' || c == '`' || static_cast<unsigned char>(c) < 0x20)
      result += "#" + std::to_string(static_cast<int>(c)) + ";";
    else
      result += c;
  }
  return result;
}

std::string stage_and_version(const StageNode& node) { return node.stage + " v" + std::to_string(node.version); }

/// One member per printed line "key = value".
std::string options_as_json(const std::string& printed) {
  std::string result;
  for (std::size_t begin = 0; begin < printed.size();) {
    const std::size_t end = printed.find('\n', begin);
    const std::string line = printed.substr(begin, end - begin);
    const std::size_t equals = line.find(" = ");
    result += (result.empty() ? "" : ", ") + quoted(line.substr(0, equals)) + ": " + quoted(line.substr(equals + 3));
    begin = end + 1;
  }
  return "{" + result + "}";
}

template <class Visit>
void for_each_edge(const StageGraph& graph, Visit visit) {
  for (std::size_t id = 0; id < graph.node_count(); ++id)
    for (const NodeId input : graph.nodes()[id].inputs) visit(std::to_string(input.value), std::to_string(id));
}

}  // namespace

std::string to_dot(const StageGraph& graph) {
  std::string text = "digraph strataflow {\n  rankdir=LR;\n  node [shape=box];\n";
  for (std::size_t id = 0; id < graph.node_count(); ++id) {
    const StageNode& node = graph.nodes()[id];
    text += "  n" + std::to_string(id) + " [label=" + quoted(node.name + "\n" + stage_and_version(node)) + "];\n";
  }
  for_each_edge(graph,
                [&](const std::string& from, const std::string& to) { text += "  n" + from + " -> n" + to + ";\n"; });
  return text + "}\n";
}

std::string to_mermaid(const StageGraph& graph) {
  std::string text = "flowchart LR\n";
  for (std::size_t id = 0; id < graph.node_count(); ++id) {
    const StageNode& node = graph.nodes()[id];
    text += "  n" + std::to_string(id) + "[\"" + mermaid_text(node.name) + "<br/>" +
            mermaid_text(stage_and_version(node)) + "\"]\n";
  }
  for_each_edge(graph,
                [&](const std::string& from, const std::string& to) { text += "  n" + from + " --> n" + to + "\n"; });
  return text;
}

std::string to_json(const StageGraph& graph) {
  std::string text = "{\"nodes\": [";
  for (std::size_t id = 0; id < graph.node_count(); ++id) {
    const StageNode& node = graph.nodes()[id];
    std::string inputs;
    for (const NodeId input : node.inputs) inputs += (inputs.empty() ? "" : ", ") + std::to_string(input.value);
    text += std::string(id ? "," : "") + "\n  {\"id\": " + std::to_string(id) + ", \"node\": " + quoted(node.name) +
            ", \"stage\": " + quoted(node.stage) + ", \"version\": " + std::to_string(node.version) +
            ", \"inputs\": [" + inputs + "], \"options\": " + options_as_json(node.options) + "}";
  }
  return text + "\n]}\n";
}

}  // namespace strataflow
