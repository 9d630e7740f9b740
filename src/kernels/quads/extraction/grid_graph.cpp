#include "kernels/quads/extraction/grid_graph.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/id.h"
#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

namespace {

constexpr std::int64_t unit = GridMap::unit;
constexpr GaussianInteger directions[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

bool is_whole(GaussianInteger a) { return a.re % unit == 0 && a.im % unit == 0; }
std::int64_t ceil_whole(std::int64_t x) { return (x >= 0 ? (x + unit - 1) / unit : -((-x) / unit)) * unit; }

/// Sign of the cross product of a step with a vector of the map.
int turn_sign(GaussianInteger step, GaussianInteger v) {
  const std::int64_t c = step.re * v.im - step.im * v.re;
  return c > 0 ? 1 : c < 0 ? -1 : 0;
}
bool points_along(GaussianInteger step, GaussianInteger v) { return step.re * v.re + step.im * v.im > 0; }

Failure astray(const std::string& what) {
  return Failure{FailureCode::geometry_failed, what, "this map cannot be turned into quads; try another edge length"};
}

class GridTracer {
 public:
  GridTracer(const FeatureMesh& mesh, const GridMap& map) : mesh_(mesh), map_(map) {}

  Result<GridGraph> run(std::size_t vertex_limit) {
    double quads = 0;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      quads += 0.5 * static_cast<double>(area(map_.uv[3 * t], map_.uv[3 * t + 1], map_.uv[3 * t + 2]));
    quads /= static_cast<double>(unit) * static_cast<double>(unit);
    if (!(quads < static_cast<double>(vertex_limit)))
      return astray("the map has " + short_number(quads) + " quads, more than " + std::to_string(vertex_limit));
    find_at_points();
    find_on_edges();
    find_in_triangles();
    find_ports();
    graph_.partner.assign(graph_.ports.size(), no_index);
    for (std::uint32_t p = 0; p < graph_.ports.size(); ++p)
      if (const auto failure = follow(p)) return *failure;
    for (std::uint32_t p = 0; p < graph_.ports.size(); ++p) {
      const std::uint32_t q = graph_.partner[p];
      if (q != no_index && graph_.partner[q] != p)
        return astray("two steps of the grid meet at " + place(graph_.ports[q].vertex));
    }
    return std::move(graph_);
  }

 private:
  std::string place(std::uint32_t vertex) const { return place_text(graph_.positions[vertex], mesh_.local_origin); }
  const Vec3& point(std::uint32_t h) const { return mesh_.points[mesh_.triangles[h / 3][h % 3]]; }

  void add(GridGraph::Place place, std::uint32_t element, GaussianInteger uv, const Vec3& position, bool on_boundary) {
    graph_.vertices.push_back({place, element, uv});
    graph_.positions.push_back(position);
    graph_.is_on_boundary.push_back(on_boundary);
  }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(graph_.vertices.size()); }

  void find_at_points() {
    graph_.at_point.assign(mesh_.points.size(), no_index);
    for (std::uint32_t p = 0; p < mesh_.points.size(); ++p) {
      const std::uint32_t h = map_.first_out[p];
      if (h == no_index || !is_whole(map_.uv[h])) continue;
      graph_.at_point[p] = vertex_count();
      add(GridGraph::Place::point, p, map_.uv[h], mesh_.points[p], map_.opposite[h] == no_index);
    }
  }

  void find_on_edges() {
    graph_.first_on_edge.assign(map_.opposite.size() + 1, 0);
    for (std::uint32_t h = 0; h < map_.opposite.size(); ++h) {
      graph_.first_on_edge[h] = vertex_count();
      const std::uint32_t g = map_.opposite[h];
      if (g != no_index && g < h) continue;
      const GaussianInteger a = map_.uv[h], b = map_.uv[GridMap::next(h)], d = b - a;
      // Along the longer coordinate; the other must come out whole.
      const bool by_re = std::abs(d.re) >= std::abs(d.im);
      const auto along = [&](GaussianInteger z) { return by_re ? z.re : z.im; };
      const auto across = [&](GaussianInteger z) { return by_re ? z.im : z.re; };
      const std::int64_t from = along(a), to = along(b), step = to > from ? unit : -unit;
      for (std::int64_t x = step > 0 ? ceil_whole(from) : -ceil_whole(-from); step > 0 ? x < to : x > to; x += step) {
        if (x == from) continue;
        const Int128 rise = Int128(across(d)) * (x - from);
        if (rise % along(d) != 0) continue;
        const std::int64_t y = across(a) + static_cast<std::int64_t>(rise / along(d));
        if (y % unit != 0) continue;
        const double t = static_cast<double>(x - from) / static_cast<double>(to - from);
        add(GridGraph::Place::edge, h, by_re ? GaussianInteger{x, y} : GaussianInteger{y, x},
            between(point(h), point(GridMap::next(h)), t), g == no_index);
      }
    }
    graph_.first_on_edge.back() = vertex_count();
  }

  void find_in_triangles() {
    first_in_triangle_.assign(mesh_.triangles.size() + 1, 0);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      first_in_triangle_[t] = vertex_count();
      const GaussianInteger c[3] = {map_.uv[3 * t], map_.uv[3 * t + 1], map_.uv[3 * t + 2]};
      const std::int64_t low = std::min({c[0].im, c[1].im, c[2].im}), high = std::max({c[0].im, c[1].im, c[2].im});
      for (std::int64_t y = ceil_whole(low); y <= high; y += unit) {
        // Where the row enters and leaves the triangle, roughly; then exactly point by point.
        double from = 1e300, to = -1e300;
        for (int k = 0; k < 3; ++k) {
          const GaussianInteger a = c[k], b = c[(k + 1) % 3];
          if (std::min(a.im, b.im) > y || std::max(a.im, b.im) < y) continue;
          const double part = a.im == b.im ? 0 : static_cast<double>(y - a.im) / static_cast<double>(b.im - a.im);
          const double x = static_cast<double>(a.re) + part * static_cast<double>(b.re - a.re);
          from = std::min({from, x, a.im == b.im ? static_cast<double>(b.re) : x});
          to = std::max({to, x, a.im == b.im ? static_cast<double>(b.re) : x});
        }
        if (!(from <= to)) continue;
        const auto first = ceil_whole(static_cast<std::int64_t>(from)) - unit;
        for (std::int64_t x = first; static_cast<double>(x) <= to + static_cast<double>(unit); x += unit) {
          const GaussianInteger at{x, y};
          const Int128 w[3] = {area(c[1], c[2], at), area(c[2], c[0], at), area(c[0], c[1], at)};
          if (w[0] <= 0 || w[1] <= 0 || w[2] <= 0) continue;
          const double all = static_cast<double>(w[0] + w[1] + w[2]);
          Vec3 position;
          for (std::uint32_t k = 0; k < 3; ++k)
            position = position + (static_cast<double>(w[k]) / all) * point(3 * t + k);
          add(GridGraph::Place::triangle, t, at, position, false);
        }
      }
    }
    first_in_triangle_.back() = vertex_count();
  }

