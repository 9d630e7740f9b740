#include "kernels/quads/quantization/quantize_map.h"

#include <algorithm>
#include <cmath>

#include "kernels/quads/quantization/close_vectors.h"
#include "kernels/quads/quantization/round_map.h"

namespace strataflow {
namespace {

constexpr std::uint32_t outside = FlatMesh::outside;

/// Asks for `rows` across the half-edge, in the part of its vector where `across` (real or imaginary) lies.
void set_rows(const FlatMesh& mesh, VectorTargets& targets, std::uint32_t h, bool across_imaginary, std::int64_t rows) {
  const auto set = [&](std::uint32_t g, bool imaginary, std::int64_t sign_of) {
    const std::uint8_t bit = imaginary ? fixed_imaginary : fixed_real;
    if (targets.goals[g] & bit) return;
    const std::int64_t value = sign_of < 0 ? -rows : rows;
    targets.goals[g] |= bit;
    (imaginary ? targets.goal[g].im : targets.goal[g].re) = value;
    if (imaginary)
      targets.wanted[g].imag(static_cast<double>(value));
    else
      targets.wanted[g].real(static_cast<double>(value));
  };
  const GaussianInteger v = mesh.vector[h];
  set(h, across_imaginary, across_imaginary ? v.im : v.re);
  const std::uint32_t o = mesh.opposite[h];
  if (o == outside) return;
  const bool is_imaginary = across_imaginary != (mesh.turns[h] % 2 == 1);
  set(o, is_imaginary, is_imaginary ? mesh.vector[o].im : mesh.vector[o].re);
}

/// S20: between a feature and its `strip_of` every triangle has an edge on one of them and a point on the other.
void ask_for_strips(const FeatureMesh& features, const FlatMesh& mesh, VectorTargets& targets) {
  const auto has = [&](std::uint32_t h, std::uint32_t feature) {
    const auto& list = mesh.curve_features[mesh.curve[h]];
    return std::binary_search(list.begin(), list.end(), feature);
  };
  std::vector<std::uint8_t> touches(features.points.size());
  for (std::uint32_t f = 0; f < features.features.size(); ++f) {
    const Feature& strip = features.features[f];
    if (strip.strip_quads == 0 || strip.strip_of < 0) continue;
    const auto other = static_cast<std::uint32_t>(strip.strip_of);
    std::fill(touches.begin(), touches.end(), 0);
    for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h)
      for (const std::uint32_t p : {mesh.origin[h], mesh.end(h)})
        touches[p] |= static_cast<std::uint8_t>((has(h, f) ? 1 : 0) | (has(h, other) ? 2 : 0));
    for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) {
      if (mesh.axis[h] == MapAxis::none) continue;
      const std::uint8_t apex = touches[mesh.origin[FlatMesh::before(h)]];
      if (!(has(h, f) && apex == 2) && !(has(h, other) && apex == 1)) continue;
      for (const std::uint32_t g : {FlatMesh::next(h), FlatMesh::before(h)})
        set_rows(mesh, targets, g, mesh.axis[h] == MapAxis::real, strip.strip_quads);
    }
  }
}

/// QuantizeOptions::crowded.
void make_room(const FlatMesh& mesh, std::size_t points, const std::vector<std::uint32_t>& crowded,
               VectorTargets& targets) {
  std::vector<std::uint32_t> times(points, 0);
  for (const std::uint32_t p : crowded)
    if (p < points) ++times[p];
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) {
    const double least = 1 + std::max(times[mesh.origin[h]], times[mesh.end(h)]), now = std::abs(targets.wanted[h]);
    if (least > 1 && now > 0 && now < least) targets.wanted[h] *= least / now;
  }
}

/// Visits the triangles of each piece as a tree: visit_root(t), then visit(h) for each half-edge crossed to a new one.
template <class VisitRoot, class Visit>
void walk_triangles(const FlatMesh& mesh, VisitRoot visit_root, Visit visit) {
  const std::uint32_t count = mesh.half_edge_count() / 3;
  std::vector<std::uint8_t> is_reached(count, 0);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t root = 0; root < count; ++root) {
    if (is_reached[root]) continue;
    visit_root(root);
    queue.assign(1, root);
    is_reached[root] = 1;
    for (std::size_t at = 0; at < queue.size(); ++at)
      for (std::uint32_t h = 3 * queue[at]; h < 3 * queue[at] + 3; ++h) {
        const std::uint32_t o = mesh.opposite[h];
        if (o == outside || is_reached[o / 3]) continue;
        is_reached[o / 3] = 1;
        queue.push_back(o / 3);
        visit(h);
      }
  }
}

