#pragma once
#include <charconv>
#include <string>

#include "model/vector3.h"

namespace strataflow {

/// Appends the shortest text that reads back as the same number.
template <class Number>
void append_number(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Appends "x y z" with that separator.
inline void append_point(std::string& text, const Vec3& point, const char* separator = " ") {
  append_number(text, point.x);
  text += separator;
  append_number(text, point.y);
  text += separator;
  append_number(text, point.z);
}

}  // namespace strataflow
