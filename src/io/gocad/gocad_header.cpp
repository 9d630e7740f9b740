#include "io/gocad/gocad_header.h"

#include <algorithm>
#include <cctype>

namespace strataflow {

namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string_view trimmed(std::string_view text) {
  static constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
  return text;
}

void take_header_entry(std::string_view entry, GocadHeader& header) {
  const std::size_t colon = entry.find(':');
  if (colon != std::string_view::npos && trimmed(entry.substr(0, colon)) == "name")
    header.name = trimmed(entry.substr(colon + 1));
}

/// Reads to the line that closes a block; every line inside is offered to `take`.
template <class Take>
Result<void> read_block(TextScanner& scanner, const Take& take) {
  const std::size_t opened = scanner.line_number();
  while (scanner.next_line()) {
    if (scanner.word() == "}") return {};
    take(scanner.line());
  }
  return Failure{FailureCode::malformed_file, scanner.where(opened) + ": the block opened here is never closed",
                 "the file seems truncated: export it again"};
}

Result<void> read_header_block(TextScanner& scanner, GocadHeader& header) {
  std::string_view text = scanner.rest();
  const std::size_t open = text.find('{');
  if (open != std::string_view::npos) text.remove_prefix(open + 1);
  const std::size_t close = text.find('}');
  take_header_entry(text.substr(0, close), header);
  if (close != std::string_view::npos) return {};
  return read_block(scanner, [&](std::string_view line) { take_header_entry(line, header); });
}

Result<void> read_sizes(TextScanner& scanner, GocadHeader& header) {
  static constexpr std::uint32_t largest = 4096;
  for (GocadProperty& property : header.properties) {
    if (scanner.at_line_end()) break;
    const auto size = scanner.integer<std::uint32_t>();
    if (!size || *size == 0 || *size > largest)
      return scanner.malformed("ESIZES of property " + shown(property.name) + " must be 1 to 4096",
                               "correct the ESIZES line");
    property.width = *size;
  }
  return {};
}

void warn_of_units(TextScanner& scanner, const GocadHeader& header, std::vector<Warning>& warnings) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string unit = lower_case(trimmed(scanner.word()));
    if (unit.empty() || unit == "m" || unit == "meter" || unit == "metre" || unit == "meters" || unit == "metres" ||
        unit == "unknown" || unit == "none" || unit == "unitless")
      continue;
    warnings.push_back({"unit_not_metre", scanner.where() + ": " + shown(header.name) + " is in " + shown(unit) +
                                              "; its numbers are taken as metres"});
    return;
  }
}

}  // namespace

Result<void> read_gocad_header_line(TextScanner& scanner, std::string_view word, GocadHeader& header,
                                    std::vector<Warning>& warnings) {
  if (word == "HEADER") return read_header_block(scanner, header);
  if (word == "HDR") {
    take_header_entry(scanner.rest(), header);
  } else if (word == "GEOLOGICAL_TYPE") {
    header.type = lower_case(scanner.rest());
  } else if (word == "ZPOSITIVE") {
    header.is_depth = lower_case(scanner.word()) == "depth";
  } else if (word == "AXIS_UNIT") {
    warn_of_units(scanner, header, warnings);
  } else if (word == "PROPERTIES") {
    header.properties.clear();
    while (!scanner.at_line_end()) {
      GocadProperty property;
      property.name = trimmed(scanner.word());
      header.properties.push_back(std::move(property));
    }
  } else if (word == "ESIZES") {
    return read_sizes(scanner, header);
  } else if (word == "UNITS") {
    for (GocadProperty& property : header.properties) property.unit = trimmed(scanner.word());
  } else if (word == "NO_DATA_VALUES") {
    for (GocadProperty& property : header.properties)
      property.no_data = scanner.number().value_or(std::numeric_limits<double>::quiet_NaN());
  } else if (const std::string_view line = scanner.rest(); !line.empty() && line.back() == '{') {
    return read_block(scanner, [](std::string_view) {});
  }
  return {};
}

Role role_from_gocad(std::string_view kind) {
  const std::string word = lower_case(kind);
  const auto holds = [&](std::string_view part) { return word.find(part) != std::string::npos; };
  if (holds("fault")) return Role::fault;
  if (holds("boundary") || word == "lease") return Role::boundary;
  if (holds("unconformity") || holds("erosion") || holds("eroded") || holds("discordan") || word == "baselap")
    return Role::unconformity;
  if (holds("intrusi") || word == "salt" || word == "diapir") return Role::intrusion;
  if (holds("horizon") || holds("topograph") || holds("formational") || word == "top" || word == "bottom" ||
      word == "base" || word == "none" || word == "conformal" || word == "paraconformal")
    return Role::horizon;
  return Role::unknown;
}

std::string_view gocad_kind_of(Role role) {
  switch (role) {
    case Role::fault:
      return "fault";
    case Role::horizon:
      return "top";
    case Role::unconformity:
      return "unconformity";
    case Role::boundary:
      return "boundary";
    case Role::intrusion:
      return "intrusive";
    default:
      return "none";
  }
}

}  // namespace strataflow
