#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace strataflow {

/// One file of a run folder, still in memory.
struct RunFile {
  std::string name;
  std::vector<std::byte> content;
};

/// Looks, before any work, whether `folder` may become a run folder: it must not exist, be empty, or be one (hold a
/// report.json), and its place must be writable. Fails with invalid_usage or write_failed.
Result<void> check_run_folder(const std::filesystem::path& folder);

/// Writes `files` to a hidden neighbour of `folder` and exchanges the two when it is whole: whoever looks sees the old
/// folder or the new one, and a crash at any moment leaves one of them. Files that earlier runs did not write (notes, a
/// viewer's state) are carried over; leftovers of killed runs are cleared away. Fails with write_failed.
Result<void> replace_run_folder(const std::filesystem::path& folder, const std::vector<RunFile>& files);

/// Removes a run folder, but for files in it that are not ours. What is no run folder stays; so does what cannot be removed.
void remove_run_folder(const std::filesystem::path& folder);

/// The exchange on file systems that have none (called by replace_run_folder): `folder` steps aside, `part` takes its
/// place, the old content ends where `part` was. A run killed in between leaves the old folder aside; the next
/// replace_run_folder puts it back first. Fails with write_failed; then `folder` is as it was.
Result<void> replace_by_renames(const std::filesystem::path& part, const std::filesystem::path& folder);

/// True for names that strataflow gives to files of a run folder.
bool is_run_file(std::string_view name);

}  // namespace strataflow
