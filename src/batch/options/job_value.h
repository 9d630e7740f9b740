#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace strataflow {

/// One value of a job file, with the place it was written at, so that every later complaint can name it.
struct JobValue {
  using Array = std::vector<JobValue>;
  using Table = std::vector<std::pair<std::string, JobValue>>;  ///< in the order of the keys' bytes

  std::string origin;  ///< "cloudspin.toml:12" or "--set remesh.sites=5"
  std::variant<bool, std::int64_t, double, std::string, Array, Table> value = Table{};

  const Table* table() const { return std::get_if<Table>(&value); }
  Table* table() { return std::get_if<Table>(&value); }
  const Array* array() const { return std::get_if<Array>(&value); }
  const std::string* text() const { return std::get_if<std::string>(&value); }

  /// The member `key` of a table, or nullptr.
  const JobValue* find(std::string_view key) const;
  JobValue* find(std::string_view key) { return const_cast<JobValue*>(std::as_const(*this).find(key)); }
  /// Sets `path` ("remesh.sites"), making the tables on the way. False if something on the way is not a table.
  bool set(std::string_view path, const JobValue& new_value);
  /// "a whole number", "a text" …: the type, as told to a person.
  std::string_view kind() const;
  /// The value as TOML writes it, on one line.
  std::string literal() const;
};

}  // namespace strataflow
