#include "io/mesh/read_medit.h"

#include <cctype>
#include <vector>

#include "io/input/input_builder.h"
#include "io/text/word_stream.h"
#include "io/vtk/vtk_cells.h"

namespace strataflow {

namespace {
struct VolumeKeyword {
  std::string_view word;
  CellType type;
};
constexpr VolumeKeyword volume_keywords[] = {{"Tetrahedra", CellType::tetrahedron},
                                             {"Pyramids", CellType::pyramid},
                                             {"Prisms", CellType::prism},
                                             {"Hexahedra", CellType::hexahedron},
                                             {"Hexaedra", CellType::hexahedron}};

class MeditReader {
 public:
  MeditReader(std::string_view bytes, const std::string& file_name) : text_(bytes, file_name), built_(file_name) {}

  Result<InputData> read() {
    if (text_.word() != "MeshVersionFormatted") text_.fail("the first word is not MeshVersionFormatted");
    text_.integer("the version");
    for (std::string_view keyword = text_.word(); keyword != "End" && !text_.failed(); keyword = text_.word())
      read_section(keyword);
    if (text_.failed()) return text_.failure();
    number_regions();
    return std::move(built_).finish();
  }

 private:
  void read_section(std::string_view keyword) {
    if (keyword.empty()) return text_.fail("the file ends without the word End");
    if (keyword == "Dimension") {
      const std::int64_t dimension = text_.integer("the dimension");
      if (dimension != 3)
        text_.fail_as(FailureCode::unsupported, "a mesh of dimension " + std::to_string(dimension) + " is not read",
                      "export it with three coordinates");
      return;
    }
    if (keyword == "Vertices") return read_vertices();
    if (keyword == "Edges") return read_edges();
    if (keyword == "Triangles") return read_polygons(3);
    if (keyword == "Quadrilaterals") return read_polygons(4);
    for (const VolumeKeyword& volume : volume_keywords)
      if (keyword == volume.word) return read_cells(volume.type);
    if (!std::isalpha(static_cast<unsigned char>(keyword[0])))
      return text_.fail("expected a keyword, found '" + shown(keyword) + "'");
    built_.warn("ignored_section", "'" + shown(keyword) + "'");
    while (!text_.peek().empty() && !std::isalpha(static_cast<unsigned char>(text_.peek()[0]))) text_.word();
  }

  void read_vertices() {
    const std::size_t count = text_.count("the number of vertices");
    for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
      built_.points.push_back(text_.point());
      text_.number("a reference");
    }
  }

  std::string name(std::int64_t reference) const { return built_.stem() + "_" + std::to_string(reference); }

  void read_edges() {
    const std::size_t count = text_.count("the number of edges");
    for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
      const std::uint32_t from = vertex(), to = vertex();
      built_.add_segment(from, to, name(text_.integer("a reference")));
    }
  }

  void read_polygons(std::size_t size) {
    const std::size_t count = text_.count("the number of polygons");
    std::uint32_t vertices[4];
    for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
      for (std::size_t k = 0; k < size; ++k) vertices[k] = vertex();
      const std::int64_t reference = text_.integer("a reference");
      if (text_.failed()) return;
      if (i == 0 || reference != last_reference_) last_patch_ = built_.patch(name(reference));
      last_reference_ = reference;
      built_.add_polygon(vertices, size, last_patch_);
    }
  }

  void read_cells(CellType type) {
    const std::size_t count = text_.count("the number of cells");
    std::uint32_t vertices[8];
    for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
      for (int k = 0; k < vertex_count(type); ++k) vertices[k] = vertex();
      cell_reference_.push_back(text_.integer("a reference"));
      swap_prism_order(type, vertices);
      built_.add_cell(type, vertices, 0);
    }
  }

  std::uint32_t vertex() { return text_.vertex(1, built_.points.size()); }

  void number_regions() {
    built_.name_regions(cell_reference_, [&](std::int64_t reference) { return name(reference); });
  }

  WordStream text_;
  InputBuilder built_;
  std::vector<std::int64_t> cell_reference_;
  std::int64_t last_reference_ = 0;
  std::uint32_t last_patch_ = 0;
};
}  // namespace

Result<InputData> read_medit(std::string_view bytes, const std::string& file_name) {
  return MeditReader(bytes, file_name).read();
}

}  // namespace strataflow
