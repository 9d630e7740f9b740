#include "io/lines/read_fault_map.h"

#include <cmath>

#include "io/text/text_scanner.h"

namespace strataflow {

Result<InputData> read_fault_map(std::string_view bytes, const std::string& file_name) {
  const char* form = "write `B n` or `F n` and below it n rows of x y";
  TextScanner text(bytes, file_name);
  InputData data;
  std::size_t faults = 0;
  while (text.next_content_line()) {
    const std::string_view kind = text.word();
    const auto count = text.integer<std::uint64_t>();
    if ((kind != "B" && kind != "F") || !count || !text.at_line_end())
      return text.malformed("expected B or F and a number of points, found '" + shown(text.line()) + "'", form);
    const std::string where = text.where();
    if (*count < 2 || *count > bytes.size())
      return text.malformed(std::to_string(*count) + " points, which this file cannot hold or no line can have", form);
    Polyline line;
    line.is_closed = kind == "B";
    line.role = line.is_closed ? Role::outline : Role::fault;
    line.name = line.is_closed ? "outline" : "F" + std::to_string(++faults);
    for (std::uint64_t i = 0; i < *count; ++i) {
      if (!text.next_content_line())
        return Failure{FailureCode::malformed_file,
                       where + ": " + std::to_string(*count) + " points announced, " + std::to_string(i) + " found", form};
      const auto x = text.number(), y = text.number();
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y) || !text.at_line_end())
        return text.malformed("expected two coordinates, found '" + shown(text.line()) + "'", form);
      line.points.push_back({*x, *y, 0});
    }
    if (line.is_closed && line.points.size() > 3 && line.points.front() == line.points.back()) line.points.pop_back();
    data.lines.push_back(std::move(line));
  }
  if (data.lines.empty()) return Failure{FailureCode::malformed_file, file_name + ": no line in it", form};
  return data;
}

}  // namespace strataflow
