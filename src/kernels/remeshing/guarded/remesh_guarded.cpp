#include "kernels/remeshing/guarded/remesh_guarded.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "kernels/remeshing/guarded/feature_sizes.h"
#include "kernels/remeshing/guarded/relax_guarded.h"

namespace strataflow {

namespace {

constexpr double shaken_share = 0.3;
/// What a vertex has to gain to be moved, while edges still come and go and at the end.
constexpr double coarse_gain = 5e-3, fine_gain = 1e-3;
/// Where blocks are cut, in turns: what lies at their sides once is inside them the next time.
constexpr std::array<double, 3> block_shares{0.5, 0.4, 0.6};

/// Why triangle t has an angle below 5°.
BadTriangleReason reason_of(const GuardedMesh& mesh, const FeatureSizes& features, std::uint32_t t) {
  const Triangle& c = mesh.triangle(t);
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.kind(c[k]) == VertexKind::surface) continue;
    if (features.at(mesh, c[k]) < 0.5 * mesh.size_m(c[k])) return BadTriangleReason::touches_small_feature;
    // Two lines that enclose the triangle: its angle at the corner is the model's.
    const std::uint32_t one = mesh.line_of_edge(c[k], c[(k + 1) % 3]), other = mesh.line_of_edge(c[k], c[(k + 2) % 3]);
    if (mesh.kind(c[k]) == VertexKind::corner && one != no_index && other != no_index)
      return BadTriangleReason::touches_small_feature;
  }
  return BadTriangleReason::kept_input;
}

}  // namespace

double edge_length_of(double area_m2, double sites) { return std::sqrt(2 * area_m2 / (std::numbers::sqrt3 * sites)); }

