#pragma once
#include <filesystem>
#include <string_view>

namespace strataflow {

enum class LogLevel { debug, info, warning, error };

/// One line to the log (stderr and, once opened, the run's log file). Safe from any thread; never stdout.
void log_line(LogLevel level, std::string_view message);

/// Lines below `level` are not shown on stderr. The file gets everything.
void set_stderr_log_level(LogLevel level);

/// From now on lines also go to `file`, replacing what it held.
void open_log_file(const std::filesystem::path& file);
void close_log_file();

}  // namespace strataflow
