#include "io/gocad/gocad_reader.h"

namespace strataflow {

/// Swaps two vertices of every cell of the object when more of its cells are negative than positive.
void GocadReader::orient_cells(std::size_t first_cell) {
  VolumeMesh& volume = data_.volume;
  std::int64_t balance = 0;
  for (std::size_t c = first_cell; c < volume.cell_count(); ++c) {
    const std::uint32_t* v = &volume.cell_vertices[volume.cell_offsets[c]];
    const Vec3& p = volume.points[v[0]];
    const double six_volumes = dot(volume.points[v[1]] - p, cross(volume.points[v[2]] - p, volume.points[v[3]] - p));
    balance += six_volumes > 0 ? 1 : six_volumes < 0 ? -1 : 0;
  }
  if (balance >= 0) return;
  for (std::size_t c = first_cell; c < volume.cell_count(); ++c) {
    std::uint32_t* v = &volume.cell_vertices[volume.cell_offsets[c]];
    std::swap(v[2], v[3]);
  }
}

bool GocadReader::read_solid() {
  VolumeMesh& volume = data_.volume;
  TriangleSoup& surfaces = soup();
  const std::size_t first_line = scanner_.line_number();
  const std::size_t first_cell = volume.cell_count();
  const std::size_t first_point = volume.points.size();
  std::vector<std::uint32_t> surface_point;  // per point of this object, its copy among the surfaces' points
  std::unordered_map<std::string, std::int32_t> region_index;
  std::int32_t region = -1;
  std::uint32_t entity = none;
  std::uint32_t patch = none;
  bool has_values = false;
  const auto region_named = [&](std::string_view name) {
    const auto [found, is_new] =
        region_index.try_emplace(std::string(name), static_cast<std::int32_t>(volume.region_names.size()));
    if (is_new) volume.region_names.emplace_back(name);
    return found->second;
  };
  const auto patch_of = [&](std::string_view name) {
    surfaces.patch_entity.push_back(entity == none ? entity = entity_named(name) : entity);
    return static_cast<std::uint32_t>(surfaces.patch_entity.size() - 1);
  };
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    const GocadVertexKind kind = gocad_vertex_kind(word);
    if (kind != GocadVertexKind::none) {
      has_values = has_values || !header_.properties.empty();
      if (!read_vertex(kind, volume.points, nullptr)) return false;
    } else if (word == "TETRA") {
      std::uint32_t v[4];
      for (std::uint32_t& vertex : v)
        if (!read_vertex_reference(vertex)) return false;
      volume.add_cell(CellType::tetrahedron, v, region);
    } else if (word == "#") {  // "# CTETRA Region +surface …" tells more about the TETRA above
      if (scanner_.word() == "CTETRA" && volume.cell_count() > first_cell)
        if (const std::string_view name = scanner_.word(); !name.empty())
          volume.cell_region.back() = region_named(name);
    } else if (word == "TVOLUME") {
      region = region_named(scanner_.rest());
    } else if (word == "SURFACE") {
      entity = entity_named(scanner_.rest());
    } else if (word == "TFACE") {
      patch = patch_of(object_name());
    } else if (word == "TRGL") {
      Triangle triangle{};
      if (!read_triangle(triangle)) return false;
      if (patch == none) patch = patch_of(object_name());
      surface_point.resize(volume.points.size() - first_point, none);
      for (std::uint32_t& vertex : triangle) {
        std::uint32_t& copy = surface_point[vertex - first_point];
        if (copy == none) {
          copy = static_cast<std::uint32_t>(surfaces.points.size());
          surfaces.points.push_back(volume.points[vertex]);
        }
        vertex = copy;
      }
      surfaces.triangles.push_back(triangle);
      surfaces.triangle_patch.push_back(patch);
    } else if (word == "END") {
      if (volume.cell_count() == first_cell)
        return malformed("solid '" + shown(object_name()) + "' has no tetrahedron",
                         "remove the object or export it again");
      orient_cells(first_cell);
      if (has_values)
        warn("skipped_property",
             scanner_.where(first_line) + ": properties of solid '" + shown(object_name()) + "' are not kept");
      ++objects_read_;
      return true;
    } else if (!read_other_line(word)) {
      return false;
    }
  }
  return truncated("solid");
}

}  // namespace strataflow
