#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

using namespace testing_support;

TEST(Bracket, has_round_holes_and_flat_faces) {
  const TriangleSoup soup = *generate_reference_model("bracket", {6, {}});
  for (const Vec3& p : points_of(soup, "Holes")) {
    const double dx = std::min(std::abs(p.x - 50), std::abs(p.x - 150));
    const double dy = std::min(std::abs(p.y - 27), std::abs(p.y - 93));
    EXPECT_NEAR(std::hypot(dx, dy), 12, 1e-10);
  }
  for (const Vec3& p : points_of(soup, "UprightFront")) EXPECT_EQ(p.x, 12);
  for (const Vec3& p : points_of(soup, "RibTop")) EXPECT_NEAR(p.z, 92 - p.x, 1e-12);
}

TEST(Impeller, winds_its_blades_by_a_fifth_of_a_turn_over_its_length) {
  const TriangleSoup soup = *generate_reference_model("impeller", {5, {}});
  // The first blade's pressure side starts at 0.2 · 10 / 80 of a turn and ends at 0.2 · 70 / 80.
  const auto turn_of = [](const Vec3& p) { return std::atan2(p.y - 100, p.x - 100) / 6.283185307179586; };
  std::size_t on_first = 0;
  for (const Vec3& p : points_of(soup, "Pressure")) {
    const double sector = (turn_of(p) - 0.2 * p.z / 80) * 7;
    EXPECT_NEAR(sector, std::round(sector), 1e-4);
    on_first += std::abs(sector) < 1e-4;
  }
  EXPECT_GT(on_first, 10u);
  for (const Vec3& p : points_of(soup, "Bore")) EXPECT_NEAR(std::hypot(p.x - 100, p.y - 100), 14, 1e-10);
}

TEST(Impeller, repeats_itself_seven_times) {
  const SoupTopology topology = topology_of(*generate_reference_model("impeller"));
  ASSERT_EQ(topology.region_volumes.size(), 1u);
  const TriangleSoup soup = *generate_reference_model("impeller");
  EXPECT_EQ(piece_count(soup, entity_named(soup, "Tips")), 7u);
}

}  // namespace
}  // namespace strataflow
