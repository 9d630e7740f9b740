#include "kernels/quads/field/cross_field.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/id.h"
#include "kernels/quads/field/compartment_system.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {

Result<std::vector<double>> smooth_cross_field(const FeatureMesh& mesh, const FeatureLayout& layout,
                                               const std::vector<double>& angle, const CrossFieldOptions& options) {
  using Complex = std::complex<double>;
  const auto count = static_cast<std::uint32_t>(layout.triangle_count());
  std::vector<double> alpha(count, 0.0);
  std::vector<Complex> z(count, 0.0);
  std::vector<std::uint32_t> unknown(count, no_index), feature_edge(count, no_index);
  std::vector<std::uint8_t> has_feature(layout.compartment_count, 0);
  std::uint32_t unknowns = 0;
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t h = 3 * t + 3; h-- > 3 * t;)
      if (layout.is_feature[h]) feature_edge[t] = h;
    if (feature_edge[t] == no_index) {
      unknown[t] = unknowns++;
      continue;
    }
    has_feature[layout.compartment[t]] = 1;
    alpha[t] = half_edge_direction(angle, feature_edge[t]);
    z[t] = std::polar(1.0, 4 * alpha[t]);
  }
  if (unknowns == 0) return alpha;

  // Σ w |z − R z'|² over edges that are no feature, + Σ A / τ |z − z_before|².
  PatternBuilder builder(unknowns);
  struct Link {
    std::uint32_t h = 0;
    double weight = 0;
    Complex turn;  ///< takes the opposite triangle's z into ours
  };
  std::vector<Link> links;
  for (std::uint32_t h = 0; h < 3 * count; ++h) {
    const std::uint32_t g = layout.opposite[h];
    if (g == no_index || g < h || layout.is_feature[h]) continue;
    const double ratio = 3 * layout.length_m[h] * layout.length_m[h] / (layout.area_m2[h / 3] + layout.area_m2[g / 3]);
    links.push_back({h, std::clamp(ratio, 0.05, 20.0),
                     std::polar(1.0, 4 * (half_edge_direction(angle, h) - half_edge_direction(angle, g)))});
    const std::uint32_t i = unknown[h / 3], j = unknown[g / 3];
    if (i != no_index && j != no_index) builder.add(i, j);
  }
  std::vector<std::uint32_t> starts, rows, slots;
  builder.finish(starts, rows, slots);
  const double quad_m = mesh.edge_length_m > 0 ? mesh.edge_length_m : 2 * layout.length_m[0];
  const double rate = 1.0 / (options.time_ratio * options.time_ratio * quad_m * quad_m);
  std::vector<Complex> values(rows.size(), 0.0), fixed(unknowns, 0.0), right(unknowns);
  std::size_t slot = 0;
  for (const Link& link : links) {
    const std::uint32_t t = link.h / 3, s = layout.opposite[link.h] / 3, i = unknown[t], j = unknown[s];
    if (i != no_index) values[starts[i]] += link.weight;
    if (j != no_index) values[starts[j]] += link.weight;
    if (i != no_index && j != no_index)
      values[slots[slot++]] -= link.weight * (i > j ? link.turn : std::conj(link.turn));
    else if (i != no_index)
      fixed[i] += link.weight * link.turn * z[s];
    else if (j != no_index)
      fixed[j] += link.weight * std::conj(link.turn) * z[t];
  }
  for (std::uint32_t t = 0; t < count; ++t) {
    if (unknown[t] == no_index) continue;
    values[starts[unknown[t]]] += rate * layout.area_m2[t];
    // Without any feature nothing drives the field: it starts along the edges and diffuses.
    if (!has_feature[layout.compartment[t]]) z[t] = 1.0;
  }
  auto system = CompartmentSystem<Complex>::analyse(starts, rows);
  if (!system) return system.failure();
  if (auto factorized = system->factorize(values); !factorized) return factorized.failure();
  for (std::int64_t step = 0; step <= options.diffusions; ++step) {
    for (std::uint32_t t = 0; t < count; ++t)
      if (unknown[t] != no_index) right[unknown[t]] = fixed[unknown[t]] + rate * layout.area_m2[t] * z[t];
    const std::vector<Complex> smooth = system->solve(right);
    for (std::uint32_t t = 0; t < count; ++t) {
      if (unknown[t] == no_index) continue;
      const Complex next = smooth[unknown[t]];
      const double size = std::abs(next);
      if (size > 1e-200) z[t] = next / size;
    }
  }
  for (std::uint32_t t = 0; t < count; ++t)
    if (unknown[t] != no_index) alpha[t] = std::arg(z[t]) / 4;
  return alpha;
}

}  // namespace strataflow
