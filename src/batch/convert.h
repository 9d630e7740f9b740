#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"
#include "model/structural_model.h"

namespace strataflow {

/// The endings that something can be written as, for messages: ".ml, .ts, …".
std::string writable_endings();

/// The whole input in the format of that ending (".vtp"): surfaces, or cells for formats of cells. A .ml is built into
/// a model first. Fails with unsupported (ending, or nothing in the input that the format holds).
Result<std::string> encode_input(const InputData& input, std::string_view ending, const std::string& name);

/// A model in the format of that ending. Fails with unsupported.
Result<std::string> encode_model(const StructuralModel& model, std::string_view ending, const std::string& name);

/// The ending of a path, in lower case, with its dot.
std::string ending_of(const std::filesystem::path& path);

}  // namespace strataflow
