#include "kernels/reference_models/fracture_network.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "graph/parallel/schedule.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/soup_topology.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"

namespace strataflow {
namespace {

using namespace testing_support;
using EntityPairs = std::set<std::array<std::uint32_t, 2>>;

bool is_fracture(const TriangleSoup& soup, std::uint32_t entity) { return soup.entities[entity].role == Role::fault; }

/// Pairs of a fracture and something else that cross, found before anything is cut.
EntityPairs crossings_of(const TriangleSoup& raw) {
  EntityPairs pairs;
  for (const IntersectingPair& pair : find_intersections(raw.points, raw.triangles)) {
    const std::uint32_t a = entity_of(raw, pair.first), b = entity_of(raw, pair.second);
    if (a != b && (is_fracture(raw, a) || is_fracture(raw, b))) pairs.insert({std::min(a, b), std::max(a, b)});
  }
  return pairs;
}

/// Pairs of a fracture and something else that share an edge.
EntityPairs contacts_of(const TriangleSoup& soup) {
  EntityPairs pairs;
  for (const auto& [edge, around] : topology_of(soup).edge_triangles)
    for (const std::uint32_t t : around)
      for (const std::uint32_t u : around) {
        const std::uint32_t a = entity_of(soup, t), b = entity_of(soup, u);
        if (a < b && (is_fracture(soup, a) || is_fracture(soup, b))) pairs.insert({a, b});
      }
  return pairs;
}

TEST(FractureNetwork, is_valid_sealed_and_joins_exactly_what_crossed) {
  for (const double edge_m : {1600.0, 700.0}) {
    const TriangleSoup soup = *fracture_network(edge_m, 1);
    const BuiltModel built = *build_structural_model(soup);
    const ValidityReport validity = check_validity(built);
    EXPECT_TRUE(validity.is_valid());
    EXPECT_EQ(validity.intersecting_triangle_pairs, 0u);
    EXPECT_TRUE(is_sealed(built.model, validity));
    const EntityPairs crossings = crossings_of(raw_fracture_network(edge_m, 1));
    EXPECT_GT(crossings.size(), 150u);
    EXPECT_EQ(contacts_of(soup), crossings) << edge_m;
    double volume = 0;
    for (const Region& region : built.model.regions) volume += region.volume_m3;
    EXPECT_NEAR(volume / (13000. * 11000 * 4000), 1, 1e-12);
    EXPECT_GE(built.model.regions.size(), 3u);
  }
}

TEST(FractureNetwork, has_200_flat_fractures_inside_the_box) {
  const TriangleSoup raw = raw_fracture_network(600, 1);
  std::map<std::uint32_t, Vec3> normal;
  for (std::size_t t = 0; t < raw.triangles.size(); ++t) {
    if (!is_fracture(raw, entity_of(raw, t))) continue;
    const auto& [a, b, c] = raw.triangles[t];
    Vec3 n = cross(raw.points[b] - raw.points[a], raw.points[c] - raw.points[a]);
    n = (1 / length(n)) * n;
    EXPECT_NEAR(dot(normal.try_emplace(entity_of(raw, t), n).first->second, n), 1, 1e-6);
    for (const std::uint32_t p : {a, b, c})
      for (int axis = 0; axis < 3; ++axis) EXPECT_GE(raw.points[p][axis], 0);
  }
  EXPECT_EQ(normal.size(), 200u);
}

TEST(FractureNetwork, is_drawn_anew_for_another_seed_and_the_same_for_the_same_on_every_schedule) {
  const auto make = [](std::uint64_t seed) {
    return archived(*generate_reference_model("dfn", {.resolution_m = 1600, .seed = seed}));
  };
  const auto serial = make(1);
  EXPECT_NE(make(2), serial);
  for (const std::uint64_t order : {1, 2}) {
    const ScheduleScope scope(ScheduleKind::shuffled, order);
    EXPECT_EQ(make(1), serial);
  }
  const ScheduleScope scope(ScheduleKind::threads);
  EXPECT_EQ(make(1), serial);
}

TEST(FractureNetwork, raw_leaves_everything_uncut_and_changes_the_size_of_fractures) {
  const auto pairs = [](double ratio) {
    const TriangleSoup raw = *generate_reference_model("dfn", {.resolution_m = 1600, .raw_ratio = ratio});
    return crossings_of(raw).size();
  };
  EXPECT_LT(pairs(0.1), pairs(0.0));
  EXPECT_GT(pairs(-0.1), pairs(0.0));
}

}  // namespace
}  // namespace strataflow
