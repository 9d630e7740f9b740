#include "kernels/quads/map/map_energy.h"

#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {

using Complex = std::complex<double>;
constexpr std::size_t grain = 512;

/// Scalar i of a triangle (2·corner + axis) → its number in the reduction.
std::uint32_t scalar(const MapReduction& reduction, std::uint32_t t, std::uint32_t i) {
  return 2 * reduction.place_of[3 * t + i / 2] + i % 2;
}

/// d(Re p, Im p, Re q, Im q) / d(scalar i).
std::array<double, 4> column(const TriangleFrame& shape, std::uint32_t i) {
  const Complex c = shape.slope[i / 2];
  return i % 2 == 0 ? std::array{c.real(), c.imag(), c.real(), -c.imag()}
                    : std::array{-c.imag(), c.real(), c.imag(), c.real()};
}

}  // namespace

std::vector<TriangleFrame> triangle_shapes(const FeatureLayout& layout, double quad_m) {
  return parallel_map(
      layout.triangle_count(),
      [&](std::size_t t) {
        const std::size_t h = 3 * t;
        const std::array<Complex, 3> z{0.0, layout.length_m[h] / quad_m,
                                       std::polar(layout.length_m[h + 2] / quad_m, layout.angle[h])};
        TriangleFrame shape;
        shape.area = layout.area_m2[t] / (quad_m * quad_m);
        for (std::size_t k = 0; k < 3; ++k) {
          const Complex facing = z[(k + 2) % 3] - z[(k + 1) % 3];
          shape.slope[k] = Complex(0, -1) * std::conj(facing) / (4 * shape.area);
        }
        return shape;
      },
      grain);
}

Result<MapEnergy> MapEnergy::build(const FeatureLayout& layout, const MapReduction& reduction, double quad_m) {
  MapEnergy energy;
  energy.layout_ = &layout;
  energy.reduction_ = &reduction;
  energy.shapes_ = triangle_shapes(layout, quad_m);
  const auto count = static_cast<std::uint32_t>(layout.triangle_count());
  PatternBuilder builder(reduction.unknowns);
  energy.scatter_first_ = {0};
  energy.scatter_first_.reserve(21 * count + 1);
  energy.scatter_coefficient_.reserve(21 * count);
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::uint32_t i = 0; i < 6; ++i) {
      const std::uint32_t si = scalar(reduction, t, i);
      for (std::uint32_t j = 0; j <= i; ++j) {
        const std::uint32_t sj = scalar(reduction, t, j);
        // H(a, b) += c_a c_b h_ij for the pair in both orders; the lower triangle keeps one of (a, b), (b, a).
        for (std::uint32_t a = reduction.first[si]; a < reduction.first[si + 1]; ++a)
          for (std::uint32_t b = reduction.first[sj]; b < reduction.first[sj + 1]; ++b) {
            const auto& ea = reduction.entries[a];
            const auto& eb = reduction.entries[b];
            const double twice = i != j && ea.unknown == eb.unknown ? 2.0 : 1.0;
            if (i == j && ea.unknown < eb.unknown) continue;
            builder.add(ea.unknown, eb.unknown);
            energy.scatter_coefficient_.push_back(twice * ea.coefficient * eb.coefficient);
          }
        energy.scatter_first_.push_back(static_cast<std::uint32_t>(energy.scatter_coefficient_.size()));
      }
    }
  std::vector<std::uint32_t> starts, rows;
  builder.finish(starts, rows, energy.scatter_slot_);
  energy.diagonal_.assign(starts.begin(), starts.end() - 1);
  energy.value_count_ = rows.size();
  auto system = PatternSystem<double>::analyse(std::move(starts), std::move(rows));
  if (!system) return system.failure();
  energy.system_ = std::make_unique<PatternSystem<double>>(std::move(*system));
  return energy;
}

std::vector<LinearPart> MapEnergy::parts_of(const std::vector<double>& v) const {
  return parallel_map(
      shapes_.size(),
      [&](std::size_t t) {
        LinearPart part;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t place = reduction_->place_of[3 * t + k];
          const Complex u(v[2 * place], v[2 * place + 1]);
          part.p += shapes_[t].slope[k] * u;
          part.q += std::conj(shapes_[t].slope[k]) * u;
        }
        return part;
      },
      grain);
}

std::vector<double> MapEnergy::gradient(const std::vector<LinearDerivatives>& triangles) const {
  std::vector<double> by_scalar(reduction_->constant.size(), 0.0), by_unknown(reduction_->unknowns, 0.0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 6; ++i) {
      const auto c = column(shapes_[t], i);
      const auto& g = triangles[t].gradient;
      by_scalar[scalar(*reduction_, t, i)] += shapes_[t].area * (c[0] * g[0] + c[1] * g[1] + c[2] * g[2] + c[3] * g[3]);
    }
  for (std::size_t s = 0; s < by_scalar.size(); ++s)
    for (std::uint32_t e = reduction_->first[s]; e < reduction_->first[s + 1]; ++e)
      by_unknown[reduction_->entries[e].unknown] += reduction_->entries[e].coefficient * by_scalar[s];
  return by_unknown;
}

Result<void> MapEnergy::factorize(const std::vector<LinearDerivatives>& triangles, double shift) {
  const auto local = parallel_map(
      triangles.size(),
      [&](std::size_t t) {
        std::array<double, 21> pairs{};
        const auto& h = triangles[t].hessian;
        std::array<std::array<double, 4>, 6> columns{}, weighed{};
        for (std::uint32_t i = 0; i < 6; ++i) {
          columns[i] = column(shapes_[t], i);
          for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t c = 0; c < 4; ++c) weighed[i][r] += shapes_[t].area * h[4 * r + c] * columns[i][c];
        }
        std::size_t pair = 0;
        for (std::size_t i = 0; i < 6; ++i)
          for (std::size_t j = 0; j <= i; ++j, ++pair)
            for (std::size_t r = 0; r < 4; ++r) pairs[pair] += columns[i][r] * weighed[j][r];
        return pairs;
      },
      grain);
  std::vector<double> values(value_count_, 0.0);
  for (std::size_t t = 0; t < local.size(); ++t)
    for (std::size_t pair = 0; pair < 21; ++pair)
      for (std::uint32_t e = scatter_first_[21 * t + pair]; e < scatter_first_[21 * t + pair + 1]; ++e)
        values[scatter_slot_[e]] += scatter_coefficient_[e] * local[t][pair];
  for (const std::uint32_t d : diagonal_) values[d] += shift;
  return system_->factorize(values);
}

}  // namespace strataflow
