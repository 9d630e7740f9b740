#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "batch/options/job_value.h"

namespace strataflow {

/// Parses the text of a job file (TOML). `name` is what messages call the file. Duplicate keys, dates and broken
/// syntax fail with invalid_usage, naming file:line.
Result<JobValue> parse_job_text(std::string_view text, const std::string& name);

/// The value of a command-line setting "remesh.sites=5000": TOML where it parses as TOML, a text otherwise.
/// The origin is the setting itself.
JobValue parse_setting_value(std::string_view text, const std::string& setting);

}  // namespace strataflow
