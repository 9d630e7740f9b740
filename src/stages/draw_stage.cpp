#include "stages/draw_stage.h"

#include <algorithm>

#include "io/write_png.h"
#include "kernels/drawing/build_scene.h"
#include "kernels/drawing/render.h"
#include "kernels/drawing/scene_of_quads.h"

namespace strataflow {

namespace {

Result<void> draw(Pictures& pictures, const Scene& scene, const std::string& caption, const ViewOptions& view) {
  if (scene.triangles.empty()) return {};
  const Image image = render(scene, view);
  Result<std::vector<std::byte>> png = encode_png(image.width, image.height, image.rgb);
  if (!png) return png.failure();
  const int exaggeration = static_cast<int>(view.vertical_exaggeration.value_or(automatic_exaggeration(scene)));
  pictures.pictures.push_back({caption + (exaggeration > 1 ? ", heights × " + std::to_string(exaggeration) : ""),
                               *std::move(png), scene.legend});
  return {};
}

ViewOptions page_view() {
  ViewOptions view;
  view.width = 900;
  view.height = 600;
  return view;
}

/// From above, north up.
ViewOptions plan_view() {
  ViewOptions view = page_view();
  view.azimuth_deg = -90;
  view.elevation_deg = 90;
  view.height = view.width;
  view.vertical_exaggeration = 1;
  return view;
}

}  // namespace

Result<Pictures> DrawModel::operator()(const BuiltModel& built, StageContext&) const {
  const StructuralModel& model = built.model;
  Pictures pictures;
  ViewOptions open = page_view();
  open.opens_front = true;
  Result<void> drawn = draw(pictures, scene_of_model(model, ColourBy::entity), "By entity, opened at the front", open);
  if (drawn && !model.regions.empty()) {
    drawn = draw(pictures, scene_of_model(model, ColourBy::region), "By region", page_view());
    if (drawn) drawn = draw(pictures, scene_of_exploded_regions(model), "Regions moved apart", page_view());
  }
  if (!drawn) return drawn.failure();
  return pictures;
}

Result<Pictures> DrawMesh::operator()(const VolumeMesh& mesh, StageContext&) const {
  Pictures pictures;
  const ViewOptions view = page_view();
  const Scene scene = scene_of_volume_mesh(mesh, middle_cut(mesh, view.azimuth_deg));
  if (const Result<void> drawn = draw(pictures, scene, "Cut open along the faces of the cells", view); !drawn)
    return drawn.failure();
  return pictures;
}

Result<Pictures> DrawQuads::operator()(const FeatureMesh& problem, const Attempt<FieldAndMap>& seamless,
                                       const Attempt<GridMapping>& grid, const MeshedQuads& quads,
                                       StageContext&) const {
  Pictures pictures;
  const bool is_plan = std::all_of(problem.points.begin(), problem.points.end(), [](const Vec3& p) { return p.z == 0; });
  const ViewOptions view = is_plan ? plan_view() : page_view();
  Result<void> drawn;
  if (seamless.why_not.empty())
    drawn = draw(pictures, scene_of_field(problem, seamless.value.field.field), "The field, on the triangles below", view);
  if (drawn && grid.why_not.empty())
    drawn = draw(pictures, scene_of_map(grid.value.mesh, grid.value.map), "Lines of whole numbers of the map", view);
  if (drawn) drawn = draw(pictures, scene_of_quads(quads.mesh), "Quads; bold: features", view);
  if (!drawn) return drawn.failure();
  return pictures;
}

Result<Pictures> DrawPlan::operator()(const MeshedQuads& quads, StageContext&) const {
  Pictures pictures;
  if (const Result<void> drawn = draw(pictures, scene_of_quads(quads.mesh), "Quads; bold: features", plan_view()); !drawn)
    return drawn.failure();
  return pictures;
}

}  // namespace strataflow
