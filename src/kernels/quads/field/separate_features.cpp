#include "kernels/quads/field/separate_features.h"

#include <array>
#include <cstdlib>

#include "base/id.h"
#include "kernels/quads/field/corner_quads.h"
#include "kernels/quads/field/feature_layout.h"

namespace strataflow {

namespace {

/// Halves the marked edges (one half-edge of each is enough) and fills the marked triangles, of which no edge may be
/// marked.
FeatureMesh split_mesh(const FeatureMesh& mesh, const FeatureLayout& layout, const std::vector<std::uint8_t>& is_halved,
                       const std::vector<std::uint8_t>& is_filled) {
  FeatureMesh out = mesh;
  const auto origin = [&](std::uint32_t h) { return mesh.triangles[h / 3][h % 3]; };
  const auto add_point = [&](const Vec3& at) {
    out.points.push_back(at);
    return static_cast<std::uint32_t>(out.points.size() - 1);
  };
  std::vector<std::uint32_t> middle(is_halved.size(), no_index);
  for (std::uint32_t h = 0; h < is_halved.size(); ++h)
    if (is_halved[h])
      middle[h] = middle[layout.opposite[h]] =
          add_point(0.5 * (mesh.points[origin(h)] + mesh.points[origin(next_half_edge(h))]));
  out.triangles.clear();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangles[t];
    const std::uint32_t h = 3 * t;
    const std::array<std::uint32_t, 3> m{middle[h], middle[h + 1], middle[h + 2]};
    const int count = (m[0] != no_index) + (m[1] != no_index) + (m[2] != no_index);
    if (is_filled[t]) {
      const std::uint32_t c = add_point(1.0 / 3 * (mesh.points[tri[0]] + mesh.points[tri[1]] + mesh.points[tri[2]]));
      for (std::size_t k = 0; k < 3; ++k) out.triangles.push_back({tri[k], tri[(k + 1) % 3], c});
    } else if (count == 0) {
      out.triangles.push_back(tri);
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
  return out;
}

/// Per compartment: whether it has too few points inside for the singular points that its outline asks for, by
/// Σ (4 − valence) inside + Σ (2 − quads) along the outline = 4 χ. Every second point inside stays regular.
std::vector<std::uint8_t> crowded_compartments(const FeatureMesh& mesh, const FeatureLayout& layout) {
  const std::vector<std::uint8_t> quads = choose_corner_quads(mesh, layout);
  std::vector<std::int64_t> asked(layout.compartment_count, 0), inside(layout.compartment_count, 0);
  std::vector<std::uint8_t> is_open(layout.compartment_count, 0), is_crowded(layout.compartment_count, 0);
  for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
    const std::uint32_t c = layout.compartment[layout.corners_of(n)[0] / 3];
    asked[c] += 4;
    if (layout.node_kind[n] == NodeKind::sector) asked[c] -= 2 - quads[n];
    inside[c] += layout.node_kind[n] == NodeKind::inside;
    is_open[c] |= layout.node_kind[n] == NodeKind::open;
  }
  for (std::uint32_t h = 0; h < layout.opposite.size(); ++h) {
    const std::uint32_t g = layout.opposite[h];
    if (g == no_index || layout.is_feature[h] || h < g) asked[layout.compartment[h / 3]] -= 4;
  }
  for (const std::uint32_t c : layout.compartment) asked[c] += 4;
  for (std::uint32_t c = 0; c < layout.compartment_count; ++c)
    is_crowded[c] = !is_open[c] && inside[c] < 2 * std::abs(asked[c]) - 1;
  return is_crowded;
}

}  // namespace

Result<FeatureMesh> separate_features(const FeatureMesh& mesh) {
  FeatureMesh out = mesh;
  std::vector<std::uint8_t> on_feature;
  std::size_t halved = 0, filled = 0;
  constexpr int most_rounds = 6;  // each has four times the points inside
  for (int round = 0; round < most_rounds; ++round) {
    const Result<FeatureLayout> layout = build_feature_layout(out);
    if (!layout) return layout.failure();
    on_feature.resize(out.points.size(), 0);
    for (const FeatureEdge& edge : out.edges) on_feature[edge.a] = on_feature[edge.b] = 1;
    const std::vector<std::uint8_t> is_crowded =
        round > 0 ? crowded_compartments(out, *layout) : std::vector<std::uint8_t>(layout->compartment_count, 0);
    std::vector<std::uint8_t> is_halved(layout->opposite.size(), 0), is_filled(out.triangles.size(), 0);
    bool any = false;
    for (std::uint32_t h = 0; h < is_halved.size(); ++h) {
      const std::uint32_t g = layout->opposite[h];
      if (g == no_index || g < h || layout->is_feature[h]) continue;
      const bool joins_features = on_feature[out.triangles[h / 3][h % 3]] && on_feature[out.triangles[h / 3][(h + 1) % 3]];
      is_halved[h] = joins_features || is_crowded[layout->compartment[h / 3]];
      halved += is_halved[h];
      any |= is_halved[h] != 0;
    }
    for (std::uint32_t t = 0; t < is_filled.size(); ++t) {
      is_filled[t] = layout->is_feature[3 * t] && layout->is_feature[3 * t + 1] && layout->is_feature[3 * t + 2];
      filled += is_filled[t];
      any |= is_filled[t] != 0;
    }
    if (any) out = split_mesh(out, *layout, is_halved, is_filled);
    if (!any && round > 0) break;
  }
  if (halved + filled > 0)
    out.changes.push_back({"refined", std::to_string(halved) + " edges and " + std::to_string(filled) + " triangles",
                           "they reached from feature to feature, or singular points had no room"});
  return out;
}

}  // namespace strataflow
