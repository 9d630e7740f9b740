#include "kernels/remeshing/dual/boundary_sides.h"

#include <set>

#include "kernels/remeshing/dual/dual_samples.h"

namespace strataflow {
namespace {

TEST(BoundarySides, a_box_has_six_sides_however_many_surfaces_they_are_cut_into) {
  const StructuralModel model = sample::reference("A1", 160);
  const std::vector<std::uint32_t> sides = find_boundary_sides(model);
  std::set<std::uint32_t> box;
  std::size_t boundary_surfaces = 0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    EXPECT_EQ(sides[s] != no_index, model.entities[model.surfaces[s].entity].role == Role::boundary);
    if (sides[s] == no_index) continue;
    box.insert(sides[s]);
    ++boundary_surfaces;
  }
  EXPECT_EQ(box.size(), 6u);
  EXPECT_EQ(boundary_surfaces, 18u);
}

TEST(BoundarySides, without_the_role_the_box_is_what_has_the_universe_on_one_side) {
  StructuralModel model = sample::reference("A1", 160);
  const std::vector<std::uint32_t> told = find_boundary_sides(model);
  for (Entity& entity : model.entities) entity.role = Role::unknown;
  EXPECT_EQ(find_boundary_sides(model), told);
}

TEST(BoundarySides, open_sheets_have_no_box) {
  const std::vector<std::uint32_t> sides = find_boundary_sides(sample::junction());
  for (const std::uint32_t side : sides) EXPECT_EQ(side, no_index);
}

}  // namespace
}  // namespace strataflow
