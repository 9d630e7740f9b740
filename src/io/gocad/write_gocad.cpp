#include "io/gocad/write_gocad.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "io/gocad/gocad_header.h"

namespace strataflow {

namespace {

constexpr double no_data = -99999;  // GOCAD's usual mark

void put(std::string& out, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}
void put(std::string& out, std::size_t value) { out += std::to_string(value); }
void put(std::string& out, std::string_view text) { out += text; }

template <class... Words>
void line(std::string& out, std::string_view first, const Words&... words) {
  out += first;
  ((out += ' ', put(out, words)), ...);
  out += '\n';
}

/// The text without what would end a line, a quotation or a block.
std::string safe(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '{' || c == '}') c = '_';
  return text;
}

/// One name per entity that a GOCAD file can hold, no two alike.
std::vector<std::string> file_names_of(const std::vector<Entity>& entities) {
  std::vector<std::string> names;
  std::unordered_set<std::string> used;  // asked, never iterated
  for (const Entity& entity : entities) {
    std::string name = safe(entity.name);
    while (!name.empty() && name.back() == ' ') name.pop_back();
    name.erase(0, name.find_first_not_of(' '));
    if (name.empty()) name = "surface";
    std::string unique = name;
    for (int n = 2; !used.insert(unique).second; ++n) unique = name + "_" + std::to_string(n);
    names.push_back(unique);
  }
  return names;
}

void put_head(std::string& out, std::string_view kind, std::string_view name) {
  out += "GOCAD " + std::string(kind) + " 1\nHEADER {\nname:" + std::string(name) + "\n}\n";
  out +=
      "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"m\"\n"
      "ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
}

/// Writes the TSurf objects of one point set.
class SurfaceWriter {
 public:
  SurfaceWriter(std::string& out, const std::vector<Vec3>& points, const Vec3& origin,
                const std::vector<PointProperty>& properties)
      : out_(out),
        points_(points),
        origin_(origin),
        properties_(properties),
        object_id_(points.size(), 0),
        face_id_(points.size(), 0) {}

  void begin(const std::string& name, Role role) {
    put_head(out_, "TSurf", name);
    line(out_, "GEOLOGICAL_FEATURE", std::string_view(name));
    if (role != Role::unknown) line(out_, "GEOLOGICAL_TYPE", gocad_kind_of(role));
    if (!properties_.empty()) put_property_head();
    next_id_ = 1;
    touched_.clear();
  }

  template <class Triangles>
  void put_face(const Triangles& triangles) {
    out_ += "TFACE\n";
    face_start_ = next_id_;
    for (const Triangle& t : triangles)
      for (const std::uint32_t point : t)
        if (face_id_[point] < face_start_) put_vertex(point);
    for (const Triangle& t : triangles) line(out_, "TRGL", face_id_[t[0]], face_id_[t[1]], face_id_[t[2]]);
  }
  /// The id of a point in the face written last, or, when that has none, in the object; 0 when in neither.
  std::size_t id_of(std::uint32_t point) const {
    return face_id_[point] >= face_start_ ? face_id_[point] : object_id_[point];
  }
  std::size_t new_id() { return next_id_++; }

  void end() {
    out_ += "END\n";
    for (const std::uint32_t point : touched_) object_id_[point] = face_id_[point] = 0;
  }

 private:
  void put_property_head() {
    std::string names = "PROPERTIES", no_data_values = "NO_DATA_VALUES", sizes = "ESIZES", units = "UNITS";
    for (const PointProperty& property : properties_) {
      names += " \"" + safe(property.name) + "\"";
      no_data_values += " -99999";
      sizes += " " + std::to_string(property.width);
      units += " " + (property.unit.empty() ? "none" : "\"" + safe(property.unit) + "\"");
    }
    out_ += names + "\n" + no_data_values + "\n" + sizes + "\n" + units + "\n";
  }

  void put_vertex(std::uint32_t point) {
    const std::size_t id = next_id_++;
    face_id_[point] = id;
    if (object_id_[point] != 0) {  // a point of an earlier face: tied to it, so that no position is there twice
      line(out_, "ATOM", id, object_id_[point]);
      return;
    }
    object_id_[point] = id;
    touched_.push_back(point);
    const Vec3 p = points_[point] + origin_;
    line(out_, properties_.empty() ? "VRTX" : "PVRTX", id, p.x, p.y, p.z);
    if (properties_.empty()) return;
    out_.pop_back();
    for (const PointProperty& property : properties_)
      for (std::uint32_t k = 0; k < property.width; ++k) {
        const double value = property.values[std::size_t{point} * property.width + k];
        out_ += ' ';
        put(out_, std::isfinite(value) ? value : no_data);
      }
    out_ += '\n';
  }

