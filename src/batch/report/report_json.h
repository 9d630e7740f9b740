#pragma once
#include <optional>
#include <string>

#include "batch/report/job_report.h"
#include "kernels/hybrid/patch_test.h"
#include "kernels/quality/analyze_triangles.h"

namespace strataflow {

/// report.json (interface.md §3): everything measured, the same bytes for the same job and build on any schedule.
std::string report_json(const JobReport& report);

/// timing.json. `threads` is how many the run could use, `total_s` and `peak_memory_mb` are of the whole run.
std::string timing_json(const JobReport& report, int threads, double total_s, double peak_memory_mb);

/// The `model` block of report.json by itself, as `strataflow check --json` prints it.
std::string model_json(const BuiltModel& built, const ValidityReport& validity);

/// Quality of a mesh file of any cells, and how its patch test went, as `strataflow quality --json` prints it.
std::string volume_quality_json(const std::string& file, const VolumeQualityReport& quality,
                                const std::optional<PatchTestReport>& patch = std::nullopt);

/// Quality of a file of triangles.
std::string triangle_quality_json(const std::string& file, const TriangleQualityReport& quality);

/// Every stage, as `strataflow stages --json` prints it.
std::string stages_json();

}  // namespace strataflow
