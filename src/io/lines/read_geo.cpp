#include "io/lines/read_geo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "base/id.h"
#include "io/text/text_scanner.h"

namespace strataflow {

namespace {

/// Statements of a .geo script. The first problem sticks: later reads give nothing.
class GeoScript {
 public:
  GeoScript(std::string_view text, const std::string& file_name, const IncludeReader& read_include)
      : source_{text, file_name, 0}, read_include_(read_include) {}

  struct Line {
    std::array<std::int64_t, 2> points;
  };
  std::map<std::int64_t, Vec3> points;
  std::map<std::int64_t, Line> lines;
  std::map<std::int64_t, std::vector<std::int64_t>> loops, surfaces;  ///< of signed lines, of loops
  std::map<std::int64_t, std::string> surface_group;
  std::vector<std::string> curve_groups;

  std::optional<Failure> run() {
    for (;;) {
      while (!failure_ && (skip(), source_.place < source_.text.size())) statement();
      if (failure_ || including_.empty()) return failure_;
      source_ = including_.back();
      including_.pop_back();
    }
  }

 private:
  void fail(FailureCode code, const std::string& what, const std::string& remedy) {
    if (failure_) return;
    const auto line = 1 + std::count(source_.text.begin(), source_.text.begin() + static_cast<std::ptrdiff_t>(std::min(source_.place, source_.text.size())), '\n');
    failure_ = Failure{code, source_.name + ":" + std::to_string(line) + ": " + what, remedy};
  }
  void malformed(const std::string& what) { fail(FailureCode::malformed_file, what, "export the section again as .geo"); }

  void skip() {
    while (source_.place < source_.text.size()) {
      if (static_cast<unsigned char>(source_.text[source_.place]) <= ' ') {
        ++source_.place;
      } else if (source_.text.substr(source_.place, 2) == "//") {
        source_.place = std::min(source_.text.find('\n', source_.place), source_.text.size());
      } else if (source_.text.substr(source_.place, 2) == "/*") {
        const std::size_t end = source_.text.find("*/", source_.place);
        source_.place = end == std::string_view::npos ? source_.text.size() : end + 2;
      } else {
        break;
      }
    }
  }
  bool take(char c) {
    skip();
    if (failure_ || source_.place >= source_.text.size() || source_.text[source_.place] != c) return false;
    ++source_.place;
    return true;
  }
  void expect(char c) {
    if (!take(c)) malformed(std::string("expected '") + c + "'");
  }
  std::string_view word() {
    skip();
    const std::size_t begin = source_.place;
    const auto is_letter = [](char c) { return c == '_' || (c >= '0' && c <= '9') || ((c | 32) >= 'a' && (c | 32) <= 'z'); };
    while (!failure_ && source_.place < source_.text.size() && is_letter(source_.text[source_.place])) ++source_.place;
    return source_.text.substr(begin, source_.place - begin);
  }
  std::string quoted() {
    expect('"');
    const std::size_t begin = source_.place, end = source_.text.find('"', source_.place);
    if (failure_ || end == std::string_view::npos) {
      malformed("a name does not end");
      return {};
    }
    source_.place = end + 1;
    return std::string(source_.text.substr(begin, end - begin));
  }

