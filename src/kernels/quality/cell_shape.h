#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "model/volume_mesh.h"

namespace strataflow {

/// Local vertices of a face, counter-clockwise seen from outside; the fourth of a triangle is `no_local_vertex`.
using LocalFace = std::array<std::uint8_t, 4>;
constexpr std::uint8_t no_local_vertex = 0xff;

/// A corner and the far ends of three of its edges: the determinant of the three edge vectors is positive in a good
/// cell. The first two edges of a prism's corner are those of its triangle.
struct CornerFrame {
  std::uint8_t corner;
  std::array<std::uint8_t, 3> ends;
};

/// A cell's faces and corner frames, in VTK's node order. Note the prism: VTK wants the normal of (0, 1, 2) to point
/// *out*, away from (3, 4, 5), the opposite of Gmsh, Abaqus and others.
///
/// The apex of a pyramid has four edges and no frame in `corners`; the trilinear map is singular there. It is judged by
/// the four frames of `apex_corners` (three neighbouring base corners seen from the apex), whose determinants are
/// those of the base corners, only the edge lengths differ.
struct CellShape {
  std::span<const LocalFace> faces;
  std::span<const CornerFrame> corners;
  std::span<const CornerFrame> apex_corners;
  /// 1 / (determinant over product of lengths) in the ideal cell: all edges equal, quadrilaterals square.
  double ideal_factor;
};

const CellShape& shape_of(CellType type);

}  // namespace strataflow
