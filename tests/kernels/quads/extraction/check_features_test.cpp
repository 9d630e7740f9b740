#include "kernels/quads/extraction/check_features.h"

#include <gtest/gtest.h>

#include "kernels/quads/extraction/extract_quads.h"
#include "kernels/quads/extraction/map_samples.h"
#include "support/quad_chains.h"

namespace strataflow {
namespace {

using namespace map_samples;

struct Sample {
  MappedMesh made = rectangle(12, 8, {line("a", Role::fault, {{2, 3, 0}, {9, 3, 0}})});
  QuadMesh quads = *extract_quads(made.mesh, made.map);
  std::vector<std::string> wrong() const { return features_not_followed(made.mesh, quads); }
  std::size_t first_edge_of(const std::string& name) const {
    std::size_t i = 0;
    while (quads.features[quads.edges[i].feature].name != name) ++i;
    return i;
  }
};

TEST(CheckFeatures, quads_of_a_map_follow_every_feature) {
  const Sample sample;
  EXPECT_TRUE(sample.wrong().empty()) << sample.wrong()[0];
  EXPECT_TRUE(features_not_held(sample.made.mesh, sample.quads).empty());
}

TEST(CheckFeatures, any_one_edge_that_is_missing_is_noticed) {
  const Sample whole;
  for (std::size_t i = 0; i < whole.quads.edges.size(); ++i) {
    Sample torn;
    torn.quads.edges.erase(torn.quads.edges.begin() + static_cast<std::ptrdiff_t>(i));
    ASSERT_EQ(torn.wrong().size(), 1u) << i;
    EXPECT_EQ(torn.wrong()[0], "'" + whole.quads.features[whole.quads.edges[i].feature].name +
                                   "' is not followed over its whole length");
    EXPECT_FALSE(features_not_held(torn.made.mesh, torn.quads).empty()) << "as the other check does";
  }
}

TEST(CheckFeatures, a_vertex_beside_its_feature_is_noticed) {
  Sample moved;
  const FeatureEdge edge = moved.quads.edges[moved.first_edge_of("a")];
  moved.quads.points[edge.b].y += 1e-6;
  ASSERT_EQ(moved.wrong().size(), 1u);
  EXPECT_EQ(moved.wrong()[0], "'a' has a vertex beside it");
}

TEST(CheckFeatures, a_feature_without_edges_is_noticed) {
  Sample none;
  std::erase_if(none.quads.edges, [&](const FeatureEdge& e) { return none.quads.features[e.feature].name == "a"; });
  ASSERT_EQ(none.wrong().size(), 1u);
  EXPECT_EQ(none.wrong()[0], "'a' has no edge");
}

}  // namespace
}  // namespace strataflow
