#include "base/digest.h"

#include <gtest/gtest.h>

#include "base/seed.h"

namespace strataflow {
namespace {

TEST(Digest, is_the_published_value_for_the_empty_text) {
  EXPECT_EQ(digest_of("").hex(), "99aa06d3014798d86001c324468d497f");  // XXH3 128 bits of nothing
}

TEST(Digest, one_bit_makes_another) { EXPECT_NE(digest_of("strata"), digest_of("strath")); }

TEST(Seed, depends_on_the_job_and_on_the_node) {
  EXPECT_EQ(seed_for(1, "remesh"), seed_for(1, "remesh"));
  EXPECT_NE(seed_for(1, "remesh"), seed_for(2, "remesh"));
  EXPECT_NE(seed_for(1, "remesh"), seed_for(1, "hexes"));
}

TEST(Seed, a_stream_stays_in_the_unit_interval_and_fills_it) {
  RandomStream random(3);
  double low = 1, high = 0, sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = random.unit();
    low = std::min(low, x);
    high = std::max(high, x);
    sum += x;
  }
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
  EXPECT_NEAR(sum / 10000, 0.5, 0.02);
}

}  // namespace
}  // namespace strataflow
