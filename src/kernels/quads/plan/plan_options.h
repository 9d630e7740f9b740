#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/option_field.h"

namespace strataflow {

/// How curves of the plane become the triangulation that a quad mesh starts from.
struct PlanOptions {
  double edge_length_m = 0;             ///< wanted of quads, metres, > 0; 0: a hundredth of the domain's diagonal
  double move_ratio = 0.1;              ///< nothing moves further than this, in edge lengths
  double open_below_deg = 20;           ///< corners sharper than this are opened as far as move_ratio allows
  double triangle_ratio = 0.8;          ///< edge length of triangles where nothing asks for less, in edge lengths
  double corner_deg = 45;               ///< a curve that turns by more has a corner there
  double box_margin_ratio = 3;          ///< the box around curves without outline is grown by this, in edge lengths
  bool free_boundary = false;           ///< quads need not follow the outline
  std::optional<double> well_radius_m{};  ///< of circles around wells; an edge length if absent
  std::int64_t well_segments = 12;      ///< of these circles
  std::map<std::string, double> fault_thickness_m{};  ///< by name: such a fault becomes a strip of one row (S20)
  std::int64_t strip_quads = 1;                     ///< rows of quads across such a strip

  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(edge_length_m,
          OptionField{.name = "edge_length_m",
                      .description = "Wanted edge length of quads, metres; 0: a hundredth of the diagonal",
                      .minimum = 0});
    visit(move_ratio, OptionField{.name = "move_ratio",
                                  .description = "Cleaning moves nothing further than this, in edge lengths",
                                  .minimum = 0,
                                  .maximum = 0.5});
    visit(open_below_deg, OptionField{.name = "open_below_deg",
                                      .description = "Corners sharper than this are opened as far as move_ratio allows",
                                      .minimum = 0,
                                      .maximum = 45});
    visit(triangle_ratio, OptionField{.name = "triangle_ratio",
                                      .description = "Edge length of the triangles below the quads, in edge lengths",
                                      .minimum = 0.1,
                                      .maximum = 2});
    visit(corner_deg,
          OptionField{.name = "corner_deg",
                      .description = "Where a curve turns by more it has a corner, which is a vertex of quads",
                      .minimum = 20,
                      .maximum = 90});
    visit(box_margin_ratio,
          OptionField{.name = "box_margin_ratio",
                      .description = "How far the box around curves without an outline is grown, in edge lengths",
                      .minimum = 0.5,
                      .maximum = 1000});
    visit(free_boundary,
          OptionField{.name = "free_boundary", .description = "Whether quads need not follow the outline"});
    visit(well_radius_m,
          OptionField{.name = "well_radius_m",
                      .description = "Radius of the circle around a well, metres; an edge length if absent",
                      .minimum = 0,
                      .exclusive_minimum = true});
    visit(well_segments, OptionField{.name = "well_segments",
                                     .description = "Segments of the circle around a well",
                                     .minimum = 8,
                                     .maximum = 64});
    visit(fault_thickness_m,
          OptionField{.name = "fault_thickness_m",
                      .description = "Thickness of faults that become a strip of quads, by name, metres"});
    visit(strip_quads,
          OptionField{
              .name = "strip_quads", .description = "Rows of quads across such a strip", .minimum = 1, .maximum = 64});
  }
};

}  // namespace strataflow
