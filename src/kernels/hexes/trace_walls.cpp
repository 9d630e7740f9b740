#include "kernels/hexes/trace_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "graph/parallel/parallel_map.h"

namespace strataflow {
namespace {

constexpr double snap = 1e-9;  // weights nearer to 0 or 1 are 0 or 1

class WallTracer {
 public:
  WallTracer(const LabelledTets& tets, const WallSheets& sheets, const std::vector<Vec3>& gravity)
      : tets_(tets), sheets_(sheets), is_line_(find_upright_lines(tets, sheets)) {
    for (const WallSheets::Wall& wall : sheets.walls) {
      Vec3 d = gravity[wall.tets[0]];
      if (wall.tets[1] != no_index) d = 0.5 * (d + gravity[wall.tets[1]]);
      directions_.push_back(d);
      rates_.push_back(rates_in(wall, d));
    }
    corner_rates_ = parallel_map(
        sheets.walls.size(), [&](std::size_t w) { return rates_at_corners(sheets_.walls[w]); }, 256);
  }

  TracedWalls trace() {
    TracedWalls traced;
    find_lower_edges(traced);
    struct Found {
      std::optional<UprightConstraint> constraint;
      std::uint32_t conflicts = 0, stuck = 0;
    };
    const std::vector<Found> found = parallel_map(
        tets_.points.size(),
        [&](std::size_t p) {
          Found result;
          const auto point = static_cast<std::uint32_t>(p);
          const std::vector<std::uint32_t> around = sheets_.sheets_at(point);
          if (around.size() > 1)
            if (const std::uint32_t below = next_on_shared_line(point, around); below != no_index) {
              result.constraint = UprightConstraint{point, below, below, 1, around[0]};
              return result;
            }
          for (const std::uint32_t sheet : around) {
            if (is_low(point, sheet)) continue;
            const auto one = follow(point, sheet);
            result.stuck += one ? 0 : 1;
            if (one && result.constraint) ++result.conflicts;
            if (one && !result.constraint) result.constraint = one;
          }
          return result;
        },
        64);
    for (const Found& one : found) {
      if (one.constraint) traced.constraints.push_back(*one.constraint);
      traced.conflicts += one.conflicts;
      traced.stuck += one.stuck;
    }
    return traced;
  }

 private:
  using Rates = std::array<double, 3>;  // how fast the weights of a triangle's corners grow along the field

  Rates rates_in(const WallSheets::Wall& wall, const Vec3& d) const {
    const Vec3 &a = tets_.points[wall.vertices[0]], &b = tets_.points[wall.vertices[1]],
               &c = tets_.points[wall.vertices[2]];
    const Vec3 ab = b - a, ac = c - a;
    const double bb = dot(ab, ab), cc = dot(ac, ac), bc = dot(ab, ac), db = dot(d, ab), dc = dot(d, ac);
    const double determinant = bb * cc - bc * bc;
    const double of_b = (cc * db - bc * dc) / determinant, of_c = (bb * dc - bc * db) / determinant;
    return {-of_b - of_c, of_b, of_c};
  }

  Vec3 down(std::uint32_t edge) const { return down_edge(tets_, sheets_.edges[edge]); }

  /// The field made continuous over a sheet, so that what goes down it never meets: at each corner the mean of the
  /// triangles around, or along the upright line it lies on.
  std::array<Rates, 3> rates_at_corners(const WallSheets::Wall& wall) const {
    std::array<Vec3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 of_lines, of_walls;
      for (const std::uint32_t e : sheets_.point_edges[wall.vertices[k]])
        if (is_line_[e] && sheets_.is_in_sheet(e, wall.sheet)) of_lines = of_lines + down(e);
      for (const std::uint32_t w : sheets_.point_walls[wall.vertices[k]])
        if (sheets_.walls[w].sheet == wall.sheet) of_walls = of_walls + directions_[w];
      corner[k] = of_lines.z < 0 ? (-1 / of_lines.z) * of_lines : (-1 / of_walls.z) * of_walls;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (is_line_[wall.edges[k]]) corner[k] = corner[(k + 1) % 3] = down(wall.edges[k]);
    return {rates_in(wall, corner[0]), rates_in(wall, corner[1]), rates_in(wall, corner[2])};
  }

  /// The rates at a place in a triangle.
  Rates rates_at(std::uint32_t wall, const Rates& place) const {
    Rates sum{};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += place[j] * corner_rates_[wall][j][k];
    return sum;
  }

