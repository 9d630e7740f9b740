#include "io/vtk/read_vtk_xml.h"

#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <vector>

#include "io/bytes/byte_order.h"
#include "io/input/input_builder.h"
#include "io/text/text_scanner.h"
#include "io/text/word_stream.h"
#include "io/vtk/vtk_blocks.h"
#include "io/vtk/vtk_cells.h"

namespace strataflow {

namespace {
const std::string remedy = "write the file again, for example with ParaView";

/// The text before `<AppendedData …>` made a whole document, and the data behind its underscore.
struct SplitFile {
  std::string xml;
  std::string_view appended;
  bool is_base64 = false;
};

SplitFile split_appended(std::string_view bytes) {
  const std::size_t begin = bytes.find("<AppendedData");
  if (begin == std::string_view::npos) return {std::string(bytes), {}, false};
  SplitFile parts{std::string(bytes.substr(0, begin)) + "</VTKFile>", {}, false};
  const std::size_t tag_end = bytes.find('>', begin);
  const std::size_t underscore = tag_end == std::string_view::npos ? tag_end : bytes.find('_', tag_end);
  if (underscore == std::string_view::npos) return parts;
  parts.is_base64 = bytes.substr(begin, tag_end - begin).find("base64") != std::string_view::npos;
  parts.appended = bytes.substr(underscore + 1);
  // Base64 ends at the closing tag; raw data may hold any bytes, and its arrays know their lengths.
  if (parts.is_base64) parts.appended = parts.appended.substr(0, parts.appended.find('<'));
  return parts;
}

/// Reads one file. The first problem sticks, as in WordStream.
class VtkXmlReader {
 public:
  VtkXmlReader(const SplitFile& parts, const std::string& file_name)
      : parts_(parts), file_name_(file_name), built_(file_name) {}

  Result<InputData> read() {
    // The parser would skip any text before the first element.
    const std::size_t first = parts_.xml.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first != std::string::npos && parts_.xml[first] != '<')
      return Failure{FailureCode::malformed_file, file_name_ + ": not a VTK XML file: it does not start with '<'",
                     remedy};
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(parts_.xml.data(), parts_.xml.size());
    const pugi::xml_node root = document.child("VTKFile");
    if (!root) {
      const std::string why = parsed ? "the root is not <VTKFile>"
                                     : std::string(parsed.description()) + " at byte " + std::to_string(parsed.offset);
      return Failure{FailureCode::malformed_file, file_name_ + ": not a VTK XML file: " + why, remedy};
    }
    if (!parsed)
      return Failure{FailureCode::malformed_file,
                     file_name_ + ": " + parsed.description() + " at byte " + std::to_string(parsed.offset), remedy};
    const std::string type = root.attribute("type").as_string();
    const std::string compressor = root.attribute("compressor").as_string();
    if (type != "PolyData" && type != "UnstructuredGrid")
      return Failure{FailureCode::unsupported, file_name_ + ": VTK data of type '" + shown(type) + "' are not read",
                     "save it as .vtp or .vtu"};
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      return Failure{FailureCode::unsupported, file_name_ + ": compressor '" + shown(compressor) + "' is not read",
                     "save with zlib or without compression"};
    packing_.is_compressed = !compressor.empty();
    packing_.has_64_bit_headers = std::string_view(root.attribute("header_type").as_string()) == "UInt64";
    packing_.is_big_endian = std::string_view(root.attribute("byte_order").as_string()) == "BigEndian";

    const pugi::xml_node data_set = root.child(type.c_str());
    if (!data_set) fail("has no <" + type + "> element");
    read_field_data(data_set.child("FieldData"));
    for (const pugi::xml_node piece : data_set.children("Piece")) {
      if (failure_) break;
      if (!is_first_piece_ && !built_.properties.empty() && !piece.child("PointData"))
        fail("its pieces carry different point data");
      read_piece(piece, type == "UnstructuredGrid");
      is_first_piece_ = false;
    }
    if (failure_) return *failure_;
    for (const PointProperty& property : built_.properties)
      if (property.values.size() != built_.points.size() * property.width)
        return Failure{FailureCode::malformed_file,
                       file_name_ + ": point array '" + property.name + "' has the wrong length", remedy};
    skipped_.report(built_);
    return std::move(built_).finish();
  }

 private:
  void fail(const std::string& what) {
    if (!failure_) failure_ = Failure{FailureCode::malformed_file, file_name_ + ": " + what, remedy};
  }

  std::string name_of(const pugi::xml_node& array) const { return shown(array.attribute("Name").as_string()); }

