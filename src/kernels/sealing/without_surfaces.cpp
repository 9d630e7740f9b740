#include "kernels/sealing/without_surfaces.h"

#include <algorithm>

#include "kernels/topology/building/weld_points.h"
#include "kernels/topology/keep_triangles.h"

namespace strataflow {

double area_m2(const StructuralModel& model, const Surface& surface) {
  double area = 0;
  for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
    const Triangle& v = model.triangles[t];
    area += 0.5 * length(cross(model.points[v[1]] - model.points[v[0]], model.points[v[2]] - model.points[v[0]]));
  }
  return area;
}

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
  std::vector<char> is_kept(soup.triangles.size());
  for (std::size_t t = 0; t < is_kept.size(); ++t)
    is_kept[t] = !std::binary_search(doomed.begin(), doomed.end(), key_of(soup.triangles[t], model.points.size()));
  TriangleSoup rest = soup;
  keep_triangles(rest, is_kept);
  return rest;
}

}  // namespace strataflow
