#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "batch/options/job_value.h"
#include "kernels/complexity/measure_complexity.h"
#include "kernels/volumes/tetrahedralize_model.h"
#include "model/geology.h"
#include "stages/cut_constrained_stage.h"
#include "stages/cut_stage.h"
#include "stages/extract_quads_stage.h"
#include "stages/extrude_stage.h"
#include "stages/hybrid_stage.h"
#include "stages/judge_surfaces_stage.h"
#include "stages/plan_surfaces_stage.h"
#include "stages/refine_plan_stage.h"
#include "stages/remesh_stage.h"
#include "stages/remove_scars_stage.h"
#include "stages/seal_stage.h"
#include "stages/simplify_borders_stage.h"
#include "stages/simulation_grid_stage.h"
#include "stages/stratigraphic_function_stage.h"
#include "stages/verticalize_stage.h"
#include "stages/volume_frames_stage.h"

namespace strataflow {

/// [job]
struct JobHeader {
  std::string name;       ///< a folder name; default: the job file's own name
  std::int64_t seed = 1;  ///< ≥ 0
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(name, OptionField{.name = "name", .description = "Name of the job, and of its run folder out/<name>"});
    visit(seed, OptionField{.name = "seed", .description = "Seed of every random choice", .minimum = 0});
  }
};

/// [[input]]: a file, or a reference model made on the spot.
struct JobInput {
  std::optional<std::string> file;
  std::optional<std::string> model;
  std::optional<std::string> name;
  std::optional<std::string> role;
  std::optional<double> resolution_m;
  std::optional<double> raw_ratio;
  bool sticks = false;
  bool traces = false;
  std::string origin;  ///< file:line
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(file,
          OptionField{.name = "file", .description = "A model, surface, line or point file, relative to the job file"});
    visit(model,
          OptionField{.name = "model", .description = "Instead of a file: a reference model of `strataflow generate`"});
    visit(name, OptionField{.name = "name", .description = "Overrides the name the file carries"});
    visit(role, OptionField{.name = "role",
                            .description = "Overrides what the file says its surfaces, lines or points are",
                            .words = role_words()});
    visit(resolution_m, OptionField{.name = "resolution_m",
                                    .description = "Reference models: length of the triangles' edges",
                                    .minimum = 0,
                                    .exclusive_minimum = true});
    visit(raw_ratio, OptionField{.name = "raw_ratio",
                                 .description = "Reference models: surfaces stop short by this share of their extent "
                                                "(overshoot if negative); absent: sealed",
                                 .minimum = -0.2,
                                 .maximum = 0.2});
    visit(sticks,
          OptionField{.name = "sticks",
                      .description = "The file's lines are sticks of one fault: their first points become its trace"});
    visit(traces,
          OptionField{.name = "traces",
                      .description = "The upper borders of the file's surfaces are taken in their place, as traces"});
  }
};

/// [output]
struct OutputOptions {
  std::vector<std::string> products;
  std::vector<std::string> formats = {"vtk"};
  std::optional<std::string> from;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(products, OptionField{.name = "products",
                                .description = "What to make; only what a product needs runs",
                                .words = {"model", "voronoi", "surfaces", "tets", "hybrid", "quads", "hexes", "frames",
                                          "complexity"}});
    visit(formats, OptionField{.name = "formats",
                               .description = "File formats of the products; vtk (vtp, vtu) is always written",
                               .words = {"vtk", "gocad", "medit", "gmsh", "obj", "abaqus", "grdecl"}});
    visit(from,
          OptionField{.name = "from",
                      .description = "What tets and hexes are built on: the model's triangles or the remeshed surfaces",
                      .words = {"model", "surfaces"}});
  }
};

/// [cut]: the options of three stages.
struct CutOptions {
  JudgeSurfacesOptions judge;
  RemoveScarsStageOptions scars;
  CutStageOptions cut;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    judge.visit_fields(visit);
    cut.visit_fields(visit);
    scars.visit_fields(visit);
  }
};

