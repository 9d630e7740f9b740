#include "kernels/quads/map/optimise_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/quads/map/carry_map.h"
#include "kernels/quads/map/integrate_field.h"

namespace strataflow {

namespace {

using Complex = std::complex<double>;

/// X nearest to a given map: least squares of its linear parts.
Result<std::vector<double>> fit(const MapReduction& reduction, const CornerMap& start, MapEnergy& energy,
                                double growth) {
  const auto at_zero = energy.linear_parts(std::vector<double>(reduction.unknowns, 0.0));
  const auto derivatives = parallel_map(
      at_zero.size(),
      [&](std::size_t t) {
        Complex p = at_zero[t].p, q = at_zero[t].q;
        for (std::size_t k = 0; k < 3; ++k) {
          const Complex u = turned(start.at(static_cast<std::uint32_t>(3 * t + k)), reduction.chart[t]);
          p -= energy.shapes()[t].slope[k] * u;
          q -= std::conj(energy.shapes()[t].slope[k]) * u;
        }
        LinearDerivatives d;
        d.gradient = {p.real(), p.imag(), q.real(), q.imag()};
        for (std::size_t i = 0; i < 4; ++i) d.hessian[5 * i] = 1;
        return d;
      },
      512);
  return fit_without_folds(derivatives, energy, 20, growth);
}

/// The feature nearest to a triangle, by steps from triangle to triangle.
std::string nearest_feature(const FeatureMesh& mesh, const FeatureLayout& layout, std::uint32_t triangle) {
  std::vector<std::uint8_t> seen(layout.triangle_count(), 0);
  std::vector<std::uint32_t> queue{triangle};
  seen[triangle] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (std::uint32_t h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
      if (layout.is_feature[h]) return name_feature(mesh, layout, h);
      const std::uint32_t g = layout.opposite[h];
      if (g == no_index || seen[g / 3]) continue;
      seen[g / 3] = 1;
      queue.push_back(g / 3);
    }
  return "no feature";
}

MapDefects map_defects(const FeatureMesh& mesh, const FeatureLayout& layout, const CornerMap& map) {
  MapDefects defects;
  const auto corners = static_cast<std::uint32_t>(3 * layout.triangle_count());
  const auto edge = [&](std::uint32_t h) { return map.at(next_half_edge(h)) - map.at(h); };
  double longest = 0;
  std::vector<double> angle(mesh.points.size(), 0.0);
  std::vector<std::uint8_t> is_free(mesh.points.size(), 0);
  for (std::uint32_t h = 0; h < corners; ++h) {
    const std::uint32_t g = layout.opposite[h], p = mesh.triangles[h / 3][h % 3];
    const Complex along = edge(h), back = -edge(previous_half_edge(h));
    longest = std::max(longest, std::abs(along));
    if (g != no_index) defects.seam = std::max(defects.seam, std::abs(along + turned(edge(g), map.turns[h])));
    if (map.axes[h] == MapAxis::real) defects.off_axis = std::max(defects.off_axis, std::abs(along.imag()));
    if (map.axes[h] == MapAxis::imaginary) defects.off_axis = std::max(defects.off_axis, std::abs(along.real()));
    if (h % 3 == 0) defects.flipped += !(along.real() * back.imag() - along.imag() * back.real() > 0);
    if (g == no_index && !layout.is_feature[h]) is_free[p] = is_free[mesh.triangles[h / 3][(h + 1) % 3]] = 1;
    angle[p] += std::atan2(along.real() * back.imag() - along.imag() * back.real(),
                           along.real() * back.real() + along.imag() * back.imag());
  }
  defects.seam /= longest;
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    if (!is_free[p] && !layout.nodes_of(static_cast<std::uint32_t>(p)).empty())
      if (!(std::abs(angle[p] - map.valence[p] * std::numbers::pi / 2) < 1e-6)) {
        if (defects.wrong_angles++ == 0) defects.first_wrong_point = static_cast<std::uint32_t>(p);
      }
  return defects;
}

/// A valid map from X, or why it is none.
Result<OptimisedMap> map_from(const FeatureMesh& mesh, const FeatureLayout& layout, const MapReduction& reduction,
                              const FrameField& field, MapEnergy& energy, Result<std::vector<double>> x,
                              const FoldoverFreeOptions& options, std::vector<std::uint32_t>* stuck) {
  if (!x) return x.failure();
  const Result<FoldoverFreeReport> done = make_foldover_free(energy, *x, options);
  if (!done) return done.failure();

  OptimisedMap result;
  result.report = {reduction.unknowns, reduction.cut_edges, *done};
  CornerMap& map = result.map;
  map.turns = field.turns;
  map.axes = field.axes;
  map.valence = field.valence;
  const std::size_t corners = 3 * layout.triangle_count();
  map.uv.resize(corners);
  const std::vector<double> v = reduction.scalars(*x);
  std::int64_t flipped = 0;
  std::uint32_t worst = done->worst_triangle;
  for (std::uint32_t t = 0; t < corners / 3; ++t) {
    std::array<Complex, 3> u;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t place = reduction.place_of[3 * t + k];
      u[k] = turned(std::complex<double>{v[2 * place], v[2 * place + 1]}, 4 - reduction.chart[t]);
      map.uv[3 * t + k] = {u[k].real(), u[k].imag()};
    }
    const Complex a = u[1] - u[0], b = u[2] - u[0];
    if (!(a.real() * b.imag() - a.imag() * b.real() > 0)) {
      if (flipped++ == 0) worst = t;
      if (stuck) stuck->push_back(t);
    }
  }
  if (flipped)
    return Failure{FailureCode::geometry_failed,
                   std::to_string(flipped) + " triangles of the map stay folded after " +
                       std::to_string(done->iterations) + " steps (" + done->stopped_by + "), one at " +
                       name_point(mesh, mesh.triangles[worst][0]) + " near " + nearest_feature(mesh, layout, worst),
                   "refine the triangles there, ask for smaller quads, or leave that feature out"};
  // Positive triangles may still wind around a point twice (coudert2024 R16).
  if (const MapDefects defects = map_defects(mesh, layout, map); defects.wrong_angles) {
    for (std::uint32_t h = 0; stuck && h < corners; ++h)
      if (mesh.triangles[h / 3][h % 3] == defects.first_wrong_point) stuck->push_back(h / 3);
    return Failure{FailureCode::geometry_failed,
                   "the map winds around " + name_point(mesh, defects.first_wrong_point) + " other than its valence " +
                       std::to_string(map.valence[defects.first_wrong_point]) + " says, and around " +
                       std::to_string(defects.wrong_angles - 1) + " other points",
                   "refine the triangles there, ask for smaller quads, or leave a feature out"};
  }
  return result;
}

}  // namespace

