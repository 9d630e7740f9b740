#pragma once
#include <memory>
#include <string>
#include <string_view>

namespace strataflow {

enum class LogLevel { info, warning, error };

/// The log of one run, kept in memory until the run folder is written: library code never prints, what it has to say
/// travels as data. Not thread-safe.
class RunLog {
 public:
  RunLog();
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Adds one line, which starts with its level unless that is info.
  void line(LogLevel level, std::string_view message);
  std::string text() const;

 private:
  struct Sink;
  std::unique_ptr<Sink> sink_;
};

}  // namespace strataflow