  // Expressions: comparison of sums of products of numbers, constants and parentheses.
  double factor(int depth) {
    if (depth > 100) {
      malformed("an expression nested too deeply");
      return 0;
    }
    if (take('-')) return -factor(depth + 1);
    if (take('+')) return factor(depth + 1);
    if (take('(')) {
      const double value = sum(depth + 1);
      expect(')');
      return value;
    }
    skip();
    const std::size_t begin = source_.place;
    if (source_.place < source_.text.size() && (source_.text[source_.place] == '.' || (source_.text[source_.place] >= '0' && source_.text[source_.place] <= '9'))) {
      while (source_.place < source_.text.size() && ((source_.text[source_.place] >= '0' && source_.text[source_.place] <= '9') || source_.text[source_.place] == '.' ||
                                       (source_.text[source_.place] | 32) == 'e' ||
                                       ((source_.text[source_.place] == '-' || source_.text[source_.place] == '+') && (source_.text[source_.place - 1] | 32) == 'e')))
        ++source_.place;
      const auto value = TextScanner::number_from(source_.text.substr(begin, source_.place - begin));
      if (!value) malformed("'" + shown(source_.text.substr(begin, source_.place - begin)) + "' is no number");
      return value.value_or(0);
    }
    const std::string_view name = word();
    if (const auto found = constants_.find(std::string(name)); found != constants_.end()) return found->second;
    if (const auto found = lists_.find(std::string(name)); found != lists_.end() && take('(')) {
      const double index = sum(depth + 1);
      expect(')');
      if (!failure_ && !(index >= 0 && index < static_cast<double>(found->second.size()) && index == std::floor(index)))
        malformed("the list '" + std::string(name) + "' has no such element");
      return failure_ ? 0 : found->second[static_cast<std::size_t>(index)];
    }
    malformed("expected a number, found '" + shown(name.empty() ? source_.text.substr(source_.place, 10) : name) + "'");
    return 0;
  }
  double product(int depth) {
    double value = factor(depth);
    for (;;) {
      if (take('*'))
        value *= factor(depth);
      else if (take('/'))
        value /= factor(depth);
      else
        return value;
    }
  }
  double sum(int depth) {
    double value = product(depth);
    for (;;) {
      if (take('+'))
        value += product(depth);
      else if (take('-'))
        value -= product(depth);
      else
        return value;
    }
  }
  double number() {
    const double value = sum(0);
    if (!failure_ && !std::isfinite(value)) malformed("a value is not a finite number");
    return value;
  }
  std::int64_t tag() {
    const double value = number();
    if (!failure_ && !(std::abs(value) < 1e15 && value == std::round(value))) malformed("a number of an entity must be whole");
    return failure_ ? 0 : static_cast<std::int64_t>(value);
  }
  std::vector<std::int64_t> tags() {
    std::vector<std::int64_t> list;
    expect('{');
    if (take('}')) return list;
    do list.push_back(tag());
    while (take(',') && !failure_);
    expect('}');
    return list;
  }
  std::array<double, 3> triple() {
    std::array<double, 3> at{};
    expect('{');
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0) expect(',');
      at[k] = number();
    }
    return at;
  }
  /// `Point{:}`, `Surface{:}`: entities of a kind, all of them.
  void all_entities() {
    const std::string_view kind = word();
    if (kind != "Point" && kind != "Curve" && kind != "Line" && kind != "Surface") return unsupported(kind);
    expect('{');
    if (!take(':')) return unsupported(std::string(kind) + "{…} of some only");
    expect('}');
  }
  std::vector<double> bounding_box() {
    word();  // of which kind
    expect('{');
    all_entities();
    expect('}');
    std::vector<double> box(6, 0);
    bool is_first = true;
    for (const auto& [number_of, at] : points)
      for (int k = 0; k < 3; ++k) {
        double &low = box[static_cast<std::size_t>(k)], &high = box[static_cast<std::size_t>(3 + k)];
        low = is_first ? at[k] : std::min(low, at[k]);
        high = is_first ? at[k] : std::max(high, at[k]);
        if (k == 2) is_first = false;
      }
    return box;
  }
  void dilate() {
    expect('{');
    const auto centre = triple();
    expect('}');
    expect(',');
    std::array<double, 3> factor_of{};
    if (skip(), source_.place < source_.text.size() && source_.text[source_.place] == '{') {
      factor_of = triple();
      expect('}');
    } else {
      factor_of.fill(number());
    }
    expect('}');
    expect('{');
    all_entities();
    take(';');
    expect('}');
    if (failure_) return;
    for (auto& [number_of, at] : points)
      for (int k = 0; k < 3; ++k) {
        const double c = centre[static_cast<std::size_t>(k)];
        at[k] = c + factor_of[static_cast<std::size_t>(k)] * (at[k] - c);
        if (!std::isfinite(at[k])) return malformed("a point is moved to infinity");
      }
  }
  void include() {
    const std::string written = quoted();
    take(';');
    if (failure_) return;
    const std::size_t slash = source_.name.find_last_of('/');
    const bool is_beside = slash != std::string::npos && !written.starts_with('/');
    const std::string name = is_beside ? source_.name.substr(0, slash + 1) + written : written;
    if (including_.size() >= deepest_include)
      return malformed("files include each other more than " + std::to_string(deepest_include) + " deep, '" + written +
                       "' among them");
    if (!read_include_)
      return fail(FailureCode::unsupported, "'" + written + "' is included, which is not at hand here",
                  "put both files into a folder, unpacked");
    Result<std::string> text = read_include_(name);
    if (!text)
      return fail(text.failure().code, "includes '" + written + "': " + text.failure().what, text.failure().remedy);
    including_.push_back(std::move(source_));
    source_ = {included_texts_.emplace_back(std::move(*text)), name, 0};
  }

  std::int64_t entity_number() {
    expect('(');
    const std::int64_t number = tag();
    expect(')');
    expect('=');
    return number;
  }

