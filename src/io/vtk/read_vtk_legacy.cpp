#include "io/vtk/read_vtk_legacy.h"

#include <cmath>
#include <vector>

#include "io/input/input_builder.h"
#include "io/text/word_stream.h"
#include "io/vtk/vtk_cells.h"

namespace strataflow {

namespace {
class LegacyReader {
 public:
  LegacyReader(std::string_view bytes, const std::string& file_name)
      : text_(bytes, file_name, '\n'), built_(file_name) {}

  Result<InputData> read() {
    read_header();
    for (std::string keyword = next_keyword(); !keyword.empty() && !text_.failed(); keyword = next_keyword())
      read_section(keyword);
    if (!has_points_) text_.fail("the file ends before POINTS");
    if (text_.failed()) return text_.failure();
    for (const PointProperty& property : built_.properties)
      if (property.values.size() != built_.points.size() * property.width)
        return Failure{FailureCode::malformed_file,
                       built_.file_name() + ": point array '" + shown(property.name) + "' has the wrong length",
                       "write the file again"};
    if (const Result<void> added = add_vtk_piece(built_, skipped_, piece_, {}); !added) return added.failure();
    skipped_.report(built_);
    return std::move(built_).finish();
  }

 private:
  enum class Owner { none, points, cells };

  std::string next_keyword() { return std::string(text_.word()); }

  void read_header() {
    if (text_.rest_of_line().substr(0, 5) != "# vtk")
      return text_.fail("the first line does not start with '# vtk DataFile'");
    text_.rest_of_line();  // title
    const std::string_view encoding = text_.word();
    is_binary_ = encoding == "BINARY";
    if (!is_binary_ && encoding != "ASCII")
      return text_.fail("expected ASCII or BINARY, found '" + shown(encoding) + "'");
    if (text_.word() != "DATASET") return text_.fail("expected DATASET");
    const std::string_view type = text_.word();
    if (text_.bytes_left() == 0) text_.fail("the file ends in its header");
    if (type != "POLYDATA" && type != "UNSTRUCTURED_GRID")
      text_.fail_as(FailureCode::unsupported, "VTK data of type '" + shown(type) + "' are not read",
                    "save it as POLYDATA or UNSTRUCTURED_GRID");
  }

  void read_section(const std::string& keyword) {
    if (keyword == "POINTS") return read_points();
    if (keyword == "VERTICES") return read_cells(piece_.verts);
    if (keyword == "LINES") return read_cells(piece_.lines);
    if (keyword == "POLYGONS") return read_cells(piece_.polys);
    if (keyword == "TRIANGLE_STRIPS") return read_cells(piece_.strips);
    if (keyword == "CELLS") return read_cells(piece_.cells);
    if (keyword == "CELL_TYPES") {
      const std::size_t count = text_.count("the number of cell types");
      piece_.types = array<std::int64_t>(count, "int");
      return;
    }
    if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      owner_ = keyword == "POINT_DATA" ? Owner::points : Owner::cells;
      tuple_count_ = text_.count("the number of tuples");
      return;
    }
    if (keyword == "METADATA") {
      text_.rest_of_line();
      while (text_.bytes_left() > 0 && !text_.rest_of_line().empty()) {
      }  // up to an empty line
      return;
    }
    if (keyword == "FIELD") return read_field();
    if (owner_ == Owner::none) return text_.fail("expected a section, found '" + shown(keyword) + "'");
    const std::string name(text_.word());
    if (keyword == "SCALARS") {
      const std::string type(text_.word());
      std::size_t width = 1;
      if (text_.peek() != "LOOKUP_TABLE") width = text_.count("the number of components");
      if (text_.peek() == "LOOKUP_TABLE") {
        text_.word();
        text_.word();
      }
      return read_array(name, width, tuple_count_, type);
    }
    if (keyword == "VECTORS" || keyword == "NORMALS")
      return read_array(name, 3, tuple_count_, std::string(text_.word()));
    if (keyword == "TENSORS") return read_array(name, 9, tuple_count_, std::string(text_.word()));
    if (keyword == "TEXTURE_COORDINATES") {
      const std::size_t width = text_.count("the dimension");
      return read_array(name, width, tuple_count_, std::string(text_.word()));
    }
    if (keyword == "COLOR_SCALARS")
      return read_array(name, text_.count("the number of colours"), tuple_count_,
                        is_binary_ ? "unsigned_char" : "float");
    if (keyword == "LOOKUP_TABLE") {
      const std::size_t size = text_.count("the size of the table");
      array<double>(product(size, 4), is_binary_ ? "unsigned_char" : "float");
      return;
    }
    text_.fail("unknown section '" + shown(keyword) + "'");
  }

  /// Saturates: what is larger than the file is refused by `array`.
  static std::size_t product(std::size_t a, std::size_t b) {
    return b != 0 && a > (std::size_t{1} << 60) / b ? std::size_t{1} << 60 : a * b;
  }

  template <class Stored, class T>
  void take_binary(std::size_t count, std::vector<T>& values) {
    const std::string_view bytes = text_.bytes(product(count, sizeof(Stored)));
    values.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(Stored)) {
      const Stored value = load_number<Stored>(bytes.data() + i, true);
      if constexpr (std::is_floating_point_v<Stored> && std::is_integral_v<T>)
        values.push_back(std::abs(value) < 9e15 ? static_cast<T>(value) : -1);
      else
        values.push_back(static_cast<T>(value));
    }
  }

