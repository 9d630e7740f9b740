#include "batch/report/report_json.h"
#include "commands.h"
#include "stages/all_stages.h"
#include "terminal.h"

namespace strataflow {

namespace {

std::string stages_as_text() {
  std::string text;
  for (const StageDescription& stage : all_stages()) {
    std::string inputs;
    for (const std::string& input : stage.inputs) inputs += (inputs.empty() ? "" : ", ") + input;
    text += stage.name + " (version " + std::to_string(stage.version) + "): " + (inputs.empty() ? "nothing" : inputs) +
            " → " + stage.output + "\n  " + stage.summary + "\n";
    for (const OptionDescription& option : stage.options)
      text += "  " + stage.section + " " + option.name + " = " +
              (option.default_value.empty() ? "(absent)" : option.default_value) +
              (option.domain.empty() ? "" : ", " + option.domain) + (option.unit.empty() ? "" : ", " + option.unit) +
              ": " + option.description + "\n";
    text += "\n";
  }
  return text;
}

}  // namespace

int stages_command(const StagesArguments& arguments) {
  return print_result(arguments.json ? stages_json() : arguments.markdown ? stages_as_markdown() : stages_as_text());
}

}  // namespace strataflow
