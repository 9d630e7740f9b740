#include "graph/draw_graph.h"

#include <gtest/gtest.h>

#include "graph/number_stages.h"

namespace strataflow {
namespace {

using namespace support;

StageGraph two_nodes() {
  StageGraph graph;
  const auto drawn = graph.add("draw \"F1\" <b>\\", DrawNumbers{{.count = 4}});
  graph.add("dot", DotNumbers{}, drawn, drawn);
  return graph;
}

TEST(DrawGraph, dot_has_every_node_and_edge_with_names_escaped) {
  EXPECT_EQ(to_dot(two_nodes()),
            "digraph strataflow {\n  rankdir=LR;\n  node [shape=box];\n"
            "  n0 [label=\"draw \\\"F1\\\" <b>\\\\\\ndraw_numbers v1\"];\n"
            "  n1 [label=\"dot\\ndot_numbers v1\"];\n"
            "  n0 -> n1;\n  n0 -> n1;\n}\n");
}

TEST(DrawGraph, mermaid_has_every_node_and_edge_with_names_escaped) {
  EXPECT_EQ(to_mermaid(two_nodes()),
            "flowchart LR\n"
            "  n0[\"draw #34;F1#34; #60;b#62;\\<br/>draw_numbers v1\"]\n"
            "  n1[\"dot<br/>dot_numbers v1\"]\n"
            "  n0 --> n1\n  n0 --> n1\n");
}

TEST(DrawGraph, json_has_every_node_with_its_inputs_and_options) {
  EXPECT_EQ(to_json(two_nodes()),
            "{\"nodes\": [\n"
            "  {\"id\": 0, \"node\": \"draw \\\"F1\\\" <b>\\\\\", \"stage\": \"draw_numbers\", \"version\": 1, "
            "\"inputs\": [], \"options\": {\"count\": \"4\"}},\n"
            "  {\"id\": 1, \"node\": \"dot\", \"stage\": \"dot_numbers\", \"version\": 1, "
            "\"inputs\": [0, 0], \"options\": {}}\n]}\n");
}

}  // namespace
}  // namespace strataflow
