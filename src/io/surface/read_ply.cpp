#include "io/surface/read_ply.h"

#include <cmath>
#include <limits>
#include <vector>

#include "io/input/input_builder.h"
#include "io/text/word_stream.h"

namespace strataflow {

namespace {
enum class Encoding { ascii, little_endian, big_endian };
enum class NumberType { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

NumberType number_type(std::string_view word) {
  if (word == "char" || word == "int8") return NumberType::int8;
  if (word == "uchar" || word == "uint8") return NumberType::uint8;
  if (word == "short" || word == "int16") return NumberType::int16;
  if (word == "ushort" || word == "uint16") return NumberType::uint16;
  if (word == "int" || word == "int32") return NumberType::int32;
  if (word == "uint" || word == "uint32") return NumberType::uint32;
  if (word == "float" || word == "float32") return NumberType::float32;
  if (word == "double" || word == "float64") return NumberType::float64;
  return NumberType::none;
}

struct Property {
  std::string name;
  NumberType type = NumberType::none;
  NumberType size_type = NumberType::none;  ///< of lists; none: a single number
  bool is_list() const { return size_type != NumberType::none; }
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file_name) : text_(bytes, file_name, '\n'), built_(file_name) {}

  Result<InputData> read() {
    read_header();
    for (const Element& element : elements_) {
      if (text_.failed()) break;
      if (element.properties.empty() && element.count > 0)
        text_.fail("element '" + shown(element.name) + "' has no properties");
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else
        skip(element);
    }
    if (text_.failed()) return text_.failure();
    if (short_faces_ != 0)
      built_.warn("skipped_cells", std::to_string(short_faces_) + " x polygon of fewer than three points");
    return std::move(built_).finish();
  }

 private:
  void read_header() {
    if (text_.rest_of_line() != "ply") text_.fail("the first line is not 'ply'");
    while (!text_.failed()) {
      const std::string_view keyword = text_.word();
      if (keyword == "format") {
        const std::string_view word = text_.word();
        if (word == "binary_little_endian")
          encoding_ = Encoding::little_endian;
        else if (word == "binary_big_endian")
          encoding_ = Encoding::big_endian;
        else if (word != "ascii")
          text_.fail("unknown format '" + shown(word) + "'");
      } else if (keyword == "element") {
        Element& element = elements_.emplace_back();
        element.name = text_.word();
        element.count = text_.count("the number of elements");
      } else if (keyword == "property") {
        Property property;
        std::string_view word = text_.word();
        if (word == "list") {
          property.size_type = number_type(text_.word());
          if (property.size_type == NumberType::none || property.size_type >= NumberType::float32)
            text_.fail("unknown type of a list's length");
          word = text_.word();
        }
        property.type = number_type(word);
        if (property.type == NumberType::none) text_.fail("unknown type '" + shown(word) + "'");
        property.name = text_.word();
        if (elements_.empty())
          text_.fail("a property before any element");
        else
          elements_.back().properties.push_back(property);
      } else if (keyword == "end_header") {
        text_.rest_of_line();
        return;
      } else if (keyword != "comment" && keyword != "obj_info") {
        text_.fail(keyword.empty() ? std::string("the header does not end")
                                   : "unknown keyword '" + shown(keyword) + "'");
      }
      text_.rest_of_line();
    }
  }

  double number(NumberType type) {
    if (encoding_ == Encoding::ascii) return text_.number("a number");
    const bool swap = encoding_ == Encoding::big_endian;
    switch (type) {
      case NumberType::int8:
        return text_.binary<std::int8_t>(swap);
      case NumberType::uint8:
        return text_.binary<std::uint8_t>(swap);
      case NumberType::int16:
        return text_.binary<std::int16_t>(swap);
      case NumberType::uint16:
        return text_.binary<std::uint16_t>(swap);
      case NumberType::int32:
        return text_.binary<std::int32_t>(swap);
      case NumberType::uint32:
        return text_.binary<std::uint32_t>(swap);
      case NumberType::float32:
        return text_.binary<float>(swap);
      case NumberType::float64:
        return text_.binary<double>(swap);
      case NumberType::none:
        break;
    }
    return 0;
  }

