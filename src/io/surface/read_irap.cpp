#include "io/surface/read_irap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/id.h"
#include "io/bytes/byte_order.h"
#include "io/input/input_builder.h"
#include "io/text/text_scanner.h"

namespace strataflow {

namespace {

constexpr std::int32_t magic = -996;
constexpr double undefined_from = 9999900;

struct DepthGrid {
  std::int64_t columns = 0, rows = 0;
  double step_x = 0, step_y = 0, turn_deg = 0, x = 0, y = 0;
  std::vector<double> depth;  ///< columns · rows, x first
};

/// Fortran records: their length before and after.
class Records {
 public:
  Records(std::string_view bytes, const std::string& file_name) : bytes_(bytes), file_name_(file_name) {}

  bool next() {
    if (bytes_.size() - at_ < 8) return false;
    const auto size = load_number<std::uint32_t>(bytes_.data() + at_, true);
    if (size > bytes_.size() - at_ - 8 || load_number<std::uint32_t>(bytes_.data() + at_ + 4 + size, true) != size)
      return false;
    record_ = bytes_.substr(at_ + 4, size);
    at_ += size + 8;
    return true;
  }
  std::size_t size() const { return record_.size() / 4; }
  std::size_t bytes_left() const { return bytes_.size() - at_; }
  std::int32_t integer(std::size_t i) const { return load_number<std::int32_t>(record_.data() + 4 * i, true); }
  double number(std::size_t i) const { return load_number<float>(record_.data() + 4 * i, true); }
  Failure malformed(const std::string& what) const {
    return {FailureCode::malformed_file, file_name_ + ": byte " + std::to_string(at_) + ": " + what,
            "export the surface again as IRAP classic"};
  }

 private:
  std::string_view bytes_, record_;
  const std::string& file_name_;
  std::size_t at_ = 0;
};

Result<DepthGrid> read_binary(std::string_view bytes, const std::string& file_name) {
  Records records(bytes, file_name);
  DepthGrid grid;
  if (!records.next() || records.size() < 8 || records.integer(0) != magic)
    return records.malformed("no header of a grid");
  grid.rows = records.integer(1);
  grid.step_x = records.number(6);
  grid.step_y = records.number(7);
  if (!records.next() || records.size() < 4) return records.malformed("no place of the grid");
  grid.columns = records.integer(0);
  grid.turn_deg = records.number(1);
  grid.x = records.number(2);
  grid.y = records.number(3);
  if (!records.next()) return records.malformed("the header ends early");
  const auto room = static_cast<std::int64_t>(records.bytes_left() / 4);
  if (grid.columns < 2 || grid.rows < 2 || grid.columns > room / grid.rows)
    return records.malformed(std::to_string(grid.columns) + " × " + std::to_string(grid.rows) +
                             " depths do not fit the file");
  const auto count = static_cast<std::size_t>(grid.columns * grid.rows);
  while (grid.depth.size() < count && records.next())
    for (std::size_t i = 0; i < records.size(); ++i) grid.depth.push_back(records.number(i));
  if (grid.depth.size() != count)
    return records.malformed("there are " + std::to_string(grid.depth.size()) + " depths, not " +
                             std::to_string(count));
  return grid;
}

Result<DepthGrid> read_text(std::string_view bytes, const std::string& file_name) {
  TextScanner text(bytes, file_name);
  const auto number = [&]() -> std::optional<double> {
    while (text.at_line_end())
      if (!text.next_line()) return std::nullopt;
    return text.number();
  };
  std::array<double, 19> header{};
  for (double& value : header) {
    const std::optional<double> read = number();
    if (!read || !std::isfinite(*read))
      return text.malformed("the header has 19 numbers", "export the surface again as IRAP classic");
    value = *read;
  }
  DepthGrid grid;
  if (header[0] != magic) return text.malformed("no header of a grid", "export the surface again as IRAP classic");
  const double room = static_cast<double>(bytes.size()) / 2 + 1;  // a digit and a blank at least
  if (!(header[1] >= 2 && header[8] >= 2 && header[1] * header[8] <= room))
    return text.malformed("the depths do not fit the file", "export the surface again as IRAP classic");
  grid.rows = static_cast<std::int64_t>(header[1]);
  grid.step_x = header[2];
  grid.step_y = header[3];
  grid.columns = static_cast<std::int64_t>(header[8]);
  grid.turn_deg = header[9];
  grid.x = header[10];
  grid.y = header[11];
  for (std::int64_t i = 0; i < grid.columns * grid.rows; ++i) {
    const std::optional<double> depth = number();
    if (!depth)
      return text.malformed("depth " + std::to_string(i + 1) + " of " + std::to_string(grid.columns * grid.rows) +
                                " is missing or no number",
                            "export the surface again as IRAP classic");
    grid.depth.push_back(*depth);
  }
  return grid;
}

}  // namespace

Result<InputData> read_irap(std::string_view bytes, const std::string& file_name) {
  const bool is_binary = bytes.size() >= 8 && load_number<std::int32_t>(bytes.data() + 4, true) == magic;
  const Result<DepthGrid> grid = is_binary ? read_binary(bytes, file_name) : read_text(bytes, file_name);
  if (!grid) return grid.failure();
  if (!(grid->step_x > 0) || !(grid->step_y > 0) || !std::isfinite(grid->turn_deg))
    return Failure{FailureCode::malformed_file, file_name + ": the grid's steps are not positive",
                   "export the surface again"};
  InputBuilder builder(file_name);
  const std::uint32_t patch = builder.patch(builder.stem());
  const double c = std::cos(grid->turn_deg * std::numbers::pi / 180),
               s = std::sin(grid->turn_deg * std::numbers::pi / 180);
  std::vector<std::uint32_t> number(grid->depth.size(), no_index);
  bool any_positive = false;
  for (std::int64_t j = 0; j < grid->rows; ++j)
    for (std::int64_t i = 0; i < grid->columns; ++i) {
      const auto k = static_cast<std::size_t>(j * grid->columns + i);
      const double depth = grid->depth[k], u = static_cast<double>(i) * grid->step_x,
                   v = static_cast<double>(j) * grid->step_y;
      if (!(depth < undefined_from)) continue;
      any_positive = any_positive || depth > 0;
      number[k] = static_cast<std::uint32_t>(builder.points.size());
      builder.points.push_back({grid->x + c * u - s * v, grid->y + s * u + c * v, -depth});
    }
  std::size_t cells = 0;
  for (std::int64_t j = 0; j + 1 < grid->rows; ++j)
    for (std::int64_t i = 0; i + 1 < grid->columns; ++i) {
      const auto k = static_cast<std::size_t>(j * grid->columns + i),
                 above = k + static_cast<std::size_t>(grid->columns);
      std::array<std::uint32_t, 4> corners{number[k], number[k + 1], number[above + 1], number[above]};
      const auto end = std::remove(corners.begin(), corners.end(), no_index);
      if (end - corners.begin() < 3) continue;
      builder.add_polygon(corners.data(), static_cast<std::size_t>(end - corners.begin()), patch);
      ++cells;
    }
  if (cells == 0)
    return Failure{FailureCode::malformed_file, file_name + ": no cell has its depths", "export the surface again"};
  if (any_positive)
    builder.warn("taken_for_depths", "its numbers are taken for depths: z is their negative");
  else
    for (Vec3& p : builder.points) p.z = -p.z;  // elevations below zero
  return std::move(builder).finish();
}

}  // namespace strataflow
