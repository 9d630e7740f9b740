#pragma once
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/failure.h"

namespace strataflow {

/// Reads a text line by line and word by word, without copies. Lines end with LF or CRLF, the last one may lack its
/// end; words are separated by blanks and tabs, and a word in double quotes may hold blanks. Knows the line number,
/// so that every complaint can name file:line. `text` must outlive the scanner.
class TextScanner {
 public:
  TextScanner(std::string_view text, const std::string& file_name)
      : next_(text.data()), end_(text.data() + text.size()), file_name_(file_name) {}

  /// Moves to the next line; false at the end of the text.
  bool next_line();
  /// Moves to the next line that holds a word.
  bool next_content_line();

  /// The next word of the line without its quotes; empty when the line has no more (or holds `""`).
  std::string_view word() {
    skip_blanks();
    const char* first = cursor_;
    if (cursor_ != line_end_ && *cursor_ == '"') return quoted_word();
    while (cursor_ != line_end_ && !is_blank(*cursor_)) ++cursor_;
    return {first, static_cast<std::size_t>(cursor_ - first)};
  }
  /// What is left of the line, without blanks at its ends and without quotes around the whole.
  std::string_view rest();
  bool at_line_end() {
    skip_blanks();
    return cursor_ == line_end_;
  }
  /// The next word as a number, NaN and infinity included; nothing when it is none.
  std::optional<double> number() { return number_from(word()); }
  /// The next word as an integer (a leading + is allowed); nothing when it is none or does not fit.
  template <class Integer>
  std::optional<Integer> integer() {
    return integer_from<Integer>(word());
  }

  /// Goes back to the start of the line.
  void restart_line() { cursor_ = line_begin_; }
  /// The whole line without its end.
  std::string_view line() const { return {line_begin_, static_cast<std::size_t>(line_end_ - line_begin_)}; }
  /// Starting at 1; 0 before the first line.
  std::size_t line_number() const { return line_number_; }
  /// "file.ml:1234".
  std::string where() const { return where(line_number_); }
  std::string where(std::size_t line_number) const { return file_name_ + ":" + std::to_string(line_number); }
  /// A malformed_file failure at this line.
  Failure malformed(const std::string& what, const std::string& remedy) const {
    return Failure{FailureCode::malformed_file, where() + ": " + what, remedy};
  }

  static std::optional<double> number_from(std::string_view word);
  template <class Integer>
  static std::optional<Integer> integer_from(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    Integer value{};
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size()) return std::nullopt;
    return value;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip_blanks() {
    while (cursor_ != line_end_ && is_blank(*cursor_)) ++cursor_;
  }
  std::string_view quoted_word();

  const char* next_;
  const char* end_;
  const char* line_begin_ = nullptr;
  const char* line_end_ = nullptr;
  const char* cursor_ = nullptr;
  std::size_t line_number_ = 0;
  const std::string& file_name_;
};

/// `word` shortened to what fits a message, with unprintable characters replaced.
std::string shown(std::string_view word);

}  // namespace strataflow
