#pragma once
#include <gtest/gtest.h>

#include <filesystem>

#include "kernels/quality/analyze_volume_mesh.h"
#include "kernels/quality/check_mesh_against_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/volumes/tetrahedralize_model.h"
#include "model/triangle_soup.h"

namespace strataflow::support {

/// tools/tet_worker of this build.
inline std::filesystem::path tet_worker() {
  return std::filesystem::path(STRATAFLOW_BINARY_DIR) / "bin" / "tet_worker";
}

inline StructuralModel model_of(const TriangleSoup& soup) {
  Result<BuiltModel> built = build_structural_model(soup);
  return built ? std::move(built->model) : StructuralModel{};
}

inline Result<VolumeMesh> tetrahedralized(const StructuralModel& model, const TetrahedralizeOptions& options = {}) {
  return tetrahedralize_model(model, options, nullptr, tet_worker());
}

/// Checks by kernels that share no code with the mesher.
inline void expect_valid(const VolumeMesh& mesh, const StructuralModel& model) {
  const VolumeQualityReport report = analyze_volume_mesh(mesh);
  EXPECT_GT(report.cells, 0u);
  EXPECT_EQ(report.inverted, 0u);
  EXPECT_EQ(report.nonconforming_faces, 0u);
  EXPECT_EQ(report.faces_with_hanging_vertex, 0u);
  EXPECT_EQ(report.open_boundary_edges, 0u);
  EXPECT_EQ(report.per_region.size(), model.regions.size());
  for (const Violation& violation : check_mesh_against_model(mesh, model))
    ADD_FAILURE() << violation.kind << ": " << violation.what;
}

/// The first points are the model's own, bit for bit.
inline void expect_model_points_kept(const VolumeMesh& mesh, const StructuralModel& model) {
  ASSERT_GE(mesh.points.size(), model.points.size());
  for (std::size_t i = 0; i < model.points.size(); ++i) ASSERT_EQ(mesh.points[i], model.points[i]) << "point " << i;
}

}  // namespace strataflow::support