Result<RemeshGuardedResult> remesh_guarded(const StructuralModel& model, const RemeshGuardedOptions& options) {
  std::vector<double> size_m = options.surface_edge_length_m;
  if (size_m.empty()) size_m.assign(model.surfaces.size(), options.target_edge_length_m);
  if (size_m.size() != model.surfaces.size())
    return Failure{FailureCode::invalid_options,
                   "surface_edge_length_m has " + std::to_string(size_m.size()) + " values for " +
                       std::to_string(model.surfaces.size()) + " surfaces",
                   "give one length per surface"};
  if (!std::all_of(size_m.begin(), size_m.end(), [](double s) { return s > 0 && std::isfinite(s); }))
    return Failure{FailureCode::invalid_options, "an edge length is not positive", "give lengths in metres, > 0"};
  if (!(options.distance_ratio > 0) || !(options.turn_angle_deg > 0 && options.turn_angle_deg < 90) ||
      !(options.smallest_size_ratio > 0 && options.smallest_size_ratio <= 1) || !(options.size_growth_ratio > 0))
    return Failure{
        FailureCode::invalid_options, "an option of the guarded remeshing is out of its domain",
        "distance_ratio > 0, turn_angle_deg in (0, 90), smallest_size_ratio in (0, 1], size_growth_ratio > 0"};
  if (model.triangles.empty())
    return Failure{FailureCode::invalid_input, "the model has no triangles", "give surfaces"};

  const InputSurfaces inputs(model);
  Box3 box;
  for (const Vec3& p : model.points) box.take(p);
  GuardedMesh mesh(inputs, {.distance_m = options.distance_ratio * box.diagonal_m(),
                            .turn_angle_deg = options.turn_angle_deg,
                            .cell_m = *std::min_element(size_m.begin(), size_m.end()),
                            .is_cancelled = options.is_cancelled});
  const FeatureSizes features(inputs, *std::max_element(size_m.begin(), size_m.end()));

  RemeshGuardedReport report;
  std::size_t turn = 0;
  // Calls work(part, counts) for the parts of the mesh, adds the counts up and returns how many parts there were.
  const auto in_blocks = [&](auto&& work) {
    const std::vector<RemeshGuardedReport> parts =
        mesh.in_blocks({.share = block_shares[turn++ % block_shares.size()]}, [&](GuardedMesh& part) {
          RemeshGuardedReport counts;
          work(part, counts);
          return counts;
        });
    for (const RemeshGuardedReport& done : parts) {
      report.splits += done.splits;
      report.collapses += done.collapses;
      report.flips += done.flips;
      report.moves += done.moves;
      report.mended += done.mended;
    }
    return parts.size();
  };
  for (std::int64_t round = 0; round < options.rounds && !mesh.is_stopped(); ++round) {
    set_graded_sizes(mesh, features, size_m, options.smallest_size_ratio, options.size_growth_ratio);
    // Regular vertices first, the best angles last.
    const bool is_last = round + 1 == options.rounds;
    const double least_gain = is_last ? fine_gain : coarse_gain;
    const auto relax = [&](GuardedMesh& part, std::uint32_t since, RemeshGuardedReport& counts) {
      counts.collapses += collapse_short_edges(part, since);
      counts.flips += flip_edges(part, since);
      counts.splits += split_long_edges(part, since);
      counts.collapses += collapse_short_edges(part, since);
      part.renumber();
      if (round == 0 && since == 0) counts.moves += shake(part, shaken_share);
      for (int sweep = 0; sweep < 2; ++sweep) {
        const std::uint32_t start = part.step_count() + 1;
        counts.flips += is_last ? flip_edges(part, since) : even_valences(part, since);
        counts.moves += even_out(part, since, least_gain);
        since = start;
      }
    };
    const std::size_t parts =
        in_blocks([&](GuardedMesh& part, RemeshGuardedReport& counts) { relax(part, 0, counts); });
    // At first what lies at the sides of blocks is far behind, and would spoil what is next to it.
    if (parts > 1 && round < 2) {
      const std::uint32_t since = mesh.step_count();
      in_blocks([&](GuardedMesh& part, RemeshGuardedReport& counts) { relax(part, since, counts); });
    }
  }
  // Once where blocks are cut here, then there, so that what lies at their sides is mended, too.
  for (std::uint32_t cut = 0, since = 0; cut < block_shares.size(); ++cut) {
    const std::uint32_t before = mesh.step_count() + 1;
    const std::size_t parts = in_blocks([&](GuardedMesh& part, RemeshGuardedReport& counts) {
      std::uint32_t recent = since;
      for (std::int64_t round = 0; round < options.mending_rounds; ++round) {
        const std::uint32_t start = part.step_count() + 1;
        const std::uint64_t mended = mend_bad_triangles(part, recent);
        counts.mended += mended;
        counts.flips += flip_edges(part, recent);
        recent = start;
        if (mended == 0) break;
      }
    });
    since = before;
    if (parts == 1) break;
  }
  std::uint32_t since = 0;
  for (std::int64_t round = 0; round < options.shape_rounds; ++round) {
    const std::uint32_t start = mesh.step_count() + 1;
    in_blocks([&](GuardedMesh& part, RemeshGuardedReport& counts) {
      counts.moves += even_out(part, since, fine_gain);
      counts.mended += raise_mean_shape(part, since);
    });
    since = start;
  }
  if (mesh.is_stopped()) return Failure{FailureCode::cancelled, "remeshing was stopped", "run it again"};
  report.verdicts = mesh.verdicts();
  const std::vector<std::uint32_t> order = mesh.triangles_in_order();
  const double sine_5_deg = std::sin(5 * std::numbers::pi / 180);
  for (std::uint32_t k = 0; k < order.size(); ++k)
    if (const double q = mesh.quality(order[k]); q < sine_5_deg)
      report.bad_triangles.push_back({k, std::asin(q) * 180 / std::numbers::pi, reason_of(mesh, features, order[k])});
  return RemeshGuardedResult{mesh.soup(), std::move(report)};
}

}  // namespace strataflow
