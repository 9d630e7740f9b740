#include "kernels/hexes/stratigraphic_function.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::LevelledTets;

StratigraphicTets function_of(const LevelledTets& model, const LayerOptions& options = {}) {
  Result<StratigraphicTets> found = find_stratigraphic_function(model.tets, model.levels, options);
  EXPECT_TRUE(found) << describe(found.failure());
  return found ? std::move(*found) : StratigraphicTets{};
}

/// R6: W of every horizon on both sides of its facets, nothing out of range.
void expect_good_function(const LevelledTets& model, const StratigraphicTets& found) {
  EXPECT_EQ(found.model_tets, model.tets.tets.size());
  for (std::uint32_t face = 0; face < model.tets.facet_of.size(); ++face) {
    if (model.tets.facet_of[face] == no_index) continue;
    const SheetFacet& facet = model.tets.facets[model.tets.facet_of[face]];
    if (facet.kind == SheetKind::fault || facet.kind == SheetKind::side) continue;
    const std::uint32_t unit = model.levels.unit[face / 4];
    // The level of the tetrahedron's own unit, which is that of the facet unless units between are missing.
    for (const std::uint32_t copy : face_vertices(found.tets[face / 4], face % 4)) {
      EXPECT_EQ(found.w[copy], std::round(found.w[copy]));
      EXPECT_GE(found.w[copy], found.level_w[unit]);
      EXPECT_LE(found.w[copy], found.level_w[unit + 1]);
    }
  }
  for (std::uint32_t t = 0; t < found.model_tets; ++t)
    for (const std::uint32_t copy : found.tets[t]) {
      ASSERT_GE(found.w[copy], found.level_w[model.levels.unit[t]]);
      ASSERT_LE(found.w[copy], found.level_w[model.levels.unit[t] + 1]);
    }
  for (std::uint32_t t = found.model_tets; t < found.tets.size(); ++t) {
    const auto point = [&](std::size_t k) { return found.point[found.tets[t][k]]; };
    EXPECT_TRUE(point(0) == point(3) || point(1) == point(3) || point(2) == point(3)) << "a volume in space";
  }
}

/// UVW space is filled: the tetrahedra have the volume of plan × levels, and outside are only walls and both ends.
void expect_filled(const LevelledTets& model, const StratigraphicTets& found, double plan_m2) {
  double volume = 0;
  for (const Tet& tet : found.tets) {
    std::array<Vec3, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
      at[k] = model.tets.points[found.point[tet[k]]];
      at[k].z = found.w[tet[k]];
    }
    volume += support::six_volumes(at[0], at[1], at[2], at[3]) / 6;
  }
  EXPECT_NEAR(volume / (plan_m2 * found.layer_count()), 1, 1e-9);
  for (std::uint32_t face = 0; face < found.neighbour.size(); ++face) {
    if (found.neighbour[face] != no_index) continue;
    const Triangle v = face_vertices(found.tets[face / 4], face % 4);
    const bool is_end = found.w[v[0]] == found.w[v[1]] && found.w[v[1]] == found.w[v[2]];
    if (is_end) {
      EXPECT_TRUE(found.w[v[0]] == 0 || found.w[v[0]] == found.layer_count()) << found.w[v[0]];
      continue;
    }
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = model.tets.points[found.point[v[k]]];
    EXPECT_NEAR(cross(p[1] - p[0], p[2] - p[0]).z, 0, 1e-6);
  }
}

TEST(StratigraphicFunction, has_whole_numbers_on_horizons_and_is_positive_between) {
  const LevelledTets model = support::levelled(support::filled(*vertical_faults(0, false), 100));
  EXPECT_EQ(model.levels.names, (std::vector<std::string>{"Bottom", "H1", "H2", "H3", "Top"}));
  const StratigraphicTets found = function_of(model, {2, {{"H1", 3}, {"Top", 1}}, {}});
  EXPECT_EQ(found.level_w, (std::vector<std::uint32_t>{0, 3, 5, 7, 8}));
  EXPECT_EQ(found.tets.size(), found.model_tets);
  expect_good_function(model, found);
  expect_filled(model, found, 1600.0 * 1200);
}

