#pragma once

namespace strataflow::support {

/// True under the address or thread sanitizer, where code runs 10 to 50 times slower: repeated trials take fewer turns.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace strataflow::support