  /// Bytes of a binary array.
  std::string binary_bytes(const pugi::xml_node& array) {
    const std::string name = file_name_ + ": array '" + name_of(array) + "'";
    const bool is_appended = std::string_view(array.attribute("format").as_string()) == "appended";
    std::string_view encoded = is_appended ? parts_.appended : std::string_view(array.text().get());
    if (is_appended) {
      const std::uint64_t offset = array.attribute("offset").as_ullong(std::numeric_limits<std::uint64_t>::max());
      if (offset >= encoded.size()) {
        fail("array '" + name_of(array) + "' starts behind the end of the appended data");
        return {};
      }
      encoded = encoded.substr(offset);
    } else if (encoded.find_first_not_of(" \t\r\n") == std::string_view::npos) {
      return {};
    }
    Result<std::string> bytes = unpack_vtk_array(encoded, is_appended ? parts_.is_base64 : true, packing_, name);
    if (bytes) return std::move(*bytes);
    if (!failure_) failure_ = bytes.failure();
    return {};
  }

  template <class Stored, class T>
  void append(const std::string& bytes, std::vector<T>& values) {
    if (bytes.size() % sizeof(Stored) != 0) fail("an array ends in the middle of a number");
    values.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i + sizeof(Stored) <= bytes.size(); i += sizeof(Stored)) {
      const Stored value = load_number<Stored>(bytes.data() + i, packing_.is_big_endian);
      if constexpr (std::is_floating_point_v<Stored> && std::is_integral_v<T>)
        values.push_back(std::abs(value) < 9e15 ? static_cast<T>(value)
                                                : -1);  // labels stored as reals; NaN becomes -1
      else
        values.push_back(static_cast<T>(value));
    }
  }

