#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/cut_result.h"
#include "model/triangle_soup.h"

namespace strataflow {

struct CutSurfacesOptions {
  /// Names of the entities that are cut, and of those that cut them. Empty: all. An entity may be in both.
  std::vector<std::string> cut = {};
  std::vector<std::string> cutting = {};
  double tolerance_m = 0;  ///< input points closer than this become one before cutting; 0: only equal ones
  /// Points of intersection closer than this to an input point, or to each other, become one after cutting (euler1999
  /// §2.3.5); 0: only equal ones.
  double intersection_tolerance_m = 0;
  /// Write a point property `inserted_by_cut`: 1 at points the cut made. It is what remove_scars needs to undo the cut
  /// and costs eight bytes a point. Where the input has it, it is kept up to date whatever this says.
  bool mark_inserted = false;
};

/// Cuts surfaces along everything they share, with each other and with themselves (euler1999 §2.3, §2.6). The result
/// conforms vertex for vertex, holds no improper intersection among what was cut, and keeps entities, patches and
/// point properties (interpolated linearly in the triangle a piece comes from). Coordinates are rounded once; where
/// that made new intersections, the places are cut again and points nearer than a few units in the last place become
/// one (input points stay where they are), which `report` tells. Triangles of zero area and triangles given twice in
/// one entity are dropped and told. Records of a file about its own borders are kept only where nothing was cut.
/// Fails with invalid_options for a name that is no entity.
Result<CutResult> cut_surfaces(const TriangleSoup& soup, const CutSurfacesOptions& options = {});

}  // namespace strataflow
