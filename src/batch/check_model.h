#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/warning.h"
#include "model/built_model.h"
#include "model/input_data.h"

namespace strataflow {

/// A model read from files, built and judged, without a graph or a store.
struct CheckedModel {
  BuiltModel built;
  ValidityReport validity;
  std::vector<Warning> warnings;  ///< of the readers
};

/// Reads files side by side and puts them together, near the origin. Fails as read_input does.
Result<InputData> read_inputs(const std::vector<std::filesystem::path>& files);

/// The files form one model. Fails as read_input and build_structural_model do; a model that is not valid is a result.
Result<CheckedModel> check_model(const std::vector<std::filesystem::path>& files);

/// What is in the model and every violation, for a person.
std::string model_text(const CheckedModel& checked);

}  // namespace strataflow
