#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "base/archive.h"
#include "base/atomic_file.h"
#include "base/digest.h"
#include "io/model_file/read_model_file.h"
#include "model/soup_of_model.h"
#include "io/model_file/write_model_file.h"

namespace {

using namespace strataflow;

// The places of a model file (model_project.h).
constexpr std::size_t start_bytes = 64, file_bytes_at = 48, directory_bytes_at = 56, checksum_bytes = 16;
constexpr std::size_t entry_bytes = 40, entry_size_at = 16, entry_checksum_at = 24;

std::uint64_t number_at(const std::string& bytes, std::size_t place) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

void put(std::string& bytes, std::size_t place, const Digest& digest) {
  std::memcpy(bytes.data() + place, &digest.high, 8);
  std::memcpy(bytes.data() + place + 8, &digest.low, 8);
}

Digest digest_of_part(const std::string& bytes, std::size_t begin, std::size_t size) {
  return digest_of(std::as_bytes(std::span(bytes.data() + begin, size)));
}

/// Makes all lengths and checksums right, so that damage is met behind them too.
void mend(std::string& bytes) {
  if (bytes.size() < start_bytes + checksum_bytes) return;
  const std::uint64_t size = bytes.size();
  std::memcpy(bytes.data() + file_bytes_at, &size, 8);
  std::uint64_t directory = number_at(bytes, directory_bytes_at) / entry_bytes * entry_bytes;
  directory = std::min(directory, (size - start_bytes - checksum_bytes) / entry_bytes * entry_bytes);
  std::memcpy(bytes.data() + directory_bytes_at, &directory, 8);
  std::uint64_t section = start_bytes + directory + checksum_bytes;
  for (std::size_t entry = start_bytes; entry < start_bytes + directory; entry += entry_bytes) {
    const bool is_last = entry + entry_bytes == start_bytes + directory;
    const std::uint64_t left = size - section;
    const std::uint64_t length = is_last ? left : std::min(left, number_at(bytes, entry + entry_size_at));
    std::memcpy(bytes.data() + entry + entry_size_at, &length, 8);
    put(bytes, entry + entry_checksum_at, digest_of_part(bytes, section, length));
    section += length;
  }
  const Digest entries = digest_of_part(bytes, start_bytes, directory);
  ArchiveWriter whole;
  whole(size, directory, entries.high, entries.low);
  put(bytes, start_bytes + directory, digest_of(whole.bytes()));
}

const std::filesystem::path& scratch_file() {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("strataflow_fuzz_" + std::to_string(::getpid()) + ".sfm");
  return file;
}

/// A value or a named failure; what was read is sound, and is the same after it was written or refused by the writer.
void check(const std::string& bytes) {
  STRATAFLOW_ASSERT(write_file_atomically(scratch_file(), std::string_view(bytes)), "no scratch file");
  const Result<StructuralModel> model = read_model_file(scratch_file());
  if (!model) {
    STRATAFLOW_ASSERT(model.failure().what.find(scratch_file().string()) == 0, "a failure that does not name the file");
    STRATAFLOW_ASSERT(!model.failure().remedy.empty(), "a failure without a remedy");
  } else if (const Result<void> written = write_model_file(scratch_file(), *model); written) {
    const TriangleSoup soup = soup_of_model(*model);
    for (const Triangle& triangle : soup.triangles)
      for (const std::uint32_t vertex : triangle) STRATAFLOW_ASSERT(vertex < soup.points.size(), "vertex out of range");
    const Result<StructuralModel> again = read_model_file(scratch_file());
    STRATAFLOW_ASSERT(again, "what was written does not read: " + again.failure().what);
    STRATAFLOW_ASSERT(archived(*again) == archived(*model), "a model changed on its way through a file");
  } else {
    STRATAFLOW_ASSERT(written.failure().code == FailureCode::invalid_input, written.failure().what);
  }
  ::unlink(scratch_file().c_str());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  check(bytes);
  mend(bytes);
  check(bytes);
  return 0;
}
