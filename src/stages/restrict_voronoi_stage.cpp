#include "stages/restrict_voronoi_stage.h"

#include "kernels/voronoi/restricted_diagram.h"

namespace strataflow {

Result<RestrictedDiagram> RestrictVoronoi::operator()(const BuiltModel& built, const SiteSet& sites,
                                                      StageContext&) const {
  if (sites.sites.empty()) return Failure{FailureCode::invalid_input, "there are no sites", "ask for more sites"};
  SiteNeighbours neighbours;
  neighbours.move_to(sites.sites);
  return restrict_to_triangles(built.model.points, built.model.triangles, neighbours);
}

}  // namespace strataflow
