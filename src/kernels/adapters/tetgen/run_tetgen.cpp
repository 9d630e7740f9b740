#include "kernels/adapters/tetgen/run_tetgen.h"

#include <csignal>
#include <cstring>

#include "base/archive.h"
#include "base/child_process.h"

namespace strataflow {

namespace {

std::string words_for(std::int32_t error) {
  switch (error) {
    case 1:
      return "TetGen ran out of memory";
    case 2:
      return "TetGen met a bug of its own";
    case 3:
      return "TetGen says that two facets cross";
    case 4:
      return "TetGen says that a feature is smaller than its tolerance";
    case 5:
      return "TetGen says that two facets nearly coincide";
    case 10:
      return "TetGen refused the input";
    default:
      return "TetGen stopped with error " + std::to_string(error);
  }
}

/// Nothing in the answer of a program that may have been corrupted is believed.
bool is_consistent(const TetgenRequest& request, const TetgenResponse& response) {
  const std::size_t points = response.points.size();
  if (points < request.points.size() || response.subfaces.size() != response.subface_facet.size()) return false;
  for (const Vec3& point : response.points)
    if (!is_finite(point)) return false;
  for (const auto& tet : response.tets)
    for (const std::uint32_t vertex : tet)
      if (vertex >= points) return false;
  for (const Triangle& subface : response.subfaces)
    for (const std::uint32_t vertex : subface)
      if (vertex >= points) return false;
  for (const std::uint32_t facet : response.subface_facet)
    if (facet >= request.facets.size()) return false;
  return true;
}

}  // namespace

Result<TetgenOutcome> run_tetgen(const std::filesystem::path& worker, const TetgenRequest& request, double timeout_s,
                                 const CancellationToken* cancellation) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(worker, error))
    return Failure{FailureCode::geometry_failed, "the worker program " + worker.filename().string() + " is missing",
                   "reinstall strataflow: tet_worker belongs beside the main program"};
  const Result<ChildOutcome> child = run_child_process(worker, {}, archived(request), timeout_s, cancellation);
  if (!child) return child.failure();
  if (child->cancelled) return Failure{FailureCode::cancelled, "TetGen was stopped", "run it again"};
  if (child->timed_out)
    return Failure{FailureCode::timed_out, "TetGen took longer than timeout_s",
                   "raise timeout_s, or simplify the surfaces"};
  if (child->signal == SIGKILL)  // from outside, mostly the system when memory runs out: says nothing about the input
    return Failure{FailureCode::geometry_failed, "the TetGen worker was killed from outside",
                   "free memory, or use fewer threads"};
  TetgenOutcome outcome;
  if (child->signal != 0) {
    outcome.reason = std::string("TetGen died: ") + ::strsignal(child->signal);
    return outcome;
  }
  auto response = unarchived<TetgenResponse>(child->output);
  if (child->exit_code != 0 || !response || (response->error == 0 && !is_consistent(request, *response))) {
    outcome.reason = "the worker gave no usable answer (exit code " + std::to_string(child->exit_code) + ")";
    return outcome;
  }
  outcome.end = response->error == 0 ? TetgenOutcome::End::finished : TetgenOutcome::End::refused;
  if (response->error != 0) outcome.reason = words_for(response->error);
  outcome.response = std::move(*response);
  return outcome;
}

}  // namespace strataflow
