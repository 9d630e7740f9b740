#include "io/gocad/gocad_reader.h"

namespace strataflow {

bool GocadReader::read_id_list(std::vector<std::int64_t>& ids) {
  ids.clear();
  const std::size_t first_line = scanner_.line_number();
  while (scanner_.next_content_line()) {
    while (!scanner_.at_line_end()) {
      const std::string_view word = scanner_.word();
      const auto id = TextScanner::integer_from<std::int64_t>(word);
      if (!id)
        return malformed("expected a number of the list that starts at line " + std::to_string(first_line) +
                             ", found '" + shown(word) + "'",
                         "close the list with 0");
      if (*id == 0) return true;
      ids.push_back(*id);
    }
  }
  return truncated("Model3d");
}

bool GocadReader::read_model_surface_row() {
  const auto number = scanner_.integer<std::int64_t>();
  const std::string_view kind = scanner_.word();
  const std::string_view name = scanner_.rest();
  if (!number || *number <= 0 || name.empty())
    return malformed("a TFACE row needs a number, a kind and the name of its TSurf", "write 'TFACE 1 fault NAME'");
  const auto patch = static_cast<std::uint32_t>(soup().patch_entity.size());
  if (!patch_of_row_.try_emplace(*number, patch).second)
    return malformed("TFACE " + std::to_string(*number) + " is there twice", "number the TFACE rows 1, 2, 3 …");
  const std::uint32_t entity = entity_named(name);
  soup().patch_entity.push_back(entity);
  rows_of_entity_[entity].rows.push_back({patch, scanner_.line_number()});
  if (const Role role = role_from_gocad(kind); role != Role::unknown && !role_is_sure_[entity]) {
    soup().entities[entity].role = role;
    role_is_sure_[entity] = kind != "none";
  }
  return true;
}

bool GocadReader::read_model_region() {
  const auto number = scanner_.integer<std::int64_t>();
  const std::string name(scanner_.rest());
  if (!number || name.empty()) return malformed("a REGION needs a number and a name", "write 'REGION 10 NAME'");
  if (!region_of_number_.try_emplace(*number, static_cast<std::uint32_t>(soup().regions.size())).second)
    return malformed("REGION " + std::to_string(*number) + " is there twice", "give every region its own number");
  std::vector<std::int64_t> ids;
  if (!read_id_list(ids)) return false;
  RegionRecord region{name, {}};
  for (const std::int64_t id : ids) {
    const auto found = patch_of_row_.find(id > 0 ? id : id == INT64_MIN ? 0 : -id);
    if (found == patch_of_row_.end())
      return malformed("region '" + shown(name) + "' names TFACE " + std::to_string(id) + ", which is not in the table",
                       "use numbers of the TFACE table above");
    PatchSide side;
    side.patch = found->second;
    side.is_positive = id > 0;
    region.sides.push_back(side);
  }
  soup().regions.push_back(std::move(region));
  return true;
}

bool GocadReader::read_model_layer() {
  LayerRecord layer{std::string(scanner_.rest()), {}};
  std::vector<std::int64_t> ids;
  if (!read_id_list(ids)) return false;
  for (const std::int64_t id : ids) {
    const auto found = region_of_number_.find(id);
    if (found == region_of_number_.end())
      return malformed("layer '" + shown(layer.name) + "' names region " + std::to_string(id) + ", which there is not",
                       "use numbers of the REGION records above");
    layer.regions.push_back(found->second);
  }
  soup().layers.push_back(std::move(layer));
  return true;
}

bool GocadReader::read_model() {
  patch_of_row_.clear();  // each model numbers its own
  region_of_number_.clear();
  header_.is_depth = false;
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    bool is_read = true;
    if (word == "END") {
      has_model_ = true;
      model_is_depth_ = header_.is_depth;
      ++objects_read_;
      return true;
    }
    if (word == "TSURF")
      entity_named(scanner_.rest());
    else if (word == "TFACE")
      is_read = read_model_surface_row();
    else if (word == "REGION")
      is_read = read_model_region();
    else if (word == "LAYER")
      is_read = read_model_layer();
    else
      is_read = read_other_line(word);  // also the three key points of a TFACE row: the TSurf has the triangles
    if (!is_read) return false;
  }
  return truncated("Model3d");
}

// ---- TSurf

std::uint32_t GocadReader::open_patch() {
  const std::uint32_t entity = entity_named(object_name());
  if (const Role role = role_from_gocad(header_.type); role != Role::unknown && !role_is_sure_[entity]) {
    soup().entities[entity].role = role;
    role_is_sure_[entity] = header_.type != "none";
  }
  if (auto& [rows, taken] = rows_of_entity_[entity]; taken < rows.size()) return rows[taken++].patch;
  if (has_model_)
    warn("undeclared_tface",
         scanner_.where() + ": this part of '" + shown(object_name()) + "' is not in the TFACE table of the model");
  soup().patch_entity.push_back(entity);
  return static_cast<std::uint32_t>(soup().patch_entity.size() - 1);
}

bool GocadReader::read_surface() {
  TriangleSoup& surfaces = soup();
  std::uint32_t patch = none;
  bool has_rows = false;
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    const GocadVertexKind kind = gocad_vertex_kind(word);
    if (kind != GocadVertexKind::none) {
      if (!has_rows) surface_values_.begin_object(header_.properties);
      has_rows = true;
      if (!read_vertex(kind, surfaces.points, &surface_values_, /*atoms_are_copies=*/true)) return false;
    } else if (word == "TRGL") {
      Triangle triangle{};
      if (!read_triangle(triangle)) return false;
      if (patch == none) patch = open_patch();
      surfaces.triangles.push_back(triangle);
      surfaces.triangle_patch.push_back(patch);
    } else if (word == "TFACE") {
      patch = open_patch();
    } else if (word == "BSTONE") {
      if (!read_vertex_reference(surfaces.border_stones.emplace_back())) return false;
    } else if (word == "BORDER") {
      scanner_.word();  // its number means nothing
      std::array<std::uint32_t, 2>& start = surfaces.border_starts.emplace_back();
      if (!read_vertex_reference(start[0]) || !read_vertex_reference(start[1])) return false;
    } else if (word == "END") {
      if (patch == none)
        return malformed("TSurf '" + shown(object_name()) + "' has no triangle",
                         "remove the object or export it again");
      ++objects_read_;
      return true;
    } else if (!read_other_line(word)) {
      return false;
    }
  }
  return truncated("TSurf");
}

}  // namespace strataflow
