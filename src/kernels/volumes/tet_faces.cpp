#include "kernels/volumes/tet_faces.h"

#include <algorithm>

#include "base/internal_error.h"
#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {

FaceEntry face_entry(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t id, bool is_facet) {
  bool is_even = true;
  const auto order = [&](std::uint32_t& x, std::uint32_t& y) {
    if (x <= y) return;
    std::swap(x, y);
    is_even = !is_even;
  };
  order(a, b);
  order(b, c);
  order(a, b);
  return {b, c, id, is_facet, is_even, a};
}

}  // namespace

std::vector<FaceEntry> grouped_faces(const std::vector<Triangle>& facets, std::size_t point_count,
                                     const std::vector<Tet>& tets) {
  std::vector<FaceEntry> unsorted;
  unsorted.reserve(4 * tets.size() + facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    const Triangle& facet = facets[f];
    unsorted.push_back(face_entry(facet[0], facet[1], facet[2], f, true));
  }
  for (std::uint32_t t = 0; t < tets.size(); ++t)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto& corner = face_corners[k];
      unsorted.push_back(face_entry(tets[t][corner[0]], tets[t][corner[1]], tets[t][corner[2]], 4 * t + k, false));
    }
  std::vector<std::uint32_t> start(point_count + 1, 0);
  for (const FaceEntry& face : unsorted) ++start[face.smallest + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<FaceEntry> faces(unsorted.size());
  std::vector<std::uint32_t> next = start;
  for (const FaceEntry& face : unsorted) faces[next[face.smallest]++] = face;
  parallel_ranges(point_count, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      std::sort(faces.begin() + start[p], faces.begin() + start[p + 1], [](const FaceEntry& a, const FaceEntry& b) {
        if (a.middle != b.middle) return a.middle < b.middle;
        if (a.largest != b.largest) return a.largest < b.largest;
        if (a.is_facet != b.is_facet) return a.is_facet;
        return a.id < b.id;
      });
  });
  return faces;
}

std::vector<std::uint32_t> tet_neighbours(const std::vector<Triangle>& facets, std::size_t point_count,
                                          const std::vector<Tet>& tets) {
  std::vector<std::uint32_t> behind(4 * tets.size(), facet_flag);
  const std::vector<FaceEntry> faces = grouped_faces(facets, point_count, tets);
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].has_same_vertices(faces[i])) ++end;
    if (faces[i].is_facet) {
      for (std::size_t f = i + 1; f < end; ++f)
        behind[faces[f].id] = facet_flag | (2 * faces[i].id + (faces[f].is_even == faces[i].is_even ? 0 : 1));
    } else {
      STRATAFLOW_ASSERT(end - i == 2, "a face inside the region without partner");
      behind[faces[i].id] = faces[i + 1].id;
      behind[faces[i + 1].id] = faces[i].id;
    }
    i = end;
  }
  return behind;
}

}  // namespace strataflow
