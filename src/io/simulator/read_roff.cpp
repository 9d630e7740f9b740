#include "io/simulator/read_roff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "io/bytes/byte_order.h"
#include "io/simulator/corner_point_hexahedra.h"
#include "io/text/text_scanner.h"

namespace strataflow {

namespace {
/// The values of a file by "tag.name"; words have none.
class RoffFile {
 public:
  RoffFile(std::string_view bytes, const std::string& file_name) : bytes_(bytes), file_name_(file_name) {
    if (bytes.substr(0, 8) == "roff-asc") {
      is_ascii_ = true;
      for (char end : {'\n', '\0'}) place_ = std::min(place_, bytes.find(end));
      place_ = std::min(place_, bytes.size());
    } else if (bytes.substr(0, 8) == "roff-bin") {
      place_ = std::min(bytes.find('\0'), bytes.size());
    } else {
      fail("this is no ROFF file");
    }
  }

  void read() {
    std::string tag;
    while (!failure_ && !at_end()) {
      const std::string word = next_word();
      if (word.empty() || word[0] == '#') continue;
      if (word == "tag") {
        tag = next_word();
        if (tag == "eof") return;
      } else if (word == "endtag") {
        tag.clear();
      } else if (word == "array") {
        const std::string type = next_word(), name = next_word();
        const auto count = static_cast<std::int64_t>(next_number("int"));
        // Each value takes at least a byte.
        if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size() - place_)
          return fail(tag + "." + name + " has " + std::to_string(count) + " values, which this file cannot hold");
        read_values(type, static_cast<std::size_t>(count), values_[tag + "." + name]);
      } else {
        const std::string name = next_word();
        read_values(word, 1, values_[tag + "." + name]);
      }
    }
  }

