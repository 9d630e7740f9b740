#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace strataflow {

static_assert(std::endian::native == std::endian::little, "archives are the memory of a little-endian machine");

/// Types whose memory is their content: no padding, no pointers. Aggregates opt in with
/// `static constexpr bool is_flat = true;` and must hold flat members without gaps. A bool is not flat: a damaged byte
/// that is neither 0 nor 1 must not become one.
template <class T>
struct IsFlat : std::bool_constant<(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>> {};
template <class T, std::size_t N>
struct IsFlat<std::array<T, N>> : IsFlat<T> {};
template <class T>
requires requires { T::is_flat; }
struct IsFlat<T> : std::bool_constant<T::is_flat && std::is_trivially_copyable_v<T>> {};
template <class T>
inline constexpr bool is_flat_v = IsFlat<T>::value;

/// Writes values as one flat little-endian byte string. A type takes part either by being flat or by a member
/// `template <class A> void archive(A& a) { a(first, second, …); }`, which serves writing and reading alike.
class ArchiveWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void put_memory(const void* data, std::size_t size) {
    const std::size_t before = bytes_.size();
    if (before + size > bytes_.capacity()) bytes_.reserve(std::max(before + size, 2 * bytes_.capacity()));
    bytes_.resize(before + size);
    if (size > 0) std::memcpy(bytes_.data() + before, data, size);
  }
  template <class T>
  void put(const T& value) {
    if constexpr (is_flat_v<T>) {
      put_memory(&value, sizeof(T));
    } else {
      const_cast<T&>(value).archive(*this);  // archive() is one function for both directions
    }
  }
  void put(bool value) { put(static_cast<std::uint8_t>(value)); }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    put_memory(text.data(), text.size());
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    if constexpr (is_flat_v<T>) {
      if (!values.empty()) put_memory(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }

  std::vector<std::byte> bytes_;
};

/// Reads what ArchiveWriter wrote. Never reads past the end and never allocates more than the bytes can fill:
/// after the first impossible length `ok()` is false and everything that follows stays default.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  /// No read went wrong so far.
  bool ok() const { return ok_; }
  /// Everything was read, and nothing is left over.
  bool is_complete() const { return ok_ && position_ == bytes_.size(); }

 private:
  void get_memory(void* data, std::size_t size) {
    if (!ok_ || size > bytes_.size() - position_) {
      ok_ = false;
      return;
    }
    if (size > 0) std::memcpy(data, bytes_.data() + position_, size);
    position_ += size;
  }
  std::size_t get_count(std::size_t bytes_each) {
    std::uint64_t count = 0;
    get_memory(&count, sizeof count);
    if (!ok_ || count > (bytes_.size() - position_) / bytes_each) {
      ok_ = false;
      return 0;
    }
    return static_cast<std::size_t>(count);
  }
  template <class T>
  void get(T& value) {
    if constexpr (is_flat_v<T>) {
      get_memory(&value, sizeof(T));
    } else {
      value.archive(*this);
    }
  }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    if (byte > 1) ok_ = false;
    value = ok_ && byte == 1;
  }
  void get(std::string& text) {
    text.resize(get_count(1));
    get_memory(text.data(), text.size());
  }
  template <class T>
  void get(std::vector<T>& values) {
    if constexpr (is_flat_v<T>) {
      values.resize(get_count(sizeof(T)));
      get_memory(values.data(), values.size() * sizeof(T));
    } else {
      const std::size_t count = get_count(1);
      values.clear();
      for (std::size_t i = 0; i < count && ok_; ++i) get(values.emplace_back());
    }
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool is_present = false;
    get(is_present);
    value.reset();
    if (is_present) get(value.emplace());
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

/// The archived bytes of one value.
template <class T>
std::vector<std::byte> archived(const T& value) {
  ArchiveWriter writer;
  writer(value);
  return writer.take();
}

/// The value whose archived bytes these are, or nothing when they are damaged.
template <class T>
std::optional<T> unarchived(std::span<const std::byte> bytes) {
  ArchiveReader reader(bytes);
  T value;
  reader(value);
  if (!reader.is_complete()) return std::nullopt;
  return value;
}

}  // namespace strataflow