  void statement() {
    const std::string_view first = word();
    if (first == "DefineConstant") {
      expect('[');
      do {
        const std::string name(word());
        expect('=');
        const double value = number();
        if (!failure_) constants_.emplace(name, value);
      } while (take(',') && !failure_);
      expect(']');
    } else if (first == "If") {
      expect('(');
      double value = number();
      if (take('>')) value = value > number() ? 1 : 0;
      else if (take('<')) value = value < number() ? 1 : 0;
      expect(')');
      if (!failure_ && value == 0) skip_to_end_if();
      return;
    } else if (first == "EndIf") {
      return;
    } else if (first == "Include") {
      return include();
    } else if (first == "Dilate") {
      dilate();
      take(';');
      return;
    } else if (first == "Point") {
      const std::int64_t number_of = entity_number();
      const auto at = triple();
      if (take(',')) number();  // a mesh size
      expect('}');
      if (!failure_) points[number_of] = {at[0], at[1], at[2]};
    } else if (first == "Line") {
      const std::int64_t number_of = entity_number();
      const auto ends = tags();
      if (failure_) return;
      if (ends.size() != 2 || ends[0] == ends[1] || !points.count(ends[0]) || !points.count(ends[1]))
        return malformed("a line needs two different points that are there");
      lines[number_of] = {{ends[0], ends[1]}};
    } else if (first == "Curve" || first == "Plane") {
      const std::string_view second = word();
      if (second != (first == "Curve" ? "Loop" : "Surface")) return unsupported(first);
      const std::int64_t number_of = entity_number();
      (first == "Curve" ? loops : surfaces)[number_of] = tags();
    } else if (first == "Physical") {
      const std::string_view kind = word();
      if (kind != "Curve" && kind != "Line" && kind != "Surface" && kind != "Point") return unsupported("Physical");
      expect('(');
      skip();
      std::string name = source_.place < source_.text.size() && source_.text[source_.place] == '"' ? quoted() : std::to_string(tag());
      if (take(',')) tag();
      expect(')');
      expect('=');
      for (const std::int64_t member : tags())
        if (kind == "Surface") surface_group[member] = name;
      if (kind != "Surface") curve_groups.push_back(name);
    } else if (!first.empty() && take('(')) {
      if (!take(')')) return unsupported(first);
      expect('=');
      if (word() != "BoundingBox") return unsupported(first);
      lists_[std::string(first)] = bounding_box();
    } else if (take('=')) {
      const double value = number();
      if (!failure_) constants_[std::string(first)] = value;
    } else {
      return unsupported(first);
    }
    expect(';');
  }
  void unsupported(std::string_view what) {
    fail(FailureCode::unsupported, "'" + shown(what.empty() ? source_.text.substr(source_.place, 20) : what) + "' is not read",
         "a section is made of Point, Line, Curve Loop, Plane Surface and Physical");
  }
  void skip_to_end_if() {
    for (int depth = 1; depth > 0;) {
      skip();
      if (source_.place >= source_.text.size()) return malformed("If without EndIf");
      const std::string_view next = word();
      depth += next == "If" ? 1 : next == "EndIf" ? -1 : 0;
      if (next.empty()) ++source_.place;
    }
  }

  /// A file being read.
  struct Source {
    std::string_view text;
    std::string name;
    std::size_t place = 0;
  };
  static constexpr std::size_t deepest_include = 16;

  Source source_;
  std::vector<Source> including_;  ///< the files whose Include led to this one, outermost first
  std::deque<std::string> included_texts_;
  const IncludeReader& read_include_;
  std::map<std::string, double> constants_;
  std::map<std::string, std::vector<double>> lists_;
  std::optional<Failure> failure_;
};

/// One straight line with what lies beside it.
struct Piece {
  std::array<std::int64_t, 2> points;
  std::vector<std::int64_t> surfaces;  ///< that use it
  std::string name;
};

/// Pieces of one name, broken where other than two pieces meet or the name changes.
struct Chain {
  std::string name;
  std::vector<std::int64_t> points;  ///< the first again at the end, if closed
};

