#include "stages/all_stages.h"

#include "stages/baseline_stage.h"
#include "stages/build_model_stage.h"
#include "stages/check_mesh_stage.h"
#include "stages/check_validity_stage.h"
#include "stages/combine_stage.h"
#include "stages/complexity_stage.h"
#include "stages/cut_constrained_stage.h"
#include "stages/cut_stage.h"
#include "stages/draw_stage.h"
#include "stages/extract_quads_stage.h"
#include "stages/generate_stage.h"
#include "stages/hybrid_stage.h"
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
#include "stages/refine_plan_stage.h"
#include "stages/simulation_grid_stage.h"
#include "stages/stratigraphic_function_stage.h"
#include "stages/tetrahedralize_stage.h"
#include "stages/verticalize_stage.h"
#include "stages/volume_frames_stage.h"

namespace strataflow {

template <>
struct DataName<InputData> {
  static constexpr std::string_view text = "input data";
};
template <>
struct DataName<SealingNeed> {
  static constexpr std::string_view text = "sealing need";
};
template <>
struct DataName<CutResult> {
  static constexpr std::string_view text = "cut surfaces";
};
template <>
struct DataName<BuiltModel> {
  static constexpr std::string_view text = "structural model";
};
template <>
struct DataName<ValidityReport> {
  static constexpr std::string_view text = "validity report";
};
template <>
struct DataName<Pictures> {
  static constexpr std::string_view text = "pictures";
};
template <>
struct DataName<VolumeMesh> {
  static constexpr std::string_view text = "volume mesh";
};
template <>
struct DataName<SiteSet> {
  static constexpr std::string_view text = "sites";
};
template <>
struct DataName<RestrictedDiagram> {
  static constexpr std::string_view text = "restricted Voronoi diagram";
};
template <>
struct DataName<RemeshedSurfaces> {
  static constexpr std::string_view text = "remeshed surfaces";
};
template <>
struct DataName<SurfacesReport> {
  static constexpr std::string_view text = "surface quality";
};
template <>
struct DataName<ComplexityReport> {
  static constexpr std::string_view text = "complexity";
};
template <>
struct DataName<VolumeQualityReport> {
  static constexpr std::string_view text = "mesh quality";
};
template <>
struct DataName<HybridMesh> {
  static constexpr std::string_view text = "hybrid mesh";
};
template <>
struct DataName<FeatureMesh> {
  static constexpr std::string_view text = "plan problem";
};
template <>
struct DataName<Attempt<FrameFieldResult>> {
  static constexpr std::string_view text = "frame field";
};
template <>
struct DataName<Attempt<FieldAndMap>> {
  static constexpr std::string_view text = "map";
};
template <>
struct DataName<Attempt<GridMapping>> {
  static constexpr std::string_view text = "grid map";
};
template <>
struct DataName<MeshedQuads> {
  static constexpr std::string_view text = "quads";
};
template <>
struct DataName<FramedMesh> {
  static constexpr std::string_view text = "frames";
};
template <>
struct DataName<UprightModel> {
  static constexpr std::string_view text = "upright model";
};
template <>
struct DataName<LayeredSpace> {
  static constexpr std::string_view text = "layered space";
};
template <>
struct DataName<ExtrudedHexes> {
  static constexpr std::string_view text = "extruded hexahedra";
};
template <>
struct DataName<SmoothedHexes> {
  static constexpr std::string_view text = "hexahedra";
};
template <>
struct DataName<CheckedHexes> {
  static constexpr std::string_view text = "checked hexahedra";
};
template <>
struct DataName<SimulationFiles> {
  static constexpr std::string_view text = "simulation grid";
};

std::vector<StageDescription> all_stages() {
  return {
      describe_stage<Read>("Reads one input file", "[[input]]"),
      describe_stage<Generate>("Makes a reference model instead of reading one", "[[input]]"),
      describe_stage<Combine>("Puts the inputs together and moves them near the origin", ""),
      describe_stage<RemoveScars>("Sews the slits of an earlier cut and erases its nodes", "[cut]"),
      describe_stage<JudgeSurfaces>("Decides whether the surfaces must be cut and sealed", "[cut]"),
      describe_stage<CutConstrained>("Leads borders that stop short of a surface onto it", "[seal]"),
      describe_stage<Cut>("Cuts surfaces along everything they share, exactly", "[cut]"),
      describe_stage<Seal>("Trims what juts out, closes what still stops short, merges micro-regions", "[seal]"),
      describe_stage<SimplifyBorders>("Gives contacts the coarsest common sampling", "[simplify]"),
      describe_stage<BuildModel>("Finds corners, lines, surfaces and regions", ""),
      describe_stage<CheckValidity>("Judges the model by the validity rules", ""),
      describe_stage<DrawModel>("Draws the model by entity, by region, and with its regions moved apart", ""),
      describe_stage<OptimiseSites>("Spreads sites over all surfaces as a centroidal Voronoi tessellation", "[remesh]"),
      describe_stage<RestrictVoronoi>("Cuts the surfaces into the cells of the sites", ""),
      describe_stage<Remesh>("Remeshes all surfaces by steps from the input's triangles, valid at each", "[remesh]"),
      describe_stage<RemeshByCells>("Remeshes all surfaces as the dual of Voronoi cells, evened out", "[remesh]"),
      describe_stage<BuildSurfaces>("Builds the model of the remeshed surfaces", ""),
      describe_stage<CompareSurfaces>("Measures the remeshed surfaces and holds them against the model", ""),
      describe_stage<MeasureComplexity>("Measures how complex the model is, as a whole and by neighbourhood",
                                        "[complexity]"),
      describe_stage<PlanProblem>("Cleans the curves that quads must follow and triangulates between them", "[quad]"),
      describe_stage<PlanSurfaces>("Takes the surfaces of the model that quads are wanted on, with its lines on them",
                                   "[quad]"),
      describe_stage<ComputeFrameField>("Directions of quads that stand on every feature", "[quad]"),
      describe_stage<SeamlessMap>("A map along the field without folds, features on isolines", "[quad]"),
      describe_stage<Quantize>("Gives features and singular points whole numbers in the map", "[quad]"),
      describe_stage<ExtractQuads>("Takes the quads out of the map and smooths them", "[quad]"),
      describe_stage<DrawQuads>("Draws the field, the map and the quads", ""),
      describe_stage<Tetrahedralize>("Fills every region with tetrahedra that conform to all surfaces",
                                     "[tetrahedralize]"),
      describe_stage<RemeshHybrid>("Remeshes all surfaces with the same triangles on both sides of thin layers", "[hybrid]"),
      describe_stage<FillHybrid>("Fills thin layers with prisms and the rest with pyramids and tetrahedra", "[hybrid]"),
      describe_stage<TakeHybridCells>("Hands the cells of a hybrid mesh on", ""),
      describe_stage<Verticalize>("Finds the plan in which faults stand upright", "[hex]"),
      describe_stage<FindStratigraphicFunction>("Finds the levels between layers", "[hex]"),
      describe_stage<TakePlanLines>("Hands the traces of faults, sides and wells on to the quads", ""),
      describe_stage<RefinePlan>("Cuts quads of the plan in three where shorter edges are wanted", "[hex]"),
      describe_stage<CutPillars>("Cuts the plan along I and J, in the place of quads", ""),
      describe_stage<TakePlan>("Takes the model as it stands, in the place of an upright plan", ""),
      describe_stage<StairStep>("Makes columns of cells that pass faults in steps", ""),
      describe_stage<TakeHexPlan>("Hands the plan of columns on", ""),
      describe_stage<DrawPlan>("Draws the plan of columns", ""),
      describe_stage<Extrude>("Makes one hexahedron per quad and layer", ""),
      describe_stage<SmoothHexes>("Improves the worst hexahedra", "[hex]"),
      describe_stage<CheckHexes>("Measures the hexahedra and judges them", ""),
      describe_stage<MakeSimulationGrid>("Gives cells indices and connections for simulators, places wells", "[hex]"),
      describe_stage<TakeHexCells>("Hands the cells of hexahedra on", ""),
      describe_stage<FindVolumeFrames>("Directions in every tetrahedron that stand on the boundary, and their singular curves",
                                       "[frames]"),
      describe_stage<CheckMesh>("Measures the mesh and holds it against the model", ""),
      describe_stage<DrawMesh>("Draws the mesh cut open along the faces of its cells", ""),
  };
}

namespace {

std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

}  // namespace

std::string stages_as_markdown() {
  std::string text =
      "# Stages\n\n"
      "Written by `strataflow stages --markdown`; a test compares. Options are set in the section of the job file "
      "that\n"
      "is named beside them (configs/README.md).\n";
  for (const StageDescription& stage : all_stages()) {
    text += "\n## " + stage.name + "\n\n" + stage.summary + ".\n\n";
    std::string inputs;
    for (const std::string& input : stage.inputs) inputs += (inputs.empty() ? "" : ", ") + input;
    text += "- inputs: " + (inputs.empty() ? std::string("none") : inputs) + "\n- output: " + stage.output +
            "\n- version: " + std::to_string(stage.version) + "\n";
    if (stage.uses_seed) text += "- draws random numbers from `job.seed`\n";
    if (stage.options.empty()) continue;
    text += "- section: `" + stage.section +
            "`\n\n| option | type | unit | default | domain | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
    for (const OptionDescription& option : stage.options)
      text += "| `" + option.name + "` | " + option.type + " | " + option.unit + " | " +
              (option.default_value.empty() ? "absent" : "`" + cell(option.default_value) + "`") + " | " +
              cell(option.domain) + " | " + cell(option.description) + " |\n";
  }
  return text;
}

}  // namespace strataflow
