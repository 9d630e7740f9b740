#include "io/input/labelled_triangles.h"

#include <algorithm>
#include <map>
#include <set>

namespace strataflow {

namespace {
/// Makes names differ from each other (and from the empty one) by a number behind those that come again.
std::vector<std::string> made_unique(std::vector<std::string> names) {
  std::set<std::string> taken;
  for (std::string& name : names) {
    std::string candidate = name;
    for (int number = 2; candidate.empty() || !taken.insert(candidate).second; ++number)
      candidate = name + "_" + std::to_string(number);
    name = candidate;
  }
  return names;
}
}  // namespace

VolumeMesh facets_only(const LabelledTriangles& surfaces) {
  VolumeMesh mesh;
  mesh.local_origin = surfaces.local_origin;
  mesh.points.assign(surfaces.points.begin(), surfaces.points.end());
  mesh.facets.reserve(surfaces.triangles.size());
  for (std::size_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Triangle& v = surfaces.triangles[t];
    mesh.facets.push_back({{v[0], v[1], v[2], no_index}, surfaces.triangle_surface[t], no_index, no_index});
  }
  mesh.surface_entity.assign(surfaces.surface_entity.begin(), surfaces.surface_entity.end());
  mesh.entities.assign(surfaces.entities.begin(), surfaces.entities.end());
  mesh.point_line.assign(surfaces.point_line.begin(), surfaces.point_line.end());
  mesh.point_corner.assign(surfaces.point_corner.begin(), surfaces.point_corner.end());
  return mesh;
}

std::string plain_name(const std::string& name) {
  std::string plain = name;
  for (char& c : plain)
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.')) c = '_';
  return plain;
}

std::vector<std::string> surface_names(std::span<const std::uint32_t> surface_entity,
                                       std::span<const Entity> entities) {
  std::map<std::uint32_t, int> count, number;
  for (const std::uint32_t entity : surface_entity) ++count[entity];
  std::vector<std::string> names;
  for (const std::uint32_t entity : surface_entity) {
    std::string name = entity < entities.size() ? plain_name(entities[entity].name) : "surface";
    if (count[entity] > 1) name += "_" + std::to_string(++number[entity]);
    names.push_back(name);
  }
  return made_unique(std::move(names));
}

std::vector<std::int32_t> used_regions(const VolumeMesh& mesh) {
  std::vector<std::int32_t> regions = mesh.cell_region;
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  regions.erase(regions.begin(), std::lower_bound(regions.begin(), regions.end(), 0));
  return regions;
}

std::vector<std::string> region_names(const VolumeMesh& mesh, const std::vector<std::int32_t>& regions) {
  std::vector<std::string> names;
  for (const std::int32_t region : regions) {
    const std::size_t r = static_cast<std::size_t>(region);
    const bool has_name = r < mesh.region_names.size() && !mesh.region_names[r].empty();
    names.push_back(has_name ? plain_name(mesh.region_names[r]) : "region_" + std::to_string(r + 1));
  }
  return made_unique(std::move(names));
}

std::vector<std::uint32_t> region_places(const VolumeMesh& mesh, const std::vector<std::int32_t>& regions) {
  std::vector<std::uint32_t> places(mesh.cell_count(), static_cast<std::uint32_t>(regions.size()));
  for (std::size_t c = 0; c < mesh.cell_region.size() && c < places.size(); ++c)
    if (mesh.cell_region[c] >= 0)
      places[c] = static_cast<std::uint32_t>(std::lower_bound(regions.begin(), regions.end(), mesh.cell_region[c]) -
                                             regions.begin());
  return places;
}

}  // namespace strataflow
