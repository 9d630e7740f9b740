#include "compile_fail/small_stages.h"

int main() {
  strataflow::StageGraph graph;
  const auto text = graph.add("text", MakeText{});
  const auto number = graph.add("number", MeasureText{}, text);
  graph.add("repeat", RepeatText{}, text, number);
#ifdef BAD
  graph.add("repeat", RepeatText{}, number, text);
#endif
}
