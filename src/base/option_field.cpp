#include "base/option_field.h"

#include <array>
#include <charconv>

namespace strataflow {

std::string OptionPrinter::literal(double value) {
  std::array<char, 40> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  // TOML tells floats from integers by the point or the exponent.
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string OptionPrinter::literal(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    if (c == '\n') {
      text += "\\n";
      continue;
    }
    text += c;
  }
  return text + "\"";
}

std::string OptionPrinter::literal(const std::map<std::string, double>& values) {
  std::string text = "{";
  for (const auto& [name, value] : values)
    text += (text.size() > 1 ? ", " : " ") + literal(name) + " = " + literal(value);
  return text + (values.empty() ? "}" : " }");
}

}  // namespace strataflow
