#include "io/mesh/read_ucd.h"

#include <array>
#include <vector>

#include "io/input/input_builder.h"
#include "io/input/tagged_points.h"
#include "io/text/word_stream.h"
#include "io/vtk/vtk_cells.h"

namespace strataflow {

namespace {
struct UcdCell {
  std::string_view word;
  std::size_t size;
  std::optional<CellType> type;       ///< of volume cells
  std::array<std::uint8_t, 8> order;  ///< ours[k] = theirs[order[k]]; AVS counts from the top down
};
constexpr UcdCell ucd_cells[] = {{"pt", 1, std::nullopt, {}},
                                 {"line", 2, std::nullopt, {}},
                                 {"tri", 3, std::nullopt, {}},
                                 {"quad", 4, std::nullopt, {}},
                                 {"tet", 4, CellType::tetrahedron, {0, 1, 3, 2}},
                                 {"pyr", 5, CellType::pyramid, {1, 2, 3, 4, 0}},
                                 {"prism", 6, CellType::prism, {3, 4, 5, 0, 1, 2}},
                                 {"hex", 8, CellType::hexahedron, {4, 5, 6, 7, 0, 1, 2, 3}}};

struct PendingCell {
  CellType type;
  std::int64_t material;
  std::array<std::uint32_t, 8> vertices;
};

class UcdReader {
 public:
  UcdReader(std::string_view bytes, const std::string& file_name) : text_(bytes, file_name), built_(file_name) {}

  Result<InputData> read() {
    const std::string_view first = text_.peek();
    if (!first.empty() && (first[0] == '*' || first[0] == 7))
      text_.fail_as(FailureCode::unsupported, first[0] == '*' ? "Abaqus files are not read" : "binary UCD is not read",
                    "export it as ascii AVS UCD, or as .vtu");
    const std::size_t point_count = text_.count("the number of nodes"), cell_count = text_.count("the number of cells");
    const std::size_t node_values = text_.count("the number of node values"),
                      cell_values = text_.count("the number of cell values");
    text_.integer("the number of model values");
    read_points(point_count);
    for (std::size_t c = 0; c < cell_count && !text_.failed(); ++c) read_cell();
    if (node_values != 0) read_node_values(node_values);
    if (cell_values != 0) built_.warn("ignored_cell_data", std::to_string(cell_values) + " values of cells");
    if (text_.failed()) return text_.failure();
    add_volume_cells();
    built_.name_regions(cell_material_, [&](std::int64_t material) { return name(material); });
    return std::move(built_).finish();
  }

 private:
  std::string name(std::int64_t material) const { return built_.stem() + "_" + std::to_string(material); }

  void read_points(std::size_t count) {
    for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
      tags_.add(text_.integer("a node number"));
      built_.points.push_back(text_.point());
    }
    if (!tags_.finish()) text_.fail("two nodes have the same number");
  }

  std::uint32_t vertex() {
    const std::int64_t tag = text_.integer("a node number");
    const auto index = tags_.index(tag);
    if (!index) text_.fail("node " + std::to_string(tag) + " does not exist");
    return index.value_or(0);
  }

  void read_cell() {
    text_.integer("a cell number");
    const std::int64_t material = text_.integer("a material");
    const std::string_view word = text_.word();
    for (const UcdCell& cell : ucd_cells) {
      if (cell.word != word) continue;
      std::uint32_t theirs[8] = {};
      for (std::size_t k = 0; k < cell.size; ++k) theirs[k] = vertex();
      if (text_.failed()) return;
      if (cell.type) {
        PendingCell pending{*cell.type, material, {}};
        for (std::size_t k = 0; k < cell.size; ++k) pending.vertices[k] = theirs[cell.order[k]];
        swap_prism_order(*cell.type, pending.vertices.data());
        cells_.push_back(pending);
      } else if (cell.size >= 3) {
        built_.add_polygon(theirs, cell.size, built_.patch(name(material)));
      } else if (cell.size == 2) {
        built_.add_segment(theirs[0], theirs[1], name(material));
      }
      return;
    }
    text_.fail(word.empty() ? std::string("the file ends in the list of cells")
                            : "unknown kind of cell '" + shown(word) + "'");
  }

  /// Writers disagree about the order of tetrahedra: the one that makes most of them positive is taken for all.
  void add_volume_cells() {
    std::int64_t balance = 0;
    for (const PendingCell& cell : cells_) {
      if (cell.type != CellType::tetrahedron) continue;
      const auto corner = [&](std::size_t k) { return built_.points[cell.vertices[k]]; };
      const double volume = dot(cross(corner(1) - corner(0), corner(2) - corner(0)), corner(3) - corner(0));
      balance += volume > 0 ? 1 : volume < 0 ? -1 : 0;
    }
    for (PendingCell& cell : cells_) {
      if (cell.type == CellType::tetrahedron && balance < 0) std::swap(cell.vertices[2], cell.vertices[3]);
      cell_material_.push_back(cell.material);
      built_.add_cell(cell.type, cell.vertices.data(), 0);
    }
  }

  void read_node_values(std::size_t value_count) {
    const std::size_t component_count = text_.count("the number of components");
    std::size_t total = 0;
    for (std::size_t c = 0; c < component_count && !text_.failed(); ++c) {
      const std::size_t width = text_.count("the size of a component");
      built_.properties.push_back({"", "", static_cast<std::uint32_t>(width), {}});
      total += width;
    }
    if (total != value_count) text_.fail("the sizes of the components do not add up to " + std::to_string(value_count));
    text_.rest_of_line();
    for (std::size_t c = 0; c < component_count && !text_.failed(); ++c) {
      const std::string_view line = text_.rest_of_line();
      const std::size_t comma = std::min(line.find(','), line.size());
      built_.properties[c].name = line.substr(0, comma);
      std::string_view unit = line.substr(std::min(comma + 1, line.size()));
      while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
      built_.properties[c].unit = unit;
    }
    if (text_.failed()) return;
    for (PointProperty& property : built_.properties)
      property.values.reserve(std::min(built_.points.size() * property.width, text_.bytes_left()));
    for (std::size_t i = 0; i < built_.points.size() && !text_.failed(); ++i) {
      const std::int64_t tag = text_.integer("a node number");
      if (tags_.index(tag) != i) text_.fail("node values are not in the order of the nodes");
      for (PointProperty& property : built_.properties)
        for (std::uint32_t k = 0; k < property.width && !text_.failed(); ++k)
          property.values.push_back(text_.number("a node value"));
    }
  }

  WordStream text_;
  InputBuilder built_;
  TaggedPoints tags_;
  std::vector<PendingCell> cells_;
  std::vector<std::int64_t> cell_material_;
};
}  // namespace

Result<InputData> read_ucd(std::string_view bytes, const std::string& file_name) {
  return UcdReader(bytes, file_name).read();
}

}  // namespace strataflow
