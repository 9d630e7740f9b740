#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// A point moved an infinitely small step towards a second one, and an infinitely smaller one towards a third. The
/// three vertices of a triangle stand for a point of its interior, one vertex for itself.
using Place = std::span<const Vec3>;

/// Where a vertical ray from a place upward meets one triangle. Decided exactly; ties are broken by moving the place
/// still less in x and less again in y, so every closed surface is crossed consistently.
enum class RayMeeting : std::uint8_t { misses, crosses, starts_on };
RayMeeting meeting_of_upward_ray(Place place, const Vec3& a, const Vec3& b, const Vec3& c);
inline RayMeeting meeting_of_upward_ray(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return meeting_of_upward_ray(Place(&p, 1), a, b, c);
}

/// The sides whose other side is not among them: what remains of a frontier without the surfaces that end in its
/// region. `sides` is ascending.
std::vector<SurfaceSide> closed_shell_of(std::span<const SurfaceSide> sides);

/// −1 outside, 0 on it, +1 inside a closed shell.
int place_in_shell(const StructuralModel& model, std::span<const SurfaceSide> closed_shell, Place place);

}  // namespace strataflow
