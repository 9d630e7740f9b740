#pragma once
#include <string>

#include "batch/report/job_report.h"

namespace strataflow {

/// report.html: what report.json says, for a person. One page that needs nothing else: tables, histograms (SVG) and
/// pictures of the model and the meshes (PNG, drawn here).
std::string report_html(const JobReport& report);

}  // namespace strataflow
