#include "kernels/remeshing/dual/ball_property.h"

#include <set>

#include "kernels/remeshing/dual/dual_samples.h"
#include "kernels/remeshing/dual/dual_soup.h"
#include "kernels/remeshing/dual/element_changes.h"
#include "kernels/voronoi/line_edges.h"
#include "kernels/voronoi/optimise_sites.h"
#include "kernels/voronoi/sample_sites.h"

namespace strataflow {
namespace {

using sample::Dual;
using sample::dual_of;
using sample::Patches;

std::set<BallCheck> failed_checks(const Dual& dual) {
  std::set<BallCheck> checks;
  for (const BallFailure& failure : check_ball_property(dual.model, dual.diagram, dual.components))
    checks.insert(failure.check);
  return checks;
}

TEST(BallProperty, holds_for_a_well_sampled_sphere) {
  const StructuralModel model = Patches().add("S", Role::horizon, sample::sphere(3)).model();
  const Dual dual = dual_of(model, sample::sphere(1).points);
  EXPECT_TRUE(failed_checks(dual).empty());
  EXPECT_EQ(sample::euler_of(dual.mesh), 2);
}

TEST(BallProperty, a_belt_round_a_sphere_is_not_a_disc_and_meets_its_neighbours_in_closed_curves) {
  const Dual dual =
      dual_of(Patches().add("S", Role::horizon, sample::sphere(3)).model(), {{0, 0, 0}, {0, 0, 1.4}, {0, 0, -1.4}});
  EXPECT_EQ(failed_checks(dual),
            (std::set{BallCheck::not_a_disc, BallCheck::several_borders, BallCheck::closed_chain}));
}

TEST(BallProperty, a_disc_that_meets_the_border_in_two_arcs_fails) {
  const StructuralModel strip =
      Patches().add("S", Role::horizon, sample::rectangle({0, 0, 0}, {9, 0, 0}, {0, 1, 0}, 9, 1)).model();
  const Dual dual = dual_of(strip, {{1, 0.5, 0}, {4, 0.5, 0}, {7, 0.5, 0}});
  EXPECT_EQ(failed_checks(dual), (std::set{BallCheck::several_arcs, BallCheck::several_border_points}));
}

TEST(BallProperty, two_sheets_in_one_cell_are_told) {
  const auto sheet = [](double z) { return sample::rectangle({-1, -1, z}, {2, 0, 0}, {0, 2, 0}, 3, 3); };
  const Dual dual = dual_of(Patches().add("H1", Role::horizon, sheet(0)).add("H2", Role::horizon, sheet(0.1)).model(),
                            {{0.5, 0, 0.05}, {-0.3, 0.5, 0.05}, {-0.3, -0.5, 0.05}});
  EXPECT_EQ(failed_checks(dual), std::set{BallCheck::several_sheets});
}

TEST(BallProperty, corners_linked_inside_a_cell_are_told) {
  const Dual dual = dual_of(sample::junction(), {{0.5, 0, 0}, {0.9, 0.4, -0.4}});
  EXPECT_TRUE(failed_checks(dual).contains(BallCheck::several_corners));
}

TEST(BallProperty, where_it_holds_and_nothing_merged_the_model_keeps_all_its_elements) {
  const StructuralModel model = sample::reference("A1", 100);
  const auto edges = line_edges(model);
  const CvtDomain domain{model.points, model.triangles, {}, edges};
  const auto sites = optimise_sites(domain, sample_sites(model.points, model.triangles, {}, 500, 1), {},
                                    {.iterations = 20, .line_attraction = std::nullopt})
                         .sites;
  Dual dual = dual_of(model, sites);
  std::set<BallCheck> checks = failed_checks(dual);
  checks.erase(BallCheck::several_sheets);
  ASSERT_TRUE(checks.empty());
  ASSERT_TRUE(dual.points.merges.empty());
  clean_up_dual(model, dual.mesh);
  const DualSoup made = make_dual_soup(model, dual.mesh);
  const StructuralModel after = build_structural_model(made.soup)->model;
  EXPECT_TRUE(compare_elements(model, made, after).empty());
  EXPECT_EQ(after.regions.size(), model.regions.size());
  EXPECT_TRUE(after.is_sealed);
}

}  // namespace
}  // namespace strataflow
