#include "kernels/complexity/box_elements.h"

#include <gtest/gtest.h>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

TEST(BoxElements, of_a_layered_box_are_all_but_the_horizons) {
  const StructuralModel model = model_of(support::layered_box({0, 0.25, 0.5, 1}));
  const ElementCounts counts = count_elements(model, find_box_elements(model));
  EXPECT_EQ(counts.regions, 3u);
  EXPECT_EQ(counts.surfaces, 2u);
  EXPECT_EQ(counts.lines, 0u);  // the horizons' borders lie on the box
  EXPECT_EQ(counts.corners, 0u);
  EXPECT_EQ(counts.total(), 5u);
}

TEST(BoxElements, are_those_that_face_the_universe_where_no_feature_is_called_boundary) {
  TriangleSoup soup = support::layered_box({0, 0.25, 0.5, 1});
  soup.entities[0].role = Role::unknown;
  const StructuralModel model = model_of(soup);
  EXPECT_EQ(count_elements(model, find_box_elements(model)).surfaces, 2u);
}

TEST(BoxElements, a_free_fault_counts_with_its_border) {
  const StructuralModel model = model_of(support::box_with_floating_fault());
  const ElementCounts counts = count_elements(model, find_box_elements(model));
  EXPECT_EQ(counts.surfaces, 1u);
  EXPECT_EQ(counts.lines, 1u);
}

}  // namespace
}  // namespace strataflow
