#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/bytes/byte_order.h"
#include "io/text/text_scanner.h"
#include "model/vector3.h"

namespace strataflow {

/// Reads words over line ends, and stretches of binary numbers between them, for formats in which line ends mean
/// little. The first problem sticks: later reads give zeros, so a loop only has to ask `failed()`. `text` and
/// `file_name` must outlive the stream.
class WordStream {
 public:
  /// A word that starts with `comment` hides the rest of its line.
  WordStream(std::string_view text, const std::string& file_name, char comment = '#')
      : text_(text), file_name_(file_name), comment_(comment) {}

  /// The next word without its double quotes; empty at the end of the text or after a failure.
  std::string_view word() {
    skip_blanks();
    if (failure_ || place_ == text_.size()) return {};
    if (text_[place_] == '"') {
      const std::size_t begin = ++place_, end = std::min(text_.find('"', begin), text_.size());
      place_ = std::min(end + 1, text_.size());
      return text_.substr(begin, end - begin);
    }
    const std::size_t begin = place_;
    while (place_ != text_.size() && !is_blank(text_[place_])) ++place_;
    return text_.substr(begin, place_ - begin);
  }
  /// The next word, which stays the next.
  std::string_view peek() {
    const std::size_t place = place_;
    const std::string_view found = word();
    place_ = place;
    return found;
  }
  /// What is left of the line, and moves to the next.
  std::string_view rest_of_line() {
    const std::size_t begin = place_, end = std::min(text_.find('\n', begin), text_.size());
    place_ = std::min(end + 1, text_.size());
    std::string_view rest = text_.substr(begin, end - begin);
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
    return rest;
  }
  /// The next word as an integer; `what` names it in the message.
  std::int64_t integer(const char* what) {
    const std::string_view found = word();
    const auto value = TextScanner::integer_from<std::int64_t>(found);
    if (!value) fail_at(found, what);
    return value.value_or(0);
  }
  /// The next word as a number, which may be NaN.
  double number(const char* what) {
    const std::string_view found = word();
    const auto value = TextScanner::number_from(found);
    if (!value) fail_at(found, what);
    return value.value_or(0);
  }
  /// Three finite numbers.
  Vec3 point() {
    const double x = number("a coordinate"), y = number("a coordinate"), z = number("a coordinate");
    if (!is_finite({x, y, z})) fail("a coordinate is not a finite number");
    return {x, y, z};
  }
  /// A number of things, each of which takes at least a byte: a count that the rest of the text cannot hold fails.
  std::size_t count(const char* what) {
    const std::int64_t value = integer(what);
    if (value >= 0 && static_cast<std::uint64_t>(value) <= text_.size() - place_)
      return static_cast<std::size_t>(value);
    fail(std::string(what) + " is " + std::to_string(value) + ", which this file cannot hold");
    return 0;
  }
  /// A vertex that counts from `first`, of `count`; as an index from zero.
  std::uint32_t vertex(std::int64_t first, std::size_t count) {
    const std::int64_t value = integer("a point number");
    if (value >= first && static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(first) < count)
      return static_cast<std::uint32_t>(value - first);
    fail("point " + std::to_string(value) + " does not exist; there are " + std::to_string(count));
    return 0;
  }

  /// The next `size` bytes; fails, and gives none, when there are fewer.
  std::string_view bytes(std::size_t size) {
    if (failure_) return {};
    if (size > text_.size() - place_) {
      fail_at_byte("the file ends in the middle of binary data");
      return {};
    }
    const std::string_view found = text_.substr(place_, size);
    place_ += size;
    return found;
  }
  /// The next bytes as one binary number.
  template <class T>
  T binary(bool swap) {
    const std::string_view found = bytes(sizeof(T));
    return found.empty() ? T{} : load_number<T>(found.data(), swap);
  }
  std::size_t bytes_left() const { return text_.size() - place_; }

  bool failed() const { return failure_.has_value(); }
  const Failure& failure() const { return *failure_; }
  /// Notes a malformed_file failure at the current line, unless there is one already.
  void fail(const std::string& what) { note(":" + std::to_string(line_number()) + ": " + what); }
  /// The same for binary data, which have no lines.
  void fail_at_byte(const std::string& what) { note(": byte " + std::to_string(place_) + ": " + what); }
  /// Notes any other failure, unless there is one already.
  void fail_as(FailureCode code, const std::string& what, const std::string& remedy) {
    if (!failure_) failure_ = Failure{code, file_name_ + ": " + what, remedy};
  }
  std::size_t line_number() const {
    return 1 + static_cast<std::size_t>(
                   std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(place_), '\n'));
  }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip_blanks() {
    for (;;) {
      while (place_ != text_.size() && is_blank(text_[place_])) ++place_;
      if (place_ == text_.size() || text_[place_] != comment_) return;
      place_ = std::min(text_.find('\n', place_), text_.size());
    }
  }
  void note(const std::string& message) {
    if (!failure_)
      failure_ = Failure{FailureCode::malformed_file, file_name_ + message, "correct the file or export it again"};
  }
  void fail_at(std::string_view found, const char* what) {
    fail(found.empty() ? std::string("the file ends where ") + what + " should be"
                       : std::string("expected ") + what + ", found '" + shown(found) + "'");
  }

  std::string_view text_;
  const std::string& file_name_;
  char comment_;
  std::size_t place_ = 0;
  std::optional<Failure> failure_;
};

}  // namespace strataflow
