#include "io/lines/read_geo.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  GeoScript(std::string_view text, const std::string& file_name) : text_(text), file_name_(file_name) {}

  struct Line {
    std::array<std::int64_t, 2> points;
  };
  std::map<std::int64_t, Vec3> points;
  std::map<std::int64_t, Line> lines;
  std::map<std::int64_t, std::vector<std::int64_t>> loops, surfaces;  ///< of signed lines, of loops
  std::map<std::int64_t, std::string> surface_group;
  std::vector<std::string> curve_groups;

  std::optional<Failure> run() {
    while (!failure_ && (skip(), place_ < text_.size())) statement();
    return failure_;
  }

 private:
  void fail(FailureCode code, const std::string& what, const std::string& remedy) {
    if (failure_) return;
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(place_, text_.size())), '\n');
    failure_ = Failure{code, file_name_ + ":" + std::to_string(line) + ": " + what, remedy};
  }
  void malformed(const std::string& what) { fail(FailureCode::malformed_file, what, "export the section again as .geo"); }

  void skip() {
    while (place_ < text_.size()) {
      if (static_cast<unsigned char>(text_[place_]) <= ' ') {
        ++place_;
      } else if (text_.substr(place_, 2) == "//") {
        place_ = std::min(text_.find('\n', place_), text_.size());
      } else if (text_.substr(place_, 2) == "/*") {
        const std::size_t end = text_.find("*/", place_);
        place_ = end == std::string_view::npos ? text_.size() : end + 2;
      } else {
        break;
      }
    }
  }
  bool take(char c) {
    skip();
    if (failure_ || place_ >= text_.size() || text_[place_] != c) return false;
    ++place_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) malformed(std::string("expected '") + c + "'");
  }
  std::string_view word() {
    skip();
    const std::size_t begin = place_;
    const auto is_letter = [](char c) { return c == '_' || (c >= '0' && c <= '9') || ((c | 32) >= 'a' && (c | 32) <= 'z'); };
    while (!failure_ && place_ < text_.size() && is_letter(text_[place_])) ++place_;
    return text_.substr(begin, place_ - begin);
  }
  std::string quoted() {
    expect('"');
    const std::size_t begin = place_, end = text_.find('"', place_);
    if (failure_ || end == std::string_view::npos) {
      malformed("a name does not end");
      return {};
    }
    place_ = end + 1;
    return std::string(text_.substr(begin, end - begin));
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
    const std::size_t begin = place_;
    if (place_ < text_.size() && (text_[place_] == '.' || (text_[place_] >= '0' && text_[place_] <= '9'))) {
      while (place_ < text_.size() && ((text_[place_] >= '0' && text_[place_] <= '9') || text_[place_] == '.' ||
                                       (text_[place_] | 32) == 'e' ||
                                       ((text_[place_] == '-' || text_[place_] == '+') && (text_[place_ - 1] | 32) == 'e')))
        ++place_;
      const auto value = TextScanner::number_from(text_.substr(begin, place_ - begin));
      if (!value) malformed("'" + shown(text_.substr(begin, place_ - begin)) + "' is no number");
      return value.value_or(0);
    }
    const std::string_view name = word();
    const auto found = constants_.find(std::string(name));
    if (found != constants_.end()) return found->second;
    malformed("expected a number, found '" + shown(name.empty() ? text_.substr(place_, 10) : name) + "'");
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
    } else if (first == "Point") {
      const std::int64_t number_of = entity_number();
      expect('{');
      std::array<double, 3> at{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (k > 0) expect(',');
        at[k] = number();
      }
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
      std::string name = place_ < text_.size() && text_[place_] == '"' ? quoted() : std::to_string(tag());
      if (take(',')) tag();
      expect(')');
      expect('=');
      for (const std::int64_t member : tags())
        if (kind == "Surface") surface_group[member] = name;
      if (kind != "Surface") curve_groups.push_back(name);
    } else if (take('=')) {
      const double value = number();
      if (!failure_) constants_[std::string(first)] = value;
    } else {
      return unsupported(first);
    }
    expect(';');
  }
  void unsupported(std::string_view what) {
    fail(FailureCode::unsupported, "'" + shown(what.empty() ? text_.substr(place_, 20) : what) + "' is not read",
         "a section is made of Point, Line, Curve Loop, Plane Surface and Physical");
  }
  void skip_to_end_if() {
    for (int depth = 1; depth > 0;) {
      skip();
      if (place_ >= text_.size()) return malformed("If without EndIf");
      const std::string_view next = word();
      depth += next == "If" ? 1 : next == "EndIf" ? -1 : 0;
      if (next.empty()) ++place_;
    }
  }

  std::string_view text_;
  const std::string& file_name_;
  std::size_t place_ = 0;
  std::map<std::string, double> constants_;
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
  GeoScript script(bytes, file_name);
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
