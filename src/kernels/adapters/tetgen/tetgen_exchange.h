#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/triangle_soup.h"
#include "model/vector3.h"

namespace strataflow {

/// What the main program asks tools/tet_worker: one call of TetGen on a piecewise linear complex of triangles.
struct TetgenRequest {
  std::string switches;               ///< as on TetGen's command line, without '-'
  std::vector<Vec3> points;           ///< any unit; TetGen sees these numbers unchanged
  std::vector<Triangle> facets;       ///< indices into points; facet i gets the marker i + 1
  std::uint64_t memory_limit_mb = 0;  ///< address space of the worker; 0: unlimited
  template <class A>
  void archive(A& a) {
    a(switches, points, facets, memory_limit_mb);
  }
};

/// What the worker answers. The request's points come first, unchanged in number and order.
struct TetgenResponse {
  std::int32_t error = 0;  ///< what TetGen threw: 1 out of memory, 2 bug, 3 self-intersection, 4 tiny feature,
                           ///< 5 nearly coincident facets, 10 bad input; 0: all well
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 4>> tets;  ///< the first three turn counter-clockwise seen from the fourth
  std::vector<Triangle> subfaces;                  ///< triangles that lie on facets, orientation arbitrary
  std::vector<std::uint32_t> subface_facet;        ///< per subface: the facet it lies on
  template <class A>
  void archive(A& a) {
    a(error, points, tets, subfaces, subface_facet);
  }
};

}  // namespace strataflow
