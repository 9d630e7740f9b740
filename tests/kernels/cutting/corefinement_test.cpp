// Beside CGAL: as many triangles and vertices as its corefinement makes, and the volumes of its exact booleans.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "io/read_input.h"
#include "kernels/cutting/cut_surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/building/weld_points.h"

namespace strataflow {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

struct Counts {
  std::size_t triangles = 0, vertices = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
  friend void PrintTo(const Counts& c, std::ostream* out) {
    *out << c.triangles << " triangles, " << c.vertices << " vertices";
  }
};

/// Triangles [first, end) with points welded.
Mesh mesh_of(const TriangleSoup& soup, std::size_t first, std::size_t end) {
  const WeldedPoints welded = weld_points(soup.points);
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertex(welded.source.size(), Mesh::null_vertex());
  for (std::size_t t = first; t < end; ++t) {
    Mesh::Vertex_index corner[3];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = welded.id[soup.triangles[t][k]];
      const Vec3& p = soup.points[welded.source[v]];
      if (vertex[v] == Mesh::null_vertex()) vertex[v] = mesh.add_vertex({p.x, p.y, p.z});
      corner[k] = vertex[v];
    }
    mesh.add_face(corner[0], corner[1], corner[2]);
  }
  return mesh;
}

Counts counts_of(const TriangleSoup& soup, std::uint32_t entity) {
  Counts counts;
  std::vector<Vec3> points;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (soup.patch_entity[soup.triangle_patch[t]] != entity) continue;
    ++counts.triangles;
    for (const std::uint32_t v : soup.triangles[t]) points.push_back(soup.points[v]);
  }
  counts.vertices = weld_points(points).source.size();
  return counts;
}

TEST(Corefinement, of_generated_pairs_has_as_many_triangles_and_vertices) {
  for (const double resolution : {25.0, 10.0}) {
    const Result<TriangleSoup> soup = generate_reference_model("horizon-fault-pair", {.resolution_m = resolution});
    ASSERT_TRUE(soup);
    const auto middle = static_cast<std::size_t>(
        std::find(soup->triangle_patch.begin(), soup->triangle_patch.end(), 1u) - soup->triangle_patch.begin());
    Mesh first = mesh_of(*soup, 0, middle), second = mesh_of(*soup, middle, soup->triangles.size());
    processing::corefine(first, second);
    const Result<CutResult> cut = cut_surfaces(*soup);
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->report.pairs_left, 0u);
    EXPECT_EQ(counts_of(cut->soup, 0), (Counts{first.number_of_faces(), first.number_of_vertices()})) << resolution;
    EXPECT_EQ(counts_of(cut->soup, 1), (Counts{second.number_of_faces(), second.number_of_vertices()})) << resolution;
    EXPECT_GT(cut->soup.triangles.size(), soup->triangles.size());
  }
}

TEST(Corefinement, of_the_two_spheres_has_the_same_cells) {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  const std::filesystem::path file =
      (folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data") /
      "arrangement/two_spheres.stl";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here (set STRATAFLOW_DATA)";
  const Result<InputData> input = read_input(file);
  ASSERT_TRUE(input);
  const TriangleSoup& soup = input->surfaces;
  ASSERT_EQ(soup.triangles.size(), 1600u);
  Mesh first = mesh_of(soup, 0, 800), second = mesh_of(soup, 800, 1600), common;
  ASSERT_TRUE(CGAL::is_closed(first) && CGAL::is_closed(second));
  const Kernel::FT whole_first = processing::volume(first), whole_second = processing::volume(second);
  ASSERT_TRUE(processing::corefine_and_compute_intersection(first, second, common));
  const Kernel::FT shared = processing::volume(common);
  std::vector<double> expected{CGAL::to_double(shared), CGAL::to_double(whole_first - shared),
                               CGAL::to_double(whole_second - shared)};
  std::sort(expected.begin(), expected.end());

  const Result<CutResult> cut = cut_surfaces(soup);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->report.pairs_left, 0u);
  const Result<BuiltModel> built = build_structural_model(cut->soup);
  ASSERT_TRUE(built);
  std::vector<double> found;
  for (const Region& region : built->model.regions) found.push_back(region.volume_m3);
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

}  // namespace
}  // namespace strataflow
