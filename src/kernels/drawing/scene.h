#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/drawing/image.h"
#include "model/vector3.h"

namespace strataflow {

/// What a colour stands for.
struct LegendEntry {
  std::string name;
  Colour colour;
  template <class A>
  void archive(A& a) {
    a(name, colour);
  }
};

struct SceneTriangle {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t front_colour = 0;  ///< index into the legend, seen from the side its normal points to
  std::uint32_t back_colour = 0;   ///< seen from the other side
  std::uint8_t mesh_edges = 7;     ///< bit i: the edge from vertex i to the next is an edge of the mesh
  std::int8_t outside = 0;         ///< +1: the normal's side is outside the model; −1: the other side is; 0: neither
};

/// Opaque triangles and lines to draw. Indices must be in range.
struct Scene {
  std::vector<Vec3> points;
  std::vector<SceneTriangle> triangles;
  std::vector<std::array<std::uint32_t, 2>> lines;  ///< drawn bold, where no triangle hides them
  std::vector<LegendEntry> legend;
};

}  // namespace strataflow
