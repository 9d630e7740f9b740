#include "progress_printer.h"

#include <algorithm>
#include <cstdio>

#include "terminal.h"

namespace strataflow {

ProgressPrinter::ProgressPrinter(const std::string& mode)
    : mode_(mode == "plain"                          ? Mode::plain
            : mode == "auto" && is_stderr_terminal() ? Mode::moving
                                                     : Mode::none) {}

void ProgressPrinter::redraw(const std::string& node, double ratio) {
  std::string line = std::to_string(finished_) + " done, " + node;
  if (ratio > 0) line += " " + std::to_string(static_cast<int>(100 * ratio)) + " %";
  if (running_.size() > 1) line += " and " + std::to_string(running_.size() - 1) + " more";
  if (line.size() > 78) line.resize(78);
  print_progress("\r\x1b[K" + line);
}

void ProgressPrinter::node_started(NodeId, const StageNode& node) {
  running_.push_back(node.name);
  if (mode_ == Mode::moving) redraw(node.name, 0);
}

void ProgressPrinter::node_progressed(NodeId, const StageNode& node, double ratio) {
  if (mode_ == Mode::moving) redraw(node.name, ratio);
}

void ProgressPrinter::node_finished(NodeId, const StageNode& node, double seconds, bool is_ok, bool is_cached) {
  ++finished_;
  running_.erase(std::remove(running_.begin(), running_.end(), node.name), running_.end());
  if (mode_ == Mode::moving) redraw(running_.empty() ? node.name : running_.front(), 0);
  if (mode_ != Mode::plain) return;
  char time[32];
  std::snprintf(time, sizeof time, "%.3f s", seconds);
  print_progress(node.name + ": " + (!is_ok ? "failed" : is_cached ? "from the store" : time) + "\n");
}

void ProgressPrinter::clear() {
  if (mode_ == Mode::moving) print_progress("\r\x1b[K");
}

}  // namespace strataflow
