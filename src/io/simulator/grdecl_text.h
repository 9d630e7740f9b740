#pragma once
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

#include "io/text/number_text.h"

namespace strataflow {

/// Writes the values of an Eclipse keyword: equal neighbours as n*value, lines below 100 characters, a slash at the
/// end.
class GrdeclValues {
 public:
  GrdeclValues(std::string& text, std::string_view keyword) : text_(text) {
    text_ += keyword;
    text_ += '\n';
  }
  ~GrdeclValues() {
    write_run();
    text_ += line_ > 0 ? " /\n\n" : "/\n\n";
  }
  GrdeclValues(const GrdeclValues&) = delete;
  GrdeclValues& operator=(const GrdeclValues&) = delete;

  void add(std::string_view value) {
    if (run_ > 0 && value == value_) {
      ++run_;
      return;
    }
    write_run();
    value_ = value;
    run_ = 1;
  }
  template <class Number>
  void add_number(Number value) {
    char digits[32];
    add(std::string_view(digits,
                         static_cast<std::size_t>(std::to_chars(digits, digits + sizeof digits, value).ptr - digits)));
  }
  /// With that many digits after the point, without zeros at the end.
  void add_rounded(double value, int decimals) {
    char digits[400];
    const char* end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr;
    std::string_view shown(digits, static_cast<std::size_t>(end - digits));
    if (decimals > 0) {
      while (shown.back() == '0') shown.remove_suffix(1);
      if (shown.back() == '.') shown.remove_suffix(1);
    }
    add(shown == "-0" ? "0" : shown);
  }

 private:
  void write_run() {
    if (run_ == 0) return;
    std::string count;
    if (run_ > 1) {
      append_number(count, run_);
      count += '*';
    }
    if (line_ > 0 && line_ + count.size() + value_.size() > 98) {
      text_ += '\n';
      line_ = 0;
    }
    text_ += ' ';
    text_ += count;
    text_ += value_;
    line_ += 1 + count.size() + value_.size();
    run_ = 0;
  }

  std::string& text_;
  std::string value_;
  std::size_t run_ = 0, line_ = 0;
};

}  // namespace strataflow
