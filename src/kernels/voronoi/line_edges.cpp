#include "kernels/voronoi/line_edges.h"

#include <algorithm>
#include <array>

namespace strataflow {

std::vector<LineEdge> line_edges(const StructuralModel& model) {
  using Ends = std::array<std::uint32_t, 2>;
  std::vector<Ends> on_lines;
  for (const Line& line : model.lines) {
    const std::size_t count = line.vertices.size();
    for (std::size_t i = 0; i + (line.is_closed() ? 0 : 1) < count; ++i) {
      const std::uint32_t a = line.vertices[i], b = line.vertices[(i + 1) % count];
      on_lines.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(on_lines.begin(), on_lines.end());
  std::vector<char> is_taken(on_lines.size(), 0);
  std::vector<LineEdge> edges;
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = model.triangles[t][k], b = model.triangles[t][(k + 1) % 3];
      const Ends ends{std::min(a, b), std::max(a, b)};
      const auto found = std::lower_bound(on_lines.begin(), on_lines.end(), ends);
      if (found == on_lines.end() || *found != ends) continue;
      char& taken = is_taken[static_cast<std::size_t>(found - on_lines.begin())];
      if (!taken) edges.push_back({t, k});
      taken = 1;
    }
  return edges;
}

}  // namespace strataflow
