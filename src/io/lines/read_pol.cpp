#include "io/lines/read_pol.h"

#include <cmath>

#include "io/input/input_builder.h"
#include "io/text/text_scanner.h"

namespace strataflow {

Result<InputData> read_pol(std::string_view bytes, const std::string& file_name) {
  constexpr double separator = 999;
  const std::string name = InputBuilder(file_name).stem();
  TextScanner text(bytes, file_name);
  InputData data;
  std::vector<Vec3> points;
  std::size_t extra = 0;
  const auto close = [&] {
    if (points.empty()) return;
    Polyline line{name, Role::curve, std::move(points), false};
    line.is_closed = line.points.size() > 3 && line.points.front() == line.points.back();
    if (line.is_closed) line.points.pop_back();
    data.lines.push_back(std::move(line));
    points.clear();
  };
  while (text.next_content_line()) {
    const auto x = text.number(), y = text.number(), z = text.number();
    if (!x || !y || !z)
      return text.malformed("expected three coordinates", "write x y z, and 999 999 999 between lines");
    if (!text.at_line_end()) ++extra;
    if (*x == separator && *y == separator && *z == separator) {
      close();
    } else if (!std::isfinite(*x) || !std::isfinite(*y) || !std::isfinite(*z)) {
      return text.malformed("a coordinate is not a finite number", "remove the row or mend it");
    } else {
      points.push_back({*x, *y, *z});
    }
  }
  close();
  if (data.lines.empty())
    return Failure{FailureCode::malformed_file, file_name + ": no line in it", "export the lines again"};
  if (extra != 0)
    data.warnings.push_back(
        {"ignored_columns", file_name + ": " + std::to_string(extra) + " rows have more than three columns; the rest is ignored"});
  return data;
}

}  // namespace strataflow
