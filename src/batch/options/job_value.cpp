#include "batch/options/job_value.h"

#include <algorithm>
#include <array>

#include "base/option_field.h"

namespace strataflow {

const JobValue* JobValue::find(std::string_view key) const {
  if (const Table* members = table())
    for (const auto& [name, member] : *members)
      if (name == key) return &member;
  return nullptr;
}

bool JobValue::set(std::string_view path, const JobValue& new_value) {
  Table* members = table();
  if (!members) return false;
  const std::size_t dot = path.find('.');
  const std::string key(path.substr(0, dot));
  JobValue* member = find(key);
  if (!member) {
    const auto place =
        std::find_if(members->begin(), members->end(), [&](const auto& entry) { return key < entry.first; });
    member = &members->insert(place, {key, JobValue{new_value.origin, Table{}}})->second;
  }
  if (dot != std::string_view::npos) return member->set(path.substr(dot + 1), new_value);
  *member = new_value;
  return true;
}

std::string_view JobValue::kind() const {
  static constexpr std::array<std::string_view, 6> words = {"true or false", "a whole number", "a number",
                                                            "a text",        "a list",         "a table"};
  return words[value.index()];
}

std::string JobValue::literal() const {
  if (const Array* items = array()) {
    std::string text = "[";
    for (const JobValue& item : *items) text += (text.size() > 1 ? ", " : "") + item.literal();
    return text + "]";
  }
  if (const Table* members = table()) {
    std::string text = "{";
    for (const auto& [key, member] : *members)
      text += (text.size() > 1 ? ", " : " ") + OptionPrinter::literal(key) + " = " + member.literal();
    return text + (members->empty() ? "}" : " }");
  }
  if (const bool* flag = std::get_if<bool>(&value)) return OptionPrinter::literal(*flag);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return OptionPrinter::literal(*whole);
  if (const double* number = std::get_if<double>(&value)) return OptionPrinter::literal(*number);
  return OptionPrinter::literal(*text());
}

}  // namespace strataflow
