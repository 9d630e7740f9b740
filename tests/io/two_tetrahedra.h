#pragma once
#include <limits>

#include "model/structural_model.h"

namespace strataflow::support {

/// Two tetrahedra on either side of one triangle, which is a fault. Its border is one contact, cut into two lines by
/// two corners. Every list of a StructuralModel has something in it.
inline StructuralModel two_tetrahedra() {
  StructuralModel model;
  model.local_origin = {5e6, 4e6, 0};
  model.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1}, {0.25, 0.25, -1}};
  for (const Vec3& point : model.points) model.box.take(point);
  model.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  model.triangle_surface = {0, 1, 1, 1, 2, 2, 2};
  model.entities = {{"F1", Role::fault}, {"box", Role::boundary}};
  model.corners = {{0}, {1}};
  model.lines = {{{0, 1}, {0, 1}, {0, 1, 2}}, {{1, 2, 0}, {1, 0}, {0, 1, 2}}};
  model.surfaces = {
      {0, {0, 1}, 0, 1, {0, 1}, 0, 1}, {1, {1}, 1, 4, {0, 1}, universe, 0}, {1, {1}, 4, 7, {0, 1}, universe, 1}};
  model.frontiers = {
      {{{0, 1}, {1, 0}}, 0, 1, 1.0 / 6}, {{{0, 0}, {2, 0}}, 1, 1, 1.0 / 6}, {{{1, 1}, {2, 1}}, universe, -1, -1.0 / 3}};
  model.regions = {{"above", 0, {}, 1.0 / 6}, {"below", 1, {}, 1.0 / 6}};
  model.layers = {{"sand", {0, 1}}};
  model.point_line = {-1, -1, 1, -1, -1};
  model.point_corner = {0, 1, -1, -1, -1};
  model.properties = {{"porosity", "1", 1, {0.1, 0.2, 0.3, 0.4, std::numeric_limits<double>::quiet_NaN()}},
                      {"slip", "m", 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}};
  model.is_sealed = true;
  return model;
}

}  // namespace strataflow::support
