#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Sine of the smallest angle of a triangle, negative where it faces away from `normal`; 0 if degenerate.
double signed_sharpness(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal);

/// Appends the triangles of a polygon of different corners to `triangles`, turning like it: of all triangulations the
/// one whose worst triangle is best in the sense of signed_sharpness, the first where equal. Returns that worst value;
/// 1 where there are fewer than three corners.
double triangulate_polygon(std::span<const std::uint32_t> corners, std::span<const Vec3> positions, const Vec3& normal,
                           std::vector<Triangle>& triangles);

/// Splits a closed walk into polygons that pass no corner twice; what is left of fewer than three corners is dropped.
void split_at_repeats(std::vector<std::uint32_t> walk, std::vector<std::vector<std::uint32_t>>& polygons);

}  // namespace strataflow
