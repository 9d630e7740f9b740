#include "io/bytes/tar_members.h"

#include <charconv>
#include <cstdint>
#include <optional>

namespace strataflow {

namespace {

constexpr std::size_t block = 512;

std::string_view field(std::string_view header, std::size_t offset, std::size_t size) {
  const std::string_view text = header.substr(offset, size);
  return text.substr(0, text.find('\0'));
}

std::optional<std::uint64_t> octal(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, 8);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The value of "path=" in a pax header, whose records are "<length> key=value\n".
std::string pax_path(std::string_view records) {
  std::string path;
  while (!records.empty()) {
    std::size_t length = 0;
    const auto [stop, error] = std::from_chars(records.data(), records.data() + records.size(), length);
    const auto digits = static_cast<std::size_t>(stop - records.data());
    if (error != std::errc() || length <= digits + 1 || length > records.size()) break;
    const std::string_view record = records.substr(digits + 1, length - digits - 2);
    if (record.substr(0, 5) == "path=") path = record.substr(5);
    records.remove_prefix(length);
  }
  return path;
}

}  // namespace

Result<std::vector<TarMember>> tar_members(std::string_view bytes, const std::string& file_name) {
  const auto damaged = [&](std::size_t position, const std::string& why) {
    return Failure{FailureCode::malformed_file, file_name + ": tar: " + why + " at byte " + std::to_string(position),
                   "fetch or pack the archive again"};
  };
  std::vector<TarMember> members;
  std::string long_name;
  for (std::size_t position = 0; position < bytes.size();) {
    if (bytes.size() - position < block) return damaged(position, "truncated header");
    const std::string_view header = bytes.substr(position, block);
    if (header.find_first_not_of('\0') == std::string_view::npos) break;  // the end mark
    const std::optional<std::uint64_t> checksum = octal(field(header, 148, 8));
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < block; ++i) sum += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(header[i]);
    if (!checksum || *checksum != sum) return damaged(position, "wrong header checksum");
    const std::optional<std::uint64_t> size = octal(field(header, 124, 12));
    if (!size) return damaged(position, "unreadable size");
    position += block;
    if (*size > bytes.size() - position) return damaged(position, "truncated member");
    const std::string_view content = bytes.substr(position, static_cast<std::size_t>(*size));
    const std::size_t padded = (content.size() + block - 1) / block * block;
    position = padded > bytes.size() - position ? bytes.size() : position + padded;
    const char kind = header[156];
    if (kind == 'L') {
      long_name = content.substr(0, content.find('\0'));
    } else if (kind == 'x') {
      long_name = pax_path(content);
    } else {
      std::string name(field(header, 0, 100));
      const std::string_view prefix = field(header, 257, 5) == "ustar" ? field(header, 345, 155) : std::string_view();
      if (!prefix.empty()) name = std::string(prefix) + "/" + name;
      if (!long_name.empty()) name = long_name;
      long_name.clear();
      if (kind == '0' || kind == '\0') members.push_back({std::move(name), content});
    }
  }
  return members;
}

}  // namespace strataflow
