#include "io/vtk/write_vtk_xml.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <type_traits>

#include "io/bytes/byte_order.h"
#include "io/vtk/vtk_blocks.h"

namespace strataflow {

namespace {
template <class T>
constexpr std::string_view vtk_type() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// Length of the UTF-8 character at `text[i]`, 0 if it is none.
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const unsigned char lead = static_cast<unsigned char>(text[i]);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return 0;
  return length;
}

/// Text for an XML attribute; bytes that XML cannot hold become '_'.
std::string attribute_text(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const char letter = text[i];
    const std::size_t length = utf8_length(text, i);
    if (length == 0 || (length == 1 && static_cast<unsigned char>(letter) < 0x20)) {
      result += '_';
      ++i;
      continue;
    }
    if (letter == '&')
      result += "&amp;";
    else if (letter == '<')
      result += "&lt;";
    else if (letter == '>')
      result += "&gt;";
    else if (letter == '"')
      result += "&quot;";
    else
      result.append(text, i, length);
    i += length;
  }
  return result;
}

/// The text of one file while it grows, and the data appended to it.
class VtkXmlFile {
 public:
  explicit VtkXmlFile(std::string_view type) : type_(type) {
    text_ = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type_ +
            "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
            "compressor=\"vtkZLibDataCompressor\">\n  <" +
            type_ + ">\n";
  }

  void open(const std::string& tag) { text_ += "    <" + tag + ">\n"; }
  void close(const std::string& tag) { text_ += "    </" + tag + ">\n"; }

