#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/job_file/job.h"
#include "graph/stage_graph.h"
#include "kernels/complexity/measure_complexity.h"
#include "kernels/quality/analyze_volume_mesh.h"
#include "model/built_model.h"
#include "model/cut_result.h"
#include "model/restricted_diagram.h"
#include "model/site_set.h"
#include "model/volume_mesh.h"
#include "stages/draw_stage.h"
#include "stages/hybrid_stage.h"
#include "stages/remesh_stage.h"

namespace strataflow {

/// Where a job's stages and data are in the shared graph.
struct WiredJob {
  /// The job's nodes by the names they have in its report, in the order they were wired. A node shared with another
  /// job may be called differently in the graph.
  std::vector<std::pair<std::string, NodeId>> nodes;
  std::optional<Port<CutResult>> sealed;  ///< absent where cut.mode is never
  std::optional<Port<BuiltModel>> model;
  std::optional<Port<ValidityReport>> validity;
  std::optional<Port<Pictures>> model_pictures;
  std::optional<Port<SiteSet>> sites;
  std::optional<Port<RestrictedDiagram>> diagram;
  std::optional<Port<RemeshedSurfaces>> remeshed;
  std::optional<Port<BuiltModel>> surfaces;  ///< remeshed
  std::optional<Port<ValidityReport>> surfaces_validity;
  std::optional<Port<SurfacesReport>> surfaces_report;
  std::optional<Port<Pictures>> surfaces_pictures;
  std::optional<Port<ComplexityReport>> complexity;
  std::optional<Port<RemeshedSurfaces>> hybrid_remeshed;
  std::optional<Port<BuiltModel>> hybrid_surfaces;
  std::optional<Port<SurfacesReport>> hybrid_surfaces_report;
  std::optional<Port<HybridMesh>> hybrid;
  std::optional<Port<VolumeQualityReport>> hybrid_quality;
  std::optional<Port<Pictures>> hybrid_pictures;
  std::optional<Port<FeatureMesh>> plan_problem;
  /// Of the quads, or of the plan of hexes where no quads are made.
  std::optional<Port<Attempt<FrameFieldResult>>> frame_field;
  std::optional<Port<Attempt<FieldAndMap>>> seamless_map;
  std::optional<Port<Attempt<GridMapping>>> grid;
  std::optional<Port<MeshedQuads>> quads;
  std::optional<Port<Pictures>> quads_pictures;
  std::optional<Port<UprightModel>> upright;
  std::optional<Port<LayeredSpace>> layered_space;
  std::optional<Port<FeatureMesh>> hex_plan_problem;
  std::optional<Port<MeshedQuads>> hex_plan;
  std::optional<Port<Pictures>> hex_plan_pictures;
  std::optional<Port<SmoothedHexes>> smoothed_hexes;
  std::optional<Port<CheckedHexes>> hexes;
  std::optional<Port<SimulationFiles>> simulation;
  std::optional<Port<Pictures>> hexes_pictures;
  std::optional<Port<FramedMesh>> frames;
  std::optional<Port<VolumeMesh>> tets;
  std::optional<Port<VolumeQualityReport>> tets_quality;
  std::optional<Port<Pictures>> tets_pictures;

  std::vector<NodeId> wanted() const;
};

/// Wires every job into one graph: what two jobs have in common is one node. Result: one WiredJob per job.
std::vector<WiredJob> build_graph(StageGraph& graph, const std::vector<Job>& jobs);

}  // namespace strataflow
