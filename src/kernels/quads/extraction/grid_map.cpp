#include "kernels/quads/extraction/grid_map.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>

#include "base/id.h"
#include "kernels/quads/plan/plane_geometry.h"
#include "kernels/topology/building/edge_table.h"

namespace strataflow {

namespace {

using Complex = std::complex<double>;

Failure broken(const std::string& what) {
  return Failure{FailureCode::geometry_failed, what, "this map cannot be turned into quads; try another edge length"};
}

double off_integer(double x) { return std::abs(x - std::nearbyint(x)); }

class MapRounding {
 public:
  MapRounding(const FeatureMesh& mesh, const CornerMap& map, double tolerance)
      : mesh_(mesh), map_(map), tolerance_(tolerance) {}

  Result<GridMap> run() {
    if (const auto failure = check_sizes()) return *failure;
    if (const auto failure = link()) return *failure;
    if (const auto failure = round_shifts()) return *failure;
    if (const auto failure = round_points()) return *failure;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (side(grid_.uv[3 * t], grid_.uv[3 * t + 1], grid_.uv[3 * t + 2]) <= 0)
        return broken("the map turns over triangle " + std::to_string(t) + " at " + place(mesh_.triangles[t][0]));
    return std::move(grid_);
  }

 private:
  std::string place(std::uint32_t point) const { return place_text(mesh_.points[point], mesh_.local_origin); }
  std::uint32_t origin(std::uint32_t h) const { return mesh_.triangles[h / 3][h % 3]; }

  std::optional<Failure> check_sizes() const {
    const std::size_t corners = 3 * mesh_.triangles.size();
    if (map_.uv.size() != corners || map_.turns.size() != corners || map_.axes.size() != corners)
      return broken("the map does not belong to the mesh");
    constexpr double largest = 0x1.0p24;
    for (std::size_t c = 0; c < corners; ++c)
      if (!(std::abs(map_.uv[c][0]) < largest) || !(std::abs(map_.uv[c][1]) < largest))
        return broken("the map is not finite at " + place(mesh_.triangles[c / 3][c % 3]));
    return std::nullopt;
  }

  std::optional<Failure> link() {
    const EdgeTable table = build_edge_table(mesh_.points.size(), mesh_.triangles);
    grid_.opposite.assign(3 * mesh_.triangles.size(), no_index);
    for (std::uint32_t e = 0; e < table.edge_count(); ++e) {
      const auto around = table.around(e);
      if (around.size() > 2 || (around.size() == 2 && origin(around[0]) == origin(around[1])))
        return broken("the mesh is not an oriented manifold at " + place(table.edges[e][0]));
      if (around.size() < 2) continue;
      grid_.opposite[around[0]] = around[1];
      grid_.opposite[around[1]] = around[0];
    }
    grid_.first_out.assign(mesh_.points.size(), no_index);
    for (std::uint32_t h = 0; h < grid_.opposite.size(); ++h) {
      std::uint32_t& first = grid_.first_out[origin(h)];
      if (first == no_index || grid_.opposite[h] == no_index) first = h;
    }
    return std::nullopt;
  }

  std::optional<Failure> round_shifts() {
    grid_.turns.assign(grid_.opposite.size(), 0);
    grid_.shift.assign(grid_.opposite.size(), {});
    for (std::uint32_t h = 0; h < grid_.opposite.size(); ++h) {
      const std::uint32_t g = grid_.opposite[h];
      if (g == no_index || g < h) continue;
      const unsigned turns = map_.turns[h] & 3u;
      if (((turns + map_.turns[g]) & 3u) != 0)
        return broken("the turns of the map differ across the edge at " + place(origin(h)));
      const Complex from = map_.at(h) - turned(map_.at(GridMap::next(g)), static_cast<int>(turns));
      const Complex to = map_.at(GridMap::next(h)) - turned(map_.at(g), static_cast<int>(turns));
      const Complex shift{std::nearbyint(0.5 * (from.real() + to.real())),
                          std::nearbyint(0.5 * (from.imag() + to.imag()))};
      if (!(std::abs(from - shift) <= tolerance_) || !(std::abs(to - shift) <= tolerance_))
        return broken("the map jumps by no whole number of quads across the edge at " + place(origin(h)));
      grid_.turns[h] = static_cast<std::uint8_t>(turns);
      grid_.turns[g] = static_cast<std::uint8_t>((4 - turns) & 3u);
      grid_.shift[h] = {static_cast<std::int64_t>(shift.real()) * GridMap::unit,
                        static_cast<std::int64_t>(shift.imag()) * GridMap::unit};
      grid_.shift[g] = -turned(grid_.shift[h], grid_.turns[g]);
    }
    return std::nullopt;
  }

