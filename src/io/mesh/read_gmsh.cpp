#include "io/mesh/read_gmsh.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "io/input/input_builder.h"
#include "io/input/tagged_points.h"
#include "io/text/word_stream.h"
#include "io/vtk/vtk_cells.h"

namespace strataflow {

namespace {
/// Nodes per element type, 0: unknown.
constexpr std::array<std::uint8_t, 32> element_sizes{0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                                     8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
constexpr std::array<int, 32> element_dimensions{0, 1, 2, 2, 3, 3, 3, 3, 1, 2, 2, 3, 3, 3, 3, 0,
                                                 2, 3, 3, 3, 2, 2, 2, 2, 2, 2, 1, 1, 1, 3, 3, 3};

/// Labels of elementary entities that are in no physical group start here; tags of groups are 32-bit numbers.
constexpr std::int64_t largest_tag = 0x7fffffff;
constexpr std::int64_t no_group = std::int64_t{1} << 40;

/// (dimension, tag) of a physical group or an elementary entity.
using DimensionTag = std::pair<int, std::int64_t>;

class GmshReader {
 public:
  GmshReader(std::string_view bytes, const std::string& file_name) : text_(bytes, file_name, '\n'), built_(file_name) {}

  Result<InputData> read() {
    read_format();
    for (std::string_view section = text_.word(); !section.empty() && !text_.failed(); section = text_.word()) {
      if (section == "$PhysicalNames")
        read_physical_names();
      else if (section == "$Entities" && is_4_)
        read_entities();
      else if (section == "$Nodes")
        is_4_ ? read_nodes_4() : read_nodes_2();
      else if (section == "$Elements")
        is_4_ ? read_elements_4() : read_elements_2();
      else {
        skip_section(section);
        continue;
      }
      expect_end(section);
    }
    if (!has_elements_) text_.fail("the file ends before $Elements");
    if (text_.failed()) return text_.failure();
    built_.name_regions(cell_label_, [&](std::int64_t label) { return name_of(3, label); });
    skipped_.report(built_);
    return std::move(built_).finish();
  }

 private:
  std::int64_t int_value(const char* what) {
    return is_binary_ ? text_.binary<std::int32_t>(swap_) : text_.integer(what);
  }
  std::int64_t size_value(const char* what) {
    return is_binary_ ? text_.binary<std::int64_t>(swap_) : text_.integer(what);
  }
  double real_value() { return is_binary_ ? text_.binary<double>(swap_) : text_.number("a number"); }
  std::size_t count_of(std::int64_t value, const char* what) {
    if (value >= 0 && static_cast<std::uint64_t>(value) <= text_.bytes_left()) return static_cast<std::size_t>(value);
    fail(std::string(what) + " is " + std::to_string(value) + ", which this file cannot hold");
    return 0;
  }
  std::size_t size_count(const char* what) { return count_of(size_value(what), what); }
  void fail(const std::string& what) { is_binary_ ? text_.fail_at_byte(what) : text_.fail(what); }

  void read_format() {
    if (text_.word() != "$MeshFormat") return text_.fail("the file does not start with $MeshFormat");
    const std::string_view version = text_.word();
    is_4_ = version == "4.1";
    if (!is_4_ && version.substr(0, 1) != "2")
      text_.fail_as(FailureCode::unsupported, "Gmsh format " + shown(version) + " is not read",
                    "save it as version 4.1 or 2.2");
    is_binary_ = text_.integer("the file type") == 1;
    if (text_.integer("the data size") != 8) text_.fail("only data of 8 bytes are known");
    if (is_binary_) {
      text_.rest_of_line();
      const std::int32_t one = text_.binary<std::int32_t>(false);
      swap_ = one != 1;
      if (one != 1 && one != 1 << 24) text_.fail_at_byte("the number that tells the byte order is neither way round");
    }
    expect_end("$MeshFormat");
  }

  void expect_end(std::string_view section) {
    const std::string expected = "$End" + std::string(section.substr(1));
    const std::string_view found = text_.word();
    if (found != expected) text_.fail("expected " + expected + ", found '" + shown(found) + "'");
  }

  void skip_section(std::string_view section) {
    if (section[0] != '$') return text_.fail("expected a section, found '" + shown(section) + "'");
    built_.warn("ignored_section", "'" + shown(section) + "'");
    const std::string end = "$End" + std::string(section.substr(1));
    while (!text_.failed() && text_.bytes_left() > 0)
      if (text_.rest_of_line() == end) return;
    text_.fail("the file ends before " + shown(end));
  }

  void read_physical_names() {  // text also in binary files
    const std::size_t count = text_.count("the number of names");
    for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
      const int dimension = static_cast<int>(text_.integer("a dimension"));
      const std::int64_t tag = text_.integer("a physical tag");
      physical_names_[{dimension, tag}] = text_.word();
    }
  }

  void start_section() {
    if (is_binary_) text_.rest_of_line();
  }

  void read_entities() {
    start_section();
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = size_count("the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t e = 0; e < counts[static_cast<std::size_t>(dimension)] && !text_.failed(); ++e) {
        const std::int64_t tag = int_value("an entity's tag");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) real_value();
        const std::size_t physicals = size_count("the number of physical groups");
        for (std::size_t p = 0; p < physicals && !text_.failed(); ++p) {
          const std::int64_t physical = int_value("a physical tag");
          if (p == 0)
            physical_of_[{dimension, tag}] = std::clamp<std::int64_t>(physical, -largest_tag, largest_tag);
          else
            note_second_group();
        }
        const std::size_t bounds = dimension == 0 ? 0 : size_count("the number of bounding entities");
        for (std::size_t b = 0; b < bounds && !text_.failed(); ++b) int_value("a bounding entity");
      }
  }

