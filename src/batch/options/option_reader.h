#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/failure.h"
#include "base/option_field.h"
#include "batch/options/job_value.h"

namespace strataflow {

/// Fills an options aggregate from one table of a job file; hand it to `visit_fields`. Fields the table does not name
/// keep their defaults. Every wrong type, value out of its domain and (in `finish`) unknown key is added to
/// `problems` with its file:line, so that a person sees all of them at once.
class OptionReader {
 public:
  /// `section` is the table's name in messages; a null `table` has no keys.
  OptionReader(const JobValue* table, std::string section, std::vector<Failure>& problems)
      : table_(table), section_(std::move(section)), problems_(problems) {}

  template <class T>
  void operator()(T& value, const OptionField& field) {
    if (field.is_internal) return;
    known_.push_back(field.name);
    if (const JobValue* found = table_ ? table_->find(field.name) : nullptr) read(*found, value, field);
  }
  /// Complains about the keys that no field has taken.
  void finish();

 private:
  void read(const JobValue& found, bool& value, const OptionField& field);
  void read(const JobValue& found, std::int64_t& value, const OptionField& field);
  void read(const JobValue& found, double& value, const OptionField& field);
  void read(const JobValue& found, std::string& value, const OptionField& field);
  void read(const JobValue& found, std::map<std::string, double>& values, const OptionField& field);
  template <class T>
  void read(const JobValue& found, std::optional<T>& value, const OptionField& field) {
    read(found, value.emplace(), field);
  }
  template <class T>
  void read(const JobValue& found, std::vector<T>& values, const OptionField& field) {
    const JobValue::Array* items = found.array();
    if (!items) return wrong_type(found, field, "a list");
    values.clear();
    for (const JobValue& item : *items) read(item, values.emplace_back(), field);
  }
  void wrong_type(const JobValue& found, const OptionField& field, std::string_view wanted);
  void check_domain(const JobValue& found, double value, const OptionField& field);
  /// Line breaks and the like would break messages, file names and the resolved job.
  void check_characters(const JobValue& found, const std::string& text, const OptionField& field);
  std::string key(const OptionField& field) const;

  const JobValue* table_;
  std::string section_;
  std::vector<Failure>& problems_;
  std::vector<std::string_view> known_;
};

/// Several problems as one failure, in the order found; nothing when there is none.
std::optional<Failure> combined(const std::vector<Failure>& problems);

}  // namespace strataflow