  template <class T>
  void array(std::string_view name, const std::vector<T>& values, std::size_t components = 1, bool is_field = false) {
    text_ += "      <DataArray type=\"" + std::string(vtk_type<T>()) + "\" Name=\"" + attribute_text(name) + "\"";
    if (components != 1) text_ += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    if (is_field) text_ += " NumberOfTuples=\"" + std::to_string(values.size() / components) + "\"";
    text_ += " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
    appended_ += pack_vtk_array({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }

  void string_field(std::string_view name, const std::vector<std::string>& words) {
    if (words.empty()) return;
    text_ += "      <Array type=\"String\" Name=\"" + attribute_text(name) + "\" NumberOfTuples=\"" +
             std::to_string(words.size()) + "\" format=\"ascii\">\n       ";
    for (const std::string& word : words) {
      for (const char letter : word) text_ += " " + std::to_string(static_cast<int>(static_cast<signed char>(letter)));
      text_ += " 0";
    }
    text_ += "\n      </Array>\n";
  }

  void byte_field(std::string_view name, const std::vector<std::string>& words) {
    if (words.empty()) return;
    std::vector<std::uint8_t> bytes;
    for (const std::string& word : words) {
      for (const char letter : word) bytes.push_back(static_cast<std::uint8_t>(letter));
      bytes.push_back(0);
    }
    array(name, bytes, 1, true);
  }

  std::string finish() && {
    // The line break before the closing tag is where meshio cuts the data off.
    return std::move(text_) + "  </" + type_ + ">\n  <AppendedData encoding=\"raw\">\n_" + appended_ +
           "\n  </AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string type_, text_, appended_;
};

std::vector<std::string> names_of(std::span<const Entity> entities) {
  std::vector<std::string> names;
  for (const Entity& entity : entities) names.push_back(entity.name);
  return names;
}

void write_entities(VtkXmlFile& file, std::span<const Entity> entities) {
  std::vector<std::string> roles;
  for (const Entity& entity : entities) roles.emplace_back(to_string(entity.role));
  file.open("FieldData");
  file.string_field("entity_names", names_of(entities));
  file.string_field("entity_roles", roles);
  file.close("FieldData");
}

void write_point_data(VtkXmlFile& file, std::span<const std::int32_t> line, std::span<const std::int32_t> corner,
                      std::span<const PointProperty> properties, std::size_t point_count) {
  file.open("PointData");
  if (line.size() == point_count) file.array("line", std::vector<std::int32_t>(line.begin(), line.end()));
  if (corner.size() == point_count) file.array("corner", std::vector<std::int32_t>(corner.begin(), corner.end()));
  for (const PointProperty& property : properties)
    if (property.name != "line" && property.name != "corner" && property.values.size() == point_count * property.width)
      file.array(property.name, property.values, property.width);
  file.close("PointData");
}

void write_points(VtkXmlFile& file, std::span<const Vec3> points, const Vec3& local_origin) {
  std::vector<double> coordinates;
  coordinates.reserve(points.size() * 3);
  for (const Vec3& point : points) {
    const Vec3 world = point + local_origin;
    coordinates.insert(coordinates.end(), {world.x, world.y, world.z});
  }
  file.open("Points");
  file.array("Points", coordinates, 3);
  file.close("Points");
}

std::string polys_piece(std::size_t point_count, std::size_t polygon_count, std::size_t line_count = 0) {
  return "Piece NumberOfPoints=\"" + std::to_string(point_count) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
         std::to_string(line_count) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
         std::to_string(polygon_count) + "\"";
}

std::int32_t signed_index(std::uint32_t index) { return index == no_index ? -1 : static_cast<std::int32_t>(index); }
void write_cells(VtkXmlFile& file, const std::string& tag, const std::vector<std::int64_t>& connectivity,
                 const std::vector<std::int64_t>& offsets) {
  file.open(tag);
  file.array("connectivity", connectivity);
  file.array("offsets", offsets);
  file.close(tag);
}

void write_polys(VtkXmlFile& file, const std::vector<std::int64_t>& connectivity,
                 const std::vector<std::int64_t>& offsets) {
  write_cells(file, "Polys", connectivity, offsets);
}

}  // namespace

std::string write_vtp(const LabelledTriangles& surfaces) {
  VtkXmlFile file("PolyData");
  write_entities(file, surfaces.entities);
  file.open(polys_piece(surfaces.points.size(), surfaces.triangles.size()));
  write_point_data(file, surfaces.point_line, surfaces.point_corner, surfaces.properties, surfaces.points.size());

  std::vector<std::int32_t> surface, entity;
  std::vector<std::int64_t> connectivity, offsets;
  for (std::size_t t = 0; t < surfaces.triangles.size(); ++t) {
    surface.push_back(signed_index(surfaces.triangle_surface[t]));
    entity.push_back(signed_index(surfaces.surface_entity[surfaces.triangle_surface[t]]));
    for (const std::uint32_t vertex : surfaces.triangles[t]) connectivity.push_back(vertex);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  file.open("CellData");
  file.array("surface", surface);
  file.array("entity", entity);
  file.close("CellData");
  write_points(file, surfaces.points, surfaces.local_origin);
  write_polys(file, connectivity, offsets);
  file.close("Piece");
  return std::move(file).finish();
}

std::string write_voronoi_vtp(const LabelledTriangles& surfaces, const RestrictedDiagram& diagram) {
  // Corners that are equal bit for bit are one point.
  std::vector<std::uint32_t> order(diagram.points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (diagram.points[a] == diagram.points[b]) return a < b;
    return lexicographically_less(diagram.points[a], diagram.points[b]);
  });
  std::vector<std::int64_t> point_of(order.size());
  std::vector<Vec3> points;
  for (const std::uint32_t corner : order) {
    if (points.empty() || !(points.back() == diagram.points[corner])) points.push_back(diagram.points[corner]);
    point_of[corner] = static_cast<std::int64_t>(points.size()) - 1;
  }
  std::vector<std::int32_t> site, surface, entity, triangle;
  std::vector<std::int64_t> offsets;
  for (std::size_t i = 0; i < diagram.piece_count(); ++i) {
    const std::uint32_t on = surfaces.triangle_surface[diagram.piece_triangle[i]];
    site.push_back(signed_index(diagram.piece_site[i]));
    surface.push_back(signed_index(on));
    entity.push_back(signed_index(surfaces.surface_entity[on]));
    triangle.push_back(signed_index(diagram.piece_triangle[i]));
    offsets.push_back(diagram.piece_begin[i + 1]);
  }
  VtkXmlFile file("PolyData");
  write_entities(file, surfaces.entities);
  file.open(polys_piece(points.size(), diagram.piece_count()));
  file.open("CellData");
  file.array("site", site);
  file.array("surface", surface);
  file.array("entity", entity);
  file.array("triangle", triangle);
  file.close("CellData");
  write_points(file, points, surfaces.local_origin);
  write_polys(file, point_of, offsets);
  file.close("Piece");
  return std::move(file).finish();
}

namespace {

/// Names and roles of features, and one line per edge on them.
struct FeatureLines {
  std::vector<std::string> names, roles;
  std::vector<std::int32_t> feature;
  std::vector<std::int64_t> points, offsets;
  template <class Mesh>
  explicit FeatureLines(const Mesh& mesh) {
    for (const Feature& of : mesh.features) {
      names.push_back(of.name);
      roles.emplace_back(to_string(of.role));
    }
    for (const FeatureEdge& edge : mesh.edges) {
      feature.push_back(signed_index(edge.feature));
      points.insert(points.end(), {edge.a, edge.b});
      offsets.push_back(static_cast<std::int64_t>(points.size()));
    }
  }
  void write_names(VtkXmlFile& file) const {
    file.open("FieldData");
    file.string_field("feature_names", names);
    file.string_field("feature_roles", roles);
    file.close("FieldData");
  }
};

}  // namespace

std::string write_quads_vtp(const QuadMesh& mesh) {
  FeatureLines lines(mesh);
  std::vector<std::int64_t> quad_points, quad_offsets;
  for (const auto& quad : mesh.quads) {
    lines.feature.push_back(-1);
    quad_points.insert(quad_points.end(), quad.begin(), quad.end());
    quad_offsets.push_back(static_cast<std::int64_t>(quad_points.size()));
  }
  VtkXmlFile file("PolyData");
  lines.write_names(file);
  file.open(polys_piece(mesh.points.size(), mesh.quads.size(), mesh.edges.size()));
  file.open("CellData");
  file.array("feature", lines.feature);
  file.close("CellData");
  write_points(file, mesh.points, mesh.local_origin);
  write_cells(file, "Lines", lines.points, lines.offsets);
  write_polys(file, quad_points, quad_offsets);
  file.close("Piece");
  return std::move(file).finish();
}

std::string write_lines_vtp(std::span<const Polyline> lines, const Vec3& local_origin) {
  std::vector<Vec3> points;
  std::vector<std::string> names;
  std::vector<std::int32_t> number;
  std::vector<std::int64_t> connectivity, offsets;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto first = static_cast<std::int64_t>(points.size());
    for (const Vec3& p : lines[i].points) {
      connectivity.push_back(static_cast<std::int64_t>(points.size()));
      points.push_back(p);
    }
    if (lines[i].is_closed && !lines[i].points.empty()) connectivity.push_back(first);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    names.push_back(lines[i].name);
    number.push_back(signed_index(static_cast<std::uint32_t>(i)));
  }
  VtkXmlFile file("PolyData");
  file.open("FieldData");
  file.string_field("line_names", names);
  file.close("FieldData");
  file.open(polys_piece(points.size(), 0, lines.size()));
  file.open("CellData");
  file.array("line", number);
  file.close("CellData");
  write_points(file, points, local_origin);
  write_cells(file, "Lines", connectivity, offsets);
  write_polys(file, {}, {});
  file.close("Piece");
  return std::move(file).finish();
}

std::string write_feature_mesh_vtp(const FeatureMesh& mesh, const FrameField* field, const CornerMap* map) {
  FeatureLines lines(mesh);
  const std::size_t line_count = mesh.edges.size();
  std::vector<Vec3> points = mesh.points;  // of the lines; of the triangles too without a map
  std::vector<std::uint32_t> source(points.size());
  std::iota(source.begin(), source.end(), 0u);
  std::vector<std::int64_t> connectivity, offsets;
  std::array<std::vector<double>, 2> uv, direction;
  for (auto& vectors : direction) vectors.assign(3 * line_count, 0.0);
  for (auto& values : uv) values.assign(points.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    lines.feature.push_back(-1);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = mesh.triangles[t][k];
      connectivity.push_back(map ? static_cast<std::int64_t>(points.size()) : p);
      if (!map) continue;
      points.push_back(mesh.points[p]);
      source.push_back(p);
      for (std::size_t axis = 0; axis < 2; ++axis) uv[axis].push_back(map->uv[3 * t + k][axis]);
    }
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    if (!field) continue;
    const Vec3 &a = mesh.points[mesh.triangles[t][0]], &b = mesh.points[mesh.triangles[t][1]],
               &c = mesh.points[mesh.triangles[t][2]];
    const Vec3 along = b - a, normal = cross(along, c - a);
    const Vec3 x = (1 / length(along)) * along, y = (1 / length(normal)) * cross(normal, x);
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 arm = std::cos(field->angles[t][k]) * x + std::sin(field->angles[t][k]) * y;
      direction[k].insert(direction[k].end(), {arm.x, arm.y, arm.z});
    }
  }
  std::vector<std::int32_t> corner, valence;
  const std::vector<std::int8_t>* of = field ? &field->valence : map ? &map->valence : nullptr;
  for (const std::uint32_t p : source) {
    corner.push_back(std::binary_search(mesh.corners.begin(), mesh.corners.end(), p) ? 1 : 0);
    if (of) valence.push_back((*of)[p]);
  }
  VtkXmlFile file("PolyData");
  lines.write_names(file);
  file.open(polys_piece(points.size(), mesh.triangles.size(), line_count));
  file.open("PointData");
  file.array("corner", corner);
  if (of) file.array("valence", valence);
  if (map) {
    file.array("u", uv[0]);
    file.array("v", uv[1]);
  }
  file.close("PointData");
  file.open("CellData");
  file.array("feature", lines.feature);
  if (field) {
    file.array("direction_0", direction[0], 3);
    file.array("direction_1", direction[1], 3);
  }
  file.close("CellData");
  write_points(file, points, mesh.local_origin);
  write_cells(file, "Lines", lines.points, lines.offsets);
  write_polys(file, connectivity, offsets);
  file.close("Piece");
  return std::move(file).finish();
}

