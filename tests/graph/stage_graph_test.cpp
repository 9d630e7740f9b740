#include "graph/stage_graph.h"

#include <gtest/gtest.h>

#include "graph/number_stages.h"

namespace strataflow {
namespace {

using namespace support;

struct ReadTwoFiles {
  static constexpr std::string_view name = "read_two_files";
  static constexpr int version = 1;
  NoOptions options;
  std::string path;
  Result<Digest> external_digest() const { return digest_of(path); }
  std::string external_identity() const { return path; }
  Result<Numbers> operator()(StageContext&) const { return Numbers{}; }
};

struct ReadUnnamed {
  static constexpr std::string_view name = "read_unnamed";
  static constexpr int version = 1;
  NoOptions options;
  Result<Digest> external_digest() const { return Digest{}; }
  Result<Numbers> operator()(StageContext&) const { return Numbers{}; }
};

TEST(StageGraph, node_ids_are_the_insertion_order_and_inputs_come_first) {
  const StageGraph graph = wide(3);
  for (std::uint32_t id = 0; id < graph.node_count(); ++id)
    for (const NodeId input : graph.node({id}).inputs) EXPECT_LT(input.value, id);
  EXPECT_EQ(graph.node({0}).name, "draw");
  EXPECT_EQ(graph.nodes().back().inputs.size(), 3u);
}

TEST(StageGraph, a_node_that_would_do_the_same_is_shared) {
  StageGraph graph;
  const auto drawn = graph.add("a/draw", DrawNumbers{});
  const auto scaled = graph.add("a/scale", ScaleNumbers{{.factor = 2}}, drawn);
  EXPECT_EQ(graph.add("b/scale", ScaleNumbers{{.factor = 2}}, drawn), scaled);
  EXPECT_NE(graph.add("b/scale", ScaleNumbers{{.factor = 3}}, drawn), scaled);
  EXPECT_NE(graph.add("b/scale", ScaleNumbers{{.factor = 2}}, scaled), scaled);
  EXPECT_EQ(graph.node_count(), 4u);
  EXPECT_EQ(graph.node(scaled.node()).name, "a/scale");
}

TEST(StageGraph, a_stage_that_draws_is_shared_only_with_the_same_seed) {
  StageGraph graph(1);
  const auto first = graph.add("draw", DrawNumbers{});
  EXPECT_EQ(graph.add("draw", DrawNumbers{}), first);
  EXPECT_NE(graph.add("draw again", DrawNumbers{}), first);  // the name is part of the seed
  graph.set_job_seed(2);
  EXPECT_NE(graph.add("draw", DrawNumbers{}), first);
}

TEST(StageGraph, members_of_a_sweep_get_names_of_their_own_and_the_same_seed) {
  StageGraph graph;
  const auto first = graph.add("draw", DrawNumbers{{.count = 1}});
  const auto second = graph.add("draw", DrawNumbers{{.count = 2}});
  const auto third = graph.add("draw", DrawNumbers{{.count = 3}});
  EXPECT_EQ(graph.node(second.node()).name, "draw#2");
  EXPECT_EQ(graph.node(third.node()).name, "draw#3");
  EXPECT_EQ(graph.node(first.node()).seed, graph.node(third.node()).seed);
}

TEST(StageGraph, stages_that_read_files_are_shared_when_they_name_the_same_files) {
  StageGraph graph;
  const auto first = graph.add("read", ReadTwoFiles{{}, "a.ts"});
  EXPECT_EQ(graph.add("read", ReadTwoFiles{{}, "a.ts"}), first);
  EXPECT_NE(graph.add("read", ReadTwoFiles{{}, "b.ts"}), first);
  const auto unnamed = graph.add("read", ReadUnnamed{});
  EXPECT_NE(graph.add("read", ReadUnnamed{}), unnamed);
}

TEST(StageGraph, a_port_of_another_graph_is_our_bug) {
  StageGraph other;
  const auto a = other.add("draw", DrawNumbers{});
  const auto b = other.add("scale", ScaleNumbers{}, a);
  StageGraph graph;
  EXPECT_THROW(graph.add("sort", SortNumbers{}, b), InternalError);
}

TEST(StageGraph, consumers_are_listed_once_each) {
  StageGraph graph;
  const auto a = graph.add("draw", DrawNumbers{});
  graph.add("dot", DotNumbers{}, a, a);
  EXPECT_EQ(graph.consumers(), (std::vector<std::vector<NodeId>>{{NodeId{1}}, {}}));
  EXPECT_TRUE(graph.has_stage("dot_numbers"));
  EXPECT_FALSE(graph.has_stage("dot"));
}

}  // namespace
}  // namespace strataflow
