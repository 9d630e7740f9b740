#include "kernels/sealing/without_surfaces.h"

#include <algorithm>

#include "kernels/topology/weld_points.h"

namespace strataflow {

TriangleSoup without_surfaces(const TriangleSoup& soup, const StructuralModel& model,
                              const std::vector<std::uint32_t>& surfaces) {
  std::vector<Vec3> positions = model.points;
  positions.insert(positions.end(), soup.points.begin(), soup.points.end());
  const WeldedPoints welded = weld_points(positions);
  const auto key_of = [&](Triangle t, std::size_t shift) {
    for (std::uint32_t& v : t) v = welded.id[v + shift];
    std::sort(t.begin(), t.end());
    return t;
  };
  std::vector<Triangle> doomed;
  for (const std::uint32_t s : surfaces)
    for (std::uint32_t t = model.surfaces[s].first_triangle; t < model.surfaces[s].end_triangle; ++t)
      doomed.push_back(key_of(model.triangles[t], 0));
  std::sort(doomed.begin(), doomed.end());
  TriangleSoup rest = soup;
  std::size_t next = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (std::binary_search(doomed.begin(), doomed.end(), key_of(soup.triangles[t], model.points.size()))) continue;
    rest.triangles[next] = soup.triangles[t];
    rest.triangle_patch[next++] = soup.triangle_patch[t];
  }
  rest.triangles.resize(next);
  rest.triangle_patch.resize(next);
  return rest;
}

}  // namespace strataflow
