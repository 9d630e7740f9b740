#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/cancellation.h"
#include "base/internal_error.h"
#include "base/warning.h"

namespace strataflow {

/// What a stage knows about its run besides its inputs and options. Belongs to one node; not to be shared by the items
/// of a parallel loop, except `is_cancelled`.
class StageContext {
 public:
  using ProgressCall = std::function<void(double ratio)>;

  explicit StageContext(std::string node_name = "", std::optional<std::uint64_t> seed = {},
                        const CancellationToken* cancellation = nullptr, ProgressCall progress = {})
      : node_name_(std::move(node_name)), seed_(seed), cancellation_(cancellation), progress_(std::move(progress)) {}

  const std::string& node_name() const { return node_name_; }
  /// The node's own random stream. Only for stages that declare `uses_seed`: otherwise it is not part of their key.
  std::uint64_t seed() const {
    STRATAFLOW_ASSERT(seed_.has_value(), node_name_ + " draws random numbers but does not declare uses_seed");
    return *seed_;
  }
  bool is_cancelled() const { return cancellation_ && cancellation_->is_cancelled(); }
  /// To hand on to child processes; null when nobody can cancel.
  const CancellationToken* cancellation() const { return cancellation_; }
  /// `ratio` in [0, 1] of the node's work is done.
  void report_progress(double ratio) const {
    if (progress_) progress_(ratio);
  }
  /// Adds a warning to the output: it is reported now and whenever the output is taken from the store.
  void warn(std::string kind, std::string what) { warnings_.push_back({std::move(kind), std::move(what)}); }
  void warn(std::vector<Warning> warnings) {
    for (Warning& warning : warnings) warnings_.push_back(std::move(warning));
  }
  const std::vector<Warning>& warnings() const { return warnings_; }

 private:
  std::string node_name_;
  std::optional<std::uint64_t> seed_;
  const CancellationToken* cancellation_;
  ProgressCall progress_;
  std::vector<Warning> warnings_;
};

}  // namespace strataflow
