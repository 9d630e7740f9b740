#include "io/simulator/read_grdecl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "io/simulator/corner_point_hexahedra.h"
#include "io/text/text_scanner.h"

namespace strataflow {

namespace {
/// Words of the values of one keyword, over line ends, without comments; a slash ends them.
class KeywordValues {
 public:
  explicit KeywordValues(TextScanner& lines) : lines_(lines) {}

  /// The next word; nothing after a slash. A record may end inside the line.
  std::optional<std::string_view> next() {
    for (;;) {
      if (rest_.empty()) {
        if (lines_.at_line_end() && !lines_.next_line()) return std::nullopt;
        rest_ = lines_.word();
        if (rest_.substr(0, 2) == "--") {
          lines_.rest();
          rest_ = {};
        }
        continue;
      }
      const std::size_t end = std::min(rest_.find('/'), rest_.size());
      if (end == 0) {
        lines_.rest();
        return std::nullopt;
      }
      const std::string_view word = rest_.substr(0, end);
      rest_.remove_prefix(end);
      return word;
    }
  }

 private:
  TextScanner& lines_;
  std::string_view rest_;
};

class GrdeclReader {
 public:
  GrdeclReader(std::string_view text, const std::string& file_name) : size_(text.size()), lines_(text, file_name) {}

  Result<SimulationGrid> read() {
    while (!failure_ && lines_.next_content_line()) {
      lines_.restart_line();
      const char first = lines_.line()[0];
      if (!(first >= 'A' && first <= 'Z')) continue;  // values of a keyword that is passed over
      const std::string keyword(lines_.word());
      if (keyword == "SPECGRID" || keyword == "DIMENS")
        read_size();
      else if (keyword == "COORD")
        read_numbers(keyword, coord_, 6 * pillar_count());
      else if (keyword == "ZCORN")
        read_numbers(keyword, zcorn_, 8 * cell_count());
      else if (keyword == "ACTNUM")
        read_numbers(keyword, actnum_, cell_count());
      else if (keyword == "MAPAXES")
        read_numbers(keyword, axes_, 6);
      else if (keyword == "GRIDUNIT")
        read_unit();
      else if (keyword == "NNC")
        read_connections();
      else if (keyword == "INCLUDE")
        failure_ = Failure{FailureCode::unsupported, lines_.where() + ": the file includes another",
                           "put COORD, ZCORN and ACTNUM into one file"};
    }
    if (!failure_) check();
    if (failure_) return *failure_;
    return finish();
  }

 private:
  void fail(const std::string& what) {
    if (!failure_) failure_ = lines_.malformed(what, "correct the file or export it again");
  }
  std::uint64_t cell_count() const { return std::uint64_t{size_ijk_[0]} * size_ijk_[1] * size_ijk_[2]; }
  std::uint64_t pillar_count() const { return (std::uint64_t{size_ijk_[0]} + 1) * (std::uint64_t{size_ijk_[1]} + 1); }

  void read_size() {
    if (size_ijk_[0] != 0 && !(coord_.empty() && zcorn_.empty() && actnum_.empty()))
      return fail("the size of the grid is said again after its values");
    KeywordValues values(lines_);
    for (std::uint32_t& size : size_ijk_) {
      const auto word = values.next();
      const auto value = word ? TextScanner::integer_from<std::uint32_t>(*word) : std::nullopt;
      if (!value || *value == 0 || *value > (1u << 30)) return fail("expected three sizes of a grid, each at least 1");
      size = *value;
    }
    while (values.next()) {
    }
    // A run such as 1000*0 says much in few letters, so a small file may hold a large grid, within reason.
    const std::uint64_t most = std::min<std::uint64_t>(std::uint64_t{1} << 31, 1048576 + 1024 * std::uint64_t{size_});
    if (std::uint64_t{size_ijk_[0]} * size_ijk_[1] > most || cell_count() > most || pillar_count() > 2 * most)
      fail("the grid has more cells than this file can hold");
  }

  void read_numbers(const std::string& keyword, std::vector<double>& numbers, std::uint64_t count) {
    if (keyword != "MAPAXES" && size_ijk_[0] == 0) return fail(keyword + " comes before SPECGRID");
    numbers.clear();
    numbers.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(count, size_)));
    KeywordValues values(lines_);
    while (const auto word = values.next()) {
      const std::size_t star = word->find('*');
      const auto repeats = star == std::string_view::npos
                               ? std::optional<std::uint64_t>(1)
                               : TextScanner::integer_from<std::uint64_t>(word->substr(0, star));
      const auto value = TextScanner::number_from(star == std::string_view::npos ? *word : word->substr(star + 1));
      if (!repeats || !value || !std::isfinite(*value))
        return fail(keyword + ": expected a number, found '" + shown(*word) + "'");
      if (*repeats > count - numbers.size())
        return fail(keyword + " has more than " + std::to_string(count) + " values");
      numbers.insert(numbers.end(), static_cast<std::size_t>(*repeats), *value);
    }
    if (numbers.size() != count)
      fail(keyword + " has " + std::to_string(numbers.size()) + " values, not " + std::to_string(count));
  }

