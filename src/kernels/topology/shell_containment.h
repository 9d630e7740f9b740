#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// Where a vertical ray from `p` upward meets one triangle. Decided exactly; ties are broken by moving p an
/// infinitely small step in x and an infinitely smaller one in y, so every closed surface is crossed consistently.
enum class RayMeeting : std::uint8_t { misses, crosses, starts_on };
RayMeeting meeting_of_upward_ray(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// −1 outside, 0 on it, +1 inside the closed shell made of the surfaces that have exactly one side in `sides`.
int place_in_shell(const StructuralModel& model, std::span<const SurfaceSide> sides, const Vec3& p);

}  // namespace strataflow
