#pragma once
#include <cstddef>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Leaves only the triangles marked, one mark per triangle, in their order. Points stay.
inline void keep_triangles(TriangleSoup& soup, const std::vector<char>& is_kept) {
  std::size_t next = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (!is_kept[t]) continue;
    soup.triangles[next] = soup.triangles[t];
    soup.triangle_patch[next++] = soup.triangle_patch[t];
  }
  soup.triangles.resize(next);
  soup.triangle_patch.resize(next);
}

}  // namespace strataflow