  std::string& out_;
  const std::vector<Vec3>& points_;
  const Vec3& origin_;
  const std::vector<PointProperty>& properties_;
  std::vector<std::size_t> object_id_;  ///< per point: its first id in the open object, 0 for none
  std::vector<std::size_t> face_id_;    ///< per point: its last id
  std::vector<std::uint32_t> touched_;
  std::size_t next_id_ = 1;
  std::size_t face_start_ = 1;
};

/// Lists of numbers as GOCAD writes them: five a line, closed by 0.
void put_list(std::string& out, const std::vector<std::string>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) out += (i % 5 == 0 ? (i ? "\n  " : "  ") : "  ") + numbers[i];
  out += "  0\n";
}

std::vector<std::string> sides_of_region(const StructuralModel& model, std::uint32_t region) {
  std::vector<std::string> sides;
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    if (model.surfaces[s].region_plus == region) sides.push_back("+" + std::to_string(s + 1));
    if (model.surfaces[s].region_minus == region) sides.push_back("-" + std::to_string(s + 1));
  }
  return sides;
}

/// The stones and first edges of one surface's lines.
void collect_borders(const StructuralModel& model, const Surface& surface, SurfaceWriter& writer, std::string& stones,
                     std::vector<std::array<std::size_t, 2>>& starts) {
  for (const std::uint32_t l : surface.lines) {
    const Line& border = model.lines[l];
    if (border.vertices.size() < 2) continue;
    const std::size_t first = writer.id_of(border.vertices[0]);
    const std::size_t second = writer.id_of(border.vertices[1]);
    const std::size_t last = writer.id_of(border.vertices.back());
    if (first == 0 || second == 0 || last == 0) continue;  // the line is not of this surface after all
    line(stones, "BSTONE", first);
    if (!border.is_closed()) line(stones, "BSTONE", last);
    starts.push_back({first, second});
  }
}

}  // namespace

std::string write_gocad_ts(const TriangleSoup& surfaces) {
  const std::vector<std::string> names = file_names_of(surfaces.entities);
  std::vector<std::vector<Triangle>> faces(surfaces.patch_entity.size());
  for (std::size_t t = 0; t < surfaces.triangles.size(); ++t)
    faces[surfaces.triangle_patch[t]].push_back(surfaces.triangles[t]);
  std::string out;
  SurfaceWriter writer(out, surfaces.points, surfaces.local_origin, surfaces.properties);
  for (std::size_t entity = 0; entity < surfaces.entities.size(); ++entity) {
    bool is_open = false;
    for (std::size_t patch = 0; patch < faces.size(); ++patch) {
      const std::vector<std::uint32_t> owners = surfaces.entities_of(static_cast<std::uint32_t>(patch));
      if (faces[patch].empty() || !std::binary_search(owners.begin(), owners.end(), entity)) continue;
      if (!is_open) writer.begin(names[entity], surfaces.entities[entity].role);
      is_open = true;
      writer.put_face(faces[patch]);
    }
    if (!is_open) continue;
    for (const std::uint32_t stone : surfaces.border_stones)
      if (const std::size_t id = writer.id_of(stone)) line(out, "BSTONE", id);
    for (const auto& [from, to] : surfaces.border_starts) {
      const std::size_t first = writer.id_of(from);
      const std::size_t second = writer.id_of(to);
      if (first != 0 && second != 0) line(out, "BORDER", writer.new_id(), first, second);
    }
    writer.end();
  }
  return out;
}

std::string write_gocad_ml(const StructuralModel& model, const std::string& name) {
  const std::vector<std::string> names = file_names_of(model.entities);
  std::vector<std::vector<std::uint32_t>> surfaces_of(model.entities.size());
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) surfaces_of[model.surfaces[s].entity].push_back(s);
  // Where entities coincide, each has the surface, after its own; regions are bounded by the youngest's.
  std::vector<std::array<std::uint32_t, 2>> faces;  // surface, entity
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) faces.push_back({s, model.surfaces[s].entity});
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s)
    for (const std::uint32_t entity : model.surfaces[s].all_entities) {
      if (entity == model.surfaces[s].entity) continue;
      faces.push_back({s, entity});
      surfaces_of[entity].push_back(s);
    }

  std::string out;
  put_head(out, "Model3d", safe(name));
  for (std::size_t entity = 0; entity < names.size(); ++entity)
    if (!surfaces_of[entity].empty()) line(out, "TSURF", std::string_view(names[entity]));
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const auto [s, entity] = faces[face];
    line(out, "TFACE", face + 1, gocad_kind_of(model.entities[entity].role), std::string_view(names[entity]));
    for (const std::uint32_t point : model.triangles[model.surfaces[s].first_triangle]) {
      const Vec3 p = model.points[point] + model.local_origin;
      line(out, " ", p.x, p.y, p.z);
    }
  }
  std::size_t number = faces.size() + 1;
  line(out, "REGION", number++, "Universe");
  put_list(out, sides_of_region(model, universe));
  const std::size_t first_region = number;
  for (std::uint32_t r = 0; r < model.regions.size(); ++r) {
    const std::string& region = model.regions[r].name;
    line(out, "REGION", number++, std::string_view(region.empty() ? "region_" + std::to_string(r + 1) : safe(region)));
    put_list(out, sides_of_region(model, r));
  }
  for (const Layer& layer : model.layers) {
    line(out, "LAYER", std::string_view(safe(layer.name)));
    std::vector<std::string> regions;
    for (const std::uint32_t r : layer.regions) regions.push_back(std::to_string(first_region + r));
    put_list(out, regions);
  }
  out += "END\n";

  SurfaceWriter writer(out, model.points, model.local_origin, model.properties);
  for (std::size_t entity = 0; entity < names.size(); ++entity) {
    if (surfaces_of[entity].empty()) continue;
    writer.begin(names[entity], model.entities[entity].role);
    std::string stones;
    std::vector<std::array<std::size_t, 2>> starts;
    for (const std::uint32_t s : surfaces_of[entity]) {
      const Surface& surface = model.surfaces[s];
      writer.put_face(std::vector<Triangle>(model.triangles.begin() + surface.first_triangle,
                                            model.triangles.begin() + surface.end_triangle));
      collect_borders(model, surface, writer, stones, starts);
    }
    out += stones;
    for (const auto& [first, second] : starts) line(out, "BORDER", writer.new_id(), first, second);
    writer.end();
  }
  return out;
}

