#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/structural_model.h"
#include "model/triangle_soup.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// What every writer of surfaces needs, as a view: triangles, each on a surface, each surface of an entity.
/// Lives as long as what it was made from.
struct LabelledTriangles {
  Vec3 local_origin;
  std::span<const Vec3> points;
  std::span<const Triangle> triangles;
  std::span<const std::uint32_t> triangle_surface;
  std::vector<std::uint32_t> surface_entity;  ///< per surface: index into entities
  std::span<const Entity> entities;
  std::span<const std::int32_t> point_line;    ///< may be empty
  std::span<const std::int32_t> point_corner;  ///< may be empty
  std::span<const PointProperty> properties;

  /// The point in the file's own coordinates.
  Vec3 world(std::size_t point) const { return points[point] + local_origin; }
};

inline LabelledTriangles labelled_triangles(const StructuralModel& model) {
  LabelledTriangles view{model.local_origin, model.points,     model.triangles,    model.triangle_surface, {},
                         model.entities,     model.point_line, model.point_corner, model.properties};
  for (const Surface& surface : model.surfaces) view.surface_entity.push_back(surface.entity);
  return view;
}

/// The patches of a soup are its surfaces.
inline LabelledTriangles labelled_triangles(const TriangleSoup& soup) {
  return {soup.local_origin, soup.points, soup.triangles, soup.triangle_patch, soup.patch_entity, soup.entities, {}, {},
          soup.properties};
}

/// The triangles as facets of a mesh without cells, for formats that write both alike.
VolumeMesh facets_only(const LabelledTriangles& surfaces);

/// A name per surface for formats with named groups: its entity's, numbered (`F1_2`) where an entity has several.
/// Letters, digits, '_', '-' and '.' stay, others become '_'; no two are equal and none is empty.
std::vector<std::string> surface_names(std::span<const std::uint32_t> surface_entity, std::span<const Entity> entities);
/// The regions that have cells, ascending. Labels may leave gaps.
std::vector<std::int32_t> used_regions(const VolumeMesh& mesh);
/// A name for each of these regions, as above; those without one are called `region_1` …
std::vector<std::string> region_names(const VolumeMesh& mesh, const std::vector<std::int32_t>& regions);
/// Per cell: the place of its region in `regions`, or regions.size() when it has none.
std::vector<std::uint32_t> region_places(const VolumeMesh& mesh, const std::vector<std::int32_t>& regions);
/// Letters, digits, '_', '-' and '.' stay, others become '_'.
std::string plain_name(const std::string& name);

}  // namespace strataflow
