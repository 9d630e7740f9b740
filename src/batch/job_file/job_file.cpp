#include "batch/job_file/job_file.h"

#include <toml++/toml.h>

#include <algorithm>

namespace strataflow {

namespace {

std::string place(const std::string& name, const toml::source_region& source) {
  return source.begin.line ? name + ":" + std::to_string(source.begin.line) : name;
}

/// Copies a TOML tree, remembering where each value stood. Dates are the one kind no option takes.
class TreeCopier {
 public:
  explicit TreeCopier(const std::string& name) : name_(name) {}

  JobValue copy(const toml::node& node) {
    JobValue result;
    result.origin = place(name_, node.source());
    if (const toml::table* table = node.as_table()) {
      result.value = copy_table(*table);
    } else if (const toml::array* array = node.as_array()) {
      JobValue::Array items;
      for (const toml::node& item : *array) items.push_back(copy(item));
      result.value = std::move(items);
    } else if (const auto* flag = node.as_boolean()) {
      result.value = flag->get();
    } else if (const auto* whole = node.as_integer()) {
      result.value = whole->get();
    } else if (const auto* number = node.as_floating_point()) {
      result.value = number->get();
    } else if (const auto* text = node.as_string()) {
      result.value = text->get();
    } else if (!problem_) {
      problem_ = Failure{FailureCode::invalid_usage, result.origin + ": no option takes a date or a time",
                         "write a number or a text in quotes"};
    }
    return result;
  }
  const std::optional<Failure>& problem() const { return problem_; }

 private:
  JobValue::Table copy_table(const toml::table& table) {
    JobValue::Table members;
    for (const auto& [key, value] : table) members.emplace_back(std::string(key.str()), copy(value));
    std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return members;
  }

  const std::string& name_;
  std::optional<Failure> problem_;
};

}  // namespace

Result<JobValue> parse_job_text(std::string_view text, const std::string& name) {
  try {
    const toml::table table = toml::parse(text);
    TreeCopier copier(name);
    JobValue root = copier.copy(table);
    if (copier.problem()) return *copier.problem();
    root.origin = name;
    return root;
  } catch (const toml::parse_error& error) {
    return Failure{FailureCode::invalid_usage, place(name, error.source()) + ": " + std::string(error.description()),
                   "job files are TOML: configs/README.md has every key and an example"};
  }
}

JobValue parse_setting_value(std::string_view text, const std::string& setting) {
  const std::string origin = "--set " + setting;
  const auto with_origin = [&](auto&& self, JobValue& value) -> void {
    value.origin = origin;
    if (auto* items = std::get_if<JobValue::Array>(&value.value))
      for (JobValue& item : *items) self(self, item);
    if (JobValue::Table* members = value.table())
      for (auto& [key, member] : *members) self(self, member);
  };
  // A line break would let one setting smuggle in a second key.
  if (text.find('\n') == std::string_view::npos) {
    Result<JobValue> parsed = parse_job_text("value = " + std::string(text), setting);
    if (JobValue* value = parsed ? parsed->find("value") : nullptr) {
      with_origin(with_origin, *value);
      return *value;
    }
  }
  return JobValue{origin, std::string(text)};
}

}  // namespace strataflow
