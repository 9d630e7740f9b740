#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/digest.h"
#include "base/result.h"
#include "base/warning.h"

namespace strataflow {

/// Part of every key: bump when an archive layout in base or model, or the entry layout, changes.
inline constexpr std::uint32_t stage_store_format = 1;

/// What a store knows about an output before anyone reads it.
struct StoredOutput {
  Digest digest;  ///< of the payload
  std::uint64_t payload_bytes = 0;
  std::vector<Warning> warnings;
};

/// Stage outputs on disk, found by what they were made of (content-addressed). One file per entry; written aside and
/// renamed, so any number of processes may share a folder and be killed at any moment. An entry that is not whole is
/// dropped when it is met. Safe from several threads.
class StageStore {
 public:
  static constexpr std::uint64_t default_limit_bytes = std::uint64_t{10} << 30;

  /// Opens or makes the store in `folder` and removes what killed processes left there. Fails with write_failed.
  static Result<std::unique_ptr<StageStore>> open(const std::filesystem::path& folder,
                                                  std::uint64_t limit_bytes = default_limit_bytes);

  /// What is stored under `key`, without reading the payload; marks the entry as used. Nothing: absent or damaged.
  std::optional<StoredOutput> find(const Digest& key);

  /// The payload of `key`, whose digest is checked. Nothing: absent by now, or damaged (then dropped).
  std::optional<std::vector<std::byte>> load(const Digest& key, const StoredOutput& expected);

  /// Stores an output of digest `digest`. Fails with write_failed; the store is then as before.
  Result<void> save(const Digest& key, const Digest& digest, const std::vector<Warning>& warnings,
                    std::span<const std::byte> payload);

  /// Removes an entry that turned out to be of no use.
  void drop(const Digest& key);

  /// Removes the entries used longest ago until the rest fits the limit. Returns how many were removed.
  std::size_t evict();

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path entry_file(const Digest& key) const;

 private:
  StageStore(std::filesystem::path folder, std::uint64_t limit_bytes);
  std::filesystem::path scratch_folder() const { return folder_ / "parts"; }
  void remove_leftovers() const;

  std::filesystem::path folder_;
  std::uint64_t limit_bytes_;
};

}  // namespace strataflow
