#include "stages/stage_description.h"

#include <array>
#include <utility>

#include "stages/option_domain.h"

namespace strataflow {

OptionDescription OptionDescriber::describe(const OptionField& field) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> units = {
      {{"_m", "m"}, {"_m2", "m²"}, {"_m3", "m³"}, {"_deg", "°"}, {"_s", "s"}, {"_ratio", "ratio"}}};
  OptionDescription option;
  option.name = field.name;
  for (const auto& [suffix, unit] : units)
    if (field.name.ends_with(suffix)) option.unit = unit;
  option.domain = domain_of(field);
  option.description = field.description;
  return option;
}

}  // namespace strataflow
