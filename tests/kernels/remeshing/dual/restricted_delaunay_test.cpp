#include "kernels/remeshing/dual/restricted_delaunay.h"

#include <set>

#include "kernels/remeshing/dual/dual_samples.h"
#include "kernels/voronoi/optimise_sites.h"
#include "kernels/voronoi/sample_sites.h"

namespace strataflow {
namespace {

using sample::Dual;
using sample::dual_of;
using sample::Patches;

TEST(RestrictedDelaunay, of_an_outline_lies_in_that_of_its_inside) {
  std::vector<Vec3> sites{{0, 0, 0}};  // a site in the middle, away from the outline
  for (int k = 0; k < 14; ++k)
    for (const double r : {0.3, 0.55, 0.85})
      if (r < 0.5 || k % 2 == 0) sites.push_back({r * std::cos(0.44879895 * k), r * std::sin(0.44879895 * k), 0});
  const Dual dual = dual_of(Patches().add("S", Role::horizon, sample::star(7, 0.4)).model(), sites);
  const RestrictedDelaunay plain = restricted_delaunay(dual.diagram, dual.components);
  ASSERT_FALSE(plain.line_edges.empty());
  std::set<std::uint32_t> on_outline;
  for (const auto& edge : plain.line_edges) {
    EXPECT_TRUE(std::binary_search(plain.edges.begin(), plain.edges.end(), edge));
    on_outline.insert(edge.begin(), edge.end());
  }
  EXPECT_FALSE(on_outline.contains(0));
  // Cells across an arm have two components of the outline.
  std::size_t across = 0;
  for (std::uint32_t s = 0; s < sites.size(); ++s)
    across += dual.components.site_lines[s + 1] - dual.components.site_lines[s] == 2 ? 1 : 0;
  EXPECT_GT(across, 0u);
}

TEST(RestrictedDelaunay, of_two_close_spheres_is_one_sphere) {
  const StructuralModel model = Patches()
                                    .add("in", Role::horizon, sample::sphere(3, 1))
                                    .add("out", Role::horizon, sample::sphere(3, 1.02))
                                    .model();
  const CvtDomain domain{model.points, model.triangles, {}, {}};
  const auto sites =
      optimise_sites(domain, sample_sites(model.points, model.triangles, {}, 100, 5), {}, {.iterations = 30}).sites;
  const Dual dual = dual_of(model, sites);
  const RestrictedDelaunay plain = restricted_delaunay(dual.diagram, dual.components);
  // Both sheets give the same triangles, but for the few places where they cut a Voronoi edge alone.
  EXPECT_LT(plain.triangles.size(), 210u);
  EXPECT_GE(plain.triangles.size(), 190u);
  EXPECT_EQ(dual.mesh.triangles.size(), 392u);
}

TEST(RestrictedDelaunay, every_edge_of_a_triangle_is_an_edge) {
  const StructuralModel model = sample::junction();
  const Dual dual = dual_of(model, sample::sites_in_box(model, 40, 6));
  const RestrictedDelaunay plain = restricted_delaunay(dual.diagram, dual.components);
  ASSERT_FALSE(plain.triangles.empty());
  for (const Triangle& t : plain.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::array<std::uint32_t, 2> edge{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])};
      EXPECT_TRUE(std::binary_search(plain.edges.begin(), plain.edges.end(), edge));
    }
}

}  // namespace
}  // namespace strataflow
