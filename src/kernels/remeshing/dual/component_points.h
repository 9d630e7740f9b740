#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/remeshing/dual/cell_components.h"

namespace strataflow {

/// What a point of the dual stands on; a higher one decides where merged points go.
enum class PointKind : std::uint8_t { surface, line, corner };

struct DualPoint {
  Vec3 position;
  std::uint32_t site = 0;
  PointKind kind = PointKind::surface;
  std::uint32_t element = 0;  ///< the corner, line or surface of the model it lies on
};

/// Why points of one cell became one (steps 2, 3 and 4 of Algorithm 4.2).
enum class MergeKind : std::uint8_t { linked_corners, beyond_two_points, resolution };

std::string_view to_string(MergeKind kind);

struct PointMerge {
  MergeKind kind = MergeKind::resolution;
  std::uint32_t site = 0;
  double distance_m = 0;                                ///< of the pieces, where kind is resolution
  std::vector<std::uint32_t> corners, lines, surfaces;  ///< what the merged points stood on, ascending
};

/// Which points of a cell may become one. The defaults are the thesis's. Without the first two the dual keeps every
/// corner and border apart, at the price of smaller triangles.
struct MergeOptions {
  bool merges_linked_corners = true;     ///< corners that lines link inside the cell
  bool merges_beyond_two_points = true;  ///< all points of a surface component that has more than two
  double resolution_m = 0;               ///< points whose pieces of the model are nearer than this; 0: none
  double most_move_m = 0;                ///< > 0: of these only where the common point lies so near to all their pieces
  bool follows_bends = false;  ///< a line has its point where it bends most inside the cell, else half way along it
  std::vector<char> unmerged_sites = {};  ///< per site whose points stay apart; sites beyond its end may merge theirs
  bool merges_different_roles = false;   ///< of pieces nearer than resolution_m also those with no role in common
  /// Points on a boundary never merge with points off it, nor a point on two sides with one that lacks one of them,
  /// unless it moves onto it.
  bool keeps_boundary = true;
};

struct ComponentPoints {
  std::vector<DualPoint> points;             ///< ascending by site
  std::vector<std::uint32_t> corner_point;   ///< per corner of the model
  std::vector<std::uint32_t> line_point;     ///< per line component; no_index where it holds corners
  std::vector<std::uint32_t> surface_point;  ///< per surface component; no_index where it touches lines
  std::vector<PointMerge> merges;            ///< ascending by site
};

/// Algorithm 4.2 of pellerin2014 (§2.7.2): a point for each corner, each line component without corners and each
/// surface component that touches no line, merged as options say. Merging in one surface component reaches others, so
/// step 3 is repeated until nothing changes. Merged points stand on one of those of the highest kind.
ComponentPoints place_component_points(const StructuralModel& model, const RestrictedDiagram& diagram,
                                       const CellComponents& components, const MergeOptions& options = {});

}  // namespace strataflow