  /// All numbers of an array, as T (double or int64).
  template <class T>
  std::vector<T> numbers(const pugi::xml_node& array) {
    std::vector<T> values;
    if (failure_) return values;
    const std::string type = array.attribute("type").as_string();
    const std::string_view format = array.attribute("format").as_string("ascii");
    if (format == "ascii") {
      const std::string where = file_name_ + ": array '" + name_of(array) + "'";
      WordStream words(array.text().get(), where);
      for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
        const auto real = TextScanner::number_from(word);
        const auto whole = TextScanner::integer_from<std::int64_t>(word);
        if (!real || (std::is_integral_v<T> && !whole && !(std::abs(*real) < 9e15))) {
          fail("array '" + name_of(array) + "' holds '" + shown(word) + "' where a number should be");
          break;
        }
        values.push_back(std::is_integral_v<T> && whole ? static_cast<T>(*whole) : static_cast<T>(*real));
      }
      return values;
    }
    const std::string bytes = binary_bytes(array);
    if (type == "Float64")
      append<double>(bytes, values);
    else if (type == "Float32")
      append<float>(bytes, values);
    else if (type == "Int64")
      append<std::int64_t>(bytes, values);
    else if (type == "UInt64")
      append<std::uint64_t>(bytes, values);
    else if (type == "Int32")
      append<std::int32_t>(bytes, values);
    else if (type == "UInt32")
      append<std::uint32_t>(bytes, values);
    else if (type == "Int16")
      append<std::int16_t>(bytes, values);
    else if (type == "UInt16")
      append<std::uint16_t>(bytes, values);
    else if (type == "Int8")
      append<std::int8_t>(bytes, values);
    else if (type == "UInt8")
      append<std::uint8_t>(bytes, values);
    else
      fail("array '" + name_of(array) + "' is of the unknown type '" + shown(type) + "'");
    return values;
  }

  /// Words each ended by a zero.
  std::vector<std::string> words_of(const pugi::xml_node& array) {
    std::string bytes;
    const bool is_string = std::string_view(array.attribute("type").as_string()) == "String";
    if (is_string && std::string_view(array.attribute("format").as_string("ascii")) != "ascii")
      bytes = binary_bytes(array);
    else
      for (const std::int64_t code : numbers<std::int64_t>(array)) bytes.push_back(static_cast<char>(code));
    std::vector<std::string> words;
    for (std::size_t begin = 0, end = bytes.find('\0'); end != std::string::npos;
         begin = end + 1, end = bytes.find('\0', begin))
      words.push_back(bytes.substr(begin, end - begin));
    return words;
  }

  void read_field_data(const pugi::xml_node& field) {
    for (const pugi::xml_node array : field.children()) {
      const std::string_view name = array.attribute("Name").as_string();
      if (name == "entity_names")
        entity_names_ = words_of(array);
      else if (name == "entity_roles")
        entity_roles_ = words_of(array);
      else if (name == "region_names")
        built_.region_names = words_of(array);
      else
        built_.warn("ignored_field_data", "'" + shown(name) + "'");
    }
    for (const std::string& name : entity_names_) entity_ids_.push_back(built_.entity(name));
    for (std::size_t e = 0; e < entity_ids_.size() && e < entity_roles_.size(); ++e)
      if (const auto role = role_from(entity_roles_[e])) built_.set_role(entity_ids_[e], *role);
  }

  void read_points(const pugi::xml_node& piece) {
    const std::vector<double> coordinates = numbers<double>(piece.child("Points").child("DataArray"));
    if (coordinates.size() % 3 != 0) fail("its points do not have three coordinates each");
    if (coordinates.size() / 3 != piece.attribute("NumberOfPoints").as_ullong())
      fail("says it has " + std::string(shown(piece.attribute("NumberOfPoints").as_string())) + " points, holds " +
           std::to_string(coordinates.size() / 3));
    if (built_.points.size() + coordinates.size() / 3 >= no_index) fail("has too many points");
    if (failure_) return;
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
      built_.points.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});

    for (const pugi::xml_node array : piece.child("PointData").children()) {
      const std::string name = array.attribute("Name").as_string();
      if (name == "line" || name == "corner") {
        std::vector<std::int32_t>& labels = name == "line" ? built_.point_line : built_.point_corner;
        for (const std::int64_t label : numbers<std::int64_t>(array))
          labels.push_back(label < 0 || label > 0x7fffffff ? -1 : static_cast<std::int32_t>(label));
        continue;
      }
      if (std::string_view(array.attribute("type").as_string()) == "String") {
        if (is_first_piece_) built_.warn("ignored_point_data", "'" + shown(name) + "' holds words");
        continue;
      }
      const std::uint32_t width = std::max(1u, array.attribute("NumberOfComponents").as_uint(1));
      PointProperty* property = nullptr;
      for (PointProperty& known : built_.properties)
        if (known.name == name && known.width == width) property = &known;
      if (!property) property = &built_.properties.emplace_back(PointProperty{name, "", width, {}});
      const std::vector<double> values = numbers<double>(array);
      property->values.insert(property->values.end(), values.begin(), values.end());
    }
  }

  VtkCellList cell_list(const pugi::xml_node& element) {
    VtkCellList cells;
    if (const auto array = element.find_child_by_attribute("Name", "connectivity"))
      cells.vertices = numbers<std::int64_t>(array);
    if (const auto array = element.find_child_by_attribute("Name", "offsets"))
      cells.offsets = numbers<std::int64_t>(array);
    return cells;
  }

  void read_piece(const pugi::xml_node& node, bool is_grid) {
    VtkPiece piece;
    piece.first_point = static_cast<std::int64_t>(built_.points.size());
    read_points(node);
    if (is_grid) {
      const pugi::xml_node cells = node.child("Cells");
      piece.cells = cell_list(cells);
      if (const auto array = cells.find_child_by_attribute("Name", "types")) piece.types = numbers<std::int64_t>(array);
    } else {
      piece.verts = cell_list(node.child("Verts"));
      piece.lines = cell_list(node.child("Lines"));
      piece.polys = cell_list(node.child("Polys"));
      piece.strips = cell_list(node.child("Strips"));
    }
    for (const pugi::xml_node array : node.child("CellData").children()) {
      const std::string_view name = array.attribute("Name").as_string();
      if (name == "surface")
        piece.surface = numbers<std::int64_t>(array);
      else if (name == "entity")
        piece.entity = numbers<std::int64_t>(array);
      else if (name == "region" && is_grid)
        piece.region = numbers<std::int64_t>(array);
      else if (is_first_piece_)
        built_.warn("ignored_cell_data", "'" + shown(name) + "'");
    }
    if (failure_) return;
    if (const Result<void> added = add_vtk_piece(built_, skipped_, piece, entity_ids_); !added)
      failure_ = added.failure();
  }

  const SplitFile& parts_;
  const std::string& file_name_;
  InputBuilder built_;
  SkippedCells skipped_;
  VtkPacking packing_;
  std::vector<std::string> entity_names_, entity_roles_;
  std::vector<std::uint32_t> entity_ids_;  // per name of the file
  bool is_first_piece_ = true;
  std::optional<Failure> failure_;
};
}  // namespace

Result<InputData> read_vtk_xml(std::string_view bytes, const std::string& file_name) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos)
    return Failure{FailureCode::malformed_file, file_name + ": the file is empty", remedy};
  const SplitFile parts = split_appended(bytes);
  return VtkXmlReader(parts, file_name).read();
}

}  // namespace strataflow
