#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "model/triangle_soup.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// What cutting met and did.
struct CutReport {
  std::uint64_t intersecting_pairs = 0;  ///< before cutting, among what may be cut
  std::uint64_t cut_triangles = 0;
  std::uint64_t new_points = 0;
  std::uint64_t pieces = 0;
  std::uint64_t merged_points = 0;       ///< by the tolerance, and where rounding had made intersections
  double largest_move_m = 0;             ///< of a merged point
  std::uint64_t dropped_triangles = 0;   ///< of zero area, or given twice
  std::uint64_t rounds = 0;              ///< of cutting; more than 1 where rounding made intersections
  std::uint64_t pairs_left = 0;          ///< improper pairs left among what may be cut
  template <class A>
  void archive(A& a) {
    a(intersecting_pairs, cut_triangles, new_points, pieces, merged_points, largest_move_m, dropped_triangles, rounds,
      pairs_left);
  }
};

/// Surfaces after cutting (and sealing), with what was done.
struct CutResult {
  TriangleSoup soup;
  CutReport report;
  std::vector<Change> changes;
  template <class A>
  void archive(A& a) {
    a(soup, report, changes);
  }
};

}  // namespace strataflow