Result<OptimisedMap> optimise_map(const FeatureMesh& mesh, const FrameField& field,
                                  const std::vector<IntegerConstraint>& constraints, const CornerMap* start,
                                  const FoldoverFreeOptions& options, std::vector<std::uint32_t>* stuck) {
  const Result<FeatureLayout> layout = build_feature_layout(mesh);
  if (!layout) return layout.failure();
  const std::size_t corners = 3 * layout->triangle_count();
  if (field.angles.size() != layout->triangle_count() || field.valence.size() != mesh.points.size() ||
      (start && start->uv.size() != corners) || !(mesh.edge_length_m > 0))
    return Failure{FailureCode::invalid_input, "field, start or edge length do not fit the mesh",
                   "build the map from the field of the same mesh"};
  const Result<MapReduction> reduction = reduce_map(mesh, *layout, field.turns, field.axes, constraints, stuck);
  if (!reduction) return reduction.failure();
  Result<MapEnergy> energy = MapEnergy::build(*layout, *reduction, mesh.edge_length_m);
  if (!energy) return energy.failure();
  const auto finished = [&](Result<std::vector<double>> x) {
    // What the first start left folded is told.
    return map_from(mesh, *layout, *reduction, field, *energy, std::move(x), options,
                    stuck && stuck->empty() ? stuck : nullptr);
  };
  std::vector<Failure> failures;
  const auto is_over = [&](const Result<OptimisedMap>& map) {
    if (!map) failures.push_back(map.failure());
    return map || (options.is_cancelled && options.is_cancelled());
  };
  if (start)
    if (const auto scalars = develop_map(*layout, *reduction, *start)) {
      Result<OptimisedMap> map = finished(carry_map(*energy, *reduction, *scalars, 40, options));
      if (is_over(map) || !options.may_start_afresh) return map;
      failures.clear();
    }
  // From least squares whose folds are stiffened by a factor. A start that ends folded or wound leaves others.
  for (const double growth : start ? std::array{4.0, 10.0, 1.5} : std::array{3.0, 10.0, 2.0}) {
    Result<OptimisedMap> map = finished(start ? fit(*reduction, *start, *energy, growth)
                                              : integrate_field(*reduction, field, *energy, 30, growth));
    if (is_over(map)) return map;
  }
  return failures.front();
}

Result<MapDefects> measure_map(const FeatureMesh& mesh, const CornerMap& map) {
  const Result<FeatureLayout> layout = build_feature_layout(mesh);
  if (!layout) return layout.failure();
  const std::size_t corners = 3 * layout->triangle_count();
  if (map.uv.size() != corners || map.turns.size() != corners || map.axes.size() != corners ||
      map.valence.size() != mesh.points.size())
    return Failure{FailureCode::invalid_input, "the map does not fit the mesh",
                   "measure it on the mesh it was built on"};
  return map_defects(mesh, *layout, map);
}

}  // namespace strataflow
