#pragma once
#include <cmath>
#include <string>

#include "base/option_field.h"

namespace strataflow {

/// "> 0", "≥ 1 and ≤ 3", "auto | never"; empty when everything of the type is allowed.
inline std::string domain_of(const OptionField& field) {
  const auto plain = [](double number) {
    std::string text = OptionPrinter::literal(number);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
  };
  std::string text;
  for (const std::string_view word : field.words) text += (text.empty() ? "" : " | ") + std::string(word);
  if (std::isfinite(field.minimum)) text += (field.exclusive_minimum ? "> " : "≥ ") + plain(field.minimum);
  if (std::isfinite(field.maximum)) text += (text.empty() ? "≤ " : " and ≤ ") + plain(field.maximum);
  return text;
}

}  // namespace strataflow
