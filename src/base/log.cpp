#include "base/log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <cstdlib>
#include <memory>

namespace strataflow {

namespace {

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug: return spdlog::level::debug;
    case LogLevel::info: return spdlog::level::info;
    case LogLevel::warning: return spdlog::level::warn;
    case LogLevel::error: return spdlog::level::err;
  }
  return spdlog::level::err;
}

struct Sinks {
  std::shared_ptr<spdlog::sinks::stderr_color_sink_mt> screen = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  std::shared_ptr<spdlog::sinks::dist_sink_mt> all = std::make_shared<spdlog::sinks::dist_sink_mt>();
  spdlog::sink_ptr file;
  spdlog::logger logger{"strataflow", all};

  Sinks() {
    if (std::getenv("NO_COLOR")) screen->set_color_mode(spdlog::color_mode::never);
    screen->set_pattern("%^%l%$: %v");
    screen->set_level(spdlog::level::warn);
    all->add_sink(screen);
    logger.set_level(spdlog::level::debug);
    logger.flush_on(spdlog::level::debug);
  }
};

Sinks& sinks() {
  static Sinks instance;
  return instance;
}

}  // namespace

void log_line(LogLevel level, std::string_view message) { sinks().logger.log(level_of(level), message); }

void set_stderr_log_level(LogLevel level) { sinks().screen->set_level(level_of(level)); }

void open_log_file(const std::filesystem::path& file) {
  close_log_file();
  sinks().file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), true);
  sinks().file->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
  sinks().all->add_sink(sinks().file);
}

void close_log_file() {
  if (!sinks().file) return;
  sinks().all->remove_sink(sinks().file);
  sinks().file.reset();
}

}  // namespace strataflow
