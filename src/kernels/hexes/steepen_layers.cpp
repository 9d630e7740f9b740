#include "kernels/hexes/steepen_layers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/conjugate_gradients.h"
#include "kernels/hexes/upright_system.h"

namespace strataflow {
namespace {

constexpr double least_share = 0.05;  // of a unit's mean slope: how steep W is to be everywhere
constexpr double most_pushed = 100;   // times that: where nothing helps, neighbours must not suffer
constexpr double stiffness = 30;      // of the penalty, beside the energy's 1

/// What the rise of W in one tetrahedron is made of: Σ rise[k] · W of corner k, per metre.
struct TetRise {
  std::array<double, 4> rise;
  double least = 0;  ///< wanted
  bool is_free = false, can_rise = false;
};

/// Per unit, a share of its layers over its mean thickness.
std::vector<double> least_rises(const LabelledTets& tets, const StratigraphicLevels& levels,
                                const StratigraphicTets& layers, const std::vector<TetGradients>& gradients) {
  double area = 0;
  for (const SheetFacet& facet : tets.facets) {
    const auto& [a, b, c] = facet.vertices;
    if (facet.kind == SheetKind::top)
      area += 0.5 * std::abs(cross(tets.points[b] - tets.points[a], tets.points[c] - tets.points[a]).z);
  }
  std::vector<double> volume(levels.unit_count(), 0);
  for (std::uint32_t t = 0; t < layers.model_tets; ++t) volume[levels.unit[t]] += gradients[t].volume_m3;
  for (std::uint32_t unit = 0; unit < volume.size(); ++unit)
    volume[unit] = least_share * (layers.level_w[unit + 1] - layers.level_w[unit]) * area / volume[unit];
  return volume;
}

}  // namespace

Result<std::size_t> steepen_layers(const LabelledTets& tets, const StratigraphicLevels& levels,
                                   const std::vector<Vec3>& plan, StratigraphicTets& layers, std::size_t rounds) {
  std::vector<std::uint32_t> unknown(layers.point.size(), 0);
  for (std::uint32_t t = 0; t < layers.model_tets; ++t)
    for (const std::uint32_t c : layers.tets[t])
      if (layers.w[c] == layers.level_w[levels.unit[t]] || layers.w[c] == layers.level_w[levels.unit[t] + 1])
        unknown[c] = no_index;
  for (std::size_t t = layers.model_tets; t < layers.tets.size(); ++t)
    for (const std::uint32_t c : layers.tets[t]) unknown[c] = no_index;
  std::uint32_t count = 0;
  for (std::uint32_t& number : unknown)
    if (number != no_index) number = count++;
  if (count == 0) return std::size_t{0};

  const std::vector<TetGradients> gradients = tet_gradients(tets);
  const std::vector<double> least = least_rises(tets, levels, layers, gradients);
  const std::vector<TetRise> rises = parallel_map(
      layers.model_tets,
      [&](std::size_t t) {
        TetRise tet;
        double most = 0;  // the steepest it can get between its levels
        for (std::uint32_t k = 0; k < 4; ++k) {
          const auto [a, b, c] = face_vertices(tets.tets[t], k);
          // Raising corner k by one adds twice the area that the face opposite to it has in the plan.
          tet.rise[k] = -cross(plan[b] - plan[a], plan[c] - plan[a]).z / (6 * gradients[t].volume_m3);
          const std::uint32_t copy = layers.tets[t][k], unit = levels.unit[t];
          const bool is_raised = tet.rise[k] > 0;
          most += tet.rise[k] * (unknown[copy] == no_index ? layers.w[copy] : layers.level_w[is_raised ? unit + 1 : unit]);
          tet.is_free = tet.is_free || unknown[copy] != no_index;
        }
        tet.least = std::min(least[levels.unit[t]], 0.5 * most);
        tet.can_rise = tet.is_free && most > 0;
        return tet;
      },
      1024);
  const auto rise_of = [&](std::size_t t, const std::vector<double>& w) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += rises[t].rise[k] * w[layers.tets[t][k]];
    return sum;
  };
  const auto falling_m3 = [&](const std::vector<double>& w) {
    double sum = 0;
    for (std::uint32_t t = 0; t < layers.model_tets; ++t)
      if (rises[t].is_free && !(rise_of(t, w) > 0)) sum += gradients[t].volume_m3;
    return sum;
  };

  std::vector<double> multiplier(layers.model_tets, 0), w = layers.w;
  double best = falling_m3(w);
  std::size_t solves = 0;
  for (std::size_t since_best = 0; best > 0 && solves < rounds && since_best < 12; ++solves, ++since_best) {
    std::vector<MatrixEntry> matrix;
    std::vector<double> right(count, 0);
    for (std::uint32_t t = 0; t < layers.model_tets; ++t) {
      if (!rises[t].is_free) continue;
      const double volume = gradients[t].volume_m3, wanted = rises[t].least + multiplier[t];
      const bool is_pushed = rises[t].can_rise && rise_of(t, w) < wanted;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t row = unknown[layers.tets[t][i]];
        if (row == no_index) continue;
        if (is_pushed) right[row] += stiffness * volume * wanted * rises[t].rise[i];
        for (std::size_t j = 0; j < 4; ++j) {
          double value = volume * dot(gradients[t].gradient[i], gradients[t].gradient[j]);
          if (is_pushed) value += stiffness * volume * rises[t].rise[i] * rises[t].rise[j];
          const std::uint32_t column = unknown[layers.tets[t][j]];
          if (column == no_index)
            right[row] -= value * layers.w[layers.tets[t][j]];
          else if (row >= column)
            matrix.push_back({row, column, value});
        }
      }
    }
    const auto solved = solve_symmetric(count, matrix, {right});
    if (!solved) return solved.failure();
    for (std::uint32_t c = 0; c < unknown.size(); ++c)
      if (unknown[c] != no_index) w[c] = solved->front()[unknown[c]];
    for (std::uint32_t t = 0; solves % 2 == 1 && t < layers.model_tets; ++t)  // the active set settles first
      if (rises[t].can_rise)
        multiplier[t] = std::clamp(multiplier[t] + rises[t].least - rise_of(t, w), 0.0, most_pushed * rises[t].least);
    const double falling = falling_m3(w);
    if (falling < best) {
      best = falling;
      layers.w = w;
      since_best = 0;
    }
  }
  return solves;
}

}  // namespace strataflow
