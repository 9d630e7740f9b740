#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "kernels/hexes/layered_space.h"
#include "kernels/hexes/refine_tets.h"
#include "kernels/hexes/stratigraphic_function.h"
#include "kernels/reference_models/extrudable_models.h"
#include "kernels/reference_models/seal_columns.h"
#include "kernels/volumes/filled_model.h"
#include "model/quad_mesh.h"

namespace strataflow::support {

/// A reference model filled with tetrahedra.
inline VolumeMesh filled(const ColumnModel& columns, double edge_m, TetrahedralizeOptions options = {}) {
  if (!options.radius_edge_ratio) options.radius_edge_ratio = 1.8;
  Result<VolumeMesh> mesh = tetrahedralized(model_of(seal_columns(columns, edge_m)), options);
  EXPECT_TRUE(mesh) << describe(mesh.failure());
  return mesh ? std::move(*mesh) : VolumeMesh{};
}

/// The same, labelled and with its levels.
struct LevelledTets {
  LabelledTets tets;
  StratigraphicLevels levels;
};

inline LevelledTets levelled(const VolumeMesh& mesh, const std::vector<std::string>& drop_alignment = {}) {
  LevelledTets result;
  Result<LabelledTets> tets = label_tets(mesh, drop_alignment);
  EXPECT_TRUE(tets) << describe(tets.failure());
  if (!tets) return result;
  Result<StratigraphicLevels> levels = find_stratigraphic_levels(*tets);
  EXPECT_TRUE(levels) << describe(levels.failure());
  if (!levels) return result;
  result = {std::move(*tets), std::move(*levels)};
  split_level_chords(result.tets, result.levels);
  return result;
}

/// A plan of quads over the squares of a reference model's map, seen at height `z_m`, with its walls as features.
inline QuadMesh plan_of(const ColumnModel& columns, double edge_m, double z_m = 0) {
  const ColumnMap map = columns.map(edge_m);
  QuadMesh plan;
  std::vector<std::uint32_t> block(map.points.size(), 0);
  for (const MapTriangle& t : map.triangles)
    for (const std::uint32_t p : t.corners) block[p] = t.block;
  for (std::uint32_t p = 0; p < map.points.size(); ++p) {
    plan.points.push_back(columns.at(block[p], map.points[p], z_m));
    plan.points.back().z = 0;
  }
  for (std::size_t t = 0; t + 1 < map.triangles.size(); t += 2) {
    const auto &lower = map.triangles[t].corners, &upper = map.triangles[t + 1].corners;
    plan.quads.push_back({lower[0], lower[1], lower[2], upper[2]});
  }
  for (const Entity& entity : columns.entities) plan.features.push_back({entity.name, entity.role, 0, -1});
  for (const Wall& wall : map.walls)
    plan.edges.push_back({std::min(wall.ends[0], wall.ends[1]), std::max(wall.ends[0], wall.ends[1]), wall.entity});
  std::sort(plan.edges.begin(), plan.edges.end());
  return plan;
}

/// Layers of a model whose faults stand upright already.
inline LayeredSpace upright(const VolumeMesh& mesh, const LayerOptions& options = {}) {
  LevelledTets model = levelled(mesh);
  std::vector<Vec3> plan = model.tets.points;
  for (Vec3& p : plan) p.z = 0;
  Result<LayeredSpace> space =
      build_layered_space(std::move(model.tets), std::move(model.levels), std::move(plan), options);
  EXPECT_TRUE(space) << describe(space.failure());
  return space ? std::move(*space) : LayeredSpace{};
}

inline LayeredSpace layered(const VolumeMesh& mesh, const LayeredSpaceOptions& options = {}) {
  Result<LayeredSpace> space = make_layered_space(mesh, options);
  EXPECT_TRUE(space) << describe(space.failure());
  return space ? std::move(*space) : LayeredSpace{};
}

/// plan_of, led to where the space puts the points of the bottom. Needs the resolution the tetrahedra come from.
inline QuadMesh plan_in(const LayeredSpace& space, const ColumnModel& columns, double edge_m) {
  QuadMesh plan = plan_of(columns, edge_m, columns.box.low.z);
  std::map<std::array<double, 2>, std::uint32_t> at_bottom;
  for (std::uint32_t p = 0; p < space.model.points.size(); ++p)
    if (space.model.points[p].z == columns.box.low.z)
      at_bottom.emplace(std::array{space.model.points[p].x, space.model.points[p].y}, p);
  for (Vec3& p : plan.points) {
    const auto found = at_bottom.find({p.x, p.y});
    EXPECT_TRUE(found != at_bottom.end()) << p.x << ", " << p.y;
    if (found != at_bottom.end()) p = space.plan[found->second];
  }
  return plan;
}

inline double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(b - a, cross(c - a, d - a));
}

}  // namespace strataflow::support
