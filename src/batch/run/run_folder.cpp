#include "batch/run/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <system_error>

#include "base/atomic_file.h"

namespace strataflow {

namespace fs = std::filesystem;

namespace {

Failure write_failure(const fs::path& path, const std::string& why) {
  return {FailureCode::write_failed, path.string() + ": " + why,
          "check the disk space and the permissions, or use --out"};
}

/// A folder held open under a lock, so that others can tell a run at work from the leftovers of a killed one.
class LockedFolder {
 public:
  explicit LockedFolder(const fs::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    is_locked_ = descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  }
  ~LockedFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;
  bool is_locked() const { return is_locked_; }
  bool sync() const { return ::fsync(descriptor_) == 0; }

 private:
  int descriptor_;
  bool is_locked_ = false;
};

unsigned file_mode_mask() {
  const mode_t mask = ::umask(022);  // there is no way to ask without setting
  ::umask(mask);
  return mask;
}

std::string part_prefix(const fs::path& folder) { return "." + folder.filename().string() + ".part-"; }

/// Moves what is not ours from `old_folder` to `folder`, then removes `old_folder`.
void clear_away(const fs::path& old_folder, const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(old_folder, error)) {
    if (is_run_file(entry.path().filename().string())) continue;
    const fs::path target = folder / entry.path().filename();
    if (!fs::exists(fs::symlink_status(target, error))) fs::rename(entry.path(), target, error);
    if (error) return;  // keep what could not be moved
  }
  fs::remove_all(old_folder, error);
}

constexpr std::string_view aside_ending = ".old";

void clear_leftovers(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(part_prefix(folder))) continue;
    const LockedFolder lock(entry.path());
    if (!lock.is_locked()) continue;
    // Killed between the two renames of replace_by_renames: the old run folder goes back to its place.
    if (name.ends_with(aside_ending) && !fs::exists(folder, error))
      fs::rename(entry.path(), folder, error);
    else
      clear_away(entry.path(), folder);
  }
}

Result<void> write_file(const fs::path& file, const std::vector<std::byte>& content) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return write_failure(file, std::strerror(errno));
  std::size_t written = 0;
  int problem = 0;
  while (written < content.size() && problem == 0) {
    const ssize_t count = ::write(descriptor, content.data() + written, content.size() - written);
    if (count > 0)
      written += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      problem = errno ? errno : EIO;
  }
  if (problem == 0 && ::fsync(descriptor) != 0) problem = errno;
  if (::close(descriptor) != 0 && problem == 0) problem = errno;
  if (problem) return write_failure(file, std::strerror(problem));
  return {};
}

/// Puts the whole `part` in the place of `folder`; an old folder ends where `part` was.
Result<void> exchange(const fs::path& part, const fs::path& folder) {
  if (::rename(part.c_str(), folder.c_str()) == 0) return {};  // nothing there, or an empty folder
  if (::renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) return {};
  if (errno != EINVAL && errno != ENOSYS && errno != EOPNOTSUPP) return write_failure(folder, std::strerror(errno));
  return replace_by_renames(part, folder);
}

}  // namespace

Result<void> replace_by_renames(const fs::path& part, const fs::path& folder) {
  const fs::path aside = part.string() + std::string(aside_ending);
  const LockedFolder lock(folder);  // so that no other run takes it for a leftover in between
  if (::rename(folder.c_str(), aside.c_str()) != 0) return write_failure(folder, std::strerror(errno));
  if (::rename(part.c_str(), folder.c_str()) != 0) {
    const int problem = errno;
    if (::rename(aside.c_str(), folder.c_str()) != 0)
      return write_failure(folder, "its old content is now in " + aside.string());
    return write_failure(folder, std::strerror(problem));
  }
  // What cannot be moved to where part was is cleared away by the next run.
  if (::rename(aside.c_str(), part.c_str()) != 0) clear_away(aside, folder);
  return {};
}

bool is_run_file(std::string_view name) {
  static constexpr std::array<std::string_view, 9> fixed = {
      "report.json",      "timing.json",     "report.html",      "job.toml",    "log.txt",
      "plan_problem.vtp", "frame_field.vtp", "seamless_map.vtp", "quantize.vtp"};
  static constexpr std::array<std::string_view, 9> products = {"model",  "voronoi", "surfaces", "tets",
                                                               "hybrid", "quads",   "hexes",    "frames",
                                                               "complexity"};
  if (std::find(fixed.begin(), fixed.end(), name) != fixed.end()) return true;
  std::string_view stem = name.substr(0, name.find('.'));
  for (const std::string_view ending : {"_facets", "_plan", "_regions", "_singular"})
    if (stem.ends_with(ending)) stem.remove_suffix(ending.size());
  return name.find('.') != std::string_view::npos &&
         std::find(products.begin(), products.end(), stem) != products.end();
}

Result<void> check_run_folder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status))
      return Failure{FailureCode::invalid_usage, folder.string() + " exists and is not a folder",
                     "choose another --out"};
    if (!fs::is_empty(folder, error) && !fs::exists(folder / "report.json", error))
      return Failure{FailureCode::invalid_usage, folder.string() + " holds files and is not a run folder",
                     "choose another --out, so that nothing of yours is replaced"};
  }
  fs::path parent = folder.parent_path();
  while (!parent.empty() && !fs::exists(parent, error) && parent != parent.root_path()) parent = parent.parent_path();
  if (!fs::is_directory(parent, error) || ::access(parent.c_str(), W_OK | X_OK) != 0)
    return write_failure(parent, "the run folder cannot be made here");
  return {};
}

Result<void> replace_run_folder(const fs::path& folder, const std::vector<RunFile>& files) {
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  if (error) return write_failure(folder.parent_path(), error.message());
  clear_leftovers(folder);

  fs::path part;
  std::optional<LockedFolder> lock;
  // Between making the folder and locking it, another run may take it for a leftover: then again.
  while (!lock || !lock->is_locked() || !fs::exists(part, error)) {
    std::string name = (folder.parent_path() / part_prefix(folder)).string() + "XXXXXX";
    if (!::mkdtemp(name.data())) return write_failure(name, std::strerror(errno));
    part = name;
    lock.emplace(part);
  }
  fs::permissions(part, fs::perms::all & ~fs::perms(file_mode_mask()), error);  // mkdtemp makes private folders

  Result<void> written;
  for (const RunFile& file : files)
    if (written) written = write_file(part / file.name, file.content);
  if (written && !lock->sync()) written = write_failure(part, std::strerror(errno));
  if (written) written = exchange(part, folder);
  if (!written) {
    fs::remove_all(part, error);
    return written;
  }
  if (fs::exists(part, error)) clear_away(part, folder);
  return {};
}

void remove_run_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error)) || !fs::exists(folder / "report.json", error)) return;
  std::vector<fs::path> ours;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (is_run_file(entry.path().filename().string())) ours.push_back(entry.path());
  for (const fs::path& file : ours) fs::remove(file, error);
  fs::remove(folder, error);  // if it is empty now
}

}  // namespace strataflow
