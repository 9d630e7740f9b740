#include "io/text/text_scanner.h"

#include <cstring>

namespace strataflow {

bool TextScanner::next_line() {
  if (next_ == end_) {
    line_begin_ = line_end_ = cursor_ = end_;
    return false;
  }
  const auto* found = static_cast<const char*>(std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_)));
  line_begin_ = cursor_ = next_;
  line_end_ = found ? found : end_;
  next_ = found ? found + 1 : end_;
  if (line_end_ != line_begin_ && line_end_[-1] == '\r') --line_end_;
  ++line_number_;
  return true;
}

bool TextScanner::next_content_line() {
  while (next_line())
    if (!at_line_end()) return true;
  return false;
}

std::string_view TextScanner::quoted_word() {
  const char* first = ++cursor_;
  while (cursor_ != line_end_ && *cursor_ != '"') ++cursor_;
  const std::string_view word(first, static_cast<std::size_t>(cursor_ - first));
  if (cursor_ != line_end_) ++cursor_;
  return word;
}

std::string_view TextScanner::rest() {
  skip_blanks();
  const char* first = cursor_;
  const char* last = line_end_;
  while (last != first && is_blank(last[-1])) --last;
  cursor_ = line_end_;
  if (last - first >= 2 && *first == '"' && last[-1] == '"') {
    ++first;
    --last;
  }
  return {first, static_cast<std::size_t>(last - first)};
}

std::optional<double> TextScanner::number_from(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (stop != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {  // too small is zero, too large is not a number we can hold
    const std::size_t exponent = word.find_first_of("eE");
    const bool is_tiny = exponent == std::string_view::npos
                             ? word.substr(0, 3).find("0.") != std::string_view::npos || word[0] == '.'
                             : exponent + 1 < word.size() && word[exponent + 1] == '-';
    if (!is_tiny) return std::nullopt;
    return word[0] == '-' ? -0.0 : 0.0;
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::string shown(std::string_view word) {
  static constexpr std::size_t longest = 60;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  return word.size() > longest ? text + "..." : text;
}

}  // namespace strataflow
