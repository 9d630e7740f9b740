#pragma once
#include <string>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// A border that ends free although a surface is near all along it.
struct Leak {
  std::uint32_t entity = 0;
  std::uint32_t onto = 0;
  double gap_m = 0;  ///< the largest along the border
  std::string text;  ///< "H2 stops 12.4 m short of F3 at (…)"
};

/// Borders between stones, free (one triangle in all) along most of their edges, all of which lie within
/// `search_distance_m` of one other surface and face it. Faults may die where they are: theirs count up to
/// three tenths of that distance, and where they passed through the surface up to `sealing_distance_m`. Then horizons
/// and unconformities with any free border edge from which a surface is met within `sealing_distance_m`. In the order
/// of find_contacts, then of find_gaps.
std::vector<Leak> find_leaks(const TriangleSoup& soup, double sealing_distance_m, double search_distance_m);

/// Entities of which a connected piece touches no other surface at all, ascending.
std::vector<std::uint32_t> find_loose_entities(const TriangleSoup& soup);

}  // namespace strataflow