std::vector<Chain> chains_of(const std::vector<Piece>& pieces) {
  std::map<std::int64_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const std::int64_t p : pieces[i].points) at[p].push_back(i);
  const auto goes_on = [&](std::size_t piece, std::int64_t point) {
    const auto& meeting = at.at(point);
    if (meeting.size() != 2) return no_index;
    const std::size_t other = meeting[0] == piece ? meeting[1] : meeting[0];
    return other != piece && pieces[other].name == pieces[piece].name ? static_cast<std::uint32_t>(other) : no_index;
  };
  std::vector<char> is_used(pieces.size(), 0);
  std::vector<Chain> chains;
  const auto follow = [&](std::size_t first, std::int64_t from) {
    Chain chain{pieces[first].name, {from}};
    for (std::size_t piece = first;;) {
      is_used[piece] = 1;
      const auto& ends = pieces[piece].points;
      chain.points.push_back(ends[0] == chain.points.back() ? ends[1] : ends[0]);
      const std::uint32_t next = goes_on(piece, chain.points.back());
      if (next == no_index || is_used[next]) break;
      piece = next;
    }
    chains.push_back(std::move(chain));
  };
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const std::int64_t p : pieces[i].points)
      if (!is_used[i] && goes_on(i, p) == no_index) follow(i, p);
  for (std::size_t i = 0; i < pieces.size(); ++i)  // closed ones
    if (!is_used[i]) follow(i, pieces[i].points[0]);
  return chains;
}

double area_of(const Polyline& line) {
  double twice = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Vec3 &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

}  // namespace

Result<InputData> read_geo(std::string_view bytes, const std::string& file_name) {
  return read_geo_including(bytes, file_name, {});
}

Result<InputData> read_geo_including(std::string_view bytes, const std::string& file_name,
                                     const IncludeReader& read_include) {
  GeoScript script(bytes, file_name, read_include);
  if (const auto failure = script.run()) return *failure;
  const auto broken = [&](const std::string& what) {
    return Failure{FailureCode::malformed_file, file_name + ": " + what, "export the section again as .geo"};
  };
  std::map<std::int64_t, std::vector<std::int64_t>> users;  // line → surfaces
  for (const auto& [surface, loops] : script.surfaces)
    for (const std::int64_t loop : loops) {
      const auto found = script.loops.find(std::abs(loop));
      if (found == script.loops.end())
        return broken("plane surface " + std::to_string(surface) + " names curve loop " + std::to_string(loop) +
                      ", which is not there");
      for (const std::int64_t line : found->second) {
        if (!script.lines.count(std::abs(line)))
          return broken("curve loop " + std::to_string(loop) + " names line " + std::to_string(line) +
                        ", which is not there");
        users[std::abs(line)].push_back(surface);
      }
    }
  if (script.lines.empty()) return broken("no line in it");

  const auto group_of = [&](std::int64_t surface) {
    const auto found = script.surface_group.find(surface);
    return found == script.surface_group.end() ? "surface " + std::to_string(surface) : found->second;
  };
  std::vector<Piece> border, inner;
  for (const auto& [number, line] : script.lines) {
    Piece piece{line.points, users[number], {}};
    std::vector<std::string> names;
    for (const std::int64_t surface : piece.surfaces) names.push_back(group_of(surface));
    std::sort(names.begin(), names.end());
    if (piece.surfaces.size() == 1) {
      border.push_back(piece);
      continue;
    }
    for (const std::string& name : names) piece.name += (piece.name.empty() ? "" : " | ") + name;
    if (names.empty()) piece.name = "line " + std::to_string(number);
    inner.push_back(std::move(piece));
  }
  InputData data;
  const auto add = [&](const std::vector<Piece>& pieces, bool is_border) -> std::optional<Failure> {
    for (const auto& [name, chain] : chains_of(pieces)) {
      Polyline line;
      line.name = name;
      line.is_closed = chain.size() > 3 && chain.front() == chain.back();
      for (std::size_t i = 0; i + (line.is_closed ? 1 : 0) < chain.size(); ++i)
        line.points.push_back(script.points.at(chain[i]));
      if (is_border && !line.is_closed)
        return broken("the boundary of the surfaces does not close at point " + std::to_string(chain.back()));
      line.role = is_border ? Role::hole : Role::curve;
      data.lines.push_back(std::move(line));
    }
    return std::nullopt;
  };
  if (const auto failure = add(border, true)) return *failure;
  if (!data.lines.empty()) {
    std::size_t largest = 0;
    for (std::size_t i = 0; i < data.lines.size(); ++i) {
      data.lines[i].name = "hole " + std::to_string(i);
      if (area_of(data.lines[i]) > area_of(data.lines[largest])) largest = i;
    }
    data.lines[largest].role = Role::outline;
    data.lines[largest].name = "outline";
  }
  if (const auto failure = add(inner, false)) return *failure;
  for (const std::string& group : script.curve_groups)
    data.warnings.push_back({"ignored_group", file_name + ": the group of curves '" + group +
                                                  "' is ignored: lines are called after the surfaces beside them"});
  return data;
}

}  // namespace strataflow
