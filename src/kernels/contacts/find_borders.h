#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// A chain of border edges of one entity between two stones (euler1999 §2.1).
struct Border {
  std::uint32_t entity = 0;
  std::vector<std::uint32_t>
      points;  ///< in order, as indices into the soup's points; a closed border does not repeat its first
  std::vector<std::uint32_t> triangles;  ///< per edge: the triangle of the soup it belongs to
  bool is_closed = false;                ///< without any stone
  std::size_t edge_count() const { return triangles.size(); }
};

struct BorderOptions {
  double stone_angle_deg = 40;  ///< a border that turns by more has a stone there
};

/// The borders of every entity: edges that one triangle of it uses, once points of one position are one. A seam between
/// two patches of an entity is no border of it. Stones are where a border turns sharply, and where other than two
/// border edges meet. Ordered by entity, then by their first point.
std::vector<Border> find_borders(const TriangleSoup& soup, const BorderOptions& options = {});

}  // namespace strataflow
