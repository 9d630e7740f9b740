#include "io/gocad/read_gocad.h"

#include <cmath>

#include "io/gocad/gocad_reader.h"

namespace strataflow {

bool GocadReader::read_objects() {
  while (scanner_.next_content_line()) {
    const std::string_view word = scanner_.word();
    if (word.front() == '#') continue;
    if (open_groups_ > 0 && word == "END_MEMBERS") continue;
    if (open_groups_ > 0 && word == "END") {
      --open_groups_;
      continue;
    }
    if (word != "GOCAD")
      return malformed("expected 'GOCAD <kind>', found '" + shown(word) + "'",
                       "this is not a GOCAD ascii file, or an object is damaged: check its kind and ending");
    header_ = {};
    header_.is_depth = model_is_depth_;
    ids_.clear();
    const std::string kind(scanner_.word());
    bool is_read = true;
    if (kind == "Model3d")
      is_read = read_model();
    else if (kind == "TSurf")
      is_read = read_surface();
    else if (kind == "PLine")
      is_read = read_lines();
    else if (kind == "VSet")
      is_read = read_point_set();
    else if (kind == "Well")
      is_read = read_well();
    else if (kind == "TSolid" || kind == "LightTSolid")
      is_read = read_solid();
    else if (kind.find("Group") != std::string::npos)
      is_read = open_group();
    else
      is_read = skip_object(kind);
    if (!is_read) return false;
  }
  if (open_groups_ > 0)
    return malformed("the file ends inside a group (no END)", "the file seems truncated: export it again");
  return finish_file();
}

bool GocadReader::finish_file() {
  if (objects_read_ == 0 && !objects_skipped_.empty()) {
    std::string names;
    for (const std::string& object : objects_skipped_) names += (names.empty() ? "" : ", ") + object;
    return fail({FailureCode::unsupported, file_name_ + ": holds only objects that are not read: " + shown(names),
                 "give Model3d, TSurf, PLine, VSet, Well, TSolid or LightTSolid objects"});
  }
  if (objects_read_ == 0)
    return fail(
        {FailureCode::malformed_file, file_name_ + ":1: holds no GOCAD object", "check that the file is whole"});
  for (std::size_t entity = 0; entity < rows_of_entity_.size(); ++entity)
    if (const auto& [rows, taken] = rows_of_entity_[entity]; taken < rows.size())
      return fail({FailureCode::malformed_file,
                   scanner_.where(rows[taken].line) + ": this TFACE of '" + shown(soup().entities[entity].name) +
                       "' has no triangles: the TSurf lacks it",
                   "the file seems truncated: export it again"});
  if (!surface_values_.finish(soup().points.size()))
    warn("skipped_property",
         file_name_ + ": the vertex properties would need far more memory than the file; they are not kept");
  return true;
}

bool GocadReader::skip_object(const std::string& kind) {
  const std::size_t first_line = scanner_.line_number();
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    if (word == "END") {
      const std::string object = shown(kind) + " '" + shown(header_.name) + "'";
      warn("skipped_object", scanner_.where(first_line) + ": " + object + " is not read");
      objects_skipped_.push_back(object);
      return true;
    }
    if (!read_other_line(word)) return false;
  }
  return truncated(shown(kind));
}

bool GocadReader::open_group() {
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    if (word == "BEGIN_MEMBERS") {
      ++open_groups_;
      return true;
    }
    if (word == "END") return true;
    if (!read_other_line(word)) return false;
  }
  return truncated("group");
}

// ---- records shared by several objects

bool GocadReader::read_position(Vec3& position) {
  const auto x = scanner_.number();
  const auto y = scanner_.number();
  const auto z = scanner_.number();
  if (!x || !y || !z || !std::isfinite(*x) || !std::isfinite(*y) || !std::isfinite(*z))
    return malformed("a position needs three finite numbers, found '" + shown(scanner_.line()) + "'",
                     "correct the coordinates on this line");
  position = {*x + 0.0, *y + 0.0, header_.is_depth ? 0.0 - *z : *z + 0.0};  // no negative zeros
  return true;
}

bool GocadReader::read_vertex_reference(std::uint32_t& point) {
  const std::string_view word = scanner_.word();
  const auto id = TextScanner::integer_from<std::uint64_t>(word);
  point = id ? ids_.find(*id) : GocadVertexIds::unknown;
  if (point != GocadVertexIds::unknown) return true;
  return malformed((word.empty() ? "a vertex id is missing" : "there is no vertex '" + shown(word) + "'") + " in '" +
                       shown(object_name()) + "'",
                   "name a vertex that stands above this line in the same object");
}

bool GocadReader::read_vertex(GocadVertexKind kind, std::vector<Vec3>& points, GocadPropertyStore* values,
                              bool atoms_are_copies) {
  const std::string_view word = scanner_.word();
  const auto id = TextScanner::integer_from<std::uint64_t>(word);
  if (!id) return malformed("a vertex needs an id, found '" + shown(word) + "'", "give the vertex a number");
  const bool is_atom = kind == GocadVertexKind::atom || kind == GocadVertexKind::atom_with_values;
  const bool has_values =
      values && (kind == GocadVertexKind::vertex_with_values || kind == GocadVertexKind::atom_with_values);
  auto point = static_cast<std::uint32_t>(points.size());
  Vec3 position;
  if (is_atom) {
    std::uint32_t original = 0;
    if (!read_vertex_reference(original)) return false;
    position = points[original];
    if (!has_values && !atoms_are_copies) point = original;
  } else if (!read_position(position)) {
    return false;
  }
  if (point == points.size()) points.push_back(position);
  if (!ids_.add(*id, point))
    return malformed("vertex " + shown(word) + " is there twice in '" + shown(object_name()) + "'",
                     "give every vertex of an object its own id");
  if (!has_values) return true;
  const Result<void> row = values->read_row(scanner_, point);
  return row ? true : fail(row.failure());
}

bool GocadReader::read_triangle(Triangle& triangle) {
  for (std::uint32_t& vertex : triangle)
    if (!read_vertex_reference(vertex)) return false;
  return true;
}

std::uint32_t GocadReader::entity_named(std::string_view name) {
  const auto [found, is_new] =
      entity_index_.try_emplace(std::string(name), static_cast<std::uint32_t>(soup().entities.size()));
  if (is_new) {
    soup().entities.push_back({std::string(name), Role::unknown});
    rows_of_entity_.emplace_back();
    role_is_sure_.push_back(0);
  }
  return found->second;
}

Result<InputData> read_gocad(std::string_view text, const std::string& file_name) {
  return GocadReader(text, file_name).read();
}

}  // namespace strataflow
