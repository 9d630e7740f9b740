#include "io/surface/write_obj.h"

#include <algorithm>
#include <numeric>

#include "io/text/number_text.h"

namespace strataflow {

std::string write_obj(const LabelledTriangles& surfaces) {
  std::string text = "# strataflow\n";
  for (std::size_t i = 0; i < surfaces.points.size(); ++i) {
    text += "v ";
    append_point(text, surfaces.world(i));
    text += '\n';
  }
  std::vector<std::uint32_t> order(surfaces.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return surfaces.triangle_surface[a] < surfaces.triangle_surface[b];
  });
  const std::vector<std::string> names = surface_names(surfaces.surface_entity, surfaces.entities);
  std::uint32_t surface = no_index, entity = no_index;
  for (const std::uint32_t t : order) {
    if (surfaces.triangle_surface[t] != surface) {
      surface = surfaces.triangle_surface[t];
      if (surfaces.surface_entity[surface] != entity) {
        entity = surfaces.surface_entity[surface];
        text += "o " + plain_name(surfaces.entities[entity].name) + "\n";
      }
      text += "g " + names[surface] + "\n";
    }
    text += 'f';
    for (const std::uint32_t vertex : surfaces.triangles[t]) {
      text += ' ';
      append_number(text, vertex + 1);
    }
    text += '\n';
  }
  return text;
}

}  // namespace strataflow
