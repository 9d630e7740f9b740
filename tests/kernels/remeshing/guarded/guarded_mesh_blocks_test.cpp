// Parts of a GuardedMesh, worked on at the same time.
#include <atomic>
#include <optional>

#include "kernels/remeshing/guarded/guarded_mesh.h"
#include "kernels/remeshing/guarded/mesh_of_soup.h"
#include "kernels/remeshing/guarded/relax_guarded.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using Mesh = support::MeshOfSoup;

constexpr BlockOptions small_blocks{.most_triangles = 150};

/// All kinds of steps, everywhere, in blocks that lie elsewhere each time.
void remesh_in_blocks(GuardedMesh& mesh, double size_m) {
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) mesh.set_size_m(v, size_m);
  for (const double share : {0.5, 0.4, 0.6})
    mesh.in_blocks({small_blocks.most_triangles, share}, [](GuardedMesh& part) {
      std::uint64_t steps = split_long_edges(part) + collapse_short_edges(part);
      if (steps > 0) steps += shake(part, 0.3);
      steps += even_valences(part) + even_out(part) + flip_edges(part) + raise_mean_shape(part);
      return steps + mend_bad_triangles(part);
    });
}

TEST(GuardedMeshBlocks, keep_every_rule_that_the_whole_mesh_keeps) {
  for (const auto& soup : {support::layered_box(10), support::dying_fault(), support::standing_sheet()})
    for (const double size_m : {0.4, 2.5}) {
      Mesh m(soup);
      const std::size_t before = m.alive();
      remesh_in_blocks(m.mesh, size_m);
      EXPECT_TRUE(size_m < 1 ? m.alive() > before : m.alive() < before);
      m.expect_valid();
      for (int k = 0; k < 2; ++k) collapse_short_edges(m.mesh), split_long_edges(m.mesh);  // the whole goes on
      m.expect_valid();
    }
}

TEST(GuardedMeshBlocks, are_several_and_leave_their_surroundings_alone) {
  Mesh m(support::layered_box(10));
  const auto counts = m.mesh.in_blocks(small_blocks, [](GuardedMesh& part) {
    std::array<std::uint32_t, 2> count{};
    std::vector<Triangle> surroundings;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t t = 0; t < part.triangle_count(); ++t)
      if (++count[part.is_changeable(t)]; !part.is_changeable(t)) {
        numbers.push_back(t);
        surroundings.push_back(part.triangle(t));
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t a = part.triangle(t)[k], b = part.triangle(t)[(k + 1) % 3];
          EXPECT_TRUE(part.is_fixed(a));
          EXPECT_EQ(part.split_edge(a, b, {}), Verdict::fixed);
          EXPECT_NE(part.flip_edge(a, b, {}), Verdict::done);
        }
      }
    split_long_edges(part);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      EXPECT_TRUE(part.is_alive(numbers[k]));
      EXPECT_EQ(part.triangle(numbers[k]), surroundings[k]);
    }
    return count;
  });
  EXPECT_GE(counts.size(), 8u);
  std::uint32_t changeable = 0, around = 0;
  for (const auto& count : counts) changeable += count[1], around += count[0];
  EXPECT_LT(changeable, m.model.triangles.size());
  EXPECT_GE(changeable + around / 2, m.model.triangles.size()) << "what is in no block is around two at least";
}

TEST(GuardedMeshBlocks, refuse_a_step_that_leaves_the_block_and_have_it_tried_again) {
  // From every vertex of a plane a long way in each direction: across the sides of blocks, some of them.
  TriangleSoup soup;
  support::add_grid(soup, "lying", 20, [](double u, double v) { return Vec3{20 * u, 20 * v, 0.01 * u * v}; });
  Mesh m(soup, 1, 80);
  std::atomic<int> refused = 0;
  m.mesh.in_blocks({.most_triangles = 200}, [&](GuardedMesh& part) {
    Box3 box;
    for (std::uint32_t t = 0; t < part.triangle_count(); ++t)
      if (part.is_changeable(t))
        for (const std::uint32_t v : part.triangle(t)) box.take(part.point(v));
    for (std::uint32_t v = 0; v < part.vertex_count(); ++v) {
      if (part.is_fixed(v) || part.kind(v) != VertexKind::surface) continue;
      for (const Vec3& way : {Vec3{1.5, 0, 0}, Vec3{-1.5, 0, 0}, Vec3{0, 1.5, 0}, Vec3{0, -1.5, 0}}) {
        const std::uint32_t before = part.step_count();
        const Verdict verdict = part.move_vertex(v, part.point(v) + way, {});
        EXPECT_NE(verdict, Verdict::done) << "a triangle would turn over";
        if (verdict == Verdict::fixed) {
          ++refused;
          EXPECT_GT(part.star_changed_at(v), before);
        }
      }
    }
    return 0;
  });
  EXPECT_GT(refused, 0);
  m.expect_valid();
}

TEST(GuardedMeshBlocks, count_triangles_at_their_sides_as_changed) {
  Mesh m(support::layered_box(10));
  const std::uint32_t before = m.mesh.step_count();
  m.mesh.in_blocks(small_blocks, [](GuardedMesh&) { return 0; });
  std::uint32_t changed = 0;
  for (std::uint32_t t = 0; t < m.mesh.triangle_count(); ++t) changed += m.mesh.changed_at(t) > before;
  EXPECT_GT(changed, 50u);
  EXPECT_LT(changed, m.mesh.triangle_count() / 2);
  EXPECT_EQ(m.mesh.soup().points, GuardedMesh(m.inputs, {.distance_m = 1, .cell_m = 1}).soup().points);
}

TEST(GuardedMeshBlocks, work_on_a_small_mesh_as_one) {
  Mesh m(support::standing_sheet());
  const auto sizes = m.mesh.in_blocks({}, [&](GuardedMesh& part) { return &part; });
  ASSERT_EQ(sizes.size(), 1u);
  EXPECT_EQ(sizes[0], &m.mesh);
}

TEST(GuardedMeshBlocks, come_to_the_same_mesh_on_every_schedule) {
  const auto remeshed = [] {
    Mesh m(support::layered_box(10));
    remesh_in_blocks(m.mesh, 0.7);
    return m.mesh.soup();
  };
  std::optional<TriangleSoup> expected;
  support::on_every_schedule([&](const char* schedule) {
    const TriangleSoup soup = remeshed();
    if (!expected) expected = soup;
    EXPECT_EQ(soup.points, expected->points) << schedule;
    EXPECT_EQ(soup.triangles, expected->triangles) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