  void note_second_group() {
    if (!has_second_group_)
      built_.warn("ignored_physical_group", "of entities in several physical groups only the first counts");
    has_second_group_ = true;
  }

  void add_point(std::int64_t tag, const Vec3& point) {
    if (!is_finite(point)) fail("node " + std::to_string(tag) + " has a coordinate that is not a finite number");
    tags_.add(tag);
    built_.points.push_back(point);
  }

  Vec3 point_value() {
    const double x = real_value(), y = real_value(), z = real_value();
    return {x, y, z};
  }

  void read_nodes_2() {
    const std::size_t count = text_.count("the number of nodes");
    start_section();
    for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
      const std::int64_t tag = int_value("a node's number");
      add_point(tag, point_value());
    }
    finish_points();
  }

  void read_nodes_4() {
    start_section();
    const std::size_t blocks = size_count("the number of blocks");
    for (int k = 0; k < 3; ++k) size_value("a number of nodes");
    std::vector<std::int64_t> block_tags;
    for (std::size_t b = 0; b < blocks && !text_.failed(); ++b) {
      const std::int64_t dimension = int_value("a dimension");
      int_value("an entity's tag");
      const bool is_parametric = int_value("parametric or not") != 0;
      const std::size_t count = size_count("the number of nodes");
      block_tags.clear();
      for (std::size_t i = 0; i < count && !text_.failed(); ++i) block_tags.push_back(size_value("a node's number"));
      for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
        add_point(block_tags[i], point_value());
        for (std::int64_t k = 0; is_parametric && k < std::clamp<std::int64_t>(dimension, 0, 3); ++k) real_value();
      }
    }
    finish_points();
  }

  void finish_points() {
    if (!tags_.finish()) fail("two nodes have the same number");
  }

  void read_elements_2() {
    const std::size_t count = text_.count("the number of elements");
    start_section();
    for (std::size_t done = 0; done < count && !text_.failed();) {
      if (!is_binary_) text_.integer("an element's number");
      const std::int64_t type = int_value("an element's type");
      const std::size_t in_block = is_binary_ ? count_of(int_value(""), "the number of elements of a block") : 1;
      const std::size_t tag_count = count_of(int_value("the number of tags"), "the number of tags");
      if (in_block == 0) fail("a block of elements is empty");
      for (std::size_t i = 0; i < in_block && !text_.failed(); ++i, ++done) {
        if (is_binary_) int_value("");
        std::int64_t physical = 0, elementary = 0;
        for (std::size_t t = 0; t < tag_count && !text_.failed(); ++t) {
          const std::int64_t tag = std::clamp<std::int64_t>(int_value("a tag"), -largest_tag, largest_tag);
          if (t == 0) physical = tag;
          if (t == 1) elementary = tag;
        }
        read_element(type, physical, elementary, [&] { return int_value("a node's number"); });
      }
    }
    has_elements_ = true;
  }

  void read_elements_4() {
    start_section();
    const std::size_t blocks = size_count("the number of blocks");
    for (int k = 0; k < 3; ++k) size_value("a number of elements");
    for (std::size_t b = 0; b < blocks && !text_.failed(); ++b) {
      const int dimension = static_cast<int>(int_value("a dimension"));
      const std::int64_t elementary = std::clamp<std::int64_t>(int_value("an entity's tag"), -largest_tag, largest_tag),
                         type = int_value("an element's type");
      const std::size_t count = size_count("the number of elements");
      const auto found = physical_of_.find({dimension, elementary});
      const std::int64_t physical = found == physical_of_.end() ? 0 : found->second;
      for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
        size_value("an element's number");
        read_element(type, physical, elementary, [&] { return size_value("a node's number"); });
      }
    }
    has_elements_ = true;
  }

  template <class NextNode>
  void read_element(std::int64_t type, std::int64_t physical, std::int64_t elementary, NextNode next_node) {
    const std::size_t size = type > 0 && type < static_cast<std::int64_t>(element_sizes.size())
                                 ? element_sizes[static_cast<std::size_t>(type)]
                                 : 0;
    if (size == 0) return fail("unknown element type " + std::to_string(type));
    std::array<std::uint32_t, 56> nodes{};
    for (std::size_t k = 0; k < size && !text_.failed(); ++k) {
      const std::int64_t tag = next_node();
      const auto index = tags_.index(tag);
      if (!index) fail("node " + std::to_string(tag) + " does not exist");
      nodes[k] = index.value_or(0);
    }
    if (text_.failed()) return;
    const std::int64_t label = physical > 0 ? physical : no_group + elementary;
    switch (type) {
      case 1:
        return built_.add_segment(nodes[0], nodes[1], name_of(1, label));
      case 2:
      case 3:
        return built_.add_polygon(nodes.data(), size, surface_patch(elementary, label));
      case 4:
        return add_cell(CellType::tetrahedron, nodes.data(), label);
      case 5:
        return add_cell(CellType::hexahedron, nodes.data(), label);
      case 6:
        return add_cell(CellType::prism, nodes.data(), label);
      case 7:
        return add_cell(CellType::pyramid, nodes.data(), label);
      case 15:
        return;
      default:
        skipped_.add("element of Gmsh type " + std::to_string(type) + " (dimension " +
                     std::to_string(element_dimensions[static_cast<std::size_t>(type)]) + ", of higher order)");
    }
  }

  void add_cell(CellType type, std::uint32_t* nodes, std::int64_t label) {
    swap_prism_order(type, nodes);
    cell_label_.push_back(label);
    built_.add_cell(type, nodes, 0);
  }

  std::uint32_t surface_patch(std::int64_t elementary, std::int64_t label) {
    if (!has_patch_ || last_elementary_ != elementary || last_label_ != label) {
      last_patch_ = built_.patch(elementary, built_.entity(name_of(2, label)));
      last_elementary_ = elementary;
      last_label_ = label;
      has_patch_ = true;
    }
    return last_patch_;
  }

  std::string name_of(int dimension, std::int64_t label) const {
    const auto found = physical_names_.find({dimension, label});
    if (found != physical_names_.end()) return found->second;
    return built_.stem() + "_" + std::to_string(label < no_group / 2 ? label : label - no_group);
  }

  WordStream text_;
  InputBuilder built_;
  SkippedCells skipped_;
  TaggedPoints tags_;
  bool is_4_ = false, is_binary_ = false, swap_ = false, has_elements_ = false, has_second_group_ = false,
       has_patch_ = false;
  std::map<DimensionTag, std::string> physical_names_;
  std::map<DimensionTag, std::int64_t> physical_of_;  // of elementary entities
  std::vector<std::int64_t> cell_label_;
  std::int64_t last_elementary_ = 0, last_label_ = 0;
  std::uint32_t last_patch_ = 0;
};
}  // namespace

Result<InputData> read_gmsh(std::string_view bytes, const std::string& file_name) {
  return GmshReader(bytes, file_name).read();
}

}  // namespace strataflow
