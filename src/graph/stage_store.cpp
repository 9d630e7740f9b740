#include "graph/stage_store.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <string>

#include "base/archive.h"

namespace strataflow {

namespace fs = std::filesystem;

namespace {

// An entry is: EntryStart, header (archived), digest of both, payload. The file ends with the payload.
struct EntryStart {
  std::array<char, 8> magic{'S', 'F', 'S', 'T', 'O', 'R', 'E', '\n'};
  std::uint32_t format = stage_store_format;
  std::uint32_t header_bytes = 0;
  static constexpr bool is_flat = true;
};
constexpr std::size_t checksum_bytes = 16;
constexpr std::uint32_t longest_header = 1u << 30;

struct EntryHeader {
  Digest key;
  StoredOutput output;
  template <class A>
  void archive(A& a) {
    a(key.high, key.low, output.digest.high, output.digest.low, output.payload_bytes, output.warnings);
  }
};

std::vector<std::byte> start_and_header(const EntryHeader& header) {
  EntryStart start;
  start.header_bytes = static_cast<std::uint32_t>(archived(header).size());
  ArchiveWriter writer;
  writer(start, header);
  const Digest checksum = digest_of(writer.bytes());
  writer(checksum.high, checksum.low);
  return writer.take();
}

class File {
 public:
  File(const fs::path& path, int flags) : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  bool close() {
    const bool is_ok = descriptor_ < 0 || ::close(descriptor_) == 0;
    descriptor_ = -1;
    return is_ok;
  }
  std::uint64_t size() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
  }
  bool read_at(std::uint64_t offset, std::span<std::byte> target) const {
    for (std::size_t done = 0; done < target.size();) {
      const ssize_t n =
          ::pread(descriptor_, target.data() + done, target.size() - done, static_cast<off_t>(offset + done));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      done += static_cast<std::size_t>(n);
    }
    return true;
  }
  /// One after the other, without joining them in memory.
  bool write(std::span<const std::byte> first, std::span<const std::byte> second) const {
    while (!first.empty() || !second.empty()) {
      const std::array<iovec, 2> parts{iovec{const_cast<std::byte*>(first.data()), first.size()},
                                       iovec{const_cast<std::byte*>(second.data()), second.size()}};
      const ssize_t n = ::writev(descriptor_, parts.data(), 2);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return false;
      const std::size_t from_first = std::min(first.size(), static_cast<std::size_t>(n));
      first = first.subspan(from_first);
      second = second.subspan(static_cast<std::size_t>(n) - from_first);
    }
    return true;
  }
  void mark_as_used() const { ::futimens(descriptor_, nullptr); }

 private:
  int descriptor_;
};

/// The header of a whole entry for `key`; nothing when anything about it is wrong. `payload_start` gets its position.
std::optional<EntryHeader> read_header(const File& file, const Digest& key, std::uint64_t& payload_start) {
  const std::uint64_t file_bytes = file.size();
  std::vector<std::byte> bytes(sizeof(EntryStart));
  if (file_bytes < bytes.size() || !file.read_at(0, bytes)) return std::nullopt;
  const auto start = unarchived<EntryStart>(bytes);
  if (!start || start->magic != EntryStart{}.magic || start->format != stage_store_format ||
      start->header_bytes > std::min<std::uint64_t>(file_bytes, longest_header))
    return std::nullopt;
  const std::size_t checked = sizeof(EntryStart) + start->header_bytes;
  payload_start = checked + checksum_bytes;
  if (payload_start > file_bytes) return std::nullopt;
  bytes.resize(payload_start);
  if (!file.read_at(0, bytes)) return std::nullopt;
  Digest checksum;
  std::memcpy(&checksum.high, bytes.data() + checked, 8);
  std::memcpy(&checksum.low, bytes.data() + checked + 8, 8);
  if (digest_of(std::span(bytes).first(checked)) != checksum) return std::nullopt;
  auto header = unarchived<EntryHeader>(std::span(bytes).subspan(sizeof(EntryStart), start->header_bytes));
  if (!header || header->key != key || header->output.payload_bytes != file_bytes - payload_start) return std::nullopt;
  return header;
}

bool is_hex_name(const std::string& name, std::size_t length) {
  return name.size() == length && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// The entries of a folder that are called like ours, whatever vanishes meanwhile.
template <class Visit>
void for_each_named(const fs::path& folder, std::size_t name_length, Visit visit) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (is_hex_name(it->path().filename().string(), name_length)) visit(it->path());
}

/// The process that writes "<key>.<pid>.<serial>.part"; 0 when the name is not of that form.
pid_t owner_of(const std::string& part_name) {
  const std::size_t dot = part_name.find('.');
  if (dot == std::string::npos) return 0;
  pid_t owner = 0;
  const auto [end, error] = std::from_chars(part_name.data() + dot + 1, part_name.data() + part_name.size(), owner);
  return error == std::errc{} && *end == '.' && owner > 0 ? owner : 0;
}

}  // namespace

