#include "kernels/quads/quantization/decimate_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "base/internal_error.h"
#include "base/seed.h"

namespace strataflow {
namespace {

constexpr std::uint32_t outside = FlatMesh::outside;
using Wedge = std::vector<std::uint32_t>;  // half-edges out of one point, counter-clockwise, without gaps

class Decimator {
 public:
  Decimator(const FeatureMesh& mesh, const FlatMesh& flat, const CutChart& cut, const DecimateOptions& options)
      : options_(options) {
    const std::uint32_t count = flat.half_edge_count();
    result_.mesh = flat;
    result_.quarters = quarters_around(flat, mesh.points.size());
    result_.bearing = quarter_bearings(flat, cut, result_.quarters);
    result_.forms.resize(count);
    out_.assign(mesh.points.size(), outside);
    is_boundary_.assign(mesh.points.size(), 0);
    FlatMesh& m = result_.mesh;
    for (std::uint32_t h = 0; h < count; ++h) {
      result_.forms[h] = combine(cut.corners[FlatMesh::next(h)], 0, cut.corners[h], 2);
      const int turns = cut.turns[h / 3];
      m.vector[h] = turned(flat.vector[h], turns);
      m.axis[h] = turned(flat.axis[h], turns);
      if (flat.opposite[h] != outside) m.turns[h] = (flat.turns[h] + turns - cut.turns[flat.opposite[h] / 3]) & 3;
      out_[m.origin[h]] = h;
      if (flat.opposite[h] == outside) is_boundary_[flat.origin[h]] = is_boundary_[flat.end(h)] = 1;
    }
    is_alive_.assign(count / 3, 1);
    is_corner_.assign(mesh.points.size(), 0);
    for (const std::uint32_t p : mesh.corners) is_corner_[p] = 1;
  }

  DecimatedMap run() {
    classify();
    for (std::uint32_t h = 0; h < result_.mesh.half_edge_count(); ++h) restless_.push_back(h);
    settle();
    std::vector<std::uint32_t> order;
    for (std::uint32_t p = 0; p < out_.size(); ++p)
      if (is_removable_[p]) order.push_back(p);
    // A mixed order keeps the points that remain evenly spread, and with it all degrees small.
    std::sort(order.begin(), order.end(), [](std::uint32_t a, std::uint32_t b) { return mix64(a) < mix64(b); });
    for (std::size_t before = order.size() + 1; before != order.size();) {
      before = order.size();
      std::erase_if(order, [&](std::uint32_t p) {
        const bool is_removed = remove(p);
        settle();
        return is_removed;
      });
    }
    for (const std::uint32_t p : order) result_.kind[p] = rests_on_feature(p) ? PointKind::integer : PointKind::free;
    compact();
    return std::move(result_);
  }

 private:
  static std::uint32_t next(std::uint32_t h) { return FlatMesh::next(h); }
  static std::uint32_t before(std::uint32_t h) { return FlatMesh::before(h); }

  /// Half-edges out of p, counter-clockwise; at a curve or boundary from one of its edges.
  void collect(std::uint32_t p, Wedge& wedge) const {
    const FlatMesh& m = result_.mesh;
    std::uint32_t start = out_[p];
    for (std::uint32_t h = m.right_of(start); h != outside && h != out_[p]; h = m.right_of(h)) start = h;
    if (m.opposite[start] != outside) {  // closed: start on a curve if there is one
      start = out_[p];
      for (std::uint32_t h = start; m.curve[start] == 0;) {
        h = m.left_of(h);
        if (h == out_[p] || m.curve[h] != 0) {
          start = h;
          break;
        }
      }
    }
    wedge.assign(1, start);
    for (std::uint32_t h = m.left_of(start); h != outside && h != start; h = m.left_of(h)) wedge.push_back(h);
  }

