#include "kernels/reference_models/generate_reference_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/archive.h"
#include "graph/parallel/schedule.h"
#include "kernels/reference_models/soup_topology.h"
#include "model/box3.h"

namespace strataflow {
namespace {

using testing::Each;
using testing::HasSubstr;
using namespace testing_support;

/// Counts off the sides of the box, as pellerin2014 Table 3.1 (A2 has 13 lines and A3 16 surfaces there: 7 pieces of a
/// fault, cut by three lenses, make 17; A6's erosion surface is ours).
struct Expected {
  std::string_view name;
  std::size_t regions, surfaces, lines, corners;
  std::string dying;  ///< faults with a tip line
  Vec3 box{1600, 930, 500};
  bool has_raw = true;
};

class ReferenceModel : public testing::TestWithParam<Expected> {
 protected:
  static double width() { return GetParam().box.x; }
  static double box_volume() { return GetParam().box.x * GetParam().box.y * GetParam().box.z; }
  /// Edges of 1/20 (coarse) and 1/64 (fine) of the width.
  static std::vector<double> resolutions() { return {width() / 20, width() / 64}; }
  static TriangleSoup sealed(double resolution_m) {
    auto soup = generate_reference_model(GetParam().name, {resolution_m, std::nullopt});
    EXPECT_TRUE(soup);
    return soup ? *soup : TriangleSoup{};
  }
};

TEST_P(ReferenceModel, encloses_its_regions_and_they_fill_the_box) {
  for (const double resolution : resolutions()) {
    const SoupTopology topology = topology_of(sealed(resolution));
    EXPECT_EQ(topology.region_volumes.size(), GetParam().regions) << resolution << " m";
    const double sum = std::accumulate(topology.region_volumes.begin(), topology.region_volumes.end(), 0.0);
    EXPECT_NEAR(sum / box_volume(), 1, 1e-9);
    EXPECT_NEAR(topology.outer_volume / box_volume(), -1, 1e-9);
  }
}

TEST_P(ReferenceModel, has_the_surfaces_lines_and_corners_of_its_kind) {
  for (const double resolution : resolutions()) {
    const SoupTopology topology = topology_of(sealed(resolution));
    EXPECT_EQ(topology.surfaces, GetParam().surfaces) << resolution << " m";
    EXPECT_EQ(topology.lines, GetParam().lines) << resolution << " m";
    EXPECT_EQ(topology.corners, GetParam().corners) << resolution << " m";
  }
}

TEST_P(ReferenceModel, has_free_edges_only_on_the_tip_lines_of_its_dying_faults) {
  const TriangleSoup soup = sealed(resolutions()[1]);
  const SoupTopology topology = topology_of(soup);
  std::set<std::string> torn;
  for (const auto& edge : topology.free_edges)
    torn.insert(soup.entities[entity_of(soup, topology.edge_triangles.at(edge)[0])].name);
  std::string names;
  for (const std::string& name : torn) names += name;
  EXPECT_EQ(names, GetParam().dying);
}

TEST_P(ReferenceModel, shares_points_instead_of_repeating_positions) {
  const TriangleSoup soup = sealed(resolutions()[1]);
  std::set<std::array<double, 3>> positions;
  for (const Vec3& p : soup.points) positions.insert({p.x, p.y, p.z});
  EXPECT_EQ(positions.size(), soup.points.size());
  std::set<std::array<std::uint32_t, 3>> triangles;
  std::set<std::uint32_t> used;
  for (Triangle t : soup.triangles) {
    EXPECT_GT(length(cross(soup.points[t[1]] - soup.points[t[0]], soup.points[t[2]] - soup.points[t[0]])), 0);
    used.insert(t.begin(), t.end());
    std::sort(t.begin(), t.end());
    triangles.insert(t);
  }
  EXPECT_EQ(triangles.size(), soup.triangles.size());
  EXPECT_EQ(used.size(), soup.points.size());
}

TEST_P(ReferenceModel, keeps_the_sides_of_the_box_in_their_planes) {
  const TriangleSoup soup = sealed(resolutions()[0]);
  const double depth = GetParam().box.y, high = GetParam().box.z;
  for (const Vec3& p : points_of(soup, "Top")) EXPECT_EQ(p.z, high);
  for (const Vec3& p : points_of(soup, "Bottom")) EXPECT_EQ(p.z, 0);
  for (const Vec3& p : points_of(soup, "North")) EXPECT_EQ(p.y, depth);
  for (const Vec3& p : points_of(soup, "South")) EXPECT_EQ(p.y, 0);
  for (const Vec3& p : points_of(soup, "East")) EXPECT_EQ(p.x, width());
  for (const Vec3& p : points_of(soup, "West")) EXPECT_EQ(p.x, 0);
}

TEST_P(ReferenceModel, is_the_same_to_the_byte_on_every_schedule) {
  for (const std::optional<double> ratio : {std::optional<double>{}, std::optional<double>{0.01}}) {
    if (ratio && !GetParam().has_raw) continue;
    const auto make = [&] { return archived(*generate_reference_model(GetParam().name, {width() / 30, ratio})); };
    const auto serial = make();
    for (const std::uint64_t seed : {1, 2}) {
      const ScheduleScope scope(ScheduleKind::shuffled, seed);
      EXPECT_EQ(make(), serial);
    }
    const ScheduleScope scope(ScheduleKind::threads);
    EXPECT_EQ(make(), serial);
  }
}

TEST_P(ReferenceModel, has_about_ten_thousand_triangles_by_default) {
  const auto soup = generate_reference_model(GetParam().name);
  ASSERT_TRUE(soup);
  EXPECT_GT(soup->triangles.size(), 5000u);
  EXPECT_LT(soup->triangles.size(), GetParam().surfaces > 500 ? 50000u : 21000u);
}

TEST_P(ReferenceModel, raw_keeps_names_and_a_closed_box_and_joins_no_two_entities) {
  if (!GetParam().has_raw) {
    const auto refused = generate_reference_model(GetParam().name, {width() / 30, 0.01});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.failure().what, HasSubstr("raw"));
    return;
  }
  for (const double ratio : {0.05, 1e-6, -0.03}) {
    const auto soup = generate_reference_model(GetParam().name, {width() / 30, ratio});
    ASSERT_TRUE(soup);
    EXPECT_EQ(soup->entities.size(), sealed(width() / 20).entities.size());
    std::map<std::uint32_t, std::set<std::uint32_t>> point_entities;
    for (std::size_t t = 0; t < soup->triangles.size(); ++t) {
      const auto& [a, b, c] = soup->triangles[t];
      EXPECT_GT(length(cross(soup->points[b] - soup->points[a], soup->points[c] - soup->points[a])), 0);
      for (const std::uint32_t p : soup->triangles[t]) point_entities[p].insert(entity_of(*soup, t));
    }
    for (const auto& [p, entities] : point_entities) EXPECT_EQ(entities.size(), 1u);
    // The six rectangles close once equal positions are welded.
    TriangleSoup box = *soup;
    std::map<std::array<double, 3>, std::uint32_t> welded;
    box.triangles.clear();
    box.triangle_patch.clear();
    for (std::size_t t = 0; t < soup->triangles.size(); ++t) {
      if (soup->entities[entity_of(*soup, t)].role != Role::boundary) continue;
      Triangle triangle = soup->triangles[t];
      for (std::uint32_t& p : triangle)
        p = welded.try_emplace({soup->points[p].x, soup->points[p].y, soup->points[p].z}, p).first->second;
      box.triangles.push_back(triangle);
      box.triangle_patch.push_back(soup->triangle_patch[t]);
    }
    const SoupTopology topology = topology_of(box);
    EXPECT_TRUE(topology.free_edges.empty());
    ASSERT_EQ(topology.region_volumes.size(), 1u);
    EXPECT_NEAR(topology.region_volumes[0] / box_volume(), 1, 1e-9);
  }
}

/// The faults F1 … F`count` of which `dies` holds, as the fixture lists them: by name.
std::string dying_faults(std::uint32_t count, bool (*dies)(std::uint32_t)) {
  std::set<std::string> names;
  for (std::uint32_t f = 1; f <= count; ++f)
    if (dies(f)) names.insert("F" + std::to_string(f));
  std::string text;
  for (const std::string& name : names) text += name;
  return text;
}

std::string name_of(const testing::TestParamInfo<Expected>& model) {
  std::string name(model.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Nine, ReferenceModel,
                         testing::Values(Expected{"A1", 4, 3, 0, 0, ""}, Expected{"A2", 12, 23, 12, 0, ""},
                                         Expected{"A3", 4, 17, 24, 12, "F1F2"}, Expected{"A4", 8, 23, 22, 6, "F1"},
                                         Expected{"A5", 12, 31, 30, 10, ""}, Expected{"A6", 14, 36, 32, 9, "F1"},
                                         Expected{"B", 5, 8, 4, 0, "F1"}, Expected{"C", 4, 4, 1, 0, ""},
                                         Expected{"D", 5, 6, 2, 0, "", {120, 120, 120}}),
                         name_of);

// veins: 29 columns of rock, each cut by the horizon; 28 walls in two pieces and 29 pieces of the horizon; 28 contacts.
// onlap: two layers under U, six above; U in nine pieces (the mound, the middle, three in the east, four in the west);
// H2 meets it three times, H3 and H4 twice, H5 once.
// sandbox: eleven regional faults make 12 compartments of 8 layers over one. Every fault is in 15 pieces, for each of
// the seven horizons it cuts has two traces, and it roots in H1. A tip line is divided by seven corners where two
// traces join, and an eighth corner is its foot.
// fault-network: 24 faults with 18 crossings, 6 abutments and 25 tips are 66 pieces along strike, of 9 each by the two
// traces of four horizons, and make 18 compartments. The line of a crossing has 16 corners, of an abutment 8, a tip 4.
INSTANTIATE_TEST_SUITE_P(Classes, ReferenceModel,
                         testing::Values(Expected{"variable-layers", 5, 4, 0, 0, "", {2000, 1500, 600}},
                                         Expected{"veins", 2 * 29, 2 * 28 + 29, 28, 0, "", {10200, 1300, 280}},
                                         Expected{"onlap", 8, 9 + 6, 3 + 2 + 2 + 1, 0, "", {110, 65, 40}},
                                         Expected{"sandbox",
                                                  12 * 8 + 1,
                                                  33 * 15 + 8 * 12,
                                                  33 * 15 + (11 + 22) * 8,
                                                  (11 + 22) * 8,
                                                  dying_faults(33, [](std::uint32_t f) { return f % 3 != 1; }),
                                                  {3500, 3000, 500}},
                                         Expected{"fault-network",
                                                  18 * 5,
                                                  66 * 9 + 18 * 4,
                                                  66 * 8 + 18 * 17 + 6 * 9 + 25 * 5,
                                                  18 * 16 + 6 * 8 + 25 * 4,
                                                  dying_faults(24,
                                                               [](std::uint32_t f) {
                                                                 return f != 2 && f != 5 && f != 8 && f != 12 &&
                                                                        f != 18 && f != 24;
                                                               }),
                                                  {12000, 10300, 1700},
                                                  false}),
                         name_of);

TEST(HorizonFaultPair, is_two_open_sheets_that_cross) {
  const auto soup = generate_reference_model("horizon-fault-pair", {20.0, std::nullopt});
  ASSERT_TRUE(soup);
  EXPECT_EQ(soup->triangles.size(), 2u * 2 * 50 * 50);
  EXPECT_EQ(soup->entities[0].role, Role::horizon);
  EXPECT_EQ(soup->entities[1].role, Role::fault);
  EXPECT_EQ(piece_count(*soup, 0), 1u);
  EXPECT_EQ(piece_count(*soup, 1), 1u);
  // At every y the fault runs from below the horizon to above it, inside its west–east extent.
  Box3 horizon, fault;
  for (const Vec3& p : points_of(*soup, "H1")) horizon.take(p);
  for (const Vec3& p : points_of(*soup, "F1")) fault.take(p);
  EXPECT_LT(fault.low.z, horizon.low.z);
  EXPECT_GT(fault.high.z, horizon.high.z);
  EXPECT_GT(fault.low.x, horizon.low.x);
  EXPECT_LT(fault.high.x, horizon.high.x);
}

TEST(GenerateReferenceModel, refuses_an_unknown_name_and_lists_the_known_ones) {
  const auto soup = generate_reference_model("A7");
  ASSERT_FALSE(soup);
  EXPECT_EQ(soup.failure().code, FailureCode::invalid_options);
  EXPECT_THAT(soup.failure().what, HasSubstr("A7"));
  for (const std::string_view name : reference_model_names())
    EXPECT_THAT(soup.failure().remedy, HasSubstr(std::string(name)));
}

TEST(GenerateReferenceModel, refuses_resolutions_it_cannot_mesh) {
  for (const double bad : {0.0, -1.0, 1e-9, 201.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    const auto soup = generate_reference_model("A1", {bad, std::nullopt});
    ASSERT_FALSE(soup) << bad;
    EXPECT_EQ(soup.failure().code, FailureCode::invalid_options);
    EXPECT_THAT(soup.failure().remedy, HasSubstr("200"));
    EXPECT_THAT(soup.failure().remedy, HasSubstr("horizon-fault-pair"));
  }
  const std::map<std::string_view, double> width_m{{"D", 120},
                                                   {"nested-spheres", 200},
                                                   {"slab", 1000},
                                                   {"wedge", 1000},
                                                   {"variable-layers", 2000},
                                                   {"bracket", 200},
                                                   {"impeller", 200},
                                                   {"veins", 10200},
                                                   {"onlap", 110},
                                                   {"sandbox", 3500},
                                                   {"smooth-closed", 200},
                                                   {"torus", 200},
                                                   {"fault-network", 12000},
                                                   {"dfn", 13000},
                                                   {"dipping-faults", 2000},
                                                   {"listric", 2000},
                                                   {"thin-layers", 1000},
                                                   {"horizon-fault-pair", 1000}};
  for (const std::string_view name : reference_model_names()) {  // the coarsest one allowed works
    const double coarsest_m = (width_m.contains(name) ? width_m.at(name) : 1600) / 8;
    EXPECT_TRUE(generate_reference_model(name, {coarsest_m, {}})) << name;
    EXPECT_FALSE(generate_reference_model(name, {1.01 * coarsest_m, {}})) << name;
  }
}

TEST(GenerateReferenceModel, refuses_raw_ratios_out_of_their_domain) {
  for (const double bad : {0.21, -0.21, std::numeric_limits<double>::quiet_NaN()}) {
    const auto soup = generate_reference_model("B", {std::nullopt, bad});
    ASSERT_FALSE(soup) << bad;
    EXPECT_EQ(soup.failure().code, FailureCode::invalid_options);
  }
}

}  // namespace
}  // namespace strataflow
