#include "kernels/quads/field/smooth_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/id.h"
#include "kernels/quads/field/compartment_system.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {

Result<std::vector<std::array<double, 2>>> smooth_frames(const FeatureMesh& mesh, const FeatureLayout& layout,
                                                         const std::vector<double>& angle,
                                                         const std::vector<double>& alpha,
                                                         const FieldTopology& topology, double orthogonality) {
  constexpr double pi = std::numbers::pi;
  const auto count = static_cast<std::uint32_t>(layout.triangle_count());
  // Unknown 2 t + i: how far direction i turns away from alpha + i π/2; the fixed ones of features are known.
  std::vector<double> turn(2 * count, 0.0);
  std::vector<std::uint32_t> unknown(2 * count, no_index);
  std::vector<std::int8_t> fixed(count, -1);
  std::uint32_t unknowns = 0;
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t h = 3 * t; h < 3 * t + 3 && fixed[t] < 0; ++h) {
      const int label = topology.label[h];
      if (label < 0) continue;
      fixed[t] = label % 2 ? 0 : 1;
      const double straight = half_edge_direction(angle, h);
      turn[2 * t + static_cast<std::uint32_t>(fixed[t])] =
          half_edge_direction(layout.angle, h) - straight +
          std::remainder(straight - label * (pi / 2) - alpha[t], 2 * pi);
    }
    for (std::uint32_t i = 0; i < 2; ++i)
      if (fixed[t] != static_cast<int>(i)) unknown[2 * t + i] = unknowns++;
  }

  struct Link {
    std::uint32_t ours = 0, theirs = 0;
    double weight = 0, ahead = 0;
  };
  std::vector<Link> links;
  links.reserve(3 * count);
  PatternBuilder builder(unknowns);
  const auto add = [&](const Link& link) {
    links.push_back(link);
    if (unknown[link.ours] != no_index && unknown[link.theirs] != no_index)
      builder.add(unknown[link.ours], unknown[link.theirs]);
  };
  for (std::uint32_t h = 0; h < 3 * count; ++h) {
    const std::uint32_t g = layout.opposite[h];
    if (g == no_index || g < h || layout.is_feature[h]) continue;
    const double ratio = 3 * layout.length_m[h] * layout.length_m[h] / (layout.area_m2[h / 3] + layout.area_m2[g / 3]);
    const double carry = half_edge_direction(layout.angle, h) - half_edge_direction(layout.angle, g) -
                         half_edge_direction(angle, h) + half_edge_direction(angle, g);
    for (std::uint32_t i = 0; i < 2; ++i)
      add({2 * (h / 3) + i, 2 * (g / 3) + (i + topology.turns[h]) % 2, std::clamp(ratio, 0.05, 20.0),
           topology.residual[h] + carry});
  }
  const double quad_m = mesh.edge_length_m > 0 ? mesh.edge_length_m : 2 * layout.length_m[0];
  for (std::uint32_t t = 0; t < count; ++t)
    add({2 * t, 2 * t + 1, orthogonality * layout.area_m2[t] / (quad_m * quad_m), 0});
  std::vector<std::uint32_t> starts, rows, slots;
  builder.finish(starts, rows, slots);
  std::vector<double> values(rows.size(), 0.0), right(unknowns, 0.0);
  std::size_t slot = 0;
  for (const Link& link : links) {
    // weight (ahead + theirs − ours)²
    const std::uint32_t i = unknown[link.ours], j = unknown[link.theirs];
    if (i != no_index) {
      values[starts[i]] += link.weight;
      right[i] += link.weight * (link.ahead + (j == no_index ? turn[link.theirs] : 0.0));
    }
    if (j != no_index) {
      values[starts[j]] += link.weight;
      right[j] -= link.weight * (link.ahead - (i == no_index ? turn[link.ours] : 0.0));
    }
    if (i != no_index && j != no_index) values[slots[slot++]] -= link.weight;
  }
  for (std::uint32_t i = 0; i < unknowns; ++i) values[starts[i]] += 1e-9;
  auto system = CompartmentSystem<double>::analyse(starts, rows);
  if (!system) return system.failure();
  if (auto factorized = system->factorize(values); !factorized) return factorized.failure();
  const std::vector<double> x = system->solve(right);

  std::vector<std::array<double, 2>> frames(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      if (unknown[2 * t + i] != no_index) turn[2 * t + i] = x[unknown[2 * t + i]];
      frames[t][i] = alpha[t] + i * (pi / 2) + turn[2 * t + i];
    }
    auto& [a, b] = frames[t];
    if (b - a > 0.05 && b - a < pi - 0.05) continue;
    if (fixed[t] == 0)
      b = a + pi / 2;
    else if (fixed[t] == 1)
      a = b - pi / 2;
    else
      a = (a + b) / 2 - pi / 4, b = a + pi / 2;
  }
  return frames;
}

}  // namespace strataflow
