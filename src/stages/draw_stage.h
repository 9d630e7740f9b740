#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/drawing/scene.h"
#include "model/built_model.h"
#include "model/volume_mesh.h"
#include "stages/extract_quads_stage.h"

namespace strataflow {

/// A picture as a page shows it.
struct Picture {
  std::string caption;
  std::vector<std::byte> png;
  std::vector<LegendEntry> legend;
  template <class A>
  void archive(A& a) {
    a(caption, png, legend);
  }
};

struct Pictures {
  std::vector<Picture> pictures;
  template <class A>
  void archive(A& a) {
    a(pictures);
  }
};

/// Draws a model by entity, by region, and with its regions moved apart.
struct DrawModel {
  static constexpr std::string_view name = "draw_model";
  static constexpr int version = 1;
  NoOptions options;

  Result<Pictures> operator()(const BuiltModel& built, StageContext& context) const;
};

/// Draws a volume mesh cut open along the faces of its cells.
struct DrawMesh {
  static constexpr std::string_view name = "draw_mesh";
  static constexpr int version = 1;
  NoOptions options;

  Result<Pictures> operator()(const VolumeMesh& mesh, StageContext& context) const;
};

/// Draws the field, the map and the quads; only what there is.
struct DrawQuads {
  static constexpr std::string_view name = "draw_quads";
  static constexpr int version = 1;
  NoOptions options;

  Result<Pictures> operator()(const FeatureMesh& problem, const Attempt<FieldAndMap>& seamless,
                              const Attempt<GridMapping>& grid, const MeshedQuads& quads, StageContext& context) const;
};

/// Draws quads alone, from above.
struct DrawPlan {
  static constexpr std::string_view name = "draw_plan";
  static constexpr int version = 1;
  NoOptions options;

  Result<Pictures> operator()(const MeshedQuads& quads, StageContext& context) const;
};

}  // namespace strataflow
