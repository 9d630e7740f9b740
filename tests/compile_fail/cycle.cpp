#include "compile_fail/small_stages.h"

// A node cannot be fed by a later one: that one's port does not exist yet, and nobody but the graph makes ports.
int main() {
  strataflow::StageGraph graph;
#ifdef BAD
  strataflow::Port<double> later{strataflow::NodeId{2}};
#else
  const auto later = graph.add("number", MeasureText{}, graph.add("text", MakeText{}));
#endif
  const auto text = graph.add("repeat", RepeatText{}, graph.add("text", MakeText{}), later);
  graph.add("number", MeasureText{}, text);
}