  /// Ports of `vertex` in [from, to) of a triangle, counter-clockwise; with `closed`, also along `to`.
  void add_ports(std::uint32_t vertex, std::uint32_t triangle, GaussianInteger from, GaussianInteger to, bool closed) {
    const auto is_inside = [&](GaussianInteger d) {
      // Half a turn or less: `to` may be −from.
      const int at_from = -turn_sign(d, from);
      return at_from == 0 ? points_along(d, from) : at_from > 0 && turn_sign(d, to) > 0;
    };
    std::vector<std::uint8_t> found;
    for (std::uint8_t k = 0; k < 4; ++k)
      if (is_inside(directions[k])) found.push_back(k);
    std::sort(found.begin(), found.end(),
              [&](std::uint8_t a, std::uint8_t b) { return turn_sign(directions[a], directions[b]) > 0; });
    for (const std::uint8_t k : found) graph_.ports.push_back({vertex, triangle, k, false});
    for (std::uint8_t k = 0; closed && k < 4; ++k)
      if (turn_sign(directions[k], to) == 0 && points_along(directions[k], to))
        graph_.ports.push_back({vertex, triangle, k, true});
  }

  void find_ports() {
    for (std::uint32_t v = 0; v < vertex_count(); ++v) {
      graph_.first_port.push_back(static_cast<std::uint32_t>(graph_.ports.size()));
      const GridGraph::Vertex& vertex = graph_.vertices[v];
      if (vertex.place == GridGraph::Place::triangle) {
        for (std::uint8_t k = 0; k < 4; ++k) graph_.ports.push_back({v, vertex.element, k, false});
      } else if (vertex.place == GridGraph::Place::edge) {
        for (std::uint32_t h = vertex.element; h != no_index;) {
          const GaussianInteger along = map_.uv[GridMap::next(h)] - map_.uv[h];
          const std::uint32_t g = map_.opposite[h];
          add_ports(v, h / 3, along, -along, g == no_index);
          h = h == vertex.element ? g : no_index;
        }
      } else {
        const std::uint32_t first = map_.first_out[vertex.element];
        for (std::uint32_t h = first;;) {
          const std::uint32_t g = map_.opposite[GridMap::previous(h)];
          add_ports(v, h / 3, map_.uv[GridMap::next(h)] - map_.uv[h], map_.uv[GridMap::previous(h)] - map_.uv[h],
                    g == no_index);
          if (g == no_index || g == first) break;
          h = g;
        }
      }
    }
    graph_.first_port.push_back(static_cast<std::uint32_t>(graph_.ports.size()));
  }

  /// Where a vertex lies in the chart of one of its triangles.
  GaussianInteger position_in(const GridGraph::Vertex& vertex, std::uint32_t triangle) const {
    if (vertex.place == GridGraph::Place::triangle) return vertex.uv;
    if (vertex.place == GridGraph::Place::edge)
      return vertex.element / 3 == triangle ? vertex.uv : map_.into(map_.opposite[vertex.element], vertex.uv);
    for (std::uint32_t h = 3 * triangle;; ++h)
      if (mesh_.triangles[h / 3][h % 3] == vertex.element) return map_.uv[h];
  }

