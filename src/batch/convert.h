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

/// Fails with invalid_usage when the file's ending is none of these.
Result<void> can_write(const std::filesystem::path& file);

/// The whole input in the format of that ending (".vtp"): surfaces, or cells for formats of cells. A .ml is built into
/// a model first. Fails with unsupported (ending, or nothing in the input that the format holds).
Result<std::string> encode_input(const InputData& input, std::string_view ending, const std::string& name);

/// A model in the format of that ending. Fails with unsupported.
Result<std::string> encode_model(const StructuralModel& model, std::string_view ending, const std::string& name);

/// Writes a model, or a whole input, by the file's ending; also native model files (.sfm). Fails as the above do, and
/// with write_failed. `name` is what the file calls its content.
Result<void> write_model(const std::filesystem::path& file, const StructuralModel& model);
Result<void> write_input(const std::filesystem::path& file, const InputData& input, const std::string& name);

/// What `encode_input` leaves out because the format cannot hold it: "12 lines, 3 point sets"; empty for nothing.
std::string left_out(const InputData& input, std::string_view ending);

/// The ending of a path, in lower case, with its dot.
std::string ending_of(const std::filesystem::path& path);

}  // namespace strataflow