  bool rests_on_feature(std::uint32_t p) const {
    Wedge wedge;
    collect(p, wedge);
    const auto& axis = result_.mesh.axis;
    return std::any_of(wedge.begin(), wedge.end(),
                       [&](std::uint32_t h) { return axis[h] != MapAxis::none || axis[before(h)] != MapAxis::none; });
  }

  void classify() {
    const FlatMesh& m = result_.mesh;
    result_.kind.assign(out_.size(), PointKind::gone);
    is_removable_.assign(out_.size(), 0);
    Wedge wedge;
    for (std::uint32_t p = 0; p < out_.size(); ++p) {
      if (out_[p] == outside) continue;
      collect(p, wedge);
      is_removable_[p] = !is_corner_[p] && is_regular(p, wedge);
      if (!is_removable_[p]) result_.kind[p] = PointKind::integer;
      if (!is_removable_[p] && !is_corner_[p] && m.opposite[wedge[0]] == outside) {
        // On a free boundary only what other features make of it is an integer.
        const bool is_free = std::all_of(wedge.begin(), wedge.end(), [&](std::uint32_t h) {
          return m.axis[h] == MapAxis::none && m.axis[before(h)] == MapAxis::none;
        });
        if (is_free) result_.kind[p] = PointKind::free;
      }
    }
  }

  bool is_regular(std::uint32_t p, const Wedge& wedge) const {
    const FlatMesh& m = result_.mesh;
    const bool is_closed = m.opposite[wedge[0]] != outside;
    std::vector<std::size_t> curves;
    for (std::size_t k = 0; k < wedge.size(); ++k)
      if (m.curve[wedge[k]] != 0) curves.push_back(k);
    if (curves.empty()) return result_.quarters[p] == 4;
    if (is_closed ? curves.size() != 2 || result_.quarters[p] != 4 : curves.size() != 1) return false;
    const std::uint32_t first = wedge[0], second = is_closed ? wedge[curves[1]] : before(wedge.back());
    if (m.curve[first] != m.curve[second]) return false;
    const std::size_t middle = is_closed ? curves[1] : wedge.size();
    if (!is_straight(wedge, 0, middle)) return false;
    return !is_closed || is_straight(wedge, middle, wedge.size());
  }

  /// Whether one feature or free boundary runs straight on along wedge[from … to).
  bool is_straight(const Wedge& wedge, std::size_t from, std::size_t to) const {
    const FlatMesh& m = result_.mesh;
    int quarters = 0, turns = 0;
    for (std::size_t k = from; k < to; ++k) {
      quarters += m.corner_quarters(wedge[k]);
      if (k + 1 < to) turns += m.turns[before(wedge[k])];
    }
    const std::uint32_t last = before(wedge[to - 1]);
    const MapAxis start = m.axis[wedge[from]], end = turned(m.axis[last], turns);
    if (start != end) return false;
    if (start == MapAxis::none) return !options_.keep_shape || is_collinear(wedge[from], last, turns);
    // An axis that the map does not follow leaves the quarters uncertain by one.
    const bool is_exact = follows(wedge[from]) && follows(last);
    if (!is_exact && options_.keep_shape && !is_collinear(wedge[from], last, turns)) return false;
    return is_exact ? quarters == 2 : quarters >= 1 && quarters <= 3 && is_forward(wedge[from], last, turns);
  }
  bool is_collinear(std::uint32_t out, std::uint32_t in, int turns) const {
    return is_flat(result_.mesh.vector[out], turned(result_.mesh.vector[in], turns)) && is_forward(out, in, turns);
  }
  /// Whether two vectors have the same direction but for rounding.
  static bool is_flat(GaussianInteger a, GaussianInteger b) {
    const double ax = static_cast<double>(a.re), ay = static_cast<double>(a.im), bx = static_cast<double>(b.re),
                 by = static_cast<double>(b.im);
    return std::abs(ax * by - ay * bx) <= 1e-8 * (std::abs(ax) + std::abs(ay)) * (std::abs(bx) + std::abs(by));
  }
  bool is_forward(std::uint32_t out, std::uint32_t in, int turns) const {
    const GaussianInteger a = result_.mesh.vector[out], b = turned(result_.mesh.vector[in], turns);
    return static_cast<double>(a.re) * static_cast<double>(b.re) +
               static_cast<double>(a.im) * static_cast<double>(b.im) >
           0;
  }
  bool follows(std::uint32_t h) const {
    const GaussianInteger v = result_.mesh.vector[h];
    return result_.mesh.axis[h] == MapAxis::real ? v.im == 0 : v.re == 0;
  }