  std::optional<Failure> follow(std::uint32_t port) {
    const GridGraph::Port& start = graph_.ports[port];
    std::uint32_t t = start.triangle;
    unsigned direction = start.direction;
    GaussianInteger from = position_in(graph_.vertices[start.vertex], t);
    GaussianInteger to = from + GaussianInteger{unit, 0} * directions[direction];
    // The path is moved aside by less than anything, to its left or (along the boundary) to its right, so that it
    // passes through no point.
    const int on_line = start.keeps_left ? 1 : -1;
    constexpr int step_limit = 1'000'000;
    for (int step = 0; step < step_limit; ++step) {
      int at_edge[3];
      for (std::uint32_t k = 0; k < 3; ++k) at_edge[k] = side(map_.uv[3 * t + k], map_.uv[3 * t + (k + 1) % 3], to);
      if (at_edge[0] >= 0 && at_edge[1] >= 0 && at_edge[2] >= 0) return arrive(port, t, direction, to, at_edge);
      std::uint32_t leave = no_index;
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const int a = side(from, to, map_.uv[h]), b = side(from, to, map_.uv[GridMap::next(h)]);
        if ((a == 0 ? on_line : a) < 0 && (b == 0 ? on_line : b) > 0) leave = h;
      }
      if (leave == no_index) return astray("a step of the grid is lost in triangle " + std::to_string(t));
      const std::uint32_t g = map_.opposite[leave];
      if (g == no_index) return std::nullopt;  // out of the domain
      from = map_.into(g, from);
      to = map_.into(g, to);
      direction = (direction + map_.turns[g]) & 3u;
      t = g / 3;
    }
    return astray("a step of the grid does not end, from " + place(start.vertex));
  }

  std::optional<Failure> arrive(std::uint32_t port, std::uint32_t t, unsigned direction, GaussianInteger at,
                                const int at_edge[3]) {
    const std::uint32_t vertex = vertex_at(t, at, at_edge);
    const auto lost = [&] {
      return astray("a step of the grid from " + place(graph_.ports[port].vertex) + " ends at no vertex");
    };
    if (vertex == no_index) return lost();
    const unsigned back = (direction + 2) & 3u;
    std::uint32_t found = port_of(vertex, t, back);
    if (found == no_index) {  // it lies on the far side of the wedge: the next triangle has it
      std::uint32_t g = no_index;
      if (graph_.vertices[vertex].place == GridGraph::Place::edge) {
        const std::uint32_t h = graph_.vertices[vertex].element;
        g = h / 3 == t ? map_.opposite[h] : h;
      } else if (graph_.vertices[vertex].place == GridGraph::Place::point) {
        std::uint32_t h = 3 * t;
        while (mesh_.triangles[t][h % 3] != graph_.vertices[vertex].element) ++h;
        g = map_.opposite[GridMap::previous(h)];
      }
      if (g != no_index) found = port_of(vertex, g / 3, back + map_.turns[g]);
    }
    if (found == no_index) return lost();
    graph_.partner[port] = found;
    return std::nullopt;
  }

  std::uint32_t port_of(std::uint32_t vertex, std::uint32_t triangle, unsigned direction) const {
    for (std::uint32_t p = graph_.first_port[vertex]; p < graph_.first_port[vertex + 1]; ++p)
      if (graph_.ports[p].triangle == triangle && graph_.ports[p].direction == (direction & 3u)) return p;
    return no_index;
  }

  std::uint32_t vertex_at(std::uint32_t t, GaussianInteger at, const int at_edge[3]) const {
    for (std::uint32_t k = 0; k < 3; ++k)
      if (map_.uv[3 * t + k] == at) return graph_.at_point[mesh_.triangles[t][k]];
    std::uint32_t first = first_in_triangle_[t], end = first_in_triangle_[t + 1];
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (at_edge[k] != 0) continue;
      const std::uint32_t h = 3 * t + k, g = map_.opposite[h];
      const std::uint32_t owner = g != no_index && g < h ? g : h;
      if (owner == g) at = map_.into(g, at);
      first = graph_.first_on_edge[owner];
      end = graph_.first_on_edge[owner + 1];
      break;
    }
    for (std::uint32_t v = first; v < end; ++v)
      if (graph_.vertices[v].uv == at) return v;
    return no_index;
  }

  const FeatureMesh& mesh_;
  const GridMap& map_;
  GridGraph graph_;
  std::vector<std::uint32_t> first_in_triangle_;  ///< per triangle, plus one
};

}  // namespace

Result<GridGraph> trace_grid(const FeatureMesh& mesh, const GridMap& map, std::size_t vertex_limit) {
  return GridTracer(mesh, map).run(vertex_limit);
}

}  // namespace strataflow
