#include "batch/build_graph.h"

#include <algorithm>
#include <limits>

#include "stages/baseline_stage.h"
#include "stages/build_model_stage.h"
#include "stages/check_mesh_stage.h"
#include "stages/check_validity_stage.h"
#include "stages/combine_stage.h"
#include "stages/complexity_stage.h"
#include "stages/cut_constrained_stage.h"
#include "stages/cut_stage.h"
#include "stages/generate_stage.h"
#include "stages/judge_surfaces_stage.h"
#include "stages/optimise_sites_stage.h"
#include "stages/plan_problem_stage.h"
#include "stages/plan_surfaces_stage.h"
#include "stages/read_stage.h"
#include "stages/remesh_stage.h"
#include "stages/remove_scars_stage.h"
#include "stages/restrict_voronoi_stage.h"
#include "stages/seal_stage.h"
#include "stages/simplify_borders_stage.h"
#include "stages/tetrahedralize_stage.h"

namespace strataflow {

namespace {

/// Adds a job's nodes to the graph and remembers their names.
class JobWirer {
 public:
  JobWirer(StageGraph& graph, WiredJob& wired) : graph_(graph), wired_(wired) {}

  template <class Stage, class... Wires>
  auto add(std::string name, Stage stage, const Wires&... wires) {
    const auto is_taken = [&](const std::string& other) {
      return std::any_of(wired_.nodes.begin(), wired_.nodes.end(),
                         [&](const auto& node) { return node.first == other; });
    };
    std::string unique = name;
    for (int copy = 2; is_taken(unique); ++copy) unique = name + "#" + std::to_string(copy);
    const auto port = graph_.add(unique, std::move(stage), wires...);
    wired_.nodes.emplace_back(std::move(unique), port.node());
    return port;
  }

