#include "io/mesh/write_abaqus.h"

#include <algorithm>
#include <map>
#include <set>

#include "io/text/number_text.h"
#include "io/vtk/vtk_cells.h"

namespace strataflow {

namespace {
std::string_view solid_name(CellType type) {
  switch (type) {
    case CellType::tetrahedron:
      return "C3D4";
    case CellType::pyramid:
      return "C3D5";
    case CellType::prism:
      return "C3D6";
    case CellType::hexahedron:
      return "C3D8";
  }
  return "";
}

/// Elements of one type in one set, as rows.
struct ElementBlock {
  std::string rows;
  void add(std::size_t number, const std::vector<std::uint32_t>& vertices) {
    append_number(rows, number);
    for (const std::uint32_t vertex : vertices) {
      rows += ", ";
      append_number(rows, vertex + 1);
    }
    rows += '\n';
  }
};

void append_node_set(std::string& text, const std::string& name, std::vector<std::uint32_t> nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.empty()) return;
  text += "*NSET, NSET=" + name + "\n";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    append_number(text, nodes[i] + 1);
    text += i + 1 == nodes.size() || i % 16 == 15 ? "\n" : ", ";  // sixteen a line at most
  }
}

/// Set names start with a letter and are at most 80 letters long.
std::string set_name(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  if (!((name[0] >= 'a' && name[0] <= 'z') || (name[0] >= 'A' && name[0] <= 'Z'))) name = "S_" + name;
  return name.size() <= 70 ? name : name.substr(0, 70);
}

std::vector<std::string> set_names(const std::vector<std::string>& names, std::set<std::string>& taken) {
  std::vector<std::string> result;
  for (const std::string& name : names) {
    std::string candidate = set_name(name);
    for (int number = 2; !taken.insert(candidate).second; ++number)
      candidate = set_name(name) + "_" + std::to_string(number);
    result.push_back(candidate);
  }
  return result;
}
}  // namespace

std::string write_abaqus(const VolumeMesh& mesh) {
  std::string text = "*HEADING\nstrataflow\n*NODE\n";
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    append_number(text, i + 1);
    text += ", ";
    append_point(text, mesh.points[i] + mesh.local_origin, ", ");
    text += '\n';
  }

  std::vector<std::uint32_t> surface_entity(mesh.surface_entity.begin(), mesh.surface_entity.end());
  for (const MeshFacet& facet : mesh.facets)
    if (facet.surface != no_index && facet.surface >= surface_entity.size())
      surface_entity.resize(std::size_t{facet.surface} + 1, no_index);
  const std::vector<std::int32_t> used = used_regions(mesh);
  const std::vector<std::uint32_t> places = region_places(mesh, used);
  std::set<std::string> taken;
  std::vector<std::string> regions = region_names(mesh, used);
  regions.push_back("no_region");
  regions = set_names(regions, taken);
  const std::vector<std::string> surfaces = set_names(surface_names(surface_entity, mesh.entities), taken);

  std::map<std::pair<std::size_t, std::string_view>, ElementBlock> blocks;  // by set, then type
  std::vector<std::vector<std::uint32_t>> region_nodes(regions.size()), surface_nodes(surfaces.size());
  std::size_t number = 0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    std::vector<std::uint32_t> vertices(mesh.cell_vertices.begin() + mesh.cell_offsets[c],
                                        mesh.cell_vertices.begin() + mesh.cell_offsets[c + 1]);
    const std::size_t set = places[c];
    region_nodes[set].insert(region_nodes[set].end(), vertices.begin(), vertices.end());
    swap_prism_order(mesh.cell_types[c], vertices.data());
    blocks[{set, solid_name(mesh.cell_types[c])}].add(++number, vertices);
  }
  for (const MeshFacet& facet : mesh.facets) {
    if (facet.surface == no_index) continue;
    const bool is_triangle = facet.vertices[3] == no_index;
    const std::vector<std::uint32_t> vertices(facet.vertices.begin(), facet.vertices.begin() + (is_triangle ? 3 : 4));
    surface_nodes[facet.surface].insert(surface_nodes[facet.surface].end(), vertices.begin(), vertices.end());
    if (mesh.cell_count() == 0) blocks[{facet.surface, is_triangle ? "S3" : "S4"}].add(++number, vertices);
  }
  const std::vector<std::string>& element_sets = mesh.cell_count() == 0 ? surfaces : regions;
  for (const auto& [key, block] : blocks)
    text += "*ELEMENT, TYPE=" + std::string(key.second) + ", ELSET=" + element_sets[key.first] + "\n" + block.rows;
  for (std::size_t r = 0; r < regions.size(); ++r) append_node_set(text, regions[r], std::move(region_nodes[r]));
  for (std::size_t s = 0; s < surfaces.size(); ++s) append_node_set(text, surfaces[s], std::move(surface_nodes[s]));
  return text;
}

std::string write_abaqus(const LabelledTriangles& surfaces) { return write_abaqus(facets_only(surfaces)); }

}  // namespace strataflow
