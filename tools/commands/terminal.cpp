#include "terminal.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace strataflow {

namespace {

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

std::string coloured(std::string_view code, std::string_view text) {
  const char* no_color = std::getenv("NO_COLOR");
  if (!is_stderr_terminal() || (no_color && *no_color)) return std::string(text);
  return "\x1b[" + std::string(code) + "m" + std::string(text) + "\x1b[0m";
}

}  // namespace

int print_result(std::string_view text) {
  if (write_all(STDOUT_FILENO, text) || errno == EPIPE) return 0;
  return report_failure({FailureCode::write_failed, std::string("standard output: ") + std::strerror(errno),
                         "check where the output goes"});
}

void print_progress(std::string_view text) { (void)write_all(STDERR_FILENO, text); }

bool is_stderr_terminal() { return ::isatty(STDERR_FILENO) == 1; }

int exit_code_of(FailureCode code) {
  switch (code) {
    case FailureCode::invalid_usage:
    case FailureCode::invalid_options:
      return 2;
    case FailureCode::internal_error:
      return 70;
    default:
      return 1;
  }
}

int report_failure(const Failure& failure) {
  std::string text = coloured("1;31", "error") + ": " + failure.what + "\n";
  if (!failure.remedy.empty()) text += "  " + coloured("1;36", "what to do") + ": " + failure.remedy + "\n";
  print_progress(text);
  return exit_code_of(failure.code);
}

void report_warning(std::string_view text) {
  print_progress(coloured("1;33", "warning") + ": " + std::string(text) + "\n");
}

}  // namespace strataflow
