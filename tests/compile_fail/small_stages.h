#pragma once
#include <string>
#include <vector>

#include "graph/stage_graph.h"

struct MakeText {
  static constexpr std::string_view name = "make_text";
  static constexpr int version = 1;
  strataflow::NoOptions options;
  strataflow::Result<std::string> operator()(strataflow::StageContext&) const { return std::string("text"); }
};
struct MeasureText {
  static constexpr std::string_view name = "measure_text";
  static constexpr int version = 1;
  strataflow::NoOptions options;
  strataflow::Result<double> operator()(const std::string& text, strataflow::StageContext&) const {
    return static_cast<double>(text.size());
  }
};
struct RepeatText {
  static constexpr std::string_view name = "repeat_text";
  static constexpr int version = 1;
  strataflow::NoOptions options;
  strataflow::Result<std::string> operator()(const std::string& text, const double&, strataflow::StageContext&) const {
    return text;
  }
};
struct JoinTexts {
  static constexpr std::string_view name = "join_texts";
  static constexpr int version = 1;
  strataflow::NoOptions options;
  strataflow::Result<std::string> operator()(const std::vector<const std::string*>& texts,
                                             strataflow::StageContext&) const {
    return *texts.front();
  }
};
