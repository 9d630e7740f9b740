#include "base/digest.h"

#include <xxhash.h>

namespace strataflow {

namespace {
Digest digest_of_memory(const void* data, std::size_t size) {
  const XXH128_hash_t hash = XXH3_128bits(data, size);
  return {hash.high64, hash.low64};
}
}  // namespace

std::string Digest::hex() const {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(32, '0');
  for (int i = 0; i < 16; ++i) {
    text[15 - i] = digits[(high >> (4 * i)) & 15];
    text[31 - i] = digits[(low >> (4 * i)) & 15];
  }
  return text;
}

Digest digest_of(std::span<const std::byte> bytes) { return digest_of_memory(bytes.data(), bytes.size()); }

Digest digest_of(std::string_view text) { return digest_of_memory(text.data(), text.size()); }

}  // namespace strataflow
