#pragma once
#include <cstdint>
#include <vector>

#include "model/quad_mesh.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// Hexahedra in layers over a plan mesh: one cell for every quad and layer (coudert2024 S14). Cell c stands over quad
/// cell_column[c] in layer cell_layer[c]; its VTK corners 0…3 lie over the quad's corners 0…3 at the layer's lower
/// level, 4…7 at its upper one. Layers count from the bottom.
struct HexGrid {
  VolumeMesh mesh;                         ///< facets name horizons, faults, sides; regions per cell
  QuadMesh plan;                           ///< columns
  std::uint32_t layers = 0;
  std::vector<std::uint32_t> cell_column;  ///< per cell
  std::vector<std::uint32_t> cell_layer;   ///< per cell
  std::vector<std::uint8_t> is_dead;       ///< per cell: without volume, beside an unconformity
  template <class A>
  void archive(A& a) {
    a(mesh, plan, layers, cell_column, cell_layer, is_dead);
  }
};

}  // namespace strataflow
