#include "io/surface/read_off.h"

#include <vector>

#include "io/input/input_builder.h"
#include "io/text/word_stream.h"

namespace strataflow {

Result<InputData> read_off(std::string_view bytes, const std::string& file_name) {
  WordStream text(bytes, file_name);
  InputBuilder built(file_name);
  const std::string_view header = text.word();
  if (header.size() < 3 || header.substr(header.size() - 3) != "OFF")
    text.fail("expected OFF, found '" + shown(header) + "'");
  const std::string_view prefix = header.substr(0, header.size() - std::min<std::size_t>(header.size(), 3));
  if (prefix.find_first_of("4n") != std::string_view::npos || text.peek() == "BINARY")
    text.fail_as(FailureCode::unsupported, "binary and n-dimensional OFF are not read", "export it as plain OFF");
  if (!prefix.empty()) built.warn("ignored_point_data", "only positions are used of " + shown(header));

  const std::size_t point_count = text.count("the number of points"), face_count = text.count("the number of faces");
  text.rest_of_line();  // the number of edges may be missing
  for (std::size_t i = 0; i < point_count && !text.failed(); ++i) {
    built.points.push_back(text.point());
    if (!prefix.empty()) text.rest_of_line();  // normals, colours: as many as the writer liked
  }
  const std::uint32_t patch = built.patch(built.stem());
  std::vector<std::uint32_t> vertices;
  std::size_t lines = 0;
  for (std::size_t f = 0; f < face_count && !text.failed(); ++f) {
    vertices.clear();
    const std::size_t size = text.count("the number of points of a face");
    for (std::size_t k = 0; k < size && !text.failed(); ++k) vertices.push_back(text.vertex(0, point_count));
    text.rest_of_line();  // colours
    if (size < 3) ++lines;
    built.add_polygon(vertices.data(), vertices.size(), patch);
  }
  if (text.failed()) return text.failure();
  if (lines != 0) built.warn("skipped_cells", std::to_string(lines) + " x polygon of fewer than three points");
  return std::move(built).finish();
}

}  // namespace strataflow
