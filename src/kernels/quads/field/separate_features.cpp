#include "kernels/quads/field/separate_features.h"

#include <array>

#include "base/id.h"
#include "kernels/quads/field/feature_layout.h"

namespace strataflow {

Result<FeatureMesh> separate_features(const FeatureMesh& mesh) {
  const Result<FeatureLayout> layout = build_feature_layout(mesh);
  if (!layout) return layout.failure();
  FeatureMesh out = mesh;
  const auto half_edges = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  std::vector<std::uint8_t> on_feature(mesh.points.size(), 0);
  for (const FeatureEdge& edge : mesh.edges) on_feature[edge.a] = on_feature[edge.b] = 1;
  const auto origin = [&](std::uint32_t h) { return mesh.triangles[h / 3][h % 3]; };
  const auto add_point = [&](const Vec3& at) {
    out.points.push_back(at);
    return static_cast<std::uint32_t>(out.points.size() - 1);
  };

  std::vector<std::uint32_t> middle(half_edges, no_index);
  std::size_t split = 0, filled = 0;
  for (std::uint32_t h = 0; h < half_edges; ++h) {
    const std::uint32_t other = layout->opposite[h], a = origin(h), b = origin(next_half_edge(h));
    if (other == no_index || other < h || layout->is_feature[h] || !on_feature[a] || !on_feature[b]) continue;
    middle[h] = middle[other] = add_point(0.5 * (mesh.points[a] + mesh.points[b]));
    ++split;
  }
  out.triangles.clear();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangles[t];
    const std::uint32_t h = 3 * t;
    const std::array<std::uint32_t, 3> m{middle[h], middle[h + 1], middle[h + 2]};
    const int count = (m[0] != no_index) + (m[1] != no_index) + (m[2] != no_index);
    if (count == 0) {
      if (layout->is_feature[h] && layout->is_feature[h + 1] && layout->is_feature[h + 2]) {
        const std::uint32_t c = add_point(1.0 / 3 * (mesh.points[tri[0]] + mesh.points[tri[1]] + mesh.points[tri[2]]));
        for (std::size_t k = 0; k < 3; ++k) out.triangles.push_back({tri[k], tri[(k + 1) % 3], c});
        ++filled;
      } else {
        out.triangles.push_back(tri);
      }
    } else if (count == 3) {
      for (std::size_t k = 0; k < 3; ++k) out.triangles.push_back({tri[k], m[k], m[(k + 2) % 3]});
      out.triangles.push_back({m[0], m[1], m[2]});
    } else {
      // Turn so that side 0 is split and, of two, side 2 is the other.
      std::size_t k = 0;
      while (m[k] == no_index || (count == 2 && m[(k + 2) % 3] == no_index)) ++k;
      const std::uint32_t a = tri[k], b = tri[(k + 1) % 3], c = tri[(k + 2) % 3], ab = m[k], ca = m[(k + 2) % 3];
      if (count == 1) {
        out.triangles.push_back({a, ab, c});
        out.triangles.push_back({ab, b, c});
      } else {
        out.triangles.push_back({a, ab, ca});
        // The shorter diagonal of the rest.
        const bool from_b = length(out.points[ca] - out.points[b]) <= length(out.points[ab] - out.points[c]);
        out.triangles.push_back(from_b ? Triangle{ab, b, ca} : Triangle{ab, b, c});
        out.triangles.push_back(from_b ? Triangle{b, c, ca} : Triangle{ab, c, ca});
      }
    }
  }
  if (split + filled)
    out.changes.push_back({"refined", std::to_string(split) + " edges and " + std::to_string(filled) + " triangles",
                           "they reached from feature to feature"});
  return out;
}

}  // namespace strataflow
