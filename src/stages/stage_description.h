#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/option_field.h"
#include "graph/stage_signature.h"

namespace strataflow {

/// One option of a stage, as documentation shows it.
struct OptionDescription {
  std::string name;
  std::string type;           ///< "number", "whole number", "text" …
  std::string unit;           ///< from the name's suffix; empty without one
  std::string default_value;  ///< as TOML writes it; empty when absent by default
  std::string domain;         ///< "> 0", "auto | never"; empty when everything is allowed
  std::string description;
};

/// Lists the fields of an options aggregate that a job file can set; hand it to `visit_fields`.
class OptionDescriber {
 public:
  template <class T>
  void operator()(const T& value, const OptionField& field) {
    if (field.is_internal) return;
    OptionDescription& option = options_.emplace_back(describe(field));
    option.type = type_word(value);
    OptionPrinter printer;
    printer(value, field);
    // The printer writes "name = value\n", or nothing for an absent optional.
    if (!printer.text().empty())
      option.default_value =
          printer.text().substr(field.name.size() + 3, printer.text().size() - field.name.size() - 4);
  }
  std::vector<OptionDescription> take() { return std::move(options_); }

 private:
  static OptionDescription describe(const OptionField& field);
  static std::string type_word(bool) { return "true or false"; }
  static std::string type_word(std::int64_t) { return "whole number"; }
  static std::string type_word(double) { return "number"; }
  static std::string type_word(const std::string&) { return "text"; }
  static std::string type_word(const std::map<std::string, double>&) { return "table of numbers"; }
  template <class T>
  static std::string type_word(const std::optional<T>&) {
    return type_word(T{});
  }
  template <class T>
  static std::string type_word(const std::vector<T>&) {
    return "list of " + type_word(T{}) + "s";
  }
  std::vector<OptionDescription> options_;
};

/// A stage as `strataflow stages` shows it.
struct StageDescription {
  std::string name;
  std::string summary;
  std::vector<std::string> inputs;  ///< "structural model"; "input data …" for any number
  std::string output;
  int version = 0;
  bool uses_seed = false;
  std::string section;  ///< of the job file, that sets its options
  std::vector<OptionDescription> options;
};

/// How a type of data is called in documentation: specialised in all_stages.cpp for every type that flows.
template <class T>
struct DataName;

template <class Wire>
struct WireName;
template <class T>
struct WireName<Port<T>> {
  static std::string text() { return std::string(DataName<T>::text); }
};
template <class T>
struct WireName<std::vector<Port<T>>> {
  static std::string text() { return std::string(DataName<T>::text) + " …"; }
};

template <class Signature>
struct InputNames;
template <class Output, class... Parameters>
struct InputNames<SignatureWithInputs<Output, std::tuple<Parameters...>>> {
  static std::vector<std::string> texts() { return {WireName<typename InputOf<Parameters>::Wire>::text()...}; }
};

template <class Stage>
StageDescription describe_stage(std::string summary, std::string section) {
  using Signature = StageSignature<Stage>;
  StageDescription description;
  description.name = Stage::name;
  description.summary = std::move(summary);
  description.section = std::move(section);
  description.version = Stage::version;
  description.uses_seed = uses_seed<Stage>();
  description.output = DataName<typename Signature::Output>::text;
  description.inputs = InputNames<Signature>::texts();
  decltype(Stage::options) options{};
  OptionDescriber describer;
  options.visit_fields(describer);
  description.options = describer.take();
  return description;
}

}  // namespace strataflow
