#pragma once
#include <cstdint>

#include "base/result.h"
#include "kernels/hexes/layered_space.h"
#include "model/hex_grid.h"

namespace strataflow {

/// How corners on faults find their side (coudert2024 S14). The defaults are right; the others exist so that tests can
/// show what goes wrong.
struct ExtrudeOptions {
  double ball_ratio = 0.1;  ///< [0, 0.5]: radius of the search around a corner, in edge lengths of the quads and layers
  bool uses_barycentre_tet = false;  ///< extrapolate from the tetrahedron below the quad's centre, as the thesis prints
};

/// What extrusion met, for the report.
struct ExtrusionReport {
  std::uint64_t dead = 0;        ///< cells without volume
  std::uint64_t degenerate = 0;  ///< cells with a volume of which some vertical edge has no length
  std::uint64_t inverted = 0;    ///< other cells with a corner determinant ≤ 0
  std::uint64_t unreached = 0;   ///< corners on faults whose side no path leads to: the nearest tetrahedron was taken
  std::uint64_t squeezed = 0;    ///< places where a unit is thinner than its parallel layers: there they share it
  double largest_outside_m = 0;  ///< furthest a vertex lies outside the tetrahedra in UVW: weak verticality
  std::uint64_t bridged = 0;     ///< vertices between horizons, beside faults that need not be followed (BridgedLevels)
  double largest_bridged_m = 0;  ///< furthest one of these lies from where W is its own, or leaps over it
  template <class A>
  void archive(A& a) {
    a(dead, degenerate, inverted, unreached, squeezed, largest_outside_m, bridged, largest_bridged_m);
  }
};

struct ExtrudedHexes {
  HexGrid grid;
  ExtrusionReport report;
  template <class A>
  void archive(A& a) {
    a(grid, report);
  }
};

/// One hexahedron per quad and layer (coudert2024 S14, S15). `plan` lies in (U, V) and its features of role fault carry
/// the names of the model's faults. Vertical quads on a fault edge are faces of the fault where a ray through their
/// middle meets it; around every vertex, cells that no fault face parts share it. Volumetric faults (S20) are rows of
/// cells that join both sides; mesh.cell_entity names them, and the cells in the footprint of a well (S21). Facets:
/// horizons, top, bottom, sides and faults; two for each fault face with an offset, one where both sides match. Needs W
/// without gaps. Fails with: invalid_input (no quads, quads outside the model, a fault the model has not),
/// geometry_failed (more than 2³⁰ vertices).
Result<ExtrudedHexes> extrude_hexes(const LayeredSpace& space, const QuadMesh& plan,
                                    const ExtrudeOptions& options = {});

/// Counts dead, degenerate and inverted cells anew and sets `is_dead`.
void judge_cells(ExtrudedHexes& hexes);

}  // namespace strataflow
