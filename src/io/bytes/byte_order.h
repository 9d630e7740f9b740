#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <type_traits>

namespace strataflow {

static_assert(std::endian::native == std::endian::little, "binary readers and writers take the host for little-endian");

/// A number from its bytes; `swap` when they are big-endian. `bytes` must hold sizeof(T) bytes.
template <class T>
T load_number(const char* bytes, bool swap) {
  static_assert(std::is_arithmetic_v<T>);
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (swap) std::reverse(copy.begin(), copy.end());
  T value;
  std::memcpy(&value, copy.data(), sizeof(T));
  return value;
}

/// Appends the little-endian bytes of a number.
template <class T>
void store_number(std::string& bytes, T value) {
  static_assert(std::is_arithmetic_v<T>);
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), &value, sizeof(T));
  bytes.append(copy.data(), copy.size());
}

}  // namespace strataflow