  void read_unit() {
    KeywordValues values(lines_);
    if (const auto word = values.next()) {
      if (word->find("FEET") != std::string_view::npos)
        metres_ = 0.3048;
      else if (word->find("CM") != std::string_view::npos)
        metres_ = 0.01;
      else if (word->find("METRES") == std::string_view::npos)
        return fail("unknown unit '" + shown(*word) + "'");
    }
    while (const auto word = values.next()) is_on_map_ = is_on_map_ || word->find("MAP") != std::string_view::npos;
  }

  void read_connections() {
    for (;;) {
      KeywordValues values(lines_);
      std::array<std::uint32_t, 6> ijk{};
      CellConnection connection;
      for (std::size_t n = 0;; ++n) {
        const auto word = values.next();
        if (!word && n == 0) return;
        if (!word && n == 7) break;
        if (word && n > 7) continue;  // defaults of a simulator
        if (!word && n > 7) break;
        const auto index = n < 6 && word ? TextScanner::integer_from<std::uint32_t>(*word) : std::nullopt;
        const auto number = n == 6 && word ? TextScanner::number_from(*word) : std::nullopt;
        if (n < 6 && (!index || *index < 1 || *index > size_ijk_[n % 3])) return fail("NNC: a cell is not in the grid");
        if (n == 6 && (!number || !(*number >= 0))) return fail("NNC: expected a transmissibility");
        if (n < 6)
          ijk[n] = *index - 1;
        else
          connection.transmissibility = number.value_or(0);
      }
      const auto cell = [&](int at) {
        return static_cast<std::uint32_t>(ijk[at] + std::uint64_t{size_ijk_[0]} *
                                                        (ijk[at + 1] + std::uint64_t{size_ijk_[1]} * ijk[at + 2]));
      };
      connection.cell_0 = std::min(cell(0), cell(3)), connection.cell_1 = std::max(cell(0), cell(3));
      connections_.push_back(connection);
    }
  }

  void check() {
    if (size_ijk_[0] == 0) return fail("there is no SPECGRID");
    if (coord_.empty()) return fail("there is no COORD");
    if (zcorn_.empty()) return fail("there is no ZCORN");
  }

  SimulationGrid finish() {
    SimulationGrid read;
    CornerPointGrid& grid = read.grid;
    grid.size = size_ijk_;
    for (std::size_t n = 0; n < coord_.size(); n += 3)
      grid.pillars.push_back(on_map(metres_ * Vec3{coord_[n], coord_[n + 1], -coord_[n + 2]}));
    grid.corner_z = std::move(zcorn_);
    for (double& z : grid.corner_z) z *= -metres_;
    grid.is_active.assign(grid.cell_count(), 1);
    for (std::size_t n = 0; n < actnum_.size(); ++n) grid.is_active[n] = actnum_[n] != 0;
    read.connections = std::move(connections_);
    return read;
  }

  /// MAPAXES names a point on the Y axis, the origin and a point on the X axis.
  Vec3 on_map(const Vec3& p) const {
    if (axes_.size() != 6 || is_on_map_) return p;
    const Vec3 origin{axes_[2], axes_[3], 0};
    Vec3 x = Vec3{axes_[4], axes_[5], 0} - origin, y = Vec3{axes_[0], axes_[1], 0} - origin;
    if (!(length(x) > 0) || !(length(y) > 0)) return p;
    x = (1 / length(x)) * x, y = (1 / length(y)) * y;
    return {origin.x + p.x * x.x + p.y * y.x, origin.y + p.x * x.y + p.y * y.y, p.z};
  }

  std::size_t size_;
  TextScanner lines_;
  std::optional<Failure> failure_;
  std::array<std::uint32_t, 3> size_ijk_{};
  std::vector<double> coord_, zcorn_, actnum_, axes_;
  std::vector<CellConnection> connections_;
  double metres_ = 1;
  bool is_on_map_ = false;
};
}  // namespace

Result<SimulationGrid> read_corner_points(std::string_view text, const std::string& file_name) {
  return GrdeclReader(text, file_name).read();
}

Result<InputData> read_grdecl(std::string_view text, const std::string& file_name) {
  auto grid = read_corner_points(text, file_name);
  if (!grid) return grid.failure();
  return hexahedra_of(grid->grid);
}

}  // namespace strataflow
