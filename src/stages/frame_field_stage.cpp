#include "stages/frame_field_stage.h"

#include <algorithm>

#include "kernels/quads/map/loosen_features.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {

Result<std::vector<std::uint32_t>> loose_features(const FeatureMesh& mesh, const LooseCurves& curves) {
  std::vector<std::uint32_t> loose;
  for (const std::string& name : curves.loose) {
    const std::size_t before = loose.size();
    for (std::uint32_t f = 0; f < mesh.features.size(); ++f)
      if (mesh.features[f].name == name) loose.push_back(f);
    if (loose.size() > before) continue;
    std::string names;
    for (const Feature& feature : mesh.features) names += (names.empty() ? "" : ", ") + feature.name;
    return Failure{FailureCode::invalid_options, "quad.loose names '" + name + "', which is no curve of the plan",
                   "there are " + names};
  }
  std::sort(loose.begin(), loose.end());
  loose.erase(std::unique(loose.begin(), loose.end()), loose.end());
  if (loose.empty()) return loose;
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  for (const FeatureEdge& e : edges_of_features(mesh, loose))
    if (table.around(find_edge(table, e.a, e.b)).size() != 2)
      return Failure{FailureCode::invalid_options,
                     "quad.loose names '" + mesh.features[e.feature].name + "', which lies on the boundary",
                     "name curves inside, or set quad.free_boundary"};
  return loose;
}

Result<Attempt<FrameFieldResult>> ComputeFrameField::operator()(const FeatureMesh& mesh, StageContext&) const {
  const auto loose = loose_features(mesh, options.curves);
  if (!loose) return loose.failure();
  return attempted(compute_frame_field(loose->empty() ? mesh : without_features(mesh, *loose), options.field),
                   options.fallback);
}

}  // namespace strataflow