void write_constraints(const CornerMap& map, double scale, Quantization& q) {
  const DecimatedMap& d = q.decimated;
  const FlatMesh& m = d.mesh;
  std::vector<std::uint32_t> offset_of(d.kind.size(), outside);
  for (std::uint32_t p = 0; p < d.kind.size(); ++p)
    if (d.kind[p] == PointKind::free) offset_of[p] = q.offsets++;
  const auto corners = static_cast<std::uint32_t>(map.uv.size());

  // A triangle's third edge follows from the other two: the edge by which a tree enters it is left out.
  std::vector<std::uint8_t> is_left_out(m.half_edge_count(), 0);
  std::vector<std::uint32_t> piece(m.half_edge_count() / 3, 0), pins;
  walk_triangles(
      m,
      [&](std::uint32_t t) {
        piece[t] = static_cast<std::uint32_t>(pins.size());
        pins.push_back(outside);
      },
      [&](std::uint32_t h) {
        is_left_out[h] = is_left_out[m.opposite[h]] = 1;
        piece[m.opposite[h] / 3] = piece[h / 3];
      });
  for (std::uint32_t h = 0; h < m.half_edge_count(); ++h) {
    std::uint32_t& pin = pins[piece[h / 3]];
    if (d.kind[m.origin[h]] == PointKind::integer) pin = std::min(pin, m.origin[h]);
    if (is_left_out[h] || (m.opposite[h] != outside && m.opposite[h] < h)) continue;
    IntegerConstraint row{q.cut.expand(q.flat, d.forms[h]), q.integers.vectors[h]};
    for (const LinearTerm& term : d.forms[h])
      if (term.variable < offset_of.size() && offset_of[term.variable] != outside)
        row.terms.push_back({corners + offset_of[term.variable], term.coefficient});
    if (!row.terms.empty()) q.constraints.push_back(std::move(row));
  }
  for (const std::uint32_t p : pins) {
    if (p == outside) continue;  // nothing asks for an integer
    const std::uint32_t corner = q.cut.first_corner[p];
    const std::complex<double> u = scale * map.at(corner);
    q.constraints.push_back({{{corner, {1, 0}}}, {std::llround(u.real()), std::llround(u.imag())}});
  }
}

}  // namespace

Result<Quantization> quantize_map(const FeatureMesh& mesh, const CornerMap& map, const QuantizeOptions& options) {
  if (!(options.quads_per_unit > 0) || !std::isfinite(options.quads_per_unit))
    return Failure{FailureCode::invalid_options, "quads_per_unit must be > 0", "give the number of quads per map unit"};
  auto flat = round_map(mesh, map);
  if (!flat) return flat.failure();
  Quantization q;
  q.flat = std::move(*flat);
  q.cut = cut_chart(q.flat);
  q.decimated = decimate_map(mesh, q.flat, q.cut, {.keep_shape = options.keep_shape});
  const double scale = options.quads_per_unit * (options.coarse ? 0.01 : 1);
  VectorTargets targets = targets_of(q.decimated.mesh, scale);
  make_room(q.decimated.mesh, mesh.points.size(), options.crowded, targets);
  ask_for_strips(mesh, q.decimated.mesh, targets);
  auto integers = optimise_vectors(q.decimated.mesh, targets);
  if (!integers) return integers.failure();
  q.integers = std::move(*integers);
  const FlatMesh& m = q.decimated.mesh;
  std::vector<std::uint8_t> is_unmet(mesh.features.size(), 0), is_unaligned(mesh.features.size(), 0);
  for (const std::uint32_t h : q.integers.unmet) {
    const GaussianInteger v = q.integers.vectors[h];
    const bool is_off = (m.axis[h] == MapAxis::real && v.im != 0) || (m.axis[h] == MapAxis::imaginary && v.re != 0);
    for (const std::uint32_t f : m.curve_features[m.curve[h]]) {
      is_unmet[f] = 1;
      if (is_off) is_unaligned[f] = 1;
    }
    if (m.curve[h] != 0) continue;
    for (std::uint32_t f = 0; f < mesh.features.size(); ++f)  // an edge across a strip
      if (mesh.features[f].strip_quads != 0)
        for (const std::uint32_t g : {FlatMesh::next(h), FlatMesh::before(h)}) {
          const auto& list = m.curve_features[m.curve[g]];
          if (std::binary_search(list.begin(), list.end(), f) ||
              (mesh.features[f].strip_of >= 0 &&
               std::binary_search(list.begin(), list.end(), static_cast<std::uint32_t>(mesh.features[f].strip_of))))
            is_unmet[f] = 1;
        }
  }
  for (std::uint32_t f = 0; f < is_unmet.size(); ++f)
    if (is_unmet[f]) q.unmet_features.push_back(f);
  for (std::uint32_t f = 0; f < is_unaligned.size(); ++f)
    if (is_unaligned[f]) q.unaligned_features.push_back(f);
  write_constraints(map, scale, q);
  return q;
}

}  // namespace strataflow
