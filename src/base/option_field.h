#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/digest.h"

namespace strataflow {

/// What is known about one option besides its type and default. An options aggregate lists its fields once:
///
///   struct RemeshOptions {
///     double target_edge_length_m = 50.0;  ///< metres, > 0
///     template <class Visitor>
///     void visit_fields(Visitor& visit) {
///       visit(target_edge_length_m, OptionField{.name = "target_edge_length_m", .description = "…", .minimum = 0,
///                                               .exclusive_minimum = true});
///     }
///   };
///
/// That one list feeds the job parser, `strataflow stages`, docs/stages.md and the digest. Field types: bool,
/// std::int64_t, double, std::string, std::optional of these, std::vector of int64/double/string, and
/// std::map<std::string, double> (a TOML table).
struct OptionField {
  std::string_view name;                                      ///< snake_case, with its unit suffix
  std::string_view description;                               ///< one sentence, without the final full stop
  double minimum = -std::numeric_limits<double>::infinity();  ///< numbers: smallest allowed value
  double maximum = std::numeric_limits<double>::infinity();   ///< numbers: largest allowed value
  bool exclusive_minimum = false;                             ///< `minimum` itself is not allowed
  std::vector<std::string_view> words = {};                   ///< texts: the allowed words; empty means any
  bool is_internal = false;  ///< follows from other options: part of the digest, but no key and not documented
};

/// One canonical line "name = value" per field, as TOML writes it; an absent optional is left out.
class OptionPrinter {
 public:
  template <class T>
  void operator()(const T& value, const OptionField& field) {
    print(field.name, value);
  }
  const std::string& text() const { return text_; }

  static std::string literal(bool value) { return value ? "true" : "false"; }
  static std::string literal(std::int64_t value) { return std::to_string(value); }
  static std::string literal(double value);
  static std::string literal(const std::string& value);
  template <class T>
  static std::string literal(const std::vector<T>& values) {
    std::string text = "[";
    for (std::size_t i = 0; i < values.size(); ++i) text += (i ? ", " : "") + literal(values[i]);
    return text + "]";
  }
  static std::string literal(const std::map<std::string, double>& values);

 private:
  template <class T>
  void print(std::string_view name, const T& value) {
    text_ += std::string(name) + " = " + literal(value) + "\n";
  }
  template <class T>
  void print(std::string_view name, const std::optional<T>& value) {
    if (value) print(name, *value);
  }
  std::string text_;
};

/// The fields of `options`, one canonical line each.
template <class Options>
std::string printed_options(const Options& options) {
  OptionPrinter printer;
  const_cast<Options&>(options).visit_fields(printer);  // one list serves reading and writing
  return printer.text();
}

/// Options of a stage that has none.
struct NoOptions {
  template <class Visitor>
  void visit_fields(Visitor&) {}
};

}  // namespace strataflow
