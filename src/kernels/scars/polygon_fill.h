#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Which diagonal closes a hole of four sides (euler1999 §2.5.3).
enum class QuadDiagonal : std::uint8_t {
  through_node,  ///< the one that passes nearest to the deleted node: it recreates the edge the node stood on
  shortest       ///< the thesis' own choice, kept to reproduce its figures
};

/// A closed polygon seen along the main axis of its Newell normal. All tests on it are exact.
struct ProjectedPolygon {
  int axis = 2;
  int turn = 1;  ///< sign of orientation_2d of a counter-clockwise triangle seen along `axis`
};

/// The projection of a polygon of at least three nodes, or nothing if it crosses or touches itself there.
std::optional<ProjectedPolygon> project_polygon(const std::vector<Vec3>& points,
                                                std::span<const std::uint32_t> polygon);

/// Fills a closed polygon of 3 … n nodes with triangles of the polygon's own sense (euler1999 §2.5.4); nothing if its
/// projection crosses itself or no set of upright triangles fits. Of all fillings the one with the least sum of
/// (a² + b² + c²) / area is taken: in a plane that is the Delaunay one. `is_taken`, empty or n × n, forbids diagonals.
std::optional<std::vector<Triangle>> fill_polygon(const std::vector<Vec3>& points,
                                                  std::span<const std::uint32_t> polygon,
                                                  std::span<const char> is_taken = {});

/// The same for four nodes, by the wanted diagonal if both triangles are upright and it is free, else by the other.
/// Diagonal 0 runs between nodes 0 and 2, diagonal 1 between 1 and 3. Where a scar is straight both pass through the
/// node: `on_tie` decides.
std::optional<std::vector<Triangle>> fill_quad(const std::vector<Vec3>& points, std::span<const std::uint32_t> polygon,
                                               const Vec3& deleted_node, QuadDiagonal wanted,
                                               std::span<const char> is_taken = {}, std::size_t on_tie = 0);

/// Distance of `p` from the segment ab.
double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b);

}  // namespace strataflow
