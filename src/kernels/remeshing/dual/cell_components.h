#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.h"
#include "base/result.h"
#include "kernels/voronoi/restricted_diagram.h"
#include "model/structural_model.h"

namespace strataflow {

/// A connected part of one surface inside one cell ("CC" of pellerin2014 §2.6).
struct SurfaceComponent {
  std::uint32_t site = 0;
  std::uint32_t surface = 0;
  std::int32_t euler = 1;  ///< 1 for a disc
  static constexpr bool is_flat = true;
};

/// A connected part of the lines inside one cell, through the corners it holds ("BC").
struct LineComponent {
  std::uint32_t site = 0;
  std::uint32_t line = 0;  ///< the lowest it is on; without corners it is on no other
  static constexpr bool is_flat = true;
};

/// The part of one edge of a line inside one cell, in the direction of the line.
struct LinePart {
  std::uint32_t component = 0;
  std::uint32_t line = 0;
  std::uint32_t site = 0;
  Vec3 begin, end;
};

/// What the cells of a diagram restricted to a model consist of, joined along shared segments and never by
/// coordinates (pellerin2014 §2.6). A *slot* is an edge of a piece, with its index in the diagram.
struct CellComponents {
  std::vector<std::uint32_t> slot_piece;
  /// The same segment seen from the other piece: of the neighbour cell in the triangle, or of the same cell across an
  /// edge of the mesh. no_index on lines.
  std::vector<std::uint32_t> slot_twin;
  std::vector<std::uint32_t> slot_part;    ///< on lines: the part; no_index elsewhere
  std::vector<std::uint32_t> slot_corner;  ///< corner of the model where a slot on a line ends, else no_index

  std::vector<SurfaceComponent> surfaces;           ///< ascending by site
  std::vector<std::uint32_t> piece_component;       ///< per piece of the diagram
  std::vector<std::uint32_t> pieces_begin, pieces;  ///< per surface component, ascending

  std::vector<LineComponent> lines;                   ///< ascending by site
  std::vector<LinePart> parts;                        ///< line by line, in order along it
  std::vector<std::uint32_t> line_begin;              ///< per line of the model, plus one: its parts
  std::vector<std::uint32_t> corner_component;        ///< per corner of the model: the line component that holds it
  std::vector<std::uint32_t> corners_begin, corners;  ///< per line component, ascending
  std::vector<std::uint32_t> parts_begin, part_ids;   ///< per line component, ascending

  /// The borders of surface components: closed walks over slots that bisect cells or lie on lines, interior on the
  /// left. Ascending by component.
  std::vector<std::uint32_t> loop_begin, loop_slots, loop_component;
  std::vector<std::uint32_t> touched_begin, touched;  ///< per surface component: line components it touches, ascending

  std::vector<std::uint32_t> site_surfaces, site_lines;  ///< per site, plus one: its first surface and line component

  std::span<const std::uint32_t> loop(std::size_t index) const {
    return {loop_slots.data() + loop_begin[index], loop_slots.data() + loop_begin[index + 1]};
  }
  std::span<const std::uint32_t> corners_of(std::uint32_t line_component) const {
    return {corners.data() + corners_begin[line_component], corners.data() + corners_begin[line_component + 1]};
  }
  std::span<const std::uint32_t> parts_of(std::uint32_t line_component) const {
    return {part_ids.data() + parts_begin[line_component], part_ids.data() + parts_begin[line_component + 1]};
  }
  std::span<const std::uint32_t> pieces_of(std::uint32_t component) const {
    return {pieces.data() + pieces_begin[component], pieces.data() + pieces_begin[component + 1]};
  }
  std::span<const std::uint32_t> touched_by(std::uint32_t component) const {
    return {touched.data() + touched_begin[component], touched.data() + touched_begin[component + 1]};
  }
  bool is_on_line(std::uint32_t slot) const { return slot_part[slot] != no_index; }
};

/// The next and the previous slot of the same piece.
std::uint32_t next_in_piece(const RestrictedDiagram& diagram, std::uint32_t piece, std::uint32_t slot);
std::uint32_t previous_in_piece(const RestrictedDiagram& diagram, std::uint32_t piece, std::uint32_t slot);

/// `diagram` is of the model's triangles and `site_count` sites. Fails with unsupported where a surface has no
/// coherent orientation.
Result<CellComponents> find_cell_components(const StructuralModel& model, const RestrictedDiagram& diagram,
                                            std::size_t site_count);

}  // namespace strataflow
