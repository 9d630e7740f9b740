#include "io/model_file/model_project.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "base/archive.h"
#include "base/atomic_file.h"
#include "base/seed.h"

namespace strataflow {

namespace fs = std::filesystem;

namespace {

struct CounterCopy {
  std::uint64_t value = 0;
  std::uint64_t check = 0;

  static std::uint64_t check_of(std::uint64_t value) { return mix64(value ^ 0x5346'4d43'4f55'4e54ULL); }
  CounterCopy() : CounterCopy(0) {}
  explicit CounterCopy(std::uint64_t counter) : value(counter), check(check_of(counter)) {}
  bool is_valid() const { return check == check_of(value); }
};

struct FileStart {
  std::array<char, 8> magic{'S', 'F', 'M', 'O', 'D', 'E', 'L', '\n'};
  std::uint32_t format = 1;
  std::uint32_t byte_order = 0x01020304;
  std::array<CounterCopy, 2> counters;
  std::uint64_t file_bytes = 0;
  std::uint64_t directory_bytes = 0;
  static constexpr bool is_flat = true;

  /// A counter half written by a killed process is not valid; the other one is.
  PermanentId counter() const {
    PermanentId largest = 0;
    for (const CounterCopy& copy : counters)
      if (copy.is_valid()) largest = std::max(largest, copy.value);
    return largest;
  }
};
static_assert(sizeof(FileStart) == 64);

struct DirectoryEntry {
  std::uint64_t id = 0;
  RecordKind kind = RecordKind::model;
  std::uint32_t unused = 0;
  std::uint64_t bytes = 0;
  std::uint64_t checksum_high = 0;
  std::uint64_t checksum_low = 0;
  static constexpr bool is_flat = true;
};
constexpr std::size_t checksum_bytes = 16;

/// Up to `bytes` bytes from `position`; fewer where the file ends.
std::vector<std::byte> read_part(std::ifstream& stream, std::uint64_t position, std::uint64_t bytes) {
  std::vector<std::byte> part(bytes);
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(position));
  stream.read(reinterpret_cast<char*>(part.data()), static_cast<std::streamsize>(bytes));
  part.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return part;
}

Digest directory_checksum(const FileStart& start, std::span<const std::byte> directory) {
  ArchiveWriter writer;
  writer(start.file_bytes, start.directory_bytes, digest_of(directory).high, digest_of(directory).low);
  return digest_of(writer.bytes());
}

struct Directory {
  FileStart start;
  Digest checksum;
  std::vector<DirectoryEntry> entries;
};

Result<Directory> read_directory(const fs::path& file) {
  const std::string name = file.string();
  std::error_code error;
  if (fs::is_directory(file, error))
    return Failure{FailureCode::unreadable_file, name + ": is a folder, not a file", "name a file inside it"};
  if (fs::exists(file, error) && !fs::is_regular_file(file, error))  // opening a pipe would wait for its writer
    return Failure{FailureCode::unreadable_file, name + ": is a pipe or a device, not a regular file",
                   "save its content to a file and name that one"};
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    return Failure{FailureCode::unreadable_file, name + ": " + std::strerror(errno),
                   "check the path and the permissions"};
  const std::uint64_t file_bytes = fs::file_size(file, error);
  Directory directory;
  const auto start = unarchived<FileStart>(read_part(stream, 0, sizeof(FileStart)));
  if (!start || start->magic != FileStart{}.magic)
    return ModelProject::malformed(name + ": is not a strataflow model file");
  if (start->byte_order != FileStart{}.byte_order || start->format != FileStart{}.format)
    return Failure{FailureCode::unsupported, name + ": format " + std::to_string(start->format) + " or its byte order",
                   "write it again with this version"};
  const std::uint64_t sections_start = sizeof(FileStart) + start->directory_bytes + checksum_bytes;
  if (start->file_bytes != file_bytes || start->directory_bytes > file_bytes || sections_start > file_bytes ||
      start->directory_bytes % sizeof(DirectoryEntry) != 0)
    return ModelProject::malformed(name + ": truncated: " + std::to_string(file_bytes) + " of " +
                                   std::to_string(start->file_bytes) + " bytes");
  directory.start = *start;
  const auto bytes = read_part(stream, sizeof(FileStart), start->directory_bytes + checksum_bytes);
  if (bytes.size() != start->directory_bytes + checksum_bytes)
    return ModelProject::malformed(name + ": cannot be read to its end");
  const auto entries = std::span<const std::byte>(bytes).first(start->directory_bytes);
  directory.checksum = directory_checksum(*start, entries);
  ArchiveReader reader(std::span<const std::byte>(bytes).last(checksum_bytes));
  Digest written;
  reader(written.high, written.low);
  if (written != directory.checksum) return ModelProject::malformed(name + ": its directory is damaged");
  directory.entries.resize(start->directory_bytes / sizeof(DirectoryEntry));
  if (!entries.empty()) std::memcpy(directory.entries.data(), entries.data(), entries.size());
  std::uint64_t left = file_bytes - sections_start;
  PermanentId last = 0;
  for (const DirectoryEntry& entry : directory.entries) {
    const auto kind = static_cast<std::uint32_t>(entry.kind);
    if (entry.id <= last || kind < 1 || kind > std::variant_size_v<Record> || entry.bytes > left)
      return ModelProject::malformed(name + ": its directory contradicts itself at id " + std::to_string(entry.id));
    last = entry.id;
    left -= entry.bytes;
  }
  if (left != 0) return ModelProject::malformed(name + ": " + std::to_string(left) + " bytes belong to no section");
  return directory;
}

/// Makes sure that no later program gives ids up to `counter` again, even if this one dies before it has saved.
Result<void> write_counter(const fs::path& file, const FileStart& start, PermanentId counter) {
  const std::array<CounterCopy, 2>& copies = start.counters;
  const bool second = copies[0].is_valid() && (!copies[1].is_valid() || copies[1].value < copies[0].value);
  const CounterCopy copy(counter);
  const auto position = static_cast<off_t>(offsetof(FileStart, counters) + (second ? sizeof copy : 0));
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  const bool is_written = descriptor >= 0 && ::pwrite(descriptor, &copy, sizeof copy, position) == sizeof copy &&
                          ::fdatasync(descriptor) == 0;
  const std::string reason = std::strerror(errno);
  if (descriptor >= 0) ::close(descriptor);
  if (is_written) return {};
  return Failure{FailureCode::write_failed, file.string() + ": cannot write its id counter: " + reason,
                 "check free space and permissions"};
}

template <class Stored>
Record unarchived_as(std::span<const std::byte> bytes, bool& is_ok) {
  auto stored = unarchived<Stored>(bytes);
  is_ok = stored.has_value();
  return is_ok ? Record(*std::move(stored)) : Record{};
}

Record record_from(RecordKind kind, std::span<const std::byte> bytes, bool& is_ok) {
  switch (kind) {
    case RecordKind::model:
      return unarchived_as<StoredModel>(bytes, is_ok);
    case RecordKind::point_block:
      return unarchived_as<StoredPointBlock>(bytes, is_ok);
    case RecordKind::entity:
      return unarchived_as<StoredEntity>(bytes, is_ok);
    case RecordKind::corner:
      return unarchived_as<StoredCorner>(bytes, is_ok);
    case RecordKind::line:
      return unarchived_as<StoredLine>(bytes, is_ok);
    case RecordKind::surface:
      return unarchived_as<StoredSurface>(bytes, is_ok);
    case RecordKind::frontier:
      return unarchived_as<StoredFrontier>(bytes, is_ok);
    case RecordKind::region:
      return unarchived_as<StoredRegion>(bytes, is_ok);
    case RecordKind::layer:
      return unarchived_as<StoredLayer>(bytes, is_ok);
  }
  is_ok = false;
  return {};
}

template <class Visit>
void for_each_vertex(const Record& record, Visit visit) {
  if (const auto* corner = std::get_if<StoredCorner>(&record)) visit(corner->vertex);
  if (const auto* line = std::get_if<StoredLine>(&record))
    for (const std::uint32_t vertex : line->vertices) visit(vertex);
  if (const auto* surface = std::get_if<StoredSurface>(&record))
    for (const Triangle& triangle : surface->triangles)
      for (const std::uint32_t vertex : triangle) visit(vertex);
}

template <class Visit>
void for_each_reference(const Record& record, Visit visit) {
  std::visit([&](const auto& stored) { stored.visit_references(visit); }, record);
}

}  // namespace

std::string_view to_string(RecordKind kind) {
  static constexpr std::array<std::string_view, 9> names = {"model",   "point block", "entity", "corner", "line",
                                                            "surface", "frontier",    "region", "layer"};
  return names[static_cast<std::size_t>(kind) - 1];
}

Failure ModelProject::malformed(std::string what) {
  return {FailureCode::malformed_file, std::move(what), "restore the file from a copy, or convert its source again"};
}

Result<ModelProject> ModelProject::open(const fs::path& file) {
  auto directory = read_directory(file);
  if (!directory) return directory.failure();
  ModelProject project;
  project.file_ = file;
  project.directory_checksum_ = directory->checksum;
  project.counter_ = directory->start.counter();
  std::uint64_t position = sizeof(FileStart) + directory->start.directory_bytes + checksum_bytes;
  for (const DirectoryEntry& entry : directory->entries) {
    project.sections_[entry.id] = {entry.kind, position, entry.bytes, {entry.checksum_high, entry.checksum_low}, {}};
    position += entry.bytes;
    project.counter_ = std::max<PermanentId>(project.counter_, entry.id);  // should both copies be lost
  }
  const std::vector<PermanentId> roots = project.ids(RecordKind::model);
  if (roots.size() > 1) return malformed(file.string() + ": holds more than one model");
  if (auto loaded = project.load(roots); !loaded) return loaded.failure();
  return project;
}

std::vector<PermanentId> ModelProject::ids(RecordKind kind) const {
  std::vector<PermanentId> result;
  for (const auto& [id, section] : sections_)
    if (section.kind == kind) result.push_back(id);
  return result;
}

const StoredModel* ModelProject::root() const {
  const auto roots = ids(RecordKind::model);
  return roots.empty() ? nullptr : find<StoredModel>(roots.front());
}

std::string ModelProject::name_of(PermanentId id) const {
  return (file_.empty() ? "model" : file_.string()) + ": section " + std::to_string(id) + " (" +
         std::string(to_string(sections_.at(id).kind)) + ")";
}

Result<std::vector<std::byte>> ModelProject::read_section(PermanentId id, const Section& section) const {
  std::ifstream stream(file_, std::ios::binary);
  auto bytes = read_part(stream, section.position, section.bytes);
  if (bytes.size() != section.bytes || digest_of(bytes) != section.checksum)
    return malformed(name_of(id) + " is damaged: its checksum is wrong");
  return bytes;
}

Result<void> ModelProject::load_section(PermanentId id, std::vector<PermanentId>& parts) {
  Section& section = sections_.at(id);
  if (section.record) return {};
  const auto bytes = read_section(id, section);
  if (!bytes) return bytes.failure();
  bool is_ok = false;
  Record record = record_from(section.kind, *bytes, is_ok);
  if (!is_ok) return malformed(name_of(id) + " does not hold what it says");
  std::optional<Failure> problem;
  for_each_reference(record, [&](PermanentId target, RecordKind kind, ReferenceKind reference) {
    if (target == 0 || problem) return;
    const auto found = sections_.find(target);
    if (found == sections_.end())
      problem = malformed(name_of(id) + " refers to " + std::string(to_string(kind)) + " " + std::to_string(target) +
                          ", which is not there");
    else if (found->second.kind != kind)
      problem = malformed(name_of(id) + " refers to " + std::to_string(target) + " as a " +
                          std::string(to_string(kind)) + ", which is a " + std::string(to_string(found->second.kind)));
    else if (reference == ReferenceKind::part)
      parts.push_back(target);
  });
  if (problem) return *problem;
  const StoredModel* model = root();
  std::vector<char> is_block_used(model ? model->ids.point_blocks.size() : 0);
  for_each_vertex(record, [&](std::uint32_t vertex) {
    if (vertex / points_per_block < is_block_used.size() && vertex < model->point_count)
      is_block_used[vertex / points_per_block] = 1;
    else
      problem = malformed(name_of(id) + " refers to point " + std::to_string(vertex) + ", which is not there");
  });
  if (problem) return *problem;
  for (std::size_t block = 0; block < is_block_used.size(); ++block)
    if (is_block_used[block]) parts.push_back(model->ids.point_blocks[block]);
  section.record = std::move(record);
  return {};
}

Result<void> ModelProject::load(std::span<const PermanentId> wanted) {
  std::vector<PermanentId> pending(wanted.begin(), wanted.end());
  while (!pending.empty()) {
    const PermanentId id = pending.back();
    pending.pop_back();
    if (!sections_.contains(id))
      return Failure{FailureCode::invalid_input, file_.string() + ": no object has the id " + std::to_string(id),
                     "ask for ids the file holds"};
    if (auto loaded = load_section(id, pending); !loaded) return loaded;
  }
  return {};
}

Result<void> ModelProject::load_all() {
  std::vector<PermanentId> all;
  for (const auto& [id, section] : sections_) all.push_back(id);
  return load(all);
}

Result<void> ModelProject::save(const fs::path& file) {
  std::error_code error;
  if (!file_.empty() && fs::equivalent(file, file_, error)) {
    const auto old = read_directory(file_);
    if (!old || old->checksum != directory_checksum_)
      return Failure{FailureCode::write_failed, file.string() + ": was saved by somebody else since it was opened",
                     "open it again, or save under another name"};
    if (old->start.counter() < counter_)
      if (auto written = write_counter(file_, old->start, counter_); !written) return written;
  }
  FileStart start;
  start.counters.fill(CounterCopy(counter_));
  std::vector<DirectoryEntry> entries;
  std::vector<std::byte> payload;
  for (const auto& [id, section] : sections_) {
    auto bytes = section.record ? std::visit([](const auto& stored) { return archived(stored); }, *section.record)
                                : read_section(id, section);
    if (!bytes) return bytes.failure();
    const Digest checksum = digest_of(*bytes);
    entries.push_back({id, section.kind, 0, bytes->size(), checksum.high, checksum.low});
    payload.insert(payload.end(), bytes->begin(), bytes->end());
  }
  start.directory_bytes = entries.size() * sizeof(DirectoryEntry);
  start.file_bytes = sizeof(FileStart) + start.directory_bytes + checksum_bytes + payload.size();
  const Digest checksum = directory_checksum(start, std::as_bytes(std::span(entries)));

  ArchiveWriter writer;
  writer(start);
  for (const DirectoryEntry& entry : entries) writer(entry);
  writer(checksum.high, checksum.low);
  std::vector<std::byte> bytes = writer.take();
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  if (auto written = write_file_atomically(file, bytes); !written) return written;

  file_ = file;
  directory_checksum_ = checksum;
  std::uint64_t position = bytes.size() - payload.size();
  auto entry = entries.begin();
  for (auto& [id, section] : sections_) {
    section.position = position;
    section.bytes = entry->bytes;
    section.checksum = {entry->checksum_high, entry->checksum_low};
    position += (entry++)->bytes;
  }
  return {};
}

PermanentId ModelProject::add(Record record) {
  PermanentId id = 0;
  store(id, std::move(record));
  return id;
}

void ModelProject::store(PermanentId& id, Record record) {
  if (id == 0) id = ++counter_;
  Section& section = sections_[id];
  section.kind = kind_of(record);
  section.record = std::move(record);
}

void ModelProject::replace(PermanentId id, Record record) {
  STRATAFLOW_ASSERT(sections_.contains(id) && sections_.at(id).kind == kind_of(record), "another object has this id");
  store(id, std::move(record));
}

void ModelProject::remove(PermanentId id) {
  sections_.erase(id);
  for (const PermanentId root_id : ids(RecordKind::model))
    ModelIds::for_each_list(std::get<StoredModel>(*sections_.at(root_id).record).ids,
                            [id](std::vector<PermanentId>& list, RecordKind) { std::erase(list, id); });
}

}  // namespace strataflow