  static std::uint32_t corner_of(const WallSheets::Wall& wall, std::uint32_t point) {
    return wall.vertices[0] == point ? 0u : wall.vertices[1] == point ? 1u : 2u;
  }
  /// The corner of a wall that an edge of it does not touch.
  std::uint32_t opposite(std::uint32_t wall, std::uint32_t edge) const {
    for (std::uint32_t k = 0; k < 3; ++k)
      if (sheets_.walls[wall].edges[k] == edge) return (k + 2) % 3;
    return 0;
  }
  double size_of(std::uint32_t wall) const {
    const Rates& r = rates_[wall];
    return std::abs(r[0]) + std::abs(r[1]) + std::abs(r[2]);
  }

  void find_lower_edges(TracedWalls& traced) {
    low_sheets_.resize(tets_.points.size());
    for (std::uint32_t e = 0; e < sheets_.edges.size(); ++e)
      for (const std::uint32_t wall : sheets_.edges[e].walls) {
        if (sheets_.across(wall, e) != no_index || is_upright_line(e)) continue;
        if (!(rates_[wall][opposite(wall, e)] < -snap * size_of(wall))) continue;
        const std::uint32_t sheet = sheets_.walls[wall].sheet;
        traced.lower_edges.push_back({sheet, e});
        for (const std::uint32_t p : sheets_.edges[e].points) low_sheets_[p].push_back(sheet);
      }
    std::sort(traced.lower_edges.begin(), traced.lower_edges.end(),
              [](const auto& a, const auto& b) { return a.sheet != b.sheet ? a.sheet < b.sheet : a.edge < b.edge; });
  }

  bool is_low(std::uint32_t point, std::uint32_t sheet) const {
    return std::count(low_sheets_[point].begin(), low_sheets_[point].end(), sheet) > 0;
  }

  double height(std::uint32_t point) const { return tets_.points[point].z; }
  std::uint32_t other_end(std::uint32_t edge, std::uint32_t point) const {
    const auto& ends = sheets_.edges[edge].points;
    return ends[0] == point ? ends[1] : ends[0];
  }
  double descent(std::uint32_t edge, std::uint32_t from) const {
    const Vec3 along = tets_.points[other_end(edge, from)] - tets_.points[from];
    return -along.z / length(along);
  }

  bool is_upright_line(std::uint32_t edge) const { return is_line_[edge] != 0; }

  /// Down the steepest edge that most of the point's sheets share; no_index where no two share one.
  std::uint32_t next_on_shared_line(std::uint32_t point, const std::vector<std::uint32_t>& around) const {
    std::uint32_t best = no_index, most = 1;
    for (const std::uint32_t edge : sheets_.point_edges[point]) {
      if (!(descent(edge, point) > upright_sine)) continue;
      std::uint32_t shared = 0;
      for (const std::uint32_t sheet : around) shared += sheets_.is_in_sheet(edge, sheet) ? 1 : 0;
      if (shared > most || (shared == most && best != no_index && descent(edge, point) > descent(best, point))) {
        most = shared;
        best = edge;
      }
    }
    return best == no_index ? no_index : other_end(best, point);
  }

  /// How well an edge down from a point agrees with the field beside it: the mean cosine.
  double agreement(std::uint32_t edge, std::uint32_t from, std::uint32_t sheet) const {
    const Vec3 along = tets_.points[other_end(edge, from)] - tets_.points[from];
    double sum = 0, count = 0;
    for (const std::uint32_t wall : sheets_.edges[edge].walls) {
      if (sheets_.walls[wall].sheet != sheet) continue;
      sum += dot(along, directions_[wall]) / (length(along) * length(directions_[wall]));
      ++count;
    }
    return sum / count;
  }