  /// An edge that goes on in another place, its chart turned.
  struct Moved {
    std::uint32_t from, to;
    int turns;
  };

  void move(std::initializer_list<Moved> edges) {
    FlatMesh& m = result_.mesh;
    struct Copy {
      std::uint32_t origin, opposite, curve;
      std::int32_t bearing;
      GaussianInteger vector;
      int turns;
      MapAxis axis;
      LinearForm form;
    };
    std::array<Copy, 4> copies;
    std::size_t k = 0;
    for (const Moved& e : edges) {
      Copy& copy = copies[k++];
      const std::uint32_t opposite = m.opposite[e.from];
      copy = {m.origin[e.from],
              opposite,
              m.curve[e.from],
              result_.bearing[e.from],
              turned(m.vector[e.from], e.turns),
              m.turns[e.from] + e.turns,
              turned(m.axis[e.from], e.turns),
              std::move(result_.forms[e.from])};
      if (e.turns & 3) copy.form = combine(copy.form, e.turns, {}, 0);
      for (const Moved& other : edges)
        if (other.from == opposite) {
          copy.opposite = other.to;
          copy.turns -= other.turns;
        }
    }
    k = 0;
    for (const Moved& e : edges) {
      Copy& copy = copies[k++];
      m.origin[e.to] = copy.origin;
      m.opposite[e.to] = copy.opposite;
      m.curve[e.to] = copy.curve;
      m.vector[e.to] = copy.vector;
      m.axis[e.to] = copy.axis;
      m.turns[e.to] = copy.turns & 3;
      result_.bearing[e.to] = copy.bearing;
      result_.forms[e.to] = std::move(copy.form);
      out_[copy.origin] = e.to;
      if (copy.opposite != outside) {
        m.opposite[copy.opposite] = e.to;
        m.turns[copy.opposite] = -copy.turns & 3;
      }
      restless_.push_back(e.to);
    }
  }

  /// Closes a triangle whose first two edges are in place.
  void close(std::uint32_t h, std::uint32_t origin) {
    FlatMesh& m = result_.mesh;
    const std::uint32_t a = 3 * (h / 3), b = a + 1;
    m.origin[h] = origin;
    m.vector[h] = -(m.vector[a] + m.vector[b]);
    result_.forms[h] = combine(result_.forms[a], 2, result_.forms[b], 2);
    out_[origin] = h;
  }

  bool is_flippable(std::uint32_t h) const {
    const FlatMesh& m = result_.mesh;
    const std::uint32_t o = m.opposite[h];
    if (o == outside || m.curve[h] != 0 || o / 3 == h / 3) return false;
    return cross_sign(m.vector[before(h)], turned(m.vector[next(o)], m.turns[h])) > 0 &&
           cross_sign(m.vector[before(o)], turned(m.vector[next(h)], m.turns[o])) > 0;
  }