  std::optional<Failure> round_points() {
    grid_.uv.assign(grid_.opposite.size(), {});
    std::vector<char> is_set(grid_.opposite.size(), 0);
    for (std::uint32_t p = 0; p < mesh_.points.size(); ++p) {
      const std::uint32_t first = grid_.first_out[p];
      if (first == no_index) continue;
      bool whole_re = std::binary_search(mesh_.corners.begin(), mesh_.corners.end(), p), whole_im = whole_re;
      unsigned turns = 0;  // from the first chart into the current one
      const auto hold = [&](MapAxis axis) {
        if (axis == MapAxis::none) return;
        ((axis == MapAxis::real) == (turns % 2 == 0) ? whole_im : whole_re) = true;
      };
      std::uint32_t h = first;
      for (;;) {
        hold(map_.axes[h]);
        const std::uint32_t incoming = GridMap::previous(h), g = grid_.opposite[incoming];
        if (g == no_index) {
          hold(map_.axes[incoming]);
          break;
        }
        turns = (turns + grid_.turns[g]) & 3u;
        h = g;
        if (h == first) break;
      }
      const bool is_inside = grid_.opposite[first] != no_index;
      if (is_inside && turns != 0) whole_re = whole_im = true;
      const Complex value = map_.at(first);
      if ((whole_re && off_integer(value.real()) > tolerance_) || (whole_im && off_integer(value.imag()) > tolerance_))
        return broken("the map has no whole coordinate at " + place(p) + ", where " +
                      asks_for(p, turns != 0 && is_inside));
      const auto rounded = [](double x, bool whole) {
        return whole ? static_cast<std::int64_t>(std::nearbyint(x)) * GridMap::unit
                     : static_cast<std::int64_t>(std::nearbyint(x * static_cast<double>(GridMap::unit)));
      };
      GaussianInteger at{rounded(value.real(), whole_re), rounded(value.imag(), whole_im)};
      for (h = first;;) {
        grid_.uv[h] = at;
        is_set[h] = 1;
        const Complex wanted = map_.at(h), got = Complex(double(at.re), double(at.im)) / double(GridMap::unit);
        if (!(std::abs(wanted - got) <= 4 * tolerance_)) return broken("the map is not continuous at " + place(p));
        const std::uint32_t g = grid_.opposite[GridMap::previous(h)];
        if (g == no_index) break;
        at = grid_.into(g, at);
        h = g;
        if (h == first) break;
      }
      if (is_inside && at != grid_.uv[first]) return broken("the map does not close around " + place(p));
    }
    for (std::uint32_t h = 0; h < is_set.size(); ++h)
      if (!is_set[h]) return broken("the mesh is not manifold at " + place(origin(h)));
    return std::nullopt;
  }

  std::string asks_for(std::uint32_t p, bool is_singular) const {
    if (is_singular) return "a singular point needs one";
    for (const FeatureEdge& e : mesh_.edges)
      if (e.a == p || e.b == p) return "\"" + mesh_.features[e.feature].name + "\" needs one";
    return "a required point needs one";
  }

  const FeatureMesh& mesh_;
  const CornerMap& map_;
  double tolerance_;
  GridMap grid_;
};

}  // namespace

std::uint32_t GridMap::half_edge_between(const FeatureMesh& mesh, std::uint32_t a, std::uint32_t b) const {
  const auto origin = [&](std::uint32_t h) { return mesh.triangles[h / 3][h % 3]; };
  std::uint32_t h = first_out[a];
  for (const std::uint32_t first = h; h != no_index;) {
    if (origin(next(h)) == b) return h;
    const std::uint32_t incoming = previous(h);
    if (origin(incoming) == b) return incoming;
    h = opposite[incoming];
    if (h == first) break;
  }
  return no_index;
}

Result<GridMap> exact_grid_map(const FeatureMesh& mesh, const CornerMap& map, double tolerance) {
  return MapRounding(mesh, map, tolerance).run();
}

}  // namespace strataflow
