#include "kernels/quads/extraction/subdivide_mesh.h"

#include <algorithm>

#include "kernels/topology/building/edge_table.h"

namespace strataflow {

QuadMesh subdivide_mesh(const FeatureMesh& mesh) {
  QuadMesh quads;
  quads.local_origin = mesh.local_origin;
  quads.features = mesh.features;
  quads.changes = mesh.changes;
  quads.changes.push_back({"subdivided", "all triangles", "the fallback was used: irregular points everywhere"});
  quads.points = mesh.points;
  quads.corner_points = mesh.corners;
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  const auto first_middle = static_cast<std::uint32_t>(quads.points.size());
  for (const auto& [a, b] : table.edges) quads.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    const auto centre = static_cast<std::uint32_t>(quads.points.size());
    quads.points.push_back((1.0 / 3) * (mesh.points[c[0]] + mesh.points[c[1]] + mesh.points[c[2]]));
    for (std::uint32_t k = 0; k < 3; ++k)
      quads.quads.push_back(
          {c[k], first_middle + table.edge_of[3 * t + k], centre, first_middle + table.edge_of[3 * t + (k + 2) % 3]});
  }
  for (const FeatureEdge& e : mesh.edges) {
    const std::uint32_t middle = first_middle + find_edge(table, e.a, e.b);
    quads.edges.push_back({e.a, middle, e.feature});
    quads.edges.push_back({e.b, middle, e.feature});
  }
  std::sort(quads.edges.begin(), quads.edges.end());
  return quads;
}

}  // namespace strataflow
