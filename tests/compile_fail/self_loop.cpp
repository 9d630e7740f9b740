#include "compile_fail/small_stages.h"

int main() {
  strataflow::StageGraph graph;
  const auto text = graph.add("text", MakeText{});
  const auto joined = graph.add("join", JoinTexts{}, std::vector{text});
#ifdef BAD
  const auto looped = graph.add("join", JoinTexts{}, std::vector{text, looped});
#endif
  return static_cast<int>(joined.node().value);
}