Result<std::string> write_gocad_so(const VolumeMesh& mesh, const std::string& name) {
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    if (mesh.cell_types[c] != CellType::tetrahedron)
      return Failure{FailureCode::unsupported, "cell " + std::to_string(c) + " of " + name + " is not a tetrahedron",
                     "write meshes of other cells as vtu or Gmsh"};
  std::vector<std::vector<std::uint32_t>> cells_of(mesh.region_names.size());
  std::vector<std::string> region_names = mesh.region_names;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const std::int32_t region = mesh.cell_region.empty() ? 0 : std::max(0, mesh.cell_region[c]);
    if (static_cast<std::size_t>(region) >= cells_of.size()) cells_of.resize(static_cast<std::size_t>(region) + 1);
    cells_of[static_cast<std::size_t>(region)].push_back(static_cast<std::uint32_t>(c));
  }
  region_names.resize(cells_of.size());

  std::string out;
  put_head(out, "TSolid", safe(name));
  std::vector<std::size_t> first_id(mesh.points.size(), 0);   // 0: not written yet
  std::vector<std::size_t> region_id(mesh.points.size(), 0);  // the id of the point's copy in its latest region
  std::size_t next_id = 1;
  for (std::size_t region = 0; region < cells_of.size(); ++region) {
    if (cells_of[region].empty()) continue;
    const std::string& given = region_names[region];
    const std::string region_name = given.empty() ? "region_" + std::to_string(region + 1) : safe(given);
    line(out, "TVOLUME", std::string_view(region_name));
    const std::size_t region_start = next_id;
    for (const std::uint32_t c : cells_of[region])
      for (std::size_t k = mesh.cell_offsets[c]; k < mesh.cell_offsets[c + 1]; ++k) {
        const std::uint32_t v = mesh.cell_vertices[k];
        if (region_id[v] >= region_start) continue;
        region_id[v] = next_id++;
        const Vec3 p = mesh.points[v] + mesh.local_origin;
        if (first_id[v] == 0) {
          first_id[v] = region_id[v];
          line(out, "VRTX", first_id[v], p.x, p.y, p.z);
        } else {
          line(out, "ATOM", region_id[v], first_id[v]);
        }
      }
    for (const std::uint32_t c : cells_of[region]) {
      const std::uint32_t* v = &mesh.cell_vertices[mesh.cell_offsets[c]];
      line(out, "TETRA", region_id[v[0]], region_id[v[1]], region_id[v[2]], region_id[v[3]]);
      line(out, "# CTETRA", std::string_view("\"" + region_name + "\" none none none none"));
    }
  }

  std::vector<std::vector<const MeshFacet*>> facets_of(mesh.surface_entity.size());
  for (const MeshFacet& facet : mesh.facets) {
    if (facet.surface >= facets_of.size() || facet.vertices[3] != no_index) continue;
    const bool is_in_cells = first_id[facet.vertices[0]] && first_id[facet.vertices[1]] && first_id[facet.vertices[2]];
    if (is_in_cells) facets_of[facet.surface].push_back(&facet);
  }
  const std::vector<std::string> names = file_names_of(mesh.entities);
  out += "MODEL\n";
  std::size_t face = 1;
  for (std::size_t entity = 0; entity < names.size(); ++entity) {
    bool is_named = false;
    for (std::size_t surface = 0; surface < facets_of.size(); ++surface) {
      if (mesh.surface_entity[surface] != static_cast<std::int32_t>(entity) || facets_of[surface].empty()) continue;
      if (!is_named) line(out, "SURFACE", std::string_view(names[entity]));
      is_named = true;
      line(out, "TFACE", face++);
      for (const MeshFacet* facet : facets_of[surface])
        line(out, "TRGL", first_id[facet->vertices[0]], first_id[facet->vertices[1]], first_id[facet->vertices[2]]);
    }
  }
  out += "END\n";
  return out;
}

}  // namespace strataflow
