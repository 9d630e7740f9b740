// Generated fault networks through the whole quad mesher, looked at without its code. bench_quads does 300 and more.
#include <gtest/gtest.h>

#include "support/quad_network.h"

namespace strataflow {
namespace {

/// T10.
TEST(QuadNetworks, hold_every_curve_in_quads_that_are_not_inverted) {
  for (std::uint32_t n = 0; n < 2 * network_family_count; ++n) {
    const GeneratedNetwork network = generate_network(n);
    const support::NetworkOutcome outcome = support::mesh_network(network, "none");
    EXPECT_TRUE(outcome.succeeded()) << n << ", " << network.name << ": " << outcome.failure;
    EXPECT_GT(outcome.smallest_jacobian, 0) << network.name;
    EXPECT_GT(outcome.mean_jacobian, 0.9) << network.name;
  }
}

/// A row of three fault ends within a quad (5, 105), faults that meet at 1.5° (65), wells as circles of twelve segments
/// (108, 148): each failed once.
TEST(QuadNetworks, succeed_where_curves_leave_no_room_for_convex_quads) {
  for (const std::uint32_t n : {5u, 65u, 105u, 108u, 148u}) {
    const support::NetworkOutcome outcome = support::mesh_network(generate_network(n), "none");
    EXPECT_TRUE(outcome.succeeded()) << n << ": " << outcome.failure;
  }
}

TEST(QuadNetworks, always_succeed_with_the_fallback) {
  for (const std::uint32_t n : {1u, 5u}) {
    const GeneratedNetwork network = generate_network(n);
    const support::NetworkOutcome outcome = support::mesh_network(network, "subdivide");
    EXPECT_TRUE(outcome.succeeded()) << network.name << ": " << outcome.failure;
  }
}

}  // namespace
}  // namespace strataflow
