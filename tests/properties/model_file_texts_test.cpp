// The transformations of the property tests do what they say.
#include "properties/model_file_texts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace strataflow::support {
namespace {

const std::string two_surfaces =
    "GOCAD Model3d 1\nHEADER {\nname:m\n}\nTSURF a\nTSURF b\nTFACE 1 top a\n  1 0 0\n  1.5 0 0\n  0 1 0\nREGION 2 "
    "Universe\n"
    "  -1 2 0\nEND\n"
    "GOCAD TSurf 1\nHEADER {\nname:a\n}\nTFACE\nVRTX 1 1 0 0\nVRTX 2 1.5 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nTFACE\nATOM 4 "
    "2\n"
    "VRTX 5 4 4 4\nTRGL 4 5 1\nBORDER 9 1 2\nEND\n"
    "GOCAD TSurf 1\nHEADER {\nname:b\n}\nTFACE\nPVRTX 1 7 8 9 0.5\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";

std::string sorted_letters(std::string text) {
  std::sort(text.begin(), text.end());
  return text;
}

TEST(WithShuffledSurfaces, permutes_whole_objects) {
  bool moved = false;
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const std::string text = with_shuffled_surfaces(two_surfaces, seed);
    EXPECT_TRUE(text.starts_with("GOCAD Model3d"));
    EXPECT_EQ(sorted_letters(text), sorted_letters(two_surfaces));
    moved = moved || text.find("name:b") < text.find("name:a");
  }
  EXPECT_TRUE(moved);
}

TEST(WithFlippedFacets, turns_facets_over) {
  bool flipped = false, kept = false;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const std::string text = with_flipped_facets(two_surfaces, seed);
    EXPECT_EQ(text.size(), two_surfaces.size());
    const bool even = text.find("TRGL 4 5 1") != std::string::npos;
    const bool odd = text.find("TRGL 5 4 1") != std::string::npos || text.find("TRGL 4 1 5") != std::string::npos ||
                     text.find("TRGL 1 5 4") != std::string::npos;
    EXPECT_NE(even, odd);
    flipped = flipped || odd;
    kept = kept || even;
  }
  EXPECT_TRUE(flipped && kept);
}

TEST(FilePerSurface, leaves_the_model_behind) {
  const std::vector<TextFile> files = file_per_surface(two_surfaces);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].text + files[1].text, two_surfaces.substr(two_surfaces.find("GOCAD TSurf")));
}

TEST(FilePerFace, gives_every_face_its_own_vertices) {
  const std::vector<TextFile> files = file_per_face(two_surfaces);
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[1].text,
            "GOCAD TSurf 1\nHEADER {\nname:a\n}\nTFACE\nVRTX 1 1.5 0 0\nVRTX 2 4 4 4\nVRTX 3 1 0 0\nTRGL 1 2 3\nEND\n");
}

TEST(WithMovedPoints, moves_positions_and_nothing_else) {
  const std::string moved = with_moved_points(two_surfaces, [](const Vec3& p) { return p + Vec3{5e6, 0, -1}; });
  EXPECT_NE(moved.find("PVRTX 1 5000007 8 8 0.5\n"), std::string::npos) << moved;
  EXPECT_NE(moved.find("VRTX 2 5000001.5 0 -1\nVRTX 3 5e+06 1 -1\nTRGL 1 2 3\n"), std::string::npos) << moved;
  EXPECT_NE(moved.find("TFACE 1 top a\n5000001 0 -1\n5000001.5 0 -1\n5e+06 1 -1\nREGION"), std::string::npos) << moved;
  EXPECT_NE(moved.find("  -1 2 0\n"), std::string::npos) << moved;
  EXPECT_EQ(with_moved_points("v  1.0E+00 2 3\nf 1 2 3\n", [](const Vec3& p) { return 2 * p; }), "v 2 4 6\nf 1 2 3\n");
}

TEST(WithoutGroups, keeps_geometry) { EXPECT_EQ(without_groups("o a\nv 1 2 3\ng b\nf 1 2 3\n"), "v 1 2 3\nf 1 2 3\n"); }

TEST(WithShuffledTriangles, keeps_every_triangle) {
  const std::string text = with_shuffled_triangles("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n", 3);
  EXPECT_EQ(std::count(text.begin(), text.end(), 'v'), 4);
  EXPECT_EQ(std::count(text.begin(), text.end(), 'f'), 2);
}

}  // namespace
}  // namespace strataflow::support