  /// `count` numbers stored as `type`; binary ones start on the next line and are big-endian.
  template <class T>
  std::vector<T> array(std::size_t count, const std::string& type) {
    std::vector<T> values;
    if (text_.failed()) return values;
    if (count > text_.bytes_left() && type != "bit") {
      text_.fail(std::to_string(count) + " numbers are announced, which this file cannot hold");
      return values;
    }
    if (!is_binary_) {
      values.reserve(count);
      for (std::size_t i = 0; i < count && !text_.failed(); ++i) {
        const double value = text_.number("a number");
        values.push_back(std::is_integral_v<T> && !(std::abs(value) < 9e15) ? T(-1) : static_cast<T>(value));
      }
      return values;
    }
    text_.rest_of_line();
    if (type == "double")
      take_binary<double>(count, values);
    else if (type == "float")
      take_binary<float>(count, values);
    else if (type == "int" || type == "vtkIdType" || type == "vtktypeint32")
      take_binary<std::int32_t>(count, values);
    else if (type == "unsigned_int" || type == "vtktypeuint32")
      take_binary<std::uint32_t>(count, values);
    else if (type == "vtktypeint64" || type == "vtktypeuint64" || type == "long" || type == "unsigned_long")
      take_binary<std::int64_t>(count, values);
    else if (type == "short" || type == "vtktypeint16")
      take_binary<std::int16_t>(count, values);
    else if (type == "unsigned_short" || type == "vtktypeuint16")
      take_binary<std::uint16_t>(count, values);
    else if (type == "char" || type == "vtktypeint8")
      take_binary<std::int8_t>(count, values);
    else if (type == "unsigned_char" || type == "vtktypeuint8")
      take_binary<std::uint8_t>(count, values);
    else
      text_.fail("numbers of type '" + shown(type) + "' are not known");
    return values;
  }

  void read_points() {
    const std::size_t count = text_.count("the number of points");
    const std::string type(text_.word());
    if (has_points_) return text_.fail("a second POINTS section");
    has_points_ = true;
    const std::vector<double> coordinates = array<double>(product(count, 3), type);
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
      built_.points.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  }

  void read_cells(VtkCellList& cells) {
    const std::size_t first = text_.count("the number of cells"), second = text_.count("the length of the list");
    if (text_.peek() == "OFFSETS") {  // version 5: `first` offsets, from 0, then the vertices
      text_.word();
      const std::string offset_type(text_.word());
      cells.offsets = array<std::int64_t>(first, offset_type);
      if (!cells.offsets.empty()) cells.offsets.erase(cells.offsets.begin());
      if (text_.word() != "CONNECTIVITY") text_.fail("expected CONNECTIVITY");
      const std::string vertex_type(text_.word());
      cells.vertices = array<std::int64_t>(second, vertex_type);
      return;
    }
    const std::vector<std::int64_t> list = array<std::int64_t>(second, "int");
    std::size_t place = 0;
    for (std::size_t c = 0; c < first && !text_.failed(); ++c) {
      const std::int64_t size = place < list.size() ? list[place] : -1;
      if (size < 0 || static_cast<std::uint64_t>(size) > list.size() - place - 1)
        return text_.fail("cell " + std::to_string(c) + " is longer than the list it is in");
      cells.vertices.insert(cells.vertices.end(), list.begin() + static_cast<std::ptrdiff_t>(place + 1),
                            list.begin() + static_cast<std::ptrdiff_t>(place + 1) + size);
      cells.offsets.push_back(static_cast<std::int64_t>(cells.vertices.size()));
      place += 1 + static_cast<std::size_t>(size);
    }
  }

  void read_field() {
    text_.word();  // the field's name
    const std::size_t array_count = text_.count("the number of arrays");
    for (std::size_t a = 0; a < array_count && !text_.failed(); ++a) {
      while (text_.peek() == "METADATA") {
        text_.word();
        read_section("METADATA");
      }
      const std::string name(text_.word());
      const std::size_t width = text_.count("the number of components"), count = text_.count("the number of tuples");
      const std::string type(text_.word());
      if (type == "string") {
        if (is_binary_)
          return text_.fail_as(FailureCode::unsupported, "binary arrays of words are not read",
                               "save the file as ascii or as .vtu");
        text_.rest_of_line();
        for (std::size_t i = 0; i < product(width, count) && text_.bytes_left() > 0; ++i) text_.rest_of_line();
        built_.warn("ignored_array", "'" + shown(name) + "' holds words");
        continue;
      }
      read_array(name, width, count, type);
    }
  }

  void read_array(const std::string& name, std::size_t width, std::size_t count, const std::string& type) {
    const std::size_t total = product(width, count);
    if (owner_ == Owner::points && width >= 1 && width <= 64) {
      built_.properties.push_back({name, "", static_cast<std::uint32_t>(width), array<double>(total, type)});
      return;
    }
    if (owner_ == Owner::cells && width == 1 && (name == "surface" || name == "entity" || name == "region")) {
      (name == "surface"  ? piece_.surface
       : name == "entity" ? piece_.entity
                          : piece_.region) = array<std::int64_t>(total, type);
      return;
    }
    array<double>(total, type);
    built_.warn(owner_ == Owner::cells    ? "ignored_cell_data"
                : owner_ == Owner::points ? "ignored_point_data"
                                          : "ignored_field_data",
                "'" + shown(name) + "'");
  }

  WordStream text_;
  InputBuilder built_;
  SkippedCells skipped_;
  VtkPiece piece_;
  bool is_binary_ = false, has_points_ = false;
  Owner owner_ = Owner::none;
  std::size_t tuple_count_ = 0;
};
}  // namespace

Result<InputData> read_vtk_legacy(std::string_view bytes, const std::string& file_name) {
  return LegacyReader(bytes, file_name).read();
}

}  // namespace strataflow