  /// The length of a list: each entry takes at least a byte.
  std::size_t list_size(const Property& property) {
    const double size = number(property.size_type);
    if (size >= 0 && size <= static_cast<double>(text_.bytes_left())) return static_cast<std::size_t>(size);
    fail("a list's length cannot be");
    return 0;
  }

  void fail(const std::string& what) { encoding_ == Encoding::ascii ? text_.fail(what) : text_.fail_at_byte(what); }

  void skip_value(const Property& property) {
    const std::size_t size = property.is_list() ? list_size(property) : 1;
    for (std::size_t k = 0; k < size && !text_.failed(); ++k) number(property.type);
  }

  void skip(const Element& element) {
    if (element.count > 0)
      built_.warn("ignored_element", std::to_string(element.count) + " x '" + shown(element.name) + "'");
    for (std::size_t i = 0; i < element.count && !text_.failed(); ++i)
      for (const Property& property : element.properties) skip_value(property);
  }

  void read_vertices(const Element& element) {
    std::vector<int> axis, slot;  // per property: which coordinate it is, or which point property
    int axes_found = 0;
    for (const Property& property : element.properties) {
      const int which = property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : -1;
      axis.push_back(property.is_list() ? -1 : which);
      axes_found += axis.back() >= 0;
      slot.push_back(-1);
      if (axis.back() >= 0) continue;
      if (property.is_list()) {
        built_.warn("ignored_point_data", "the lists '" + shown(property.name) + "' of vertices");
      } else {
        slot.back() = static_cast<int>(built_.properties.size());
        built_.properties.push_back({property.name, "", 1, {}});
      }
    }
    if (axes_found != 3) text_.fail("its vertices have no x, y and z");
    for (std::size_t i = 0; i < element.count && !text_.failed(); ++i) {
      Vec3 point;
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (element.properties[p].is_list()) {
          skip_value(element.properties[p]);
          continue;
        }
        const double value = number(element.properties[p].type);
        if (axis[p] >= 0)
          point[axis[p]] = value;
        else
          built_.properties[static_cast<std::size_t>(slot[p])].values.push_back(value);
      }
      if (!is_finite(point)) fail("vertex " + std::to_string(i) + " has a coordinate that is not a finite number");
      built_.points.push_back(point);
    }
  }

  void read_faces(const Element& element) {
    const std::uint32_t patch = built_.patch(built_.stem());
    const double point_count = static_cast<double>(built_.points.size());
    std::vector<std::uint32_t> vertices;
    for (const Property& property : element.properties)
      if (!is_vertex_list(property)) built_.warn("ignored_cell_data", "'" + shown(property.name) + "' of faces");
    for (std::size_t f = 0; f < element.count && !text_.failed(); ++f) {
      vertices.clear();
      for (const Property& property : element.properties) {
        if (!is_vertex_list(property)) {
          skip_value(property);
          continue;
        }
        const std::size_t size = list_size(property);
        for (std::size_t k = 0; k < size && !text_.failed(); ++k) {
          const double index = number(property.type);
          if (index >= 0 && index < point_count)
            vertices.push_back(static_cast<std::uint32_t>(index));
          else
            fail("face " + std::to_string(f) + " refers to a point that does not exist; there are " +
                 std::to_string(built_.points.size()));
        }
      }
      if (text_.failed()) return;
      if (vertices.size() < 3) ++short_faces_;
      built_.add_polygon(vertices.data(), vertices.size(), patch);
    }
  }

  static bool is_vertex_list(const Property& property) {
    return property.is_list() && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  WordStream text_;
  InputBuilder built_;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::size_t short_faces_ = 0;
};
}  // namespace

Result<InputData> read_ply(std::string_view bytes, const std::string& file_name) {
  return PlyReader(bytes, file_name).read();
}

}  // namespace strataflow
