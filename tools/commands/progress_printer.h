#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "graph/run_graph.h"

namespace strataflow {

/// Shows on standard error what a run is doing: one moving line on a terminal, one line per finished stage when plain.
class ProgressPrinter : public ProgressSink {
 public:
  /// `mode`: auto (moving line on a terminal, otherwise nothing), plain, none.
  explicit ProgressPrinter(const std::string& mode);
  void node_started(NodeId id, const StageNode& node) override;
  void node_progressed(NodeId id, const StageNode& node, double ratio) override;
  void node_finished(NodeId id, const StageNode& node, double seconds, bool is_ok, bool is_cached) override;
  /// Removes the moving line.
  void clear();

 private:
  enum class Mode { none, plain, moving };
  void redraw(const std::string& node, double ratio);

  Mode mode_;
  std::size_t finished_ = 0;
  std::vector<std::string> running_;
};

}  // namespace strataflow
