#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

struct TrimmedPiece {
  std::uint32_t entity = 0;
  std::uint64_t triangle_count = 0;
  double area_m2 = 0;
  Vec3 where;
};

struct TrimmedSurfaces {
  TriangleSoup soup;
  std::vector<TrimmedPiece> pieces;  ///< in the order they went
};

/// Takes away what juts out past contacts: pieces of surfaces between contacts and a free border, every point of which
/// lies within `distance_m` of both (per entity `entity_distance_m`, if given). A surface that truly ends inside (a
/// dying fault) reaches further and stays. What only such pieces held in place goes with them. The surfaces conform
/// vertex for vertex.
TrimmedSurfaces trim_overshoot(const TriangleSoup& soup, double distance_m,
                               const std::vector<double>& entity_distance_m = {});

}  // namespace strataflow