  void flip(std::uint32_t h) {
    FlatMesh& m = result_.mesh;
    const std::uint32_t o = m.opposite[h], t = 3 * (h / 3), u = 3 * (o / 3);
    const std::uint32_t c = m.origin[before(h)], d = m.origin[before(o)];
    const int turns = m.turns[h];
    move({{before(h), t, 0}, {next(o), t + 1, turns}, {before(o), u, 0}, {next(h), u + 1, -turns}});
    close(t + 2, d);
    close(u + 2, c);
    m.opposite[t + 2] = u + 2;
    m.opposite[u + 2] = t + 2;
    m.turns[t + 2] = turns & 3;
    m.turns[u + 2] = -turns & 3;
    m.curve[t + 2] = m.curve[u + 2] = 0;
    m.axis[t + 2] = m.axis[u + 2] = MapAxis::none;
    set_bearing(t + 2, result_.bearing[u] + m.corner_quarters(u));
    set_bearing(u + 2, result_.bearing[t] + m.corner_quarters(t));
    ++result_.flips;
  }

  void set_bearing(std::uint32_t h, int bearing) {
    const std::uint32_t p = result_.mesh.origin[h];
    const std::int32_t quarters = result_.quarters[p];
    result_.bearing[h] = is_boundary_[p] ? bearing : (bearing + quarters) % quarters;
  }
  bool is_delaunay(std::uint32_t h) const {
    const FlatMesh& m = result_.mesh;
    const std::uint32_t o = m.opposite[h];
    const double here = cotangent(before(h)), there = cotangent(before(o));
    return here + there >= -1e-10 * (std::abs(here) + std::abs(there));
  }
  /// Of the angle at the origin of h.
  double cotangent(std::uint32_t h) const {
    const GaussianInteger a = result_.mesh.vector[h], b = -result_.mesh.vector[before(h)];
    const double ax = static_cast<double>(a.re), ay = static_cast<double>(a.im), bx = static_cast<double>(b.re),
                 by = static_cast<double>(b.im);
    return (ax * bx + ay * by) / (ax * by - ay * bx);
  }

  /// Flips what is not Delaunay. Each flip lowers a bounded energy; the count guards against rounding.
  void settle() {
    std::uint64_t budget = 100 * restless_.size() + 10000;
    while (!restless_.empty()) {
      const std::uint32_t h = restless_.back();
      restless_.pop_back();
      if (!is_alive_[h / 3] || !is_flippable(h) || is_delaunay(h) || budget == 0) continue;
      --budget;
      flip(h);
    }
  }

  bool remove(std::uint32_t p) {
    Wedge wedge;
    collect(p, wedge);
    const FlatMesh& m = result_.mesh;
    if (m.curve[wedge[0]] == 0) {
      while (wedge.size() > 3) {
        if (!flip_one(wedge, 0, wedge.size()) && !flip_flat(p, wedge)) return false;
        collect(p, wedge);
      }
      if (wedge.size() != 3 || has_loop(p, wedge)) return false;
      merge_three(wedge);
      return true;
    }
    const bool is_closed = m.opposite[wedge[0]] != outside;
    for (;;) {
      const std::size_t middle = is_closed ? second_curve(wedge) : wedge.size();
      if (middle < 2 || (is_closed && wedge.size() - middle < 2)) return false;
      if (middle == 2 && (!is_closed || wedge.size() == 4)) break;
      const bool is_left = middle > 2;
      if (!(is_left ? flip_one(wedge, 1, middle) : flip_one(wedge, middle + 1, wedge.size()))) return false;
      collect(p, wedge);
    }
    return !has_loop(p, wedge) && merge_along_curve(wedge);
  }

  bool has_loop(std::uint32_t p, const Wedge& wedge) const {
    const FlatMesh& m = result_.mesh;
    return std::any_of(wedge.begin(), wedge.end(),
                       [&](std::uint32_t h) { return m.end(h) == p || m.origin[before(h)] == p; });
  }

  std::size_t second_curve(const Wedge& wedge) const {
    std::size_t k = 1;
    while (k < wedge.size() && result_.mesh.curve[wedge[k]] == 0) ++k;
    return k;
  }