/// [seal]: the options of two stages, which share where contacts are to be made.
struct SealOptions {
  SealStageOptions seal;
  bool required = true;
  double stone_angle_deg = CutConstrainedOptions{}.stone_angle_deg;
  double facing_deg = CutConstrainedOptions{}.facing_deg;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    seal.visit_fields(visit);
    visit(required, OptionField{.name = "required",
                                .description = "Fail on surfaces that still enclose nothing, leak or cross; false: "
                                               "write them as they are (a set of faults without a box)"});
    CutConstrainedOptions::visit_angles(visit, stone_angle_deg, facing_deg);
  }
  CutConstrainedOptions contacts() const {
    CutConstrainedOptions options;
    options.contacts = seal.contacts;
    options.distance_m = seal.distance_m;
    options.stone_angle_deg = stone_angle_deg;
    options.facing_deg = facing_deg;
    return options;
  }
};

/// [quad]: the options of five stages.
struct QuadOptions {
  PlanProblemOptions problem;
  std::vector<std::string> surfaces;
  FrameFieldOptions field;
  QuantizeStageOptions integers;
  ExtractQuadsOptions quads;
  QuadFallback fallback;
  LooseCurves curves;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    problem.visit_fields(visit);
    PlanSurfacesOptions::visit_surfaces(visit, surfaces);
    field.visit_fields(visit);
    integers.visit_own(visit);
    quads.visit_own(visit);
    fallback.visit_fields(visit);
    curves.visit_fields(visit);
  }
};

/// [hex]: the options of five stages, how long the edges of the plan are, and which kind of grid is made.
struct HexOptions {
  std::string method = "conforming";
  std::optional<double> edge_length_m;
  VerticalizeOptions plan;
  RefinePlanOptions refinement;
  LayerStageOptions layers;
  SmoothHexesStageOptions smoothing;
  SimulationGridStageOptions simulation;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(method,
          OptionField{.name = "method",
                      .description = "conforming: quads extruded, every fault followed; for comparison pillars: "
                                     "rows of cells along faults that fit I or J; stairs: upright columns that "
                                     "pass faults in steps",
                      .words = {"conforming", "pillars", "stairs"}});
    visit(edge_length_m, OptionField{.name = "edge_length_m",
                                     .description = "Wanted length of the cells' edges seen from above; absent: "
                                                    "quad.edge_length_m",
                                     .minimum = 0,
                                     .exclusive_minimum = true});
    plan.visit_fields(visit);
    refinement.visit_fields(visit);
    layers.visit_fields(visit);
    smoothing.visit_fields(visit);
    simulation.visit_fields(visit);
  }
};

/// One job, checked and complete: every option has a value from its domain, every input exists.
struct Job {
  std::string file_name;         ///< the job file, as messages call it
  std::filesystem::path folder;  ///< absolute; relative paths of the job start here
  JobHeader header;
  std::vector<JobInput> inputs;
  OutputOptions output;
  CutOptions cut;
  SealOptions seal;
  SimplifyBordersStageOptions simplify;
  TetrahedralizeOptions tetrahedralize;
  RemeshStageOptions remesh;
  HexOptions hex;
  ComplexityOptions complexity;
  VolumeFramesOptions frames;
  QuadOptions quad;
  HybridOptions hybrid;

  /// Calls visit(section name, options) for every section of options.
  template <class Visitor>
  void visit_sections(Visitor&& visit) {
    visit("cut", cut);
    visit("seal", seal);
    visit("simplify", simplify);
    visit("remesh", remesh);
    visit("tetrahedralize", tetrahedralize);
    visit("hybrid", hybrid);
    visit("quad", quad);
    visit("hex", hex);
    visit("complexity", complexity);
    visit("frames", frames);
  }
  bool makes(std::string_view product) const;
  bool writes(std::string_view format) const;
  /// The input's file, absolute. Only for inputs that are files.
  std::filesystem::path input_path(const JobInput& input) const;
};

/// The jobs of a job file: one, or one per combination of its [sweep]. `settings` are "key=value" overrides. All
/// problems come at once, each with file:line (or the setting) and a remedy; nothing has been worked on yet.
/// Fails with invalid_usage, invalid_options or unreadable_file.
Result<std::vector<Job>> read_jobs(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

/// The same from text; `folder` is where relative paths start.
Result<std::vector<Job>> read_jobs_from_text(std::string_view text, const std::string& file_name,
                                             const std::filesystem::path& folder,
                                             const std::vector<std::string>& settings = {});

}  // namespace strataflow
