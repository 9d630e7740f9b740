#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

namespace strataflow {

namespace fs = std::filesystem;

Result<std::string> read_file(const fs::path& file) {
  const auto unreadable = [&](const std::string& why, const char* remedy) {
    return Failure{FailureCode::unreadable_file, file.string() + ": " + why, remedy};
  };
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe would wait for its writer
  if (descriptor < 0) return unreadable(std::strerror(errno), "check the path and the file's permissions");
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    if (S_ISDIR(status.st_mode)) return unreadable("is a folder, not a file", "name a file inside it");
    return unreadable("is a pipe or a device, not a regular file", "save its content to a file and name that one");
  }
  std::string content;
  if (status.st_size > 0) content.reserve(static_cast<std::size_t>(status.st_size) + 1);
  static constexpr std::size_t chunk = std::size_t{1} << 20;
  for (std::size_t used = 0;;) {
    const std::size_t wanted = content.capacity() > used ? content.capacity() - used : chunk;
    content.resize(used + wanted);
    const ssize_t got = ::read(descriptor, content.data() + used, wanted);
    if (got < 0 && errno == EINTR) {
      content.resize(used);
      continue;
    }
    if (got < 0) {
      const std::string reason = std::strerror(errno);
      ::close(descriptor);
      return unreadable(reason, "check the disk");
    }
    used += static_cast<std::size_t>(got);
    content.resize(used);
    if (got == 0) break;
  }
  ::close(descriptor);
  return content;
}

fs::path scratch_name_beside(const fs::path& path) {
  static std::atomic<unsigned> serial{0};
  fs::path target = path;
  if (!target.has_filename()) target = target.parent_path();
  return target.parent_path() / ("." + target.filename().string() + "." + std::to_string(::getpid()) + "." +
                                 std::to_string(serial++) + ".part");
}

Result<void> write_file_atomically(const fs::path& file, std::string_view content) {
  const auto failed = [&](const std::string& step) {
    return Failure{FailureCode::write_failed, file.string() + ": " + step + ": " + std::strerror(errno),
                   "check free space and permissions"};
  };
  std::error_code ignored;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
  const fs::path part = scratch_name_beside(file);
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0) return failed("cannot create");
  for (std::size_t written = 0; written < content.size();) {
    const ssize_t n = ::write(descriptor, content.data() + written, content.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const Failure failure = failed("cannot write");
      ::close(descriptor);
      ::unlink(part.c_str());
      return failure;
    }
    written += static_cast<std::size_t>(n);
  }
  if (::close(descriptor) != 0 || ::rename(part.c_str(), file.c_str()) != 0) {
    const Failure failure = failed("cannot finish");
    ::unlink(part.c_str());
    return failure;
  }
  return {};
}

Result<void> write_file_atomically(const fs::path& file, std::span<const std::byte> content) {
  return write_file_atomically(file, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

}  // namespace strataflow
