#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/id.h"
#include "kernels/contacts/contact_mesh.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "model/box3.h"

namespace strataflow {

/// Where something meets a surface.
struct Impact {
  std::uint32_t triangle = no_index;
  Vec3 point;
  double distance_m = 0;
};

/// The point of the triangle abc nearest to p. A coordinate that all three corners share stays exactly theirs.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
/// The point of the segment ab nearest to p, likewise.
Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Finds places on one entity of a mesh. Triangles may be split after it was built, but not moved (see moves_of) by
/// more than the tolerance the queries are asked with. Keeps a reference to the mesh. Safe to read from several
/// threads.
class SurfaceSearch {
 public:
  SurfaceSearch(ContactMesh& mesh, std::uint32_t entity);

  std::uint32_t entity() const { return entity_; }
  bool is_stale() const { return mesh_.moves_of(entity_) != moves_; }
  /// The nearest place within `limit_m`; of equal ones that of the lowest triangle.
  std::optional<Impact> nearest(const Vec3& p, double limit_m) const;
  /// The nearest hit of the line p ± t direction, t ≤ reach_m (euler1999 §2.4.1). `direction` has length 1.
  std::optional<Impact> along(const Vec3& p, const Vec3& direction, double reach_m) const;
  /// Calls visit(triangle) for every triangle whose place in the tree overlaps the cube p ± radius.
  template <class Visit>
  void visit_near(const Vec3& p, double radius_m, Visit&& visit) const {
    visit_in({p - Vec3{radius_m, radius_m, radius_m}, p + Vec3{radius_m, radius_m, radius_m}}, visit);
  }

 private:
  template <class Visit>
  void visit_in(const Box3& box, Visit&& visit) const {
    tree_.visit_items(enclosing(box), [&](std::uint32_t item) {
      for (std::uint32_t t = items_[item]; t != no_index; t = mesh_.next_piece(t))
        if (mesh_.is_alive(t)) visit(t);
    });
  }

  const ContactMesh& mesh_;
  std::uint32_t entity_, moves_;
  std::vector<std::uint32_t> items_;
  BoundingVolumeTree tree_;
};

}  // namespace strataflow
