#include "batch/build_graph.h"
#include "commands.h"
#include "graph/draw_graph.h"
#include "terminal.h"

namespace strataflow {

int graph_command(const GraphArguments& arguments) {
  const Result<std::vector<Job>> jobs = read_jobs(arguments.job, arguments.settings);
  if (!jobs) {
    (void)report_failure(jobs.failure());
    return 2;
  }
  StageGraph graph;
  build_graph(graph, *jobs);
  return print_result(arguments.format == "json"      ? to_json(graph)
               : arguments.format == "mermaid" ? to_mermaid(graph)
                                               : to_dot(graph));
}

}  // namespace strataflow