  /// Flips one of the edges such that fewer edges end at their point, loops counted twice.
  bool flip_one(const Wedge& wedge, std::size_t from, std::size_t to) {
    const FlatMesh& m = result_.mesh;
    for (std::size_t k = from; k < to; ++k) {
      const std::uint32_t h = wedge[k], p = m.origin[h];
      if (!is_flippable(h)) continue;
      const int gone = 1 + (m.end(h) == p);
      const int come = (m.origin[before(h)] == p) + (m.origin[before(m.opposite[h])] == p);
      if (come >= gone) continue;
      flip(h);
      return true;
    }
    return false;
  }

  /// Where the last four edges form a cross, or two of them a line that hides the others, no flip leaves both triangles
  /// positive. One that leaves the point's triangle flat is then enough: it goes at once, with the point.
  bool flip_flat(std::uint32_t p, const Wedge& wedge) {
    const FlatMesh& m = result_.mesh;
    if (wedge.size() != 4 || has_loop(p, wedge)) return false;
    for (const std::uint32_t h : wedge) {
      const std::uint32_t o = m.opposite[h];
      if (o / 3 == h / 3 || cross_sign(m.vector[before(h)], turned(m.vector[next(o)], m.turns[h])) != 0 ||
          cross_sign(m.vector[before(o)], turned(m.vector[next(h)], m.turns[o])) <= 0)
        continue;
      flip(h);
      return true;
    }
    return false;
  }

  /// Three triangles around a point become the first of them.
  void merge_three(const Wedge& w) {
    const FlatMesh& m = result_.mesh;
    const std::uint32_t t = 3 * (w[0] / 3);
    const int from_second = m.turns[before(w[0])], from_third = m.turns[w[0]];
    is_alive_[w[1] / 3] = is_alive_[w[2] / 3] = 0;
    move({{next(w[0]), t, 0}, {next(w[1]), t + 1, from_second}, {next(w[2]), t + 2, from_third}});
    STRATAFLOW_ASSERT(m.is_positive(t / 3), "three positive triangles merged into one that is not");
  }

  /// Two triangles on each side of a curve become one, the curve's two edges one.
  bool merge_along_curve(const Wedge& w) {
    FlatMesh& m = result_.mesh;
    const bool is_closed = w.size() == 4;
    const std::uint32_t p = m.end(w[0]), q = m.origin[before(w[1])];
    const int across = m.turns[before(w[0])];
    const GaussianInteger in = turned(m.vector[before(w[1])], across);
    const bool is_straight = is_flat(m.vector[w[0]], in);
    if (!is_straight && options_.keep_shape) return false;
    if (cross_sign(m.vector[next(w[0])], turned(m.vector[next(w[1])], across)) <= 0) return false;
    const std::uint32_t t = 3 * (w[0] / 3), curve = m.curve[w[0]];
    const MapAxis axis = m.axis[w[0]];
    const std::int32_t bearing = result_.bearing[before(w[1])];
    if (!is_closed) {
      is_alive_[w[1] / 3] = 0;
      move({{next(w[0]), t, 0}, {next(w[1]), t + 1, across}});
      close(t + 2, q);
      m.opposite[t + 2] = outside;
      m.turns[t + 2] = 0;
    } else {
      const std::uint32_t u = 3 * (w[2] / 3);
      const int back = m.turns[before(w[2])];
      if (cross_sign(m.vector[next(w[2])], turned(m.vector[next(w[3])], back)) <= 0) return false;
      const int turns = across + m.turns[before(w[1])];
      const MapAxis other_axis = m.axis[w[2]];
      const std::int32_t other_bearing = result_.bearing[before(w[3])];
      const GaussianInteger other_in = turned(m.vector[before(w[3])], back);
      is_alive_[w[1] / 3] = is_alive_[w[3] / 3] = 0;
      move({{next(w[0]), t, 0}, {next(w[1]), t + 1, across}, {next(w[2]), u, 0}, {next(w[3]), u + 1, back}});
      close(t + 2, q);
      close(u + 2, p);
      m.opposite[t + 2] = u + 2;
      m.opposite[u + 2] = t + 2;
      m.turns[t + 2] = turns & 3;
      m.turns[u + 2] = -turns & 3;
      m.curve[u + 2] = curve;
      m.axis[u + 2] = other_axis;
      set_bearing(u + 2, other_bearing + quarter_step(other_in, m.vector[u + 2]));
    }
    m.curve[t + 2] = curve;
    m.axis[t + 2] = axis;
    set_bearing(t + 2, bearing + quarter_step(in, m.vector[t + 2]));
    result_.is_embedded = result_.is_embedded && is_straight;
    return true;
  }

