#include "kernels/remeshing/dual/boundary_sides.h"

#include "kernels/topology/union_find.h"

namespace strataflow {

std::vector<std::uint32_t> find_boundary_sides(const StructuralModel& model) {
  constexpr double cosine_of_one_side = 0.9;
  const std::size_t count = model.surfaces.size();
  std::vector<char> is_boundary(count, 0);
  bool has_boundary = false;
  for (std::size_t s = 0; s < count; ++s)
    for (const std::uint32_t entity : model.surfaces[s].all_entities)
      if (model.entities[entity].role == Role::boundary) is_boundary[s] = has_boundary = true;
  if (!has_boundary)
    for (std::size_t s = 0; s < count; ++s)
      is_boundary[s] = (model.surfaces[s].region_plus == universe) != (model.surfaces[s].region_minus == universe);

  std::vector<Vec3> normals(count);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const auto& [a, b, c] = model.triangles[t];
    Vec3& normal = normals[model.triangle_surface[t]];
    normal = normal + cross(model.points[b] - model.points[a], model.points[c] - model.points[a]);
  }
  UnionFind sides(count);
  for (const Line& line : model.lines)
    for (const std::uint32_t a : line.surfaces)
      for (const std::uint32_t b : line.surfaces)
        if (a < b && is_boundary[a] && is_boundary[b] && model.surfaces[a].entity == model.surfaces[b].entity &&
            std::abs(dot(normals[a], normals[b])) > cosine_of_one_side * length(normals[a]) * length(normals[b]))
          sides.unite(a, b);
  std::vector<std::uint32_t> side_of(count, no_index);
  for (std::uint32_t s = 0; s < count; ++s)
    if (is_boundary[s]) side_of[s] = sides.find(s);
  return side_of;
}

}  // namespace strataflow
