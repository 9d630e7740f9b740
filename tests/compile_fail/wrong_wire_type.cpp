#include "compile_fail/small_stages.h"

int main() {
  strataflow::StageGraph graph;
  const auto text = graph.add("text", MakeText{});
  const auto number = graph.add("number", MeasureText{}, text);
#ifdef BAD
  graph.add("number", MeasureText{}, number);
#endif
  return static_cast<int>(number.node().value);
}
