// Runs TetGen once: a TetgenRequest on standard input, a TetgenResponse on standard output. TetGen aborts on failed
// assertions, prints, and cannot run twice in one process, so the main program starts one of these per call.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <vector>

#include "base/archive.h"
#include "kernels/adapters/tetgen/call_tetgen.h"

namespace {

constexpr int exit_bad_request = 64, exit_cannot_answer = 74;

std::vector<std::byte> read_all(int file) {
  std::vector<std::byte> bytes;
  std::array<std::byte, 65536> buffer;
  for (;;) {
    const ssize_t n = ::read(file, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.insert(bytes.end(), buffer.data(), buffer.data() + n);
  }
}

bool write_all(int file, const std::vector<std::byte>& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = ::write(file, bytes.data() + sent, bytes.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    sent += static_cast<std::size_t>(n);
  }
  return true;
}

/// Addresses taken before any work: nothing to speak of, but terabytes of shadow under the address sanitizer.
rlim_t bytes_at_start() {
  rlim_t pages = 0;
#if defined(__SANITIZE_ADDRESS__)
  std::ifstream("/proc/self/statm") >> pages;
#endif
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// Crashes are expected: no core files, and no more memory than allowed.
void limit_resources(std::uint64_t memory_limit_mb) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (memory_limit_mb == 0 || memory_limit_mb >= RLIM_INFINITY >> 20) return;
  const rlim_t bytes = bytes_at_start() + (static_cast<rlim_t>(memory_limit_mb) << 20);
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__)
/// At the limit, malloc answers as it does without the sanitizer, whose own report would need memory, and hangs.
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }
#endif

int main() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // TetGen prints to stdout even when told to be quiet; the answer has a descriptor of its own.
  const int answer = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (answer < 0 || nowhere < 0) return exit_cannot_answer;
  ::dup2(nowhere, STDOUT_FILENO);
  const auto request = strataflow::unarchived<strataflow::TetgenRequest>(read_all(STDIN_FILENO));
  if (!request) return exit_bad_request;
  limit_resources(request->memory_limit_mb);
  return write_all(answer, strataflow::archived(strataflow::call_tetgen(*request))) ? 0 : exit_cannot_answer;
}
