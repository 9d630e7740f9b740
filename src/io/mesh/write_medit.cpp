#include "io/mesh/write_medit.h"

#include <algorithm>
#include <array>

#include "io/text/number_text.h"
#include "io/vtk/vtk_cells.h"

namespace strataflow {

namespace {
struct Section {
  std::string rows;
  std::size_t count = 0;
  void add(const std::uint32_t* vertices, std::size_t size, std::int64_t reference) {
    for (std::size_t k = 0; k < size; ++k) {
      append_number(rows, vertices[k] + 1);
      rows += ' ';
    }
    append_number(rows, reference);
    rows += '\n';
    ++count;
  }
  std::string text(const std::string& keyword) const {
    return count == 0 ? std::string() : "\n" + keyword + "\n" + std::to_string(count) + "\n" + rows;
  }
};
}  // namespace

std::string write_medit(const VolumeMesh& mesh) {
  Section vertices, corners, triangles, quads, tetrahedra, pyramids, prisms, hexahedra;
  for (const Vec3& point : mesh.points) {
    append_point(vertices.rows, point + mesh.local_origin);
    vertices.rows += " 0\n";
    ++vertices.count;
  }
  for (std::size_t i = 0; i < mesh.point_corner.size(); ++i)
    if (mesh.point_corner[i] >= 0) {
      append_number(corners.rows, i + 1);
      corners.rows += '\n';
      ++corners.count;
    }
  for (const MeshFacet& facet : mesh.facets) {
    const bool is_triangle = facet.vertices[3] == no_index;
    (is_triangle ? triangles : quads)
        .add(facet.vertices.data(), is_triangle ? 3 : 4,
             facet.surface == no_index ? 0 : std::int64_t{facet.surface} + 1);
  }
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const CellType type = mesh.cell_types[c];
    const std::size_t size = static_cast<std::size_t>(vertex_count(type));
    std::array<std::uint32_t, 8> corner{};
    std::copy_n(mesh.cell_vertices.begin() + mesh.cell_offsets[c], size, corner.begin());
    swap_prism_order(type, corner.data());
    Section& section = type == CellType::tetrahedron ? tetrahedra
                       : type == CellType::pyramid   ? pyramids
                       : type == CellType::prism     ? prisms
                                                     : hexahedra;
    section.add(corner.data(), size, c < mesh.cell_region.size() ? std::int64_t{mesh.cell_region[c]} + 1 : 0);
  }
  return "MeshVersionFormatted 2\n\nDimension 3\n" + vertices.text("Vertices") + corners.text("Corners") +
         triangles.text("Triangles") + quads.text("Quadrilaterals") + tetrahedra.text("Tetrahedra") +
         pyramids.text("Pyramids") + prisms.text("Prisms") + hexahedra.text("Hexahedra") + "\nEnd\n";
}

std::string write_medit(const LabelledTriangles& surfaces) { return write_medit(facets_only(surfaces)); }

}  // namespace strataflow
