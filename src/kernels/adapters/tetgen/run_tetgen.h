#pragma once
#include <filesystem>
#include <string>

#include "base/cancellation.h"
#include "base/result.h"
#include "kernels/adapters/tetgen/tetgen_exchange.h"

namespace strataflow {

/// How one call of TetGen ended, and its mesh when it ended well.
struct TetgenOutcome {
  enum class End { finished, refused, crashed };
  End end = End::crashed;
  std::string reason;       ///< why it was refused or crashed, in words
  TetgenResponse response;  ///< every index in range when finished
};

/// Runs one `request` in a process of its own: `worker`, tools/tet_worker. TetGen keeps predicate bounds in file
/// statics and its package aborts on failed asserts, so a crash there costs one attempt, not the batch.
/// Safe to call from several threads at once. Fails with timed_out, cancelled, or geometry_failed when the worker
/// program is missing or was killed from outside; an attempt that TetGen refuses or dies of is an outcome.
Result<TetgenOutcome> run_tetgen(const std::filesystem::path& worker, const TetgenRequest& request, double timeout_s,
                                 const CancellationToken* cancellation);

}  // namespace strataflow