TEST(StratigraphicFunction, jumps_at_faults_and_not_at_their_tips) {
  const LevelledTets model = support::levelled(support::filled(*vertical_faults(6, true), 60));
  const StratigraphicTets found = function_of(model);
  expect_good_function(model, found);
  expect_filled(model, found, 1600.0 * 1200);
  EXPECT_EQ(found.tets.size(), found.model_tets);
}

TEST(StratigraphicFunction, fills_what_erosion_took_away_with_tetrahedra_without_volume) {
  for (const bool has_fault : {false, true}) {
    const LevelledTets model = support::levelled(support::filled(*unconformity(has_fault), 80));
    EXPECT_EQ(model.levels.names, (std::vector<std::string>{"Bottom", "H1", "H2", "H3", "E", "H4", "Top"}));
    const StratigraphicTets found = function_of(model);
    EXPECT_GT(found.tets.size(), found.model_tets);
    expect_good_function(model, found);
    if (!has_fault) expect_filled(model, found, 1600.0 * 1000);  // with one: its dip overlaps in the plan
  }
}

TEST(StratigraphicFunction, counts_layers_from_their_mean_thickness) {
  const LevelledTets model = support::levelled(support::filled(*vertical_faults(0, false), 150));
  const StratigraphicTets found = function_of(model, {4, {}, 26.0});
  EXPECT_EQ(found.level_w, (std::vector<std::uint32_t>{0, 4, 8, 12, 16}));
}

TEST(StratigraphicFunction, follows_layers_of_a_centimetre) {
  const LevelledTets model = support::levelled(support::filled(*thin_layers(), 50));
  const StratigraphicTets found = function_of(model, {1, {}, {}});
  expect_good_function(model, found);
}

TEST(StratigraphicFunction, refuses_counts_that_make_no_layer_and_units_that_are_not) {
  const LevelledTets model = support::levelled(support::filled(*vertical_faults(0, false), 150));
  EXPECT_FALSE(find_stratigraphic_function(model.tets, model.levels, {0, {}, {}}));
  EXPECT_FALSE(find_stratigraphic_function(model.tets, model.levels, {4, {{"H9", 2}}, {}}));
  EXPECT_FALSE(find_stratigraphic_function(model.tets, model.levels, {4, {}, std::nan("")}));
}

TEST(StratigraphicFunction, is_the_same_on_every_schedule) {
  const LevelledTets model = support::levelled(support::filled(*unconformity(true), 110));
  const StratigraphicTets expected = function_of(model);
  support::on_every_schedule([&](const char* schedule) {
    const StratigraphicTets found = function_of(model);
    EXPECT_EQ(found.w, expected.w) << schedule;
    EXPECT_EQ(found.tets, expected.tets) << schedule;
  });
}

TEST(StratigraphicFunction, remembers_the_layout_and_the_thickness_of_every_unit) {
  const support::LevelledTets model = support::levelled(support::filled(*vertical_faults(0, false), 200));
  LayerOptions options{2, {}, 25.0, LayerLayout::parallel_to_base, {{"H2", LayerLayout::proportional}}};
  const Result<StratigraphicTets> tets = find_stratigraphic_function(model.tets, model.levels, options);
  ASSERT_TRUE(tets);
  ASSERT_EQ(tets->units.size(), 4u);
  EXPECT_EQ(tets->units[0].layout, LayerLayout::parallel_to_base);
  EXPECT_EQ(tets->units[1].layout, LayerLayout::proportional);
  EXPECT_EQ(tets->units[3].thickness_m, 25);
  options.thickness_m = std::nullopt;
  EXPECT_NEAR(find_stratigraphic_function(model.tets, model.levels, options)->units[0].thickness_m, 50, 3);
  options.unit_layout = {{"H9", LayerLayout::proportional}};
  EXPECT_FALSE(find_stratigraphic_function(model.tets, model.levels, options));
}

}  // namespace
}  // namespace strataflow
