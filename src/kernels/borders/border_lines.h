#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/topology/building/edge_table.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A contact between stones (euler1999 §2.9.1): the borders of all surfaces that coincide along it. In a welded mesh
/// they share their nodes, so one chain stands for all.
struct RadialBorder {
  std::vector<std::uint32_t>
      nodes;  ///< in order from the lexicographically lower end; closed: the first is not repeated
  bool is_closed = false;
  /// Least number of representative nodes (§2.9.2) over the borders that coincide here.
  std::uint32_t representative_count = 0;
  /// Surfaces around most of its edges whose order is known, cyclically, seen along the chain (§2.9.5); empty for fewer
  /// than three, where there is only one order.
  std::vector<std::uint32_t> radial_order;
  std::size_t edge_count() const { return is_closed ? nodes.size() : nodes.size() - 1; }
  /// Edges after resampling: n − 1, closed n; at least 2, a loop 3.
  std::size_t wanted_edge_count() const;
};

/// A welded mesh with its surfaces and contacts.
struct BorderNetwork {
  EdgeTable edges;
  std::vector<char> is_feature;           ///< per edge: it bounds surfaces
  std::vector<std::uint32_t> surface_of;  ///< per triangle
  std::uint32_t surface_count = 0;
  std::vector<RadialBorder> borders;  ///< contacts of two borders or more
  std::vector<char> is_stone;         ///< per point: end of a border, kept where it is
};

/// Finds the radial borders of a welded mesh: maximal chains along which the same surfaces meet, cut at nodes where the
/// chain turns by more than `corner_angle_deg`. Free borders (of one surface) are left out.
BorderNetwork find_radial_borders(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                  const std::vector<std::uint32_t>& triangle_patch, double corner_angle_deg);

/// The order of surfaces around edge `edge` seen from `from` along it, rotated to its least form; empty when fewer than
/// three or when it is ambiguous.
std::vector<std::uint32_t> surfaces_in_order(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                             const EdgeTable& edges, const std::vector<std::uint32_t>& surface_of,
                                             std::uint32_t edge, std::uint32_t from);

}  // namespace strataflow