 private:
  StageGraph& graph_;
  WiredJob& wired_;
};

Port<InputData> wire_input(JobWirer& wirer, const Job& job, const JobInput& input) {
  if (input.model)
    return wirer.add("generate/" + *input.model, Generate{{*input.model, input.resolution_m, input.raw_ratio}});
  const std::filesystem::path path = job.input_path(input);
  return wirer.add("read/" + path.filename().string(),
                   Read{{input.name, input.role, input.sticks, input.traces}, path});
}

/// From surfaces as they were read to surfaces that conform.
Port<InputData> wire_surfaces(JobWirer& wirer, const Job& job, Port<InputData> surfaces, WiredJob& wired) {
  if (job.cut.scars.remove_scars) surfaces = wirer.add("remove_scars", RemoveScars{job.cut.scars}, surfaces);
  if (job.cut.judge.mode == "never") return surfaces;
  const Port<SealingNeed> need = wirer.add("judge_surfaces", JudgeSurfaces{job.cut.judge}, surfaces);
  const Port<CutResult> joined = wirer.add("cut_constrained", CutConstrained{job.seal.contacts()}, surfaces, need);
  const Port<CutResult> cut = wirer.add("cut", Cut{job.cut.cut}, joined, need);
  const Port<CutResult> sealed = wirer.add("seal", Seal{job.seal.seal}, cut, need);
  wired.sealed = sealed;
  return wirer.add("simplify_borders", SimplifyBorders{job.simplify}, sealed);
}

/// Whether a job makes anything but quads that stand on curves.
bool needs_model(const Job& job) {
  return std::any_of(job.output.products.begin(), job.output.products.end(),
                     [&](const std::string& product) { return product != "quads" || !job.quad.surfaces.empty(); });
}

/// The checked model, the surfaces remeshed if anything stands on them, and the pictures of both.
void wire_model(JobWirer& wirer, const Job& job, Port<InputData> input, WiredJob& wired) {
  const Port<BuiltModel> model = wirer.add("build_model", BuildModel{}, wire_surfaces(wirer, job, input, wired));
  const bool remeshes = job.makes("surfaces") || (job.output.from == "surfaces" &&
                                                  (job.makes("tets") || job.makes("hexes") || job.makes("frames")));
  const bool must_be_sealed = (job.cut.judge.mode != "never" && job.seal.required) || job.makes("tets") ||
                              job.makes("hybrid") || job.makes("hexes") || job.makes("frames") || remeshes;
  wired.model = model;
  const Port<ValidityReport> validity = wirer.add("check_validity", CheckValidity{{must_be_sealed}}, model);
  wired.validity = validity;
  const bool takes_cells = remeshes && job.remesh.uses_cells();
  if (job.makes("voronoi") || takes_cells)
    wired.sites = wirer.add("optimise_sites", OptimiseSites{job.remesh.sites}, model);
  if (job.makes("voronoi")) wired.diagram = wirer.add("restricted_voronoi", RestrictVoronoi{}, model, *wired.sites);
  if (!remeshes) return;
  wired.remeshed = takes_cells ? wirer.add("remesh_by_cells", RemeshByCells{job.remesh}, model, validity, *wired.sites)
                               : wirer.add("remesh", Remesh{job.remesh}, model, validity);
  wired.surfaces = wirer.add("build_surfaces", BuildSurfaces{}, *wired.remeshed);
  wired.surfaces_validity = wirer.add("check_surfaces", CheckValidity{{true}}, *wired.surfaces);
  wired.surfaces_report =
      wirer.add("compare_surfaces", CompareSurfaces{{job.remesh.preserve == "all"}}, model, *wired.surfaces);
  wired.surfaces_pictures = wirer.add("draw_surfaces", DrawModel{}, *wired.surfaces);
}

/// Tetrahedra of the model or of its remeshed surfaces.
Port<VolumeMesh> wire_tetrahedra(JobWirer& wirer, const Job& job, const TetrahedralizeOptions& options,
                                 const WiredJob& wired) {
  const bool is_on_surfaces = job.output.from == "surfaces";
  return wirer.add("tetrahedralize", Tetrahedralize{options}, is_on_surfaces ? *wired.surfaces : *wired.model,
                   is_on_surfaces ? *wired.surfaces_validity : *wired.validity);
}

void wire_tets(JobWirer& wirer, const Job& job, WiredJob& wired) {
  const Port<BuiltModel> hull = job.output.from == "surfaces" ? *wired.surfaces : *wired.model;
  wired.tets = wire_tetrahedra(wirer, job, job.tetrahedralize, wired);
  wired.tets_quality = wirer.add("check_mesh", CheckMesh{}, hull, *wired.tets);
  wired.tets_pictures = wirer.add("draw_mesh", DrawMesh{}, *wired.tets);
}

void wire_hybrid(JobWirer& wirer, const Job& job, WiredJob& wired) {
  wired.hybrid_remeshed = wirer.add("remesh_hybrid", RemeshHybrid{job.hybrid}, *wired.model, *wired.validity);
  wired.hybrid_surfaces = wirer.add("build_hybrid_surfaces", BuildSurfaces{}, *wired.hybrid_remeshed);
  const auto validity = wirer.add("check_hybrid_surfaces", CheckValidity{{true}}, *wired.hybrid_surfaces);
  wired.hybrid_surfaces_report = wirer.add("compare_hybrid_surfaces", CompareSurfaces{{job.hybrid.preserve == "all"}},
                                           *wired.model, *wired.hybrid_surfaces);
  wired.hybrid = wirer.add("hybrid", FillHybrid{job.hybrid}, *wired.hybrid_surfaces, validity);
  const auto cells = wirer.add("hybrid_cells", TakeHybridCells{}, *wired.hybrid);
  wired.hybrid_quality = wirer.add("check_hybrid", CheckMesh{}, *wired.hybrid_surfaces, cells);
  wired.hybrid_pictures = wirer.add("draw_hybrid", DrawMesh{}, cells);
}

struct WiredQuads {
  Port<FeatureMesh> problem;
  Port<Attempt<FrameFieldResult>> field;
  Port<Attempt<FieldAndMap>> seamless;
  Port<Attempt<GridMapping>> grid;
  Port<MeshedQuads> quads;
  Port<Pictures> pictures;
};

WiredQuads wire_quads(JobWirer& wirer, const QuadOptions& quad, Port<FeatureMesh> problem) {
  const auto field = wirer.add("frame_field", ComputeFrameField{{quad.field, quad.fallback, quad.curves}}, problem);
  const auto seamless =
      wirer.add("seamless_map", SeamlessMap{{quad.field, quad.fallback, quad.curves}}, problem, field);
  QuantizeStageOptions integers = quad.integers;
  ExtractQuadsOptions extraction = quad.quads;
  integers.fallback = extraction.fallback = quad.fallback;
  integers.field = quad.field;
  const auto grid = wirer.add("quantize", Quantize{integers}, problem, seamless);
  const auto quads = wirer.add("extract_quads", ExtractQuads{extraction}, problem, grid);
  return {problem, field, seamless, grid, quads, wirer.add("draw_quads", DrawQuads{}, problem, seamless, grid, quads)};
}

/// The plan of hexahedra whose faults stand upright, and the hexahedra over it.
Port<ExtrudedHexes> wire_upright_hexes(JobWirer& wirer, const Job& job, Port<InputData> input, Port<VolumeMesh> tets,
                                       WiredJob& wired) {
  wired.upright = wirer.add("verticalize", Verticalize{job.hex.plan}, tets);
  wired.layered_space = wirer.add("stratigraphic_function", FindStratigraphicFunction{job.hex.layers}, *wired.upright);
  QuadOptions quad = job.quad;
  if (job.hex.edge_length_m) quad.problem.plan.edge_length_m = *job.hex.edge_length_m;
  const auto lines = wirer.add("take_plan_lines", TakePlanLines{}, *wired.upright, input);
  wired.hex_plan_problem = wirer.add("plan_problem", PlanProblem{quad.problem}, lines);
  if (job.hex.method == "pillars") {
    wired.hex_plan = wirer.add("cut_pillars", CutPillars{}, *wired.hex_plan_problem);
    wired.hex_plan_pictures = wirer.add("draw_plan", DrawPlan{}, *wired.hex_plan);
    return wirer.add("extrude", Extrude{}, *wired.layered_space, *wired.hex_plan);
  }
  const WiredQuads plan = wire_quads(wirer, quad, *wired.hex_plan_problem);
  if (!wired.frame_field) {
    wired.frame_field = plan.field;
    wired.seamless_map = plan.seamless;
    wired.grid = plan.grid;
  }
  wired.hex_plan = plan.quads;
  wired.hex_plan_pictures = plan.pictures;
  if (!job.hex.refinement.refine_edge_m.empty() || !job.hex.refinement.refine_within_m.empty()) {
    wired.hex_plan = wirer.add("refine_plan", RefinePlan{job.hex.refinement}, plan.quads, *wired.upright, input);
    wired.hex_plan_pictures = wirer.add("draw_plan", DrawPlan{}, *wired.hex_plan);
  }
  return wirer.add("extrude", Extrude{}, *wired.layered_space, *wired.hex_plan);
}

/// The same of upright columns that need not follow faults.
Port<ExtrudedHexes> wire_stair_steps(JobWirer& wirer, const Job& job, Port<VolumeMesh> tets, WiredJob& wired) {
  wired.upright = wirer.add("take_plan", TakePlan{{job.hex.plan.drop_alignment}}, tets);
  wired.layered_space = wirer.add("stratigraphic_function", FindStratigraphicFunction{job.hex.layers}, *wired.upright);
  const double edge_m = job.hex.edge_length_m.value_or(job.quad.problem.plan.edge_length_m);
  const auto hexes = wirer.add("stair_step", StairStep{{edge_m}}, *wired.layered_space);
  wired.hex_plan = wirer.add("take_hex_plan", TakeHexPlan{}, hexes);
  wired.hex_plan_pictures = wirer.add("draw_plan", DrawPlan{}, *wired.hex_plan);
  return hexes;
}

void wire_hexes(JobWirer& wirer, const Job& job, Port<InputData> input, WiredJob& wired) {
  TetrahedralizeOptions options = job.tetrahedralize;
  if (!options.radius_edge_ratio) options.radius_edge_ratio = 1.8;  // levels between horizons need points there
  const Port<VolumeMesh> tets = wire_tetrahedra(wirer, job, options, wired);
  const bool is_baseline = job.hex.method != "conforming";
  const auto extruded = job.hex.method == "stairs" ? wire_stair_steps(wirer, job, tets, wired)
                                                   : wire_upright_hexes(wirer, job, input, tets, wired);
  SmoothHexesStageOptions smoothing = job.hex.smoothing;
  SimulationGridStageOptions simulation = job.hex.simulation;
  if (is_baseline) {  // pillars stay where they are, and are what the simulator gets, however far from straight
    smoothing.smoothing_sweeps = 0;
    if (simulation.layout == "automatic") {
      simulation.layout = "native";
      if (!simulation.pillar_tolerance_m) simulation.pillar_tolerance_m = std::numeric_limits<double>::max();
    }
  }
  wired.smoothed_hexes = wirer.add("smooth_hexes", SmoothHexes{smoothing}, *wired.layered_space, extruded);
  wired.hexes = wirer.add("check_hexes", CheckHexes{}, *wired.smoothed_hexes, *wired.layered_space, *wired.hex_plan);
  wired.simulation = wirer.add("simulation_grid", MakeSimulationGrid{simulation}, *wired.smoothed_hexes, *wired.hexes,
                               *wired.layered_space, input);
  wired.hexes_pictures = wirer.add("draw_hexes", DrawMesh{}, wirer.add("hex_cells", TakeHexCells{}, *wired.hexes));
}

WiredJob wire_job(StageGraph& graph, const Job& job) {
  WiredJob wired;
  JobWirer wirer(graph, wired);
  graph.set_job_seed(static_cast<std::uint64_t>(job.header.seed));

  std::vector<Port<InputData>> inputs;
  for (const JobInput& input : job.inputs) inputs.push_back(wire_input(wirer, job, input));
  const Port<InputData> input = wirer.add("combine", Combine{}, inputs);
  if (needs_model(job)) wire_model(wirer, job, input, wired);
  if (job.makes("quads")) {
    const WiredQuads quads =
        wire_quads(wirer, job.quad,
                   job.quad.surfaces.empty()
                       ? wirer.add("plan_problem", PlanProblem{job.quad.problem}, input)
                       : wirer.add("plan_surfaces", PlanSurfaces{{job.quad.problem, job.quad.surfaces}}, *wired.model));
    wired.plan_problem = quads.problem;
    wired.frame_field = quads.field;
    wired.seamless_map = quads.seamless;
    wired.grid = quads.grid;
    wired.quads = quads.quads;
    wired.quads_pictures = quads.pictures;
  }
  if (!wired.model) return wired;
  if (job.makes("tets")) wire_tets(wirer, job, wired);
  if (job.makes("frames"))
    wired.frames = wirer.add("volume_frames", FindVolumeFrames{job.frames},
                             wired.tets ? *wired.tets : wire_tetrahedra(wirer, job, job.tetrahedralize, wired));
  if (job.makes("hybrid")) wire_hybrid(wirer, job, wired);
  if (job.makes("hexes")) wire_hexes(wirer, job, input, wired);
  if (job.makes("complexity"))
    wired.complexity = wirer.add("complexity", MeasureComplexity{job.complexity}, *wired.model);
  // Last: pictures wait for idle threads rather than the other way round.
  wired.model_pictures = wirer.add("draw_model", DrawModel{}, *wired.model);
  return wired;
}

}  // namespace

std::vector<NodeId> WiredJob::wanted() const {
  std::vector<NodeId> ids;
  const auto take = [&](const auto& port) {
    if (port) ids.push_back(port->node());
  };
  take(sealed);
  take(model);
  take(validity);
  take(model_pictures);
  take(sites);
  take(diagram);
  take(remeshed);
  take(surfaces);
  take(surfaces_validity);
  take(surfaces_report);
  take(surfaces_pictures);
  take(complexity);
  take(hybrid_remeshed);
  take(hybrid_surfaces);
  take(hybrid_surfaces_report);
  take(hybrid);
  take(hybrid_quality);
  take(hybrid_pictures);
  take(plan_problem);
  take(frame_field);
  take(seamless_map);
  take(grid);
  take(quads);
  take(quads_pictures);
  take(upright);
  take(layered_space);
  take(hex_plan_problem);
  take(hex_plan);
  take(hex_plan_pictures);
  take(smoothed_hexes);
  take(hexes);
  take(simulation);
  take(hexes_pictures);
  take(frames);
  take(tets);
  take(tets_quality);
  take(tets_pictures);
  return ids;
}

std::vector<WiredJob> build_graph(StageGraph& graph, const std::vector<Job>& jobs) {
  std::vector<WiredJob> wired;
  for (const Job& job : jobs) wired.push_back(wire_job(graph, job));
  return wired;
}

}  // namespace strataflow
