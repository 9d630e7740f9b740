#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Triangles, ascending, that may have the same three vertices as another: all that do, and a few that do not. Those
/// to leave out, if any, are marked in `is_left_out`. Far cheaper than sorting all of a mesh that repeats none.
std::vector<std::uint32_t> suspected_repeats(std::size_t point_count, const std::vector<Triangle>& triangles,
                                             const std::vector<char>& is_left_out = {});

}  // namespace strataflow
