#include "batch/options/option_reader.h"

#include <algorithm>
#include <cmath>

#include "batch/options/closest_word.h"
#include "stages/option_domain.h"

namespace strataflow {

std::string OptionReader::key(const OptionField& field) const { return section_ + "." + std::string(field.name); }

void OptionReader::wrong_type(const JobValue& found, const OptionField& field, std::string_view wanted) {
  problems_.push_back({FailureCode::invalid_options,
                       found.origin + ": " + key(field) + " must be " + std::string(wanted) + ", but " +
                           found.literal() + " is " + std::string(found.kind()),
                       "it means: " + std::string(field.description)});
}

void OptionReader::check_domain(const JobValue& found, double value, const OptionField& field) {
  const bool above_minimum = field.exclusive_minimum ? value > field.minimum : value >= field.minimum;  // false for NaN
  if (above_minimum && value <= field.maximum && std::isfinite(value)) return;
  const std::string domain = domain_of(field);
  problems_.push_back(
      {FailureCode::invalid_options,
       found.origin + ": " + key(field) + " = " + found.literal() + " must be " + (domain.empty() ? "finite" : domain),
       "it means: " + std::string(field.description)});
}

void OptionReader::check_characters(const JobValue& found, const std::string& text, const OptionField& field) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (std::none_of(text.begin(), text.end(), is_control)) return;
  problems_.push_back(
      {FailureCode::invalid_options, found.origin + ": " + key(field) + " holds control characters", "remove them"});
}

void OptionReader::read(const JobValue& found, bool& value, const OptionField& field) {
  if (const bool* flag = std::get_if<bool>(&found.value))
    value = *flag;
  else
    wrong_type(found, field, "true or false");
}

void OptionReader::read(const JobValue& found, std::int64_t& value, const OptionField& field) {
  const auto* whole = std::get_if<std::int64_t>(&found.value);
  if (!whole) return wrong_type(found, field, "a whole number");
  value = *whole;
  check_domain(found, static_cast<double>(value), field);
}

void OptionReader::read(const JobValue& found, double& value, const OptionField& field) {
  if (const auto* whole = std::get_if<std::int64_t>(&found.value))
    value = static_cast<double>(*whole);
  else if (const double* number = std::get_if<double>(&found.value))
    value = *number;
  else
    return wrong_type(found, field, "a number");
  check_domain(found, value, field);
}

void OptionReader::read(const JobValue& found, std::string& value, const OptionField& field) {
  const std::string* text = found.text();
  if (!text) return wrong_type(found, field, "a text");
  value = *text;
  check_characters(found, value, field);
  if (field.words.empty() || std::find(field.words.begin(), field.words.end(), value) != field.words.end()) return;
  problems_.push_back({FailureCode::invalid_options,
                       found.origin + ": " + key(field) + ": unknown word " + found.literal(),
                       suggestion(value, field.words)});
}

void OptionReader::read(const JobValue& found, std::map<std::string, double>& values, const OptionField& field) {
  const JobValue::Table* members = found.table();
  if (!members) return wrong_type(found, field, "a table of numbers");
  values.clear();
  for (const auto& [name, member] : *members) {
    check_characters(member, name, field);
    read(member, values[name], field);
  }
}

void OptionReader::finish() {
  const JobValue::Table* members = table_ ? table_->table() : nullptr;
  if (!members) return;
  for (const auto& [name, member] : *members)
    if (std::find(known_.begin(), known_.end(), name) == known_.end())
      problems_.push_back({FailureCode::invalid_options,
                           member.origin + ": unknown key '" + name + "' in [" + section_ + "]",
                           known_.empty() ? "remove it" : suggestion(name, known_)});
}

std::optional<Failure> combined(const std::vector<Failure>& problems) {
  if (problems.empty()) return std::nullopt;
  Failure all = problems.front();
  // With several, each remedy stays beside its problem.
  if (problems.size() > 1) {
    all.what = describe(problems.front());
    for (std::size_t i = 1; i < problems.size(); ++i) all.what += "\n" + describe(problems[i]);
    all.remedy = std::to_string(problems.size()) + " problems; each line says what to do";
  }
  return all;
}

}  // namespace strataflow