std::string write_vtu(const VolumeMesh& mesh) { return write_vtu(mesh, {}); }

std::string write_vtu(const VolumeMesh& mesh, std::span<const CellField> fields) {
  VtkXmlFile file("UnstructuredGrid");
  file.open("FieldData");
  file.byte_field("region_names", mesh.region_names);
  file.byte_field("entity_names", names_of(mesh.entities));
  file.close("FieldData");
  file.open("Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) + "\" NumberOfCells=\"" +
            std::to_string(mesh.cell_count()) + "\"");
  write_point_data(file, mesh.point_line, mesh.point_corner, {}, mesh.points.size());
  const std::vector<std::int32_t> none(mesh.cell_count(), -1);
  file.open("CellData");
  file.array("region", mesh.cell_region.size() == mesh.cell_count() ? mesh.cell_region : none);
  file.array("entity", mesh.cell_entity.size() == mesh.cell_count() ? mesh.cell_entity : none);
  for (const CellField& field : fields)
    for (const std::size_t width : {1u, 3u})
      if (field.values.size() == width * mesh.cell_count() && mesh.cell_count() > 0)
        file.array(field.name, field.values, width);
  file.close("CellData");
  write_points(file, mesh.points, mesh.local_origin);
  std::vector<std::uint8_t> types;
  for (const CellType type : mesh.cell_types) types.push_back(static_cast<std::uint8_t>(type));
  file.open("Cells");
  file.array("connectivity", std::vector<std::int64_t>(mesh.cell_vertices.begin(), mesh.cell_vertices.end()));
  file.array("offsets", std::vector<std::int64_t>(mesh.cell_offsets.begin() + 1, mesh.cell_offsets.end()));
  file.array("types", types);
  file.close("Cells");
  file.close("Piece");
  return std::move(file).finish();
}