  std::optional<UprightConstraint> follow(std::uint32_t start, std::uint32_t sheet) const {
    std::uint32_t at = start, edge = no_index, from = no_index;  // at a point, or on an edge coming out of a triangle
    double weight = 0;                                           // on an edge: of its first point
    const std::size_t most_steps = 3 * sheets_.walls.size() + 10;
    for (std::size_t step = 0; step < most_steps; ++step) {
      if (edge != no_index) {
        const auto& ends = sheets_.edges[edge].points;
        if (weight <= snap || weight >= 1 - snap) {
          at = ends[weight <= snap ? 1 : 0];
          edge = no_index;
          continue;
        }
        const std::uint32_t wall = sheets_.across(from, edge);
        if (wall == no_index && !is_upright_line(edge))
          return UprightConstraint{start, ends[0], ends[1], weight, sheet};
        if (wall != no_index) {
          const WallSheets::Wall& w = sheets_.walls[wall];
          const std::uint32_t c = opposite(wall, edge), a = (c + 1) % 3, b = (c + 2) % 3;
          Rates place{};
          place[a] = ends[0] == w.vertices[a] ? weight : 1 - weight;
          place[b] = 1 - place[a];
          if (rates_at(wall, place)[c] > snap * size_of(wall)) {
            if (!cross_wall(wall, place, edge, weight)) return std::nullopt;
            from = wall;
            continue;
          }
        }
        at = height(ends[0]) < height(ends[1]) ? ends[0] : ends[1];  // both sides push onto the edge, or it is a corner
        edge = no_index;
        continue;
      }
      if (at != start && is_low(at, sheet)) return UprightConstraint{start, at, at, 1, sheet};
      if (at != start)
        if (const std::vector<std::uint32_t> around = sheets_.sheets_at(at); around.size() > 1)
          if (const std::uint32_t below = next_on_shared_line(at, around); below != no_index) {
            at = below;
            continue;
          }
      bool is_inside = false;
      for (const std::uint32_t wall : sheets_.point_walls[at]) {
        if (sheets_.walls[wall].sheet != sheet) continue;
        const std::uint32_t k = corner_of(sheets_.walls[wall], at), l = (k + 1) % 3, m = (k + 2) % 3;
        const Rates& rate = corner_rates_[wall][k];
        if (!(rate[l] >= 0 && rate[m] >= 0 && rate[l] + rate[m] > 0)) continue;
        if (const double little = snap * size_of(wall); rate[l] <= little || rate[m] <= little) {  // along an edge
          at = sheets_.walls[wall].vertices[rate[l] <= little ? m : l];
        } else {
          Rates place{};
          place[k] = 1;
          if (!cross_wall(wall, place, edge, weight)) return std::nullopt;
          from = wall;
        }
        is_inside = true;
        break;
      }
      if (is_inside) continue;
      // Both triangles beside some edge push onto it.
      std::uint32_t best = no_index;
      double most = 0;
      for (const std::uint32_t e : sheets_.point_edges[at])
        if (sheets_.is_in_sheet(e, sheet) && descent(e, at) > 0 && agreement(e, at, sheet) > most) {
          most = agreement(e, at, sheet);
          best = e;
        }
      if (best == no_index) return std::nullopt;
      at = other_end(best, at);
    }
    return std::nullopt;
  }

  /// From a place in a triangle to the edge that the field leaves it by; false where it does not get there.
  bool cross_wall(std::uint32_t wall, Rates place, std::uint32_t& edge, double& weight) const {
    constexpr double step_share = 0.1;  // of a triangle
    constexpr int most_steps = 2000;
    const WallSheets::Wall& w = sheets_.walls[wall];
    double fastest = 0;
    for (const Rates& rate : corner_rates_[wall])
      for (const double r : rate) fastest = std::max(fastest, std::abs(r));
    const double time = step_share / fastest;
    for (int step = 0; step < most_steps; ++step) {
      const Rates here = rates_at(wall, place);
      Rates middle = place;
      for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.5 * time * here[k];
      Rates rate = rates_at(wall, middle);
      for (std::size_t k = 0; k < 3; ++k)
        if (!(place[k] > 0) && rate[k] < 0) rate = here;  // it came in here, so it does not go out at once
      double share = 1;
      std::uint32_t gone = 3;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const double after = place[k] + time * rate[k];
        if (after > 0 || !(rate[k] < 0) || !(place[k] / (place[k] - after) < share)) continue;
        share = place[k] / (place[k] - after);
        gone = k;
      }
      for (std::size_t k = 0; k < 3; ++k) place[k] += share * time * rate[k];
      if (gone == 3) continue;
      const std::uint32_t a = (gone + 1) % 3, b = (gone + 2) % 3;
      edge = w.edges[a];  // edge k runs from corner k to corner k + 1
      const double of_a = place[a] / (place[a] + place[b]);
      weight = sheets_.edges[edge].points[0] == w.vertices[a] ? of_a : 1 - of_a;
      return true;
    }
    return false;
  }

  const LabelledTets& tets_;
  const WallSheets& sheets_;
  std::vector<char> is_line_;                           // per edge
  std::vector<Vec3> directions_;                        // per wall
  std::vector<Rates> rates_;                            // per wall: along the field
  std::vector<std::array<Rates, 3>> corner_rates_;      // per wall and corner of it
  std::vector<std::vector<std::uint32_t>> low_sheets_;  // per point: sheets whose lower edges it is on
};

}  // namespace

TracedWalls trace_walls(const LabelledTets& tets, const WallSheets& sheets, const std::vector<Vec3>& gravity) {
  return WallTracer(tets, sheets, gravity).trace();
}

}  // namespace strataflow
