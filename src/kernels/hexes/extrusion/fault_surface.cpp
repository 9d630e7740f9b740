#include "kernels/hexes/extrusion/fault_surface.h"

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

FaultSurface::FaultSurface(const LabelledTets& model, std::uint32_t entity, const std::vector<Vec3>& points)
    : points_(&points) {
  for (const SheetFacet& facet : model.facets)
    if (facet.kind == SheetKind::fault && facet.entity == entity) triangles_.push_back(facet.vertices);
  std::vector<FloatBox> boxes;
  for (const Triangle& t : triangles_) {
    Box3 box;
    for (const std::uint32_t v : t) box.take((*points_)[v]);
    boxes.push_back(enclosing(box));
  }
  tree_ = BoundingVolumeTree(boxes);
}

bool FaultSurface::meets(const Vec3& a, const Vec3& b) const {
  Box3 box;
  box.take(a);
  box.take(b);
  bool is_met = false;
  tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
    const Vec3 &p = (*points_)[triangles_[t][0]], &q = (*points_)[triangles_[t][1]], &r = (*points_)[triangles_[t][2]];
    const int from = orientation_3d(p, q, r, a), to = orientation_3d(p, q, r, b);
    if (is_met || from == to) return;
    const int u = orientation_3d(a, b, p, q), v = orientation_3d(a, b, q, r), w = orientation_3d(a, b, r, p);
    is_met = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  });
  return is_met;
}

}  // namespace strataflow
