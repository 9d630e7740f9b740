#pragma once
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "io/gocad/gocad_header.h"
#include "io/text/text_scanner.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// The four forms of a vertex record.
enum class GocadVertexKind { none, vertex, vertex_with_values, atom, atom_with_values };
GocadVertexKind gocad_vertex_kind(std::string_view word);

/// Which point a vertex id of one object stands for. Ids are usually dense; wild ones cost a map entry, not memory.
class GocadVertexIds {
 public:
  static constexpr std::uint32_t unknown = 0xffffffffu;

  void clear() {
    dense_.clear();
    sparse_.clear();
    count_ = 0;
  }
  /// False when the id is taken.
  bool add(std::uint64_t id, std::uint32_t point) {
    if (id < 1024 + 4 * count_) {
      if (id >= dense_.size()) dense_.resize(static_cast<std::size_t>(id) + 1, unknown);
      if (dense_[id] != unknown || (!sparse_.empty() && sparse_.count(id))) return false;
      dense_[id] = point;
    } else if (!sparse_.emplace(id, point).second) {
      return false;
    }
    ++count_;
    return true;
  }
  std::uint32_t find(std::uint64_t id) const {
    if (id < dense_.size() && dense_[id] != unknown) return dense_[id];
    if (sparse_.empty()) return unknown;
    const auto found = sparse_.find(id);
    return found == sparse_.end() ? unknown : found->second;
  }

 private:
  std::vector<std::uint32_t> dense_;
  std::unordered_map<std::uint64_t, std::uint32_t> sparse_;  // looked up, never iterated
  std::size_t count_ = 0;
};

/// Collects the property values of vertices into per-point lists, NaN where a point has none. What would take far
/// more memory than the file's own size (many objects with many different properties) is given up as a whole.
class GocadPropertyStore {
 public:
  GocadPropertyStore(std::vector<PointProperty>& properties, std::size_t file_size)
      : properties_(properties), budget_(64 * file_size / sizeof(double) + 4096) {}

  /// From now on rows hold the values of these properties.
  void begin_object(const std::vector<GocadProperty>& declared);
  /// Reads the values of `point` from the rest of the line. Points must come in ascending order.
  Result<void> read_row(TextScanner& scanner, std::size_t point);
  /// Pads all lists to `point_count` points. False when the properties were given up.
  bool finish(std::size_t point_count);

 private:
  void give_up();

  std::vector<PointProperty>& properties_;
  std::size_t budget_;  ///< numbers that may be held
  bool is_given_up_ = false;
  std::vector<GocadProperty> declared_;
  std::vector<std::size_t> column_;  ///< per declared property: index into properties_; empty before the first row
  std::vector<double> row_;
};

}  // namespace strataflow
