#pragma once
#include "kernels/remeshing/guarded/guarded_mesh.h"
#include "kernels/remeshing/guarded/guarded_shapes.h"

namespace strataflow::support {

/// A mesh with its model and everything it refers to.
class MeshOfSoup {
 public:
  explicit MeshOfSoup(const TriangleSoup& soup, double distance_m = 1, double turn_angle_deg = 80)
      : model(built(soup)),
        inputs(model),
        mesh(inputs, {.distance_m = distance_m, .turn_angle_deg = turn_angle_deg, .cell_m = 1}) {}
  std::uint32_t at(const Vec3& p) const {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.is_alive_vertex(v) && length(mesh.point(v) - p) < 1e-9) return v;
    ADD_FAILURE() << "no vertex at " << p.x << " " << p.y << " " << p.z;
    return 0;
  }
  std::size_t alive() const { return mesh.triangles_in_order().size(); }
  void expect_valid() const { expect_same_structure(model, built(mesh.soup())); }

  StructuralModel model;
  InputSurfaces inputs;
  GuardedMesh mesh;
};

}  // namespace strataflow::support
