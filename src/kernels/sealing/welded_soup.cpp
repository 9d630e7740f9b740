#include "kernels/sealing/welded_soup.h"

#include "kernels/topology/building/weld_points.h"

namespace strataflow {

WeldedSoup::WeldedSoup(const TriangleSoup& soup) {
  WeldedPoints welded = weld_points(soup.points);
  id = std::move(welded.id);
  points.reserve(welded.source.size());
  for (const std::uint32_t s : welded.source) points.push_back(soup.points[s]);
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    Triangle v = soup.triangles[t];
    for (std::uint32_t& corner : v) corner = id[corner];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    triangles.push_back(v);
    entity.push_back(soup.patch_entity[soup.triangle_patch[t]]);
    origin.push_back(t);
  }
}

}  // namespace strataflow
