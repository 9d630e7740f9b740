#include "kernels/remeshing/guarded/relax_guarded.h"

#include "kernels/quality/analyze_triangles.h"
#include "kernels/remeshing/guarded/guarded_shapes.h"

namespace strataflow {
namespace {

using support::built;

class RelaxGuarded : public testing::Test {
 protected:
  static constexpr double size_m = 0.8;
  RelaxGuarded()
      : model(built(support::dying_fault())), inputs(model), mesh(inputs, {.distance_m = 0.1, .cell_m = size_m}) {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) mesh.set_size_m(v, size_m);
  }
  double longest() const {
    double most = 0;
    for (const std::uint32_t t : mesh.triangles_in_order())
      for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most, length(mesh.point(mesh.triangle(t)[k]) - mesh.point(mesh.triangle(t)[(k + 1) % 3])));
    return most;
  }
  double worst() const {
    double least = 1;
    for (const std::uint32_t t : mesh.triangles_in_order()) least = std::min(least, mesh.quality(t));
    return least;
  }
  void expect_valid() const { support::expect_same_structure(model, built(mesh.soup())); }
  StructuralModel model;
  InputSurfaces inputs;
  GuardedMesh mesh;
};

TEST_F(RelaxGuarded, splitting_leaves_no_long_edge) {
  EXPECT_GT(longest(), 4.0 / 3 * size_m);
  EXPECT_GT(split_long_edges(mesh), 0u);
  EXPECT_LE(longest(), 4.0 / 3 * size_m);
  expect_valid();
}

TEST_F(RelaxGuarded, collapsing_takes_short_edges_away) {
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) mesh.set_size_m(v, 2);
  const std::size_t before = mesh.triangles_in_order().size();
  EXPECT_GT(collapse_short_edges(mesh), 0u);
  EXPECT_LT(mesh.triangles_in_order().size(), before / 2);
  expect_valid();
}

TEST_F(RelaxGuarded, flipping_raises_the_worst_quality_and_ends) {
  // Skew the mesh first.
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    mesh.move_vertex(v, mesh.point(v) + Vec3{0.3 * std::sin(3.0 * v), 0.3, 0}, {.floor = 0.2});
  const double before = worst();
  EXPECT_GT(flip_edges(mesh), 0u);
  EXPECT_GE(worst(), before);
  EXPECT_EQ(flip_edges(mesh), 0u);
  expect_valid();
}

TEST_F(RelaxGuarded, evening_out_and_mending_make_better_triangles) {
  split_long_edges(mesh);
  collapse_short_edges(mesh);
  const auto mean = [&] {
    const TriangleSoup soup = mesh.soup();
    return analyze_triangles(soup.points, soup.triangles).mean_quality;
  };
  const double before = mean(), worst_before = worst();
  EXPECT_GT(shake(mesh, 0.3), 0u);
  for (int k = 0; k < 8; ++k) {
    even_valences(mesh);
    EXPECT_GT(even_out(mesh), 0u);
  }
  flip_edges(mesh);
  mend_bad_triangles(mesh);
  EXPECT_GT(mean(), before + 0.05);
  EXPECT_GT(mean(), 0.8);
  EXPECT_GE(worst(), std::min(worst_before, 0.34));
  const double even = mean();
  for (int k = 0; k < 3; ++k) {
    raise_mean_shape(mesh);
    even_out(mesh);
  }
  EXPECT_GT(mean(), even + 0.002);
  EXPECT_GE(worst(), std::min(worst_before, 0.34));
  expect_valid();
}

}  // namespace
}  // namespace strataflow
