#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/volumes/region_mesh.h"

namespace strataflow {

/// The corners of face k, opposite to vertex k, counter-clockwise seen from outside.
inline constexpr std::array<std::array<std::size_t, 3>, 4> face_corners{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// A face of a tetrahedron or a facet of the boundary, found by its sorted vertices.
struct FaceEntry {
  std::uint32_t middle = 0;
  std::uint32_t largest = 0;
  std::uint32_t id = 0;  ///< 4 × tet + face, or index of the facet
  bool is_facet = false;
  bool is_even = false;  ///< its vertices are an even permutation of the sorted ones
  std::uint32_t smallest = 0;
  bool has_same_vertices(const FaceEntry& other) const {
    return smallest == other.smallest && middle == other.middle && largest == other.largest;
  }
};

/// All facets and faces; those with equal vertices side by side, the facet first.
std::vector<FaceEntry> grouped_faces(const std::vector<Triangle>& facets, std::size_t point_count,
                                     const std::vector<Tet>& tets);

// What lies behind a face: the code 4 × tet + face of the face that touches it, or a side of a facet.
inline constexpr std::uint32_t facet_flag = 0x80000000u;
constexpr bool is_facet_code(std::uint32_t code) { return (code & facet_flag) != 0; }
constexpr std::uint32_t facet_of_code(std::uint32_t code) { return (code & ~facet_flag) / 2; }
constexpr std::uint32_t side_of_code(std::uint32_t code) { return code & 1; }  ///< 0 negative, 1 positive

/// Per face of `tets`, what lies behind it. Needs a verified mesh: every face is a facet or has one partner.
std::vector<std::uint32_t> tet_neighbours(const std::vector<Triangle>& facets, std::size_t point_count,
                                          const std::vector<Tet>& tets);

}  // namespace strataflow
