#pragma once
#include "kernels/hexes/audit/audit_hexes.h"
#include "kernels/hexes/extrude_hexes.h"
#include "kernels/hexes/tet_models.h"

namespace strataflow::support {

/// A reference model with hexahedra in it.
struct FilledGrid {
  LayeredSpace space;
  ExtrudedHexes hexes;
};

inline FilledGrid hexes_of(const ColumnModel& columns, double edge_m, std::int64_t layers = 2, bool is_upright = true) {
  const VolumeMesh tets = filled(columns, edge_m);
  FilledGrid result{is_upright ? upright(tets, {layers, {}, {}}) : layered(tets, {{}, {layers, {}, {}}, false, 600}),
                    {}};
  Result<ExtrudedHexes> hexes =
      extrude_hexes(result.space, is_upright ? plan_of(columns, edge_m) : plan_in(result.space, columns, edge_m));
  EXPECT_TRUE(hexes) << describe(hexes.failure());
  if (hexes) result.hexes = std::move(*hexes);
  return result;
}

inline HexAudit audited(const HexGrid& grid, const LabelledTets& model) {
  Result<HexAudit> audit = audit_hexes(grid, model);
  EXPECT_TRUE(audit) << describe(audit.failure());
  return audit ? std::move(*audit) : HexAudit{};
}
inline HexAudit audited(const FilledGrid& model) { return audited(model.hexes.grid, model.space.model); }

inline const SurfaceAudit& surface_named(const HexAudit& audit, std::string_view name) {
  for (const SurfaceAudit& surface : audit.surfaces)
    if (surface.name == name) return surface;
  ADD_FAILURE() << "no surface " << name;
  static const SurfaceAudit none;
  return none;
}

}  // namespace strataflow::support
