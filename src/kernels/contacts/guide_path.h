#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/contacts/contact_mesh.h"

namespace strataflow {

/// A plane given by three points; which side a point lies on is decided exactly.
struct GuidePlane {
  Vec3 a, b, c;
  int side_of(const Vec3& p) const;
};

/// Where a path meets the mesh: in a vertex (a == b) or inside the edge a–b.
struct PathNode {
  std::uint32_t a = 0, b = 0;
  Vec3 point;
  bool is_vertex() const { return a == b; }
};

/// The way from vertex `from` to vertex `to` on an entity along its section with the plane, shortest first: of the two
/// ways round a closed surface, the one that leaves toward `to` (euler1999 §2.4.5; a section is a curve, so a front
/// growing along it needs no graph). Crosses edges whose ends lie strictly on opposite sides, and passes through
/// vertices on the plane to every triangle of the entity there, whatever face it is of. Without its two ends. Nothing
/// if they are not joined within `max_length_m`.
std::optional<std::vector<PathNode>> find_guide_path(const ContactMesh& mesh, std::uint32_t entity, std::uint32_t from,
                                                     std::uint32_t to, const GuidePlane& plane, double max_length_m);

}  // namespace strataflow
