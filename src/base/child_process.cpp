#include "base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

namespace strataflow {

namespace {

struct Channel {
  std::array<int, 2> ends{-1, -1};
  /// A socket pair, so that writing to a child that died is an error code and not SIGPIPE.
  bool open() { return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0; }
  void close(int side) {
    if (ends[side] >= 0) ::close(ends[side]);
    ends[side] = -1;
  }
  ~Channel() {
    close(0);
    close(1);
  }
};

Failure cannot_start(const std::filesystem::path& program, int error) {
  return {FailureCode::internal_error, "cannot start " + program.string() + ": " + std::strerror(error),
          "reinstall strataflow: the worker belongs beside the main program"};
}

}  // namespace

Result<ChildOutcome> run_child_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                       std::span<const std::byte> input, double timeout_s,
                                       const CancellationToken* cancellation) {
  Channel to_child, from_child;
  if (!to_child.open() || !from_child.open()) return cannot_start(program, errno);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to_child.ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from_child.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = -1;
  const int spawn_error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (spawn_error != 0) return cannot_start(program, spawn_error);
  to_child.close(0);
  from_child.close(1);
  ::fcntl(to_child.ends[1], F_SETFL, O_NONBLOCK);
  ::fcntl(from_child.ends[0], F_SETFL, O_NONBLOCK);

  ChildOutcome outcome;
  using Clock = std::chrono::steady_clock;
  constexpr double longest_s = 1e9;  // thirty years; a longer limit would not fit the clock's nanoseconds
  const std::chrono::duration<double> limit(std::min(timeout_s, longest_s));
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  const auto must_end = [&] {
    if (cancellation && cancellation->is_cancelled()) outcome.cancelled = true;
    if (Clock::now() >= deadline) outcome.timed_out = true;
    if (outcome.cancelled || outcome.timed_out) ::kill(child, SIGKILL);
    return outcome.cancelled || outcome.timed_out;
  };
  std::size_t sent = 0;
  if (input.empty()) to_child.close(1);
  std::array<std::byte, 65536> buffer;
  for (bool reading = true; reading;) {
    if (must_end()) break;
    std::array<pollfd, 2> waiting{{{from_child.ends[0], POLLIN, 0}, {to_child.ends[1], POLLOUT, 0}}};
    if (::poll(waiting.data(), to_child.ends[1] >= 0 ? 2 : 1, 100) < 0 && errno != EINTR) {
      ::kill(child, SIGKILL);  // nobody would read its answer
      break;
    }
    if (to_child.ends[1] >= 0 && waiting[1].revents != 0) {
      const ssize_t n = ::send(to_child.ends[1], input.data() + sent, input.size() - sent, MSG_NOSIGNAL);
      if (n > 0) sent += static_cast<std::size_t>(n);
      // A child that died early closes its end; what it did write still counts, so only the writing stops.
      if ((n < 0 && errno != EAGAIN && errno != EINTR) || sent == input.size()) to_child.close(1);
    }
    if (waiting[0].revents != 0) {
      const ssize_t n = ::read(from_child.ends[0], buffer.data(), buffer.size());
      if (n > 0) outcome.output.insert(outcome.output.end(), buffer.data(), buffer.data() + n);
      if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) reading = false;
    }
  }
  // A closed output is not yet the end of a child. The pauses grow, so that a quick end is seen quickly.
  int status = 0;
  bool is_killed = outcome.cancelled || outcome.timed_out;
  std::chrono::microseconds pause(50);
  while (true) {
    const pid_t ended = ::waitpid(child, &status, is_killed ? 0 : WNOHANG);
    if (ended > 0 || (ended < 0 && errno != EINTR)) break;
    if (is_killed || (is_killed = must_end())) continue;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(20000));
  }
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  return outcome;
}

std::filesystem::path program_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

}  // namespace strataflow
