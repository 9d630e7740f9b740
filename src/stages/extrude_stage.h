#pragma once
#include <cstdint>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/hexes/audit/hex_audit.h"
#include "kernels/hexes/live_cells.h"
#include "kernels/hexes/smooth_hexes.h"
#include "kernels/quality/analyze_volume_mesh.h"
#include "stages/extract_quads_stage.h"

namespace strataflow {

/// Hexahedra in layers (coudert2024 S14, S15): one per quad of the plan and layer.
struct Extrude {
  static constexpr std::string_view name = "extrude";
  static constexpr int version = 2;
  NoOptions options;

  Result<ExtrudedHexes> operator()(const LayeredSpace& space, const MeshedQuads& plan, StageContext& context) const;
};

/// A grid whose cells are as good as smoothing made them.
struct SmoothedHexes {
  ExtrudedHexes hexes;
  HexSmoothing smoothing;
  template <class A>
  void archive(A& a) {
    a(hexes, smoothing);
  }
};

/// [hex]: smoothing.
struct SmoothHexesStageOptions {
  std::int64_t smoothing_sweeps = 10;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(smoothing_sweeps, OptionField{.name = "smoothing_sweeps",
                                        .description = "Passes that move vertices where cells are worst; 0: none",
                                        .minimum = 0,
                                        .maximum = 10000});
  }
};

/// Improves the worst cells; horizons, faults, sides and wells keep their places.
struct SmoothHexes {
  static constexpr std::string_view name = "smooth_hexes";
  static constexpr int version = 3;
  SmoothHexesStageOptions options;

  Result<SmoothedHexes> operator()(const LayeredSpace& space, const ExtrudedHexes& hexes, StageContext& context) const;
};

/// The cells with a volume, and what they are worth.
struct CheckedHexes {
  LiveCells live;
  VolumeQualityReport quality;
  HexAudit audit;
  std::uint64_t singular_vertices = 0;  ///< of the plan: inner ones without four quads around them
  template <class A>
  void archive(A& a) {
    a(live, quality, audit, singular_vertices);
  }
};

/// Holds the grid against the model, and fails where a cell is inverted or faces away from faults do not conform: never
/// a silently wrong mesh. Regions whose volume differs by more than their steps explain are warnings (`region_volume`).
struct CheckHexes {
  static constexpr std::string_view name = "check_hexes";
  static constexpr int version = 2;
  NoOptions options;

  Result<CheckedHexes> operator()(const SmoothedHexes& hexes, const LayeredSpace& space, const MeshedQuads& plan,
                                  StageContext& context) const;
};

/// The live cells of a grid alone, for what works on any volume mesh.
struct TakeHexCells {
  static constexpr std::string_view name = "take_hex_cells";
  static constexpr int version = 1;
  NoOptions options;

  Result<VolumeMesh> operator()(const CheckedHexes& hexes, StageContext& context) const;
};

}  // namespace strataflow
