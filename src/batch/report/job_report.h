#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/digest.h"
#include "base/warning.h"
#include "batch/job_file/job.h"
#include "graph/run_graph.h"
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

/// What became of one stage of a job. Times stand apart: they are never the same twice.
struct StageRecord {
  std::string node;
  std::string stage;
  int version = 0;
  NodeOutcome outcome;
  NodeTiming timing;
};

/// Everything there is to say about a job that ran: what the writers of the run folder work from.
struct JobReport {
  const Job* job = nullptr;
  std::vector<StageRecord> stages;
  std::optional<Failure> error;  ///< of the first stage that failed
  std::shared_ptr<const CutResult> sealed;
  std::shared_ptr<const BuiltModel> model;
  std::shared_ptr<const ValidityReport> validity;
  std::shared_ptr<const Pictures> model_pictures;
  std::shared_ptr<const SiteSet> sites;
  std::shared_ptr<const RestrictedDiagram> diagram;
  std::shared_ptr<const RemeshedSurfaces> remeshed;
  std::shared_ptr<const BuiltModel> surfaces;
  std::shared_ptr<const ValidityReport> surfaces_validity;
  std::shared_ptr<const SurfacesReport> surfaces_report;
  std::shared_ptr<const Pictures> surfaces_pictures;
  std::shared_ptr<const ComplexityReport> complexity;
  std::shared_ptr<const RemeshedSurfaces> hybrid_remeshed;
  std::shared_ptr<const BuiltModel> hybrid_surfaces;
  std::shared_ptr<const SurfacesReport> hybrid_surfaces_report;
  std::shared_ptr<const HybridMesh> hybrid;
  std::shared_ptr<const VolumeQualityReport> hybrid_quality;
  std::shared_ptr<const Pictures> hybrid_pictures;
  std::shared_ptr<const FeatureMesh> plan_problem;
  std::shared_ptr<const Attempt<FrameFieldResult>> frame_field;  ///< like the next two, of hexes where no quads are made
  std::shared_ptr<const Attempt<FieldAndMap>> seamless_map;
  std::shared_ptr<const Attempt<GridMapping>> grid;
  std::shared_ptr<const MeshedQuads> quads;
  std::shared_ptr<const Pictures> quads_pictures;
  std::shared_ptr<const UprightModel> upright;
  std::shared_ptr<const LayeredSpace> layered_space;
  std::shared_ptr<const FeatureMesh> hex_plan_problem;
  std::shared_ptr<const MeshedQuads> hex_plan;
  std::shared_ptr<const Pictures> hex_plan_pictures;
  std::shared_ptr<const SmoothedHexes> smoothed_hexes;
  std::shared_ptr<const CheckedHexes> hexes;
  std::shared_ptr<const SimulationFiles> simulation;
  std::shared_ptr<const Pictures> hexes_pictures;
  std::shared_ptr<const FramedMesh> frames;
  std::shared_ptr<const VolumeMesh> tets;
  std::shared_ptr<const VolumeQualityReport> tets_quality;
  std::shared_ptr<const Pictures> tets_pictures;
};

}  // namespace strataflow
