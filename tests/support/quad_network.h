#pragma once
#include <array>
#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include "kernels/quads/plan/generate_network.h"
#include "stages/extract_quads_stage.h"
#include "stages/plan_problem_stage.h"
#include "support/quad_chains.h"

namespace strataflow::support {

/// What became of one network on its way through the stages of the quad mesher.
struct NetworkOutcome {
  constexpr static std::array<const char*, 5> stage_names{"plan", "field", "map", "quantize", "extract"};
  std::string failure;            ///< of a stage, or of the independent check; empty: quads that hold every curve
  std::string why_subdivided;     ///< the failure that the fallback stood in for
  std::array<double, 5> cpu_s{};  ///< per stage, of all threads
  std::array<double, 5> wall_s{};
  std::size_t triangles = 0, quads = 0, irregular = 0, inverted = 0, half_edges = 0;
  bool took_other_field = false, was_imprinted = false, has_unmet = false;
  double smallest_jacobian = 0, mean_jacobian = 0;

  bool succeeded() const { return failure.empty(); }
};

/// Meshes the network as a job would, then looks at the quads without any of the mesher's code.
inline NetworkOutcome mesh_network(const GeneratedNetwork& network, const std::string& fallback,
                                   const FrameFieldOptions& field_options = {}) {
  NetworkOutcome outcome;
  StageContext context("quads");
  const auto timed = [&](std::size_t stage, auto&& call) {
    const std::clock_t start = std::clock();
    const auto begin = std::chrono::steady_clock::now();
    auto result = call();
    outcome.wall_s[stage] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    outcome.cpu_s[stage] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (!result) outcome.failure = std::string(NetworkOutcome::stage_names[stage]) + ": " + result.failure().what;
    return result;
  };
  InputData input;
  input.lines = network.lines;
  input.point_sets = network.point_sets;
  PlanProblem plan;
  plan.options.plan.edge_length_m = network.edge_length_m;
  const auto problem = timed(0, [&] { return plan(input, context); });
  if (!problem) return outcome;
  outcome.triangles = problem->triangles.size();
  const FrameFieldStageOptions field{field_options, {fallback}};
  const auto frames = timed(1, [&] { return ComputeFrameField{field}(*problem, context); });
  if (!frames) return outcome;
  const auto map = timed(2, [&] { return SeamlessMap{field}(*problem, *frames, context); });
  if (!map) return outcome;
  Quantize quantize;
  quantize.options.fallback = {fallback};
  quantize.options.field = field_options;
  const auto grid = timed(3, [&] { return quantize(*problem, *map, context); });
  if (!grid) return outcome;
  ExtractQuads extract;
  extract.options.fallback = {fallback};
  const auto quads = timed(4, [&] { return extract(*problem, *grid, context); });
  if (!quads) return outcome;
  for (const Warning& warning : context.warnings()) {
    outcome.took_other_field |= warning.kind == "other_field";
    outcome.was_imprinted |= warning.kind == "imprinted";
    outcome.has_unmet |= warning.kind == "unmet_feature";
  }
  outcome.why_subdivided = quads->why_subdivided;
  outcome.half_edges = grid->value.half_edges;
  outcome.quads = quads->mesh.quads.size();
  outcome.irregular = quads->quality.interior_irregular;
  outcome.inverted = quads->quality.inverted;
  outcome.smallest_jacobian = quads->quality.scaled_jacobian.minimum;
  outcome.mean_jacobian = quads->quality.scaled_jacobian.mean();
  if (outcome.inverted > 0) outcome.failure = std::to_string(outcome.inverted) + " quads are inverted";
  for (const std::string& wrong : features_not_held(*problem, quads->mesh))
    if (outcome.failure.empty()) outcome.failure = "check: " + wrong;
  return outcome;
}

}  // namespace strataflow::support
