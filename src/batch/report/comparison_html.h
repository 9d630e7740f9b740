#pragma once
#include <string>
#include <vector>

#include "batch/report/job_report.h"

namespace strataflow {

/// Several jobs of one batch side by side, as one self-contained page: a row per job for the remeshed surfaces, the
/// tetrahedra and the complexity of those that made them, and a plot of Q10, Q50 and Q90 of the elements per cell
/// (pellerin2014 Table 3.4). Deterministic: no times, paths or thread counts.
std::string comparison_html(const std::vector<JobReport>& reports);

}  // namespace strataflow