std::string write_facets_vtp(const VolumeMesh& mesh) {
  VtkXmlFile file("PolyData");
  write_entities(file, mesh.entities);
  file.open(polys_piece(mesh.points.size(), mesh.facets.size()));
  write_point_data(file, mesh.point_line, mesh.point_corner, {}, mesh.points.size());

  std::vector<std::int32_t> surface, entity, cell_0, cell_1;
  std::vector<std::int64_t> connectivity, offsets;
  for (const MeshFacet& facet : mesh.facets) {
    surface.push_back(signed_index(facet.surface));
    entity.push_back(facet.surface < mesh.surface_entity.size() ? mesh.surface_entity[facet.surface] : -1);
    cell_0.push_back(signed_index(facet.cell_0));
    cell_1.push_back(signed_index(facet.cell_1));
    for (const std::uint32_t vertex : facet.vertices)
      if (vertex != no_index) connectivity.push_back(vertex);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  file.open("CellData");
  file.array("surface", surface);
  file.array("entity", entity);
  file.array("cell_0", cell_0);
  file.array("cell_1", cell_1);
  file.close("CellData");
  write_points(file, mesh.points, mesh.local_origin);
  write_polys(file, connectivity, offsets);
  file.close("Piece");
  return std::move(file).finish();
}

}  // namespace strataflow
