#include "io/input/input_builder.h"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace strataflow {

std::string stem_of(const std::string& file_name) {
  std::filesystem::path path = std::filesystem::path(file_name).filename();
  if (path.extension() == ".gz") path = path.stem();
  return path.stem().string();
}

InputBuilder::InputBuilder(std::string file_name) : file_name_(std::move(file_name)), stem_(stem_of(file_name_)) {}

std::uint32_t InputBuilder::entity(const std::string& name) {
  const auto [place, is_new] = entity_ids_.try_emplace(name, static_cast<std::uint32_t>(entities_.size()));
  if (is_new) entities_.push_back({name, Role::unknown});
  return place->second;
}

std::uint32_t InputBuilder::patch(std::int64_t key, std::uint32_t entity) {
  const auto [place, is_new] = patch_ids_.try_emplace({key, entity}, static_cast<std::uint32_t>(patch_entity_.size()));
  if (is_new) patch_entity_.push_back(entity);
  return place->second;
}

std::uint32_t InputBuilder::patch(const std::string& entity_name) { return patch(-1, entity(entity_name)); }

void InputBuilder::add_polygon(const std::uint32_t* vertices, std::size_t count, std::uint32_t patch) {
  for (std::size_t i = 2; i < count; ++i) {
    triangles_.push_back({vertices[0], vertices[i - 1], vertices[i]});
    triangle_patch_.push_back(patch);
  }
}

void InputBuilder::add_line(const std::uint32_t* vertices, std::size_t count, const std::string& name) {
  lines_.push_back({name, {vertices, vertices + count}, false});
}

void InputBuilder::add_segment(std::uint32_t from, std::uint32_t to, const std::string& name) {
  if (!lines_.empty() && lines_.back().takes_segments && lines_.back().name == name &&
      lines_.back().vertices.back() == from)
    lines_.back().vertices.push_back(to);
  else
    lines_.push_back({name, {from, to}, true});
}

void InputBuilder::add_cell(CellType type, const std::uint32_t* vertices, std::int32_t region, std::int32_t entity) {
  volume_.add_cell(type, vertices, region);
  volume_.cell_entity.push_back(entity);
}

void InputBuilder::name_regions(const std::vector<std::int64_t>& labels,
                                const std::function<std::string(std::int64_t)>& name) {
  std::vector<std::int64_t> known = labels;
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const std::int64_t label : known) region_names.push_back(name(label));
  for (std::size_t c = 0; c < labels.size(); ++c)
    volume_.cell_region[c] =
        static_cast<std::int32_t>(std::lower_bound(known.begin(), known.end(), labels[c]) - known.begin());
}

Result<InputData> InputBuilder::finish() && {
  const auto malformed = [&](const std::string& what) {
    return Failure{FailureCode::malformed_file, file_name_ + ": " + what,
                   "export the file again and check it is whole"};
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i]))
      return malformed("point " + std::to_string(i + 1) + " has a coordinate that is not a finite number");
  const auto check = [&](std::uint32_t vertex, const char* kind, std::size_t id) -> std::optional<Failure> {
    if (vertex < points.size()) return std::nullopt;
    return malformed(std::string(kind) + " " + std::to_string(id + 1) + " refers to point " +
                     std::to_string(std::uint64_t{vertex} + 1) + " of " + std::to_string(points.size()));
  };
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const std::uint32_t vertex : triangles_[t])
      if (auto problem = check(vertex, "triangle", t)) return *problem;
  for (std::size_t c = 0; c < volume_.cell_count(); ++c)
    for (std::uint32_t k = volume_.cell_offsets[c]; k < volume_.cell_offsets[c + 1]; ++k)
      if (auto problem = check(volume_.cell_vertices[k], "cell", c)) return *problem;
  for (std::size_t l = 0; l < lines_.size(); ++l)
    for (const std::uint32_t vertex : lines_[l].vertices)
      if (auto problem = check(vertex, "line", l)) return *problem;

  if (points.empty()) return malformed("holds no points");
  if (points.size() >= no_index) return malformed("has too many points");
  for (const PointProperty& property : properties)
    if (property.values.size() != points.size() * property.width)
      return malformed("point property '" + property.name + "' has " + std::to_string(property.values.size()) +
                       " values for " + std::to_string(points.size()) + " points");
  if (volume_.cell_count() == 0 && !(point_line.empty() && point_corner.empty()))
    warn("ignored_point_data", "'line' and 'corner' are found again from the geometry");

  InputData data;
  data.warnings = std::move(warnings);
  for (IndexedLine& line : lines_) {
    Polyline polyline{line.name, Role::curve, {}, false};
    if (line.vertices.size() > 3 && line.vertices.front() == line.vertices.back()) {
      polyline.is_closed = true;
      line.vertices.pop_back();
    }
    for (const std::uint32_t vertex : line.vertices) polyline.points.push_back(points[vertex]);
    data.lines.push_back(std::move(polyline));
  }

  const bool has_volume = volume_.cell_count() > 0;
  if (!triangles_.empty()) {
    TriangleSoup& soup = data.surfaces;
    soup.triangles = std::move(triangles_);
    soup.triangle_patch = std::move(triangle_patch_);
    soup.patch_entity = std::move(patch_entity_);
    soup.entities = entities_;
    if (has_volume) {  // the points inside the volume are no business of the surfaces
      std::vector<std::uint32_t> new_id(points.size(), no_index);
      for (const Triangle& triangle : soup.triangles)
        for (const std::uint32_t vertex : triangle) new_id[vertex] = 0;
      for (const PointProperty& property : properties)
        soup.properties.push_back({property.name, property.unit, property.width, {}});
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (new_id[i] == no_index) continue;
        new_id[i] = static_cast<std::uint32_t>(soup.points.size());
        soup.points.push_back(points[i]);
        for (std::size_t p = 0; p < properties.size(); ++p) {
          const auto first = properties[p].values.begin() + static_cast<std::ptrdiff_t>(i * properties[p].width);
          soup.properties[p].values.insert(soup.properties[p].values.end(), first, first + properties[p].width);
        }
      }
      for (Triangle& triangle : soup.triangles)
        for (std::uint32_t& vertex : triangle) vertex = new_id[vertex];
    } else {
      soup.points = points;
      soup.properties = properties;
    }
  }
  if (has_volume) {
    for (const PointProperty& property : properties)
      data.warnings.push_back({"ignored_point_data", file_name_ + ": '" + property.name + "' of the volume's points"});
    if (point_line.size() == points.size()) volume_.point_line = std::move(point_line);
    if (point_corner.size() == points.size()) volume_.point_corner = std::move(point_corner);
    volume_.points = std::move(points);
    volume_.entities = std::move(entities_);
    volume_.region_names = std::move(region_names);
    for (std::vector<std::int32_t>* labels : {&volume_.cell_region, &volume_.cell_entity})
      if (std::all_of(labels->begin(), labels->end(), [](std::int32_t label) { return label < 0; })) labels->clear();
    data.volume = std::move(volume_);
  } else if (data.surfaces.triangles.empty() && data.lines.empty() && !points.empty()) {
    data.point_sets.push_back({stem_, Role::points, std::move(points), std::move(properties)});
  }
  return data;
}

}  // namespace strataflow
