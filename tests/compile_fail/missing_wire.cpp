#include "compile_fail/small_stages.h"

int main() {
  strataflow::StageGraph graph;
  const auto text = graph.add("text", MakeText{});
  graph.add("join", JoinTexts{}, std::vector{text, text});
#ifdef BAD
  graph.add("join", JoinTexts{});
#endif
}
