#include "io/gocad/gocad_vertices.h"

#include <cmath>
#include <limits>

namespace strataflow {

namespace {
constexpr double no_data = std::numeric_limits<double>::quiet_NaN();
}

GocadVertexKind gocad_vertex_kind(std::string_view word) {
  if (word == "VRTX") return GocadVertexKind::vertex;
  if (word == "PVRTX") return GocadVertexKind::vertex_with_values;
  if (word == "ATOM" || word == "SHAREDVRTX") return GocadVertexKind::atom;
  if (word == "PATOM" || word == "SHAREDPVRTX") return GocadVertexKind::atom_with_values;
  return GocadVertexKind::none;
}

void GocadPropertyStore::begin_object(const std::vector<GocadProperty>& declared) {
  declared_ = declared;
  column_.clear();
}

Result<void> GocadPropertyStore::read_row(TextScanner& scanner, std::size_t point) {
  row_.clear();
  for (const GocadProperty& property : declared_) {
    for (std::uint32_t k = 0; k < property.width; ++k) {
      const std::optional<double> value = scanner.number();
      if (!value)
        return scanner.malformed("a vertex lacks values of property " + shown(property.name),
                                 "give as many values as PROPERTIES and ESIZES declare");
      row_.push_back(*value == property.no_data || !std::isfinite(*value) ? no_data : *value);
    }
  }
  if (is_given_up_ || declared_.empty()) return {};
  if (column_.empty()) {  // only a row that was really there may make lists
    std::vector<bool> is_taken(properties_.size(), false);
    for (const GocadProperty& property : declared_) {
      std::size_t slot = 0;
      while (slot < is_taken.size() &&
             (is_taken[slot] || properties_[slot].name != property.name || properties_[slot].unit != property.unit ||
              properties_[slot].width != property.width))
        ++slot;
      if (slot == is_taken.size()) {
        properties_.push_back({property.name, property.unit, property.width, {}});
        is_taken.push_back(false);
      }
      is_taken[slot] = true;
      column_.push_back(slot);
    }
  }
  const double* value = row_.data();
  for (std::size_t i = 0; i < column_.size(); ++i) {
    PointProperty& property = properties_[column_[i]];
    const std::size_t wanted = (point + 1) * property.width;
    const std::size_t added = wanted - property.values.size();
    if (added > budget_) {
      give_up();
      return {};
    }
    budget_ -= added;
    property.values.resize(point * property.width, no_data);
    property.values.insert(property.values.end(), value, value + property.width);
    value += property.width;
  }
  return {};
}

bool GocadPropertyStore::finish(std::size_t point_count) {
  for (const PointProperty& property : properties_) {
    const std::size_t added = point_count * property.width - property.values.size();
    if (added > budget_) give_up();
    if (is_given_up_) break;
    budget_ -= added;
  }
  for (PointProperty& property : properties_) property.values.resize(point_count * property.width, no_data);
  return !is_given_up_;
}

void GocadPropertyStore::give_up() {
  is_given_up_ = true;
  std::vector<PointProperty>().swap(properties_);
}

}  // namespace strataflow
