#include "base/log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

#include <sstream>

namespace strataflow {

struct RunLog::Sink {
  std::ostringstream stream;
  std::shared_ptr<spdlog::sinks::ostream_sink_st> sink = std::make_shared<spdlog::sinks::ostream_sink_st>(stream);
  spdlog::logger logger{"run", sink};
};

RunLog::RunLog() : sink_(std::make_unique<Sink>()) {}
RunLog::~RunLog() = default;

void RunLog::line(LogLevel level, std::string_view message) {
  sink_->logger.set_pattern(level == LogLevel::info ? "%v" : "    %l: %v");
  sink_->logger.log(level == LogLevel::info      ? spdlog::level::info
                    : level == LogLevel::warning ? spdlog::level::warn
                                                 : spdlog::level::err,
                    "{}", message);
}

std::string RunLog::text() const {
  sink_->logger.flush();
  return sink_->stream.str();
}

}  // namespace strataflow
