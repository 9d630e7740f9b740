#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernels/remeshing/dual/dual_polygons.h"

namespace strataflow {

enum class CleanUpKind : std::uint8_t {
  valence_3,    ///< a point inside a surface with three triangles: one took their place
  free_border,  ///< a triangle with three points in a row of a free border: it is gone, the border passes the middle by
  contact,  ///< a triangle with three points in a row of a contact: an edge of it was collapsed in all surfaces there
  flip      ///< the same at a corner, or where no collapse may be: the middle was linked to the triangle behind
};

std::string_view to_string(CleanUpKind kind);

struct CleanUp {
  CleanUpKind kind = CleanUpKind::valence_3;
  std::uint32_t site = 0;     ///< whose point is gone
  std::uint32_t element = 0;  ///< surface or line of the model
};

struct CleanUpReport {
  std::vector<CleanUp> done;  ///< in the order they were done
  std::vector<CleanUp>
      refused;  ///< a triangle on a contact that nothing can take away: the mesh would fold or be pinched
};

/// Takes away what tiny triangular surface components leave (pellerin2014 §2.8, Alg 4.4 with code 12 as 9), until there
/// is none that may go. Triangles on a line go where it bends by less than 30 degrees, or where two surfaces share
/// them. Corners, ends of lines and points of several lines never go; no collapse changes how surfaces touch, turns a
/// triangle over or flattens one.
CleanUpReport clean_up_dual(const StructuralModel& model, DualMesh& mesh);

}  // namespace strataflow