StageStore::StageStore(fs::path folder, std::uint64_t limit_bytes)
    : folder_(std::move(folder)), limit_bytes_(limit_bytes) {}

Result<std::unique_ptr<StageStore>> StageStore::open(const fs::path& folder, std::uint64_t limit_bytes) {
  std::unique_ptr<StageStore> store(new StageStore(folder, limit_bytes));
  std::error_code error;
  fs::create_directories(store->scratch_folder(), error);
  if (error)
    return Failure{FailureCode::write_failed, folder.string() + ": cannot make the stage store: " + error.message(),
                   "name another folder with --cache, or use --no-cache"};
  store->remove_leftovers();
  return store;
}

fs::path StageStore::entry_file(const Digest& key) const {
  const std::string hex = key.hex();
  return folder_ / hex.substr(0, 2) / hex.substr(2, 2) / hex.substr(4);
}

std::optional<StoredOutput> StageStore::find(const Digest& key) {
  const fs::path path = entry_file(key);
  const File file(path, O_RDONLY);
  if (!file.is_open()) return std::nullopt;
  std::uint64_t payload_start = 0;
  auto header = read_header(file, key, payload_start);
  if (!header) {
    drop(key);
    return std::nullopt;
  }
  file.mark_as_used();
  return std::move(header->output);
}

std::optional<std::vector<std::byte>> StageStore::load(const Digest& key, const StoredOutput& expected) {
  const File file(entry_file(key), O_RDONLY);
  if (!file.is_open()) return std::nullopt;
  std::uint64_t payload_start = 0;
  const auto header = read_header(file, key, payload_start);
  if (header && header->output.digest == expected.digest) {
    std::vector<std::byte> payload(header->output.payload_bytes);
    if (file.read_at(payload_start, payload) && digest_of(payload) == expected.digest) return payload;
  }
  drop(key);
  return std::nullopt;
}

Result<void> StageStore::save(const Digest& key, const Digest& digest, const std::vector<Warning>& warnings,
                              std::span<const std::byte> payload) {
  static std::atomic<unsigned> serial{0};
  const fs::path target = entry_file(key);
  const fs::path part =
      scratch_folder() / (key.hex() + "." + std::to_string(::getpid()) + "." + std::to_string(serial++) + ".part");
  const auto failed = [&](const char* step) {
    Failure failure{FailureCode::write_failed, target.string() + ": " + step + ": " + std::strerror(errno),
                    "check free space and permissions, or use --no-cache"};
    ::unlink(part.c_str());
    return failure;
  };
  std::error_code ignored;  // what is missing shows when it is used
  fs::create_directories(scratch_folder(), ignored);
  fs::create_directories(target.parent_path(), ignored);
  File file(part, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.is_open()) return failed("cannot create");
  const StoredOutput output{digest, payload.size(), warnings};
  if (!file.write(start_and_header({key, output}), payload)) return failed("cannot write");
  if (!file.close() || ::rename(part.c_str(), target.c_str()) != 0) return failed("cannot finish");
  return {};
}

void StageStore::drop(const Digest& key) { ::unlink(entry_file(key).c_str()); }

std::size_t StageStore::evict() {
  struct Entry {
    fs::file_time_type used;
    std::uint64_t bytes;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::uint64_t total = 0;
  for_each_named(folder_, 2, [&](const fs::path& first) {
    for_each_named(first, 2, [&](const fs::path& second) {
      for_each_named(second, 28, [&](const fs::path& path) {
        std::error_code gone;
        const std::uint64_t bytes = fs::file_size(path, gone);
        if (gone) return;
        const fs::file_time_type used = fs::last_write_time(path, gone);
        if (gone) return;
        entries.push_back({used, bytes, path});
        total += bytes;
      });
    });
  });
  if (total <= limit_bytes_) return 0;
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.used != b.used ? a.used < b.used : a.path < b.path; });
  std::size_t removed = 0;
  for (const Entry& entry : entries) {
    if (total <= limit_bytes_) break;
    ::unlink(entry.path.c_str());  // if another process was first, the space is free as well
    total -= entry.bytes;
    ++removed;
  }
  return removed;
}

void StageStore::remove_leftovers() const {
  const auto yesterday = fs::file_time_type::clock::now() - std::chrono::hours(24);
  std::error_code error;
  for (fs::directory_iterator it(scratch_folder(), error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != ".part") continue;
    const pid_t owner = owner_of(it->path().filename().string());
    std::error_code gone;
    const fs::file_time_type written = fs::last_write_time(it->path(), gone);
    if (gone) continue;
    const bool is_dead = owner > 0 && ::kill(owner, 0) != 0 && errno == ESRCH;
    if (is_dead || written < yesterday) ::unlink(it->path().c_str());
  }
}

}  // namespace strataflow
