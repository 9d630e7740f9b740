#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Removes the points that no triangle uses, and records about them; the others keep their order. `is_kept`, per point,
/// saves some. Returns, per point left, the point it was.
std::vector<std::uint32_t> drop_unused_points(TriangleSoup& soup, std::vector<char> is_kept);

}  // namespace strataflow
