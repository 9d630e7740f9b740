#include "io/surface/read_stl.h"

#include "io/bytes/byte_order.h"
#include "io/input/input_builder.h"
#include "io/text/word_stream.h"

namespace strataflow {

namespace {
constexpr std::size_t header_size = 84, facet_size = 50;

Result<InputData> read_binary(std::string_view bytes, const std::string& file_name) {
  InputBuilder built(file_name);
  const std::uint32_t patch = built.patch(built.stem());
  for (std::size_t facet = header_size; facet < bytes.size(); facet += facet_size) {
    const std::uint32_t first = static_cast<std::uint32_t>(built.points.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const char* point = bytes.data() + facet + 12 + 12 * k;
      built.points.push_back({load_number<float>(point, false), load_number<float>(point + 4, false),
                              load_number<float>(point + 8, false)});
    }
    const std::uint32_t vertices[3] = {first, first + 1, first + 2};
    built.add_polygon(vertices, 3, patch);
  }
  return std::move(built).finish();
}

Result<InputData> read_ascii(std::string_view bytes, const std::string& file_name) {
  WordStream text(bytes, file_name, '\n');
  InputBuilder built(file_name);
  const auto expect = [&](std::string_view keyword) {
    const std::string_view found = text.word();
    if (found != keyword) text.fail("expected '" + std::string(keyword) + "', found '" + shown(found) + "'");
  };
  while (!text.peek().empty() && !text.failed()) {
    expect("solid");
    const std::string name(text.rest_of_line());
    const std::uint32_t patch = built.patch(name.empty() ? built.stem() : name);
    while (text.peek() == "facet") {
      text.word();
      expect("normal");
      for (int k = 0; k < 3; ++k) text.number("a normal");
      expect("outer");
      expect("loop");
      const std::uint32_t first = static_cast<std::uint32_t>(built.points.size());
      while (text.peek() == "vertex") {
        text.word();
        built.points.push_back(text.point());
      }
      if (built.points.size() != first + std::size_t{3}) text.fail("a facet needs three vertices");
      expect("endloop");
      expect("endfacet");
      const std::uint32_t vertices[3] = {first, first + 1, first + 2};
      built.add_polygon(vertices, 3, patch);
    }
    expect("endsolid");
    text.rest_of_line();
  }
  if (text.failed()) return text.failure();
  return std::move(built).finish();
}
}  // namespace

Result<InputData> read_stl(std::string_view bytes, const std::string& file_name) {
  const std::uint64_t facets = bytes.size() >= header_size ? load_number<std::uint32_t>(bytes.data() + 80, false) : 0;
  if (bytes.size() >= header_size && bytes.size() == header_size + facet_size * facets)
    return read_binary(bytes, file_name);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && bytes.substr(first, 5) == "solid") return read_ascii(bytes, file_name);
  const std::string what = bytes.size() < header_size
                               ? ": neither ascii STL (no 'solid') nor binary (shorter than its header)"
                               : ": binary STL of " + std::to_string(facets) + " facets should have " +
                                     std::to_string(header_size + facet_size * facets) + " bytes, has " +
                                     std::to_string(bytes.size());
  return Failure{FailureCode::malformed_file, file_name + what,
                 "export the file again; it is cut short or not an STL file"};
}

}  // namespace strataflow
