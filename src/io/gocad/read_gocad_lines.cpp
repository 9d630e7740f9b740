#include <cmath>

#include "io/gocad/gocad_reader.h"

namespace strataflow {

/// Turns what was gathered since the last ILINE into polylines: one per unbroken chain of segments.
void GocadReader::close_line(std::vector<Vec3>& points, std::vector<std::uint32_t>& vertices,
                             std::vector<std::array<std::uint32_t, 2>>& segments) {
  const Role role = role_from_gocad(header_.type);
  std::size_t used = 0;
  const auto add = [&](const std::vector<std::uint32_t>& chain) {
    Polyline line;
    line.name = object_name();
    line.role = role == Role::unknown ? Role::curve : role;
    line.is_closed = chain.size() > 3 && chain.front() == chain.back();
    for (std::size_t i = 0; i + (line.is_closed ? 1 : 0) < chain.size(); ++i) line.points.push_back(points[chain[i]]);
    used += line.points.size();
    data_.lines.push_back(std::move(line));
  };
  std::vector<std::uint32_t> chain;
  for (const auto& [from, to] : segments) {
    if (!chain.empty() && chain.back() != from) {
      add(chain);
      chain.clear();
    }
    if (chain.empty()) chain.push_back(from);
    chain.push_back(to);
  }
  if (segments.empty()) chain = vertices;
  if (!chain.empty()) add(chain);
  if (used < vertices.size())
    warn("unconnected_vertices", scanner_.where() + ": " + std::to_string(vertices.size() - used) + " vertices of '" +
                                     shown(object_name()) + "' are in no segment and are left out");
  vertices.clear();
  segments.clear();
}

bool GocadReader::read_lines() {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> vertices;
  std::vector<std::array<std::uint32_t, 2>> segments;
  const std::size_t first_line = scanner_.line_number();
  bool has_values = false;
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    const GocadVertexKind kind = gocad_vertex_kind(word);
    if (kind != GocadVertexKind::none) {
      has_values = has_values || !header_.properties.empty();
      if (!read_vertex(kind, points, nullptr)) return false;
      if (kind == GocadVertexKind::vertex || kind == GocadVertexKind::vertex_with_values)
        vertices.push_back(static_cast<std::uint32_t>(points.size() - 1));
    } else if (word == "SEG") {
      std::array<std::uint32_t, 2>& segment = segments.emplace_back();
      if (!read_vertex_reference(segment[0]) || !read_vertex_reference(segment[1])) return false;
    } else if (word == "ILINE" || word == "END") {
      close_line(points, vertices, segments);
      if (word == "ILINE") continue;
      if (points.empty())
        return malformed("PLine '" + shown(object_name()) + "' has no vertex", "remove the object or export it again");
      if (has_values)
        warn("skipped_property",
             scanner_.where(first_line) + ": properties of PLine '" + shown(object_name()) + "' are not kept");
      ++objects_read_;
      return true;
    } else if (!read_other_line(word)) {
      return false;
    }
  }
  return truncated("PLine");
}

bool GocadReader::read_point_set() {
  PointSet set;
  std::optional<GocadPropertyStore> values;
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    const GocadVertexKind kind = gocad_vertex_kind(word);
    if (kind != GocadVertexKind::none) {
      if (!values) values.emplace(set.properties, text_size_).begin_object(header_.properties);
      if (!read_vertex(kind, set.points, &*values)) return false;
    } else if (word == "END") {
      if (!values)
        return malformed("VSet '" + shown(object_name()) + "' has no vertex", "remove the object or export it again");
      if (!values->finish(set.points.size()))
        warn("skipped_property",
             scanner_.where() + ": properties of VSet '" + shown(object_name()) + "' are too many; they are not kept");
      set.name = object_name();
      if (const Role role = role_from_gocad(header_.type); role != Role::unknown) set.role = role;
      data_.point_sets.push_back(std::move(set));
      ++objects_read_;
      return true;
    } else if (!read_other_line(word)) {
      return false;
    }
  }
  return truncated("VSet");
}

bool GocadReader::read_well() {
  Polyline well;
  Vec3 head;
  bool has_unread_records = false;
  while (scanner_.next_line()) {
    const std::string_view word = scanner_.word();
    if (word == "WREF") {
      if (!read_position(head)) return false;
    } else if (word == "PATH" || word == "TVSS_PATH") {
      const auto measured_depth = scanner_.number();
      const auto z = scanner_.number();
      const auto dx = scanner_.number();
      const auto dy = scanner_.number();
      if (!measured_depth || !z || !dx || !dy || !std::isfinite(*z) || !std::isfinite(*dx) || !std::isfinite(*dy))
        return malformed("a well path needs four finite numbers: measured depth, z, dx, dy", "correct this line");
      well.points.push_back({head.x + *dx, head.y + *dy, header_.is_depth ? 0.0 - *z : *z + 0.0});
    } else if (const GocadVertexKind kind = gocad_vertex_kind(word); kind != GocadVertexKind::none) {
      Vec3 position;
      const bool is_numbered = kind == GocadVertexKind::vertex_with_values;  // a well's VRTX has no id
      if (is_numbered) scanner_.word();
      if (!read_position(position)) return false;
      well.points.push_back(position);
    } else if (word == "STATION" || word == "TVD_PATH" || word == "MRKR") {
      has_unread_records = true;
    } else if (word == "END") {
      if (has_unread_records)
        warn("skipped_record", scanner_.where() + ": STATION, TVD_PATH and MRKR records of well '" +
                                   shown(object_name()) + "' are not read");
      if (well.points.empty())
        warn("skipped_object", scanner_.where() + ": well '" + shown(object_name()) + "' has no path");
      well.name = object_name();
      well.role = Role::well;
      if (!well.points.empty()) data_.lines.push_back(std::move(well));
      ++objects_read_;
      return true;
    } else if (!read_other_line(word)) {
      return false;
    }
  }
  return truncated("Well");
}

}  // namespace strataflow