  void fail(const std::string& what) {
    if (!failure_)
      failure_ = Failure{FailureCode::malformed_file,
                         file_name_ + ": byte " + std::to_string(std::min(place_, bytes_.size())) + ": " + what,
                         "correct the file or export it again"};
  }
  const std::optional<Failure>& failure() const { return failure_; }
  const std::vector<double>* find(const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : &found->second;
  }
  double one(const std::string& name, double otherwise) const {
    const auto* values = find(name);
    return values && values->size() == 1 ? values->front() : otherwise;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0'; }
  bool at_end() {
    // Binary words end with one zero byte; between them there is nothing to skip.
    while (place_ < bytes_.size() && (is_ascii_ ? is_blank(bytes_[place_]) : bytes_[place_] == '\0')) ++place_;
    return place_ >= bytes_.size();
  }

  std::string next_word() {
    if (is_ascii_) {
      if (at_end()) return {};
      const bool is_quoted = bytes_[place_] == '"', is_comment = bytes_[place_] == '#';
      const std::size_t begin = place_ + is_quoted;
      std::size_t end = begin;
      while (end < bytes_.size() && (is_comment  ? bytes_[end] != '\n'
                                     : is_quoted ? bytes_[end] != '"'
                                                 : !is_blank(bytes_[end])))
        ++end;
      place_ = std::min(end + is_quoted, bytes_.size());
      return std::string(bytes_.substr(begin, end - begin));
    }
    const std::size_t end = std::min(bytes_.find('\0', place_), bytes_.size());
    std::string word(bytes_.substr(place_, end - place_));
    place_ = std::min(end + 1, bytes_.size());
    return word;
  }

  double next_number(const std::string& type) {
    if (is_ascii_) {
      const auto value = TextScanner::number_from(next_word());
      if (!value) fail("expected a number");
      return value.value_or(0);
    }
    const std::size_t size = type == "double" ? 8 : type == "int" || type == "float" ? 4 : 1;
    if (size > bytes_.size() - place_) {
      fail("the file ends in the middle of binary data");
      return 0;
    }
    const char* at = bytes_.data() + place_;
    place_ += size;
    if (type == "int") return load_number<std::int32_t>(at, swaps_);
    if (type == "float") return static_cast<double>(load_number<float>(at, swaps_));
    if (type == "double") return load_number<double>(at, swaps_);
    return static_cast<unsigned char>(*at);
  }

  void read_values(const std::string& type, std::size_t count, std::vector<double>& values) {
    values.clear();
    if (type == "char") {
      for (std::size_t n = 0; n < count && !failure_; ++n) next_word();
      return;
    }
    if (type != "int" && type != "float" && type != "double" && type != "bool" && type != "byte")
      return fail("unknown type '" + shown(type) + "'");
    values.reserve(count);
    for (std::size_t n = 0; n < count && !failure_; ++n) values.push_back(next_number(type));
    // The number 1, as the machine that wrote the file keeps it.
    if (const auto* test = find("filedata.byteswaptest"); test == &values && count == 1 && values[0] != 1)
      swaps_ = !swaps_;
  }

  std::string_view bytes_;
  const std::string& file_name_;
  std::size_t place_ = std::string_view::npos;
  bool is_ascii_ = false, swaps_ = false;
  std::map<std::string, std::vector<double>> values_;
  std::optional<Failure> failure_;
};
}  // namespace

Result<RoffGrid> read_roff_grid(std::string_view bytes, const std::string& file_name) {
  RoffFile file(bytes, file_name);
  if (!file.failure()) file.read();
  RoffGrid read;
  CornerPointGrid& grid = read.grid;
  const char* const sizes[] = {"dimensions.nX", "dimensions.nY", "dimensions.nZ"};
  for (int axis = 0; axis < 3; ++axis) {
    const double size = file.one(sizes[axis], 0);
    if (!(size >= 1 && size <= 1 << 30))
      file.fail(std::string("there is no sound ") + sizes[axis]);
    else
      grid.size[axis] = static_cast<std::uint32_t>(size);
  }
  if (file.failure()) return *file.failure();
  const std::uint64_t nodes_i = std::uint64_t{grid.size[0]} + 1, nodes_j = std::uint64_t{grid.size[1]} + 1,
                      nodes_k = std::uint64_t{grid.size[2]} + 1;
  const auto* lines = file.find("cornerLines.data");
  const auto* splits = file.find("zvalues.splitEnz");
  const auto* heights = file.find("zvalues.data");
  const auto* active = file.find("active.data");
  // Divided, for the products of three sizes may not fit.
  if (!lines || lines->size() % 6 != 0 || lines->size() / 6 % nodes_i != 0 || lines->size() / 6 / nodes_i != nodes_j)
    file.fail("cornerLines has not six numbers per pillar");
  else if (!splits || splits->size() % nodes_k != 0 || splits->size() / nodes_k != nodes_i * nodes_j)
    file.fail("splitEnz has not a number per node");
  else if (!heights)
    file.fail("there are no zvalues");
  else if (active && active->size() != grid.cell_count())
    file.fail("active has not a value per cell");
  if (file.failure()) return *file.failure();

  // Scaled heights are depths.
  const Vec3 shift{file.one("translate.xoffset", 0), file.one("translate.yoffset", 0),
                   file.one("translate.zoffset", 0)};
  const Vec3 scale{file.one("scale.xscale", 1), file.one("scale.yscale", 1), -file.one("scale.zscale", -1)};
  const auto placed = [&](double x, double y, double z) {
    return Vec3{(x + shift.x) * scale.x, (y + shift.y) * scale.y, (z + shift.z) * scale.z};
  };
  // Nodes count J within I and, along each pillar, from the bottom up; values around a node go south-west, south-east,
  // north-west, north-east, eight of them those below it first.
  grid.pillars.resize(2 * lines->size() / 6);
  grid.corner_z.assign(8 * grid.cell_count(), 0);
  grid.is_active.assign(grid.cell_count(), 1);
  std::size_t node = 0, value = 0;
  for (std::uint32_t i = 0; i < nodes_i; ++i)
    for (std::uint32_t j = 0; j < nodes_j; ++j) {
      const double* line = lines->data() + 6 * (i * nodes_j + j);
      const std::size_t pillar = grid.pillar(i, j);
      grid.pillars[2 * pillar] = placed(line[3], line[4], line[5]);
      grid.pillars[2 * pillar + 1] = placed(line[0], line[1], line[2]);
      for (std::uint32_t level = 0; level < nodes_k; ++level) {
        const double split = (*splits)[node++];
        const std::size_t count =
            split == 1 || split == 2 || split == 4 || split == 8 ? static_cast<std::size_t>(split) : 0;
        if (count == 0 || heights->size() - value < count) {
          file.fail("splitEnz and zvalues do not fit each other");
          return *file.failure();
        }
        for (std::uint32_t below = 0; below < 2; ++below)
          for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
            const std::uint32_t east = quarter % 2, north = quarter / 2;
            // The cell in that quarter, above or below the node; layer counts from the bottom.
            const std::int64_t ci = std::int64_t{i} - 1 + east, cj = std::int64_t{j} - 1 + north;
            const std::int64_t layer = std::int64_t{level} - below;
            if (ci < 0 || cj < 0 || layer < 0 || ci >= grid.size[0] || cj >= grid.size[1] || layer >= grid.size[2])
              continue;
            const std::size_t own = count == 1   ? 0
                                    : count == 2 ? 1 - below
                                    : count == 4 ? quarter
                                                 : 4 * (1 - below) + quarter;
            const double z = ((*heights)[value + own] + shift.z) * scale.z;
            if (!std::isfinite(z)) {
              file.fail("a height is not a finite number");
              return *file.failure();
            }
            grid.corner_z[grid.corner({static_cast<std::uint32_t>(ci), static_cast<std::uint32_t>(cj),
                                       static_cast<std::uint32_t>(grid.size[2] - 1 - layer)},
                                      1 - east, 1 - north, 1 - below)] = z;
          }
        value += count;
      }
    }
  for (const Vec3& point : grid.pillars)
    if (!is_finite(point)) {
      file.fail("a pillar is nowhere");
      return *file.failure();
    }
  for (std::size_t n = 0; active && n < active->size(); ++n) {
    const std::size_t layer = n % grid.size[2], column = n / grid.size[2];
    grid.is_active[grid.cell(static_cast<std::uint32_t>(column / grid.size[1]),
                             static_cast<std::uint32_t>(column % grid.size[1]),
                             static_cast<std::uint32_t>(grid.size[2] - 1 - layer))] = (*active)[n] != 0;
  }
  if (const auto* zones = file.find("subgrids.nLayers"))
    for (std::size_t zone = 0; zone < zones->size(); ++zone)
      for (double n = 0; n < (*zones)[zone] && read.layer_zone.size() < grid.size[2]; ++n)
        read.layer_zone.push_back(static_cast<std::int32_t>(zone));
  return read;
}

Result<InputData> read_roff(std::string_view bytes, const std::string& file_name) {
  auto read = read_roff_grid(bytes, file_name);
  if (!read) return read.failure();
  return hexahedra_of(read->grid, read->layer_zone);
}

}  // namespace strataflow
