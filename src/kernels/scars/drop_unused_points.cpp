#include "kernels/scars/drop_unused_points.h"

#include "base/id.h"

namespace strataflow {

std::vector<std::uint32_t> drop_unused_points(TriangleSoup& soup, std::vector<char> is_kept) {
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t v : t) is_kept[v] = 1;
  std::vector<std::uint32_t> source, renumbered(soup.points.size(), no_index);
  for (std::uint32_t v = 0; v < soup.points.size(); ++v) {
    if (!is_kept[v]) continue;
    renumbered[v] = static_cast<std::uint32_t>(source.size());
    soup.points[source.size()] = soup.points[v];
    source.push_back(v);
  }
  soup.points.resize(source.size());
  for (Triangle& t : soup.triangles)
    for (std::uint32_t& v : t) v = renumbered[v];
  for (PointProperty& property : soup.properties) {
    for (std::size_t v = 0; v < source.size(); ++v)
      for (std::size_t w = 0; w < property.width; ++w)
        property.values[v * property.width + w] = property.values[source[v] * std::size_t{property.width} + w];
    property.values.resize(source.size() * property.width);
  }
  for (std::uint32_t& v : soup.border_stones) v = renumbered[v];
  std::erase(soup.border_stones, no_index);
  for (auto& [a, b] : soup.border_starts) {
    a = renumbered[a];
    b = renumbered[b];
  }
  std::erase_if(soup.border_starts, [](const auto& edge) { return edge[0] == no_index || edge[1] == no_index; });
  return source;
}

}  // namespace strataflow