  /// A straightened edge may leave its point in the quarter before or after.
  static int quarter_step(GaussianInteger before, GaussianInteger now) {
    const int step = (quadrant(now) - quadrant(before)) & 3;
    return step == 3 ? -1 : step;
  }

  /// Drops dead triangles; the others keep their order.
  void compact() {
    FlatMesh& m = result_.mesh;
    std::vector<std::uint32_t> place(is_alive_.size(), outside);
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < is_alive_.size(); ++t)
      if (is_alive_[t]) place[t] = count++;
    for (std::uint32_t h = 0; h < m.half_edge_count(); ++h) {
      if (!is_alive_[h / 3]) continue;
      const std::uint32_t to = 3 * place[h / 3] + h % 3, o = m.opposite[h];
      m.origin[to] = m.origin[h];
      m.opposite[to] = o == outside ? outside : 3 * place[o / 3] + o % 3;
      m.vector[to] = m.vector[h];
      m.turns[to] = m.turns[h];
      m.axis[to] = m.axis[h];
      m.curve[to] = m.curve[h];
      result_.bearing[to] = result_.bearing[h];
      if (to != h) result_.forms[to] = std::move(result_.forms[h]);
    }
    m.origin.resize(3 * count);
    m.opposite.resize(3 * count);
    m.vector.resize(3 * count);
    m.turns.resize(3 * count);
    m.axis.resize(3 * count);
    m.curve.resize(3 * count);
    result_.bearing.resize(3 * count);
    result_.forms.resize(3 * count);
  }

  DecimateOptions options_;
  DecimatedMap result_;
  std::vector<std::uint32_t> out_;  // per point: a half-edge out of it
  std::vector<std::uint8_t> is_alive_, is_corner_, is_removable_, is_boundary_;
  std::vector<std::uint32_t> restless_;  // half-edges to look at again
};

}  // namespace

std::vector<std::int32_t> quarters_around(const FlatMesh& flat, std::size_t point_count) {
  std::vector<std::int32_t> quarters(point_count, 0);
  for (std::uint32_t h = 0; h < flat.half_edge_count(); ++h) quarters[flat.origin[h]] += flat.corner_quarters(h);
  return quarters;
}

std::vector<std::int32_t> quarter_bearings(const FlatMesh& flat, const CutChart& cut,
                                           const std::vector<std::int32_t>& quarters) {
  std::vector<std::int32_t> bearing(flat.half_edge_count(), 0);
  for (std::uint32_t p = 0; p < cut.first_corner.size(); ++p) {
    const std::uint32_t first = cut.first_corner[p];
    if (first == outside) continue;
    bearing[first] = (quadrant(flat.vector[first]) + cut.turns[first / 3]) & 3;
    const bool is_closed = flat.opposite[first] != outside;
    for (std::uint32_t h = first, next = flat.left_of(h); next != outside && next != first;
         h = next, next = flat.left_of(h))
      bearing[next] =
          is_closed ? (bearing[h] + flat.corner_quarters(h)) % quarters[p] : bearing[h] + flat.corner_quarters(h);
  }
  return bearing;
}

DecimatedMap decimate_map(const FeatureMesh& mesh, const FlatMesh& flat, const CutChart& cut,
                          const DecimateOptions& options) {
  return Decimator(mesh, flat, cut, options).run();
}

}  // namespace strataflow
