#include "stages/simplify_borders_stage.h"

#include <array>
#include <cstdio>
#include <string>

#include "kernels/borders/simplify_borders.h"

namespace strataflow {

namespace {

std::string place(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", p.x, p.y, p.z);
  return text;
}

}  // namespace

Result<InputData> SimplifyBorders::operator()(const CutResult& sealed, StageContext& context) const {
  InputData data;
  data.surfaces = sealed.soup;
  if (!options.borders) return data;
  Result<SimplifiedSoup> simplified = simplify_borders(data.surfaces, {options.passes, options.corner_angle_deg});
  if (!simplified) return simplified.failure();
  const SimplificationReport& report = simplified->report;
  if (report.passes > 0)
    context.warn("borders_simplified", std::to_string(report.border_count) +
                                           " contacts: " + std::to_string(report.nodes_before) +
                                           " inner nodes became " + std::to_string(report.nodes_after) + "; " +
                                           std::to_string(report.relaxed_nodes) + " nodes beside them moved");
  constexpr std::array<std::string_view, 5> texts{"a triangle beside it would turn over", "surfaces would pinch",
                                                  "a surface would vanish", "triangles would cross",
                                                  "surfaces around it would change their order"};
  for (const RefusedBorder& border : report.refused)  // those without a gain are good as they are
    if (border.reason != BorderRefusal::no_gain)
      context.warn("border_kept", "the contact from " + place(data.surfaces.local_origin + border.from) + " to " +
                                      place(data.surfaces.local_origin + border.to) + " keeps its nodes: " +
                                      std::string(texts[static_cast<std::size_t>(border.reason)]));
  data.surfaces = std::move(simplified->soup);
  return data;
}

}  // namespace strataflow
