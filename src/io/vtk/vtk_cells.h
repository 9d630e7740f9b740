#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "io/input/input_builder.h"

namespace strataflow {

/// Cells of one kind: cell c owns vertices[offsets[c-1] … offsets[c]), the first from 0.
struct VtkCellList {
  std::vector<std::int64_t> vertices, offsets;
};

/// One piece of a VTK data set, as its legacy and XML files hold it. PolyData has verts, lines, polys, strips, whose
/// cell data follow each other in that order; an unstructured grid has cells and types.
struct VtkPiece {
  std::int64_t first_point = 0;  ///< of the piece among the builder's points, which are all there already
  VtkCellList verts, lines, polys, strips;
  VtkCellList cells;
  std::vector<std::int64_t> types;
  std::vector<std::int64_t> surface, entity, region;  ///< per cell, or empty
};

/// Cells a reader passed over, counted by kind.
class SkippedCells {
 public:
  void add(const std::string& kind) { ++counts_[kind]; }
  void report(InputBuilder& built) const {
    for (const auto& [kind, count] : counts_) built.warn("skipped_cells", std::to_string(count) + " x " + kind);
  }

 private:
  std::map<std::string, std::size_t> counts_;
};

/// Adds the cells of a piece. `entity_ids`: the builder's id of each entity the file names; may be empty.
/// Fails with malformed_file: offsets out of order, a point, label or number of vertices that cannot be.
Result<void> add_vtk_piece(InputBuilder& built, SkippedCells& skipped, const VtkPiece& piece,
                           const std::vector<std::uint32_t>& entity_ids);

/// Turns tetrahedra, pyramids, prisms, hexahedra of MEDIT, Gmsh and Abaqus into VTK's node order, and back: only
/// the prism differs, whose first triangle looks out in VTK and in elsewhere.
void swap_prism_order(CellType type, std::uint32_t* vertices);

}  // namespace strataflow
