#pragma once
#include <nlohmann/json.hpp>

#include "kernels/complexity/measure_complexity.h"

namespace strataflow {

/// The `complexity` block of report.json (interface.md §3).
nlohmann::ordered_json complexity_json(const ComplexityReport& report);

}  // namespace strataflow
