#include "kernels/topology/building/build_lines.h"

#include <algorithm>
#include <span>

#include "base/id.h"

namespace strataflow {

namespace {

/// Surfaces around an edge, ascending, with repetition.
std::vector<std::uint32_t> surfaces_around(const EdgeTable& edges, const std::vector<std::uint32_t>& surface_of,
                                           std::uint32_t edge) {
  std::vector<std::uint32_t> surfaces;
  for (const std::uint32_t h : edges.around(edge)) surfaces.push_back(surface_of[h / 3]);
  std::sort(surfaces.begin(), surfaces.end());
  return surfaces;
}

class Walker {
 public:
  Walker(const EdgeTable& edges, const std::vector<char>& is_feature, const std::vector<std::uint32_t>& surface_of,
         std::size_t point_count)
      : edges_(edges), surface_of_(surface_of), first_(point_count + 1, 0), used_(edges.edge_count(), 0) {
    for (std::uint32_t e = 0; e < edges.edge_count(); ++e)
      if (is_feature[e])
        for (const std::uint32_t v : edges.edges[e]) ++first_[v + 1];
    for (std::size_t v = 0; v < point_count; ++v) first_[v + 1] += first_[v];
    incident_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t e = 0; e < edges.edge_count(); ++e)
      if (is_feature[e])
        for (const std::uint32_t v : edges.edges[e]) incident_[next[v]++] = e;
  }

  LineNetwork walk() {
    const auto point_count = static_cast<std::uint32_t>(first_.size() - 1);
    corner_of_.assign(point_count, no_index);
    for (std::uint32_t v = 0; v < point_count; ++v)
      if (is_corner(v)) {
        corner_of_[v] = static_cast<std::uint32_t>(network_.corners.size());
        network_.corners.push_back({v});
      }
    for (const Corner& corner : network_.corners)
      for (const std::uint32_t e : at(corner.vertex))
        if (!used_[e]) walk_line(corner.vertex, e);
    for (std::uint32_t v = 0; v < point_count; ++v)  // what is left are loops
      for (const std::uint32_t e : at(v))
        if (!used_[e]) walk_line(v, e);
    return std::move(network_);
  }

 private:
  std::span<const std::uint32_t> at(std::uint32_t v) const {
    return {incident_.data() + first_[v], incident_.data() + first_[v + 1]};
  }
  bool is_corner(std::uint32_t v) const {
    const auto around = at(v);
    if (around.empty()) return false;
    return around.size() != 2 ||
           surfaces_around(edges_, surface_of_, around[0]) != surfaces_around(edges_, surface_of_, around[1]);
  }
  void walk_line(std::uint32_t start, std::uint32_t first_edge) {
    Line line;
    std::vector<std::uint32_t> along;
    std::uint32_t v = start, e = first_edge;
    line.vertices.push_back(start);
    for (;;) {
      used_[e] = 1;
      along.push_back(e);
      v = edges_.edges[e][0] == v ? edges_.edges[e][1] : edges_.edges[e][0];
      if (v == start && corner_of_[v] == no_index) break;  // closed
      line.vertices.push_back(v);
      if (corner_of_[v] != no_index) {
        line.corners = {corner_of_[start], corner_of_[v]};
        break;
      }
      const auto around = at(v);
      e = around[0] == e ? around[1] : around[0];
    }
    line.surfaces = surfaces_around(edges_, surface_of_, first_edge);
    network_.lines.push_back(std::move(line));
    network_.line_edges.push_back(std::move(along));
  }

  const EdgeTable& edges_;
  const std::vector<std::uint32_t>& surface_of_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> incident_;
  std::vector<char> used_;
  std::vector<std::uint32_t> corner_of_;
  LineNetwork network_;
};

}  // namespace

LineNetwork build_lines(const EdgeTable& edges, const std::vector<char>& is_feature,
                        const std::vector<std::uint32_t>& surface_of, std::size_t point_count) {
  return Walker(edges, is_feature, surface_of, point_count).walk();
}

}  // namespace strataflow
