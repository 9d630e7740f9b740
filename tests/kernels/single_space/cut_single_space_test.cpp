#include "kernels/single_space/cut_single_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "base/digest.h"
#include "kernels/intersection/find_intersections.h"
#include "support/clean_split.h"
#include "support/schedules.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

/// A jittered sheet of 20 × 20 cells, and a steep fault through it from side to side.
TriangleSoup sheet_and_fault(std::uint32_t seed) {
  TriangleSoup soup = support::jittered_sheet(20, seed);
  const std::uint32_t fault = support::add_patch(soup, "F", Role::fault);
  support::add_quad(soup, fault, {-3, 8.3, -4}, {25, 12.9, -4}, {25, 14.9, 4}, {-3, 10.3, 4});
  return soup;
}

double height_over_fault(const Vec3& p) {
  const Vec3 a{-3, 8.3, -4}, n = cross(Vec3{28, 4.6, 0}, Vec3{28, 6.6, 8});
  return dot(n, p - a) / length(n);
}

TEST(SingleSpaceCut, inserts_few_nodes_that_lie_on_the_cutting_surface_and_splits_along_them) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const TriangleSoup soup = sheet_and_fault(seed);
    const Result<SingleSpaceCut> cut = cut_single_space(soup, 0, 1);
    ASSERT_TRUE(cut);
    const SingleSpaceReport& report = cut->report;
    EXPECT_TRUE(report.skipped_triangles.empty());
    EXPECT_GT(report.crossed_triangles, 40u);
    EXPECT_GT(report.moved_vertices, 3u);
    EXPECT_GT(report.flipped_edges, 5u);
    for (const auto& edge : cut->trace)
      for (const std::uint32_t v : edge) EXPECT_NEAR(height_over_fault(cut->soup.points[v]), 0, 1e-12);
    // One chain from border to border: every node of it is doubled.
    EXPECT_EQ(report.doubled_nodes, cut->trace.size() + 1);
    // Each half keeps to its side.
    double area = 0;
    for (std::size_t t = 0; t < cut->soup.triangles.size(); ++t) {
      if (cut->soup.triangle_patch[t] != 0) continue;
      double low = 0, high = 0;
      const Triangle& n = cut->soup.triangles[t];
      for (const std::uint32_t v : n) {
        low = std::min(low, height_over_fault(cut->soup.points[v]));
        high = std::max(high, height_over_fault(cut->soup.points[v]));
      }
      EXPECT_TRUE(low > -1e-9 || high < 1e-9) << "triangle " << t;
      const double z =
          cross(cut->soup.points[n[1]] - cut->soup.points[n[0]], cut->soup.points[n[2]] - cut->soup.points[n[0]]).z;
      EXPECT_GT(z, 0);
      area += z / 2;
    }
    EXPECT_NEAR(area, 400, 1e-9);
  }
}

TEST(SingleSpaceCut, makes_fewer_triangles_than_a_clean_cut) {
  const TriangleSoup soup = sheet_and_fault(3);
  const Result<SingleSpaceCut> cut = cut_single_space(soup, 0, 1);
  ASSERT_TRUE(cut);
  support::CleanSplit clean = support::unsplit(support::jittered_sheet(20, 3));
  support::split_along(clean, height_over_fault);
  EXPECT_LT(cut->soup.triangles.size() - 2, clean.soup.triangles.size());
}

TEST(SingleSpaceCut, of_a_triangle_alone_puts_nodes_on_its_border_only) {
  TriangleSoup soup;
  support::add_triangle(soup, support::add_patch(soup, "H"), {0, 0, 0}, {4, 0, 0}, {2, 4, 0});
  support::add_quad(soup, support::add_patch(soup, "F"), {-5, 2, -1}, {9, 2, -1}, {9, 2, 1}, {-5, 2, 1});
  const Result<SingleSpaceCut> cut = cut_single_space(soup, 0, 1);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->report.inserted_nodes, 2u);
  EXPECT_EQ(cut->soup.triangles.size(), 3u + 2u);
  EXPECT_EQ(cut->report.doubled_nodes, 2u);
}

TEST(SingleSpaceCut, ends_where_the_cutting_surface_ends) {
  TriangleSoup soup = support::jittered_sheet(20, 4);
  support::add_quad(soup, support::add_patch(soup, "F"), {-3, 8.3, -4}, {12.3, 10.9, -4}, {12.3, 10.9, 4},
                    {-3, 8.3, 4});
  const Result<SingleSpaceCut> cut = cut_single_space(soup, 0, 1);
  ASSERT_TRUE(cut);
  EXPECT_GT(cut->trace.size(), 5u);
  EXPECT_EQ(cut->report.doubled_nodes, cut->trace.size()) << "the slit closes at its inner end";
}

TEST(SingleSpaceCut, interpolates_values_and_leaves_the_cutting_surface_alone) {
  TriangleSoup soup = sheet_and_fault(2);
  soup.properties.push_back({"x", "m", 1, {}});
  for (const Vec3& p : soup.points) soup.properties[0].values.push_back(p.x);
  const Result<SingleSpaceCut> cut = cut_single_space(soup, 0, 1, {0});
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->report.moved_vertices, 0u);
  for (std::size_t v = 0; v < cut->soup.points.size(); ++v)
    EXPECT_NEAR(cut->soup.properties[0].values[v], cut->soup.points[v].x, 1e-9);
  const std::size_t n = soup.triangles.size();
  EXPECT_EQ(cut->soup.triangles.back(), soup.triangles[n - 1]);
}

TEST(SingleSpaceCut, gives_the_same_bits_on_every_schedule) {
  const TriangleSoup soup = sheet_and_fault(1);
  const auto digest = [&] {
    ArchiveWriter bytes;
    bytes(cut_single_space(soup, 0, 1)->soup);
    return digest_of(bytes.bytes());
  };
  const Digest expected = digest();
  support::on_every_schedule([&](const char* schedule) { EXPECT_EQ(digest(), expected) << schedule; });
}

TEST(SingleSpaceCut, refuses_a_surface_against_itself_and_options_out_of_their_domain) {
  const TriangleSoup soup = sheet_and_fault(1);
  EXPECT_FALSE(cut_single_space(soup, 0, 0));
  EXPECT_FALSE(cut_single_space(soup, 0, 7));
  EXPECT_FALSE(cut_single_space(soup, 0, 1, {0.5}));
}

}  // namespace
}  // namespace strataflow
