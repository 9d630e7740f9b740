#include "kernels/quads/extraction/imprint_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "base/id.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/plan/plane_geometry.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

constexpr std::int64_t unit = GridMap::unit;
using Side = std::array<std::uint32_t, 2>;  // points of the quads, ascending

Side side_between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }
std::int64_t floor_whole(std::int64_t x) { return (x - ((x % unit) + unit) % unit); }

/// Where a curve meets the grid: a vertex, or a place on a side of quads.
struct Event {
  std::uint32_t vertex = no_index;
  Side side{no_index, no_index};
  double along = 0;  // 0 … 1, from side[0]
  double arc_m = 0;
};

/// A curve from corner to corner, or closed: events and the quads between them.
struct Trail {
  std::vector<std::uint32_t> features;
  std::vector<Vec3> points;
  std::vector<double> arc_m;  // per point
  std::vector<Event> events;
  std::vector<std::uint32_t> quads;  // after each event; the last only of a closed curve
  bool is_closed = false;

  Vec3 at(double s) const {
    if (is_closed && s > arc_m.back()) s -= arc_m.back();
    const auto found = std::upper_bound(arc_m.begin(), arc_m.end(), s) - arc_m.begin();
    const auto i = std::clamp<std::size_t>(static_cast<std::size_t>(found), 1, points.size() - 1);
    return between(points[i - 1], points[i], (s - arc_m[i - 1]) / (arc_m[i] - arc_m[i - 1]));
  }
};

/// A corner of a cell, and where it lies in the unit square of its quad.
struct Corner {
  std::uint32_t point;
  double x, y;
};
using Cell = std::vector<Corner>;

class CurveImprint {
 public:
  CurveImprint(const FeatureMesh& mesh, const std::vector<FeatureEdge>& loose, double snap, const QuadsOnGrid& grid)
      : mesh_(mesh), loose_(loose), snap_(snap), grid_(grid), quads_(grid_.quads) {}

  Result<ImprintedCurves> run() {
    spread_quads();
    if (const auto failure = trace_curves()) return *failure;
    snap_to_vertices();
    place_nodes();
    if (const auto failure = split_cells()) return *failure;
    return subdivide();
  }

 private:
  // ---- where the quads lie in the triangles

  /// A quad in the chart of a triangle that it overlaps: its first corner, and the direction of its first side.
  struct Placement {
    std::uint32_t quad, triangle;
    GaussianInteger corner;
    int direction;
    GaussianInteger at(std::int64_t x, std::int64_t y) const {
      return corner + turned(GaussianInteger{x, y}, direction);
    }
    GaussianInteger low() const {
      const GaussianInteger far = at(unit, unit);
      return {std::min(corner.re, far.re), std::min(corner.im, far.im)};
    }
  };

  std::uint32_t origin(std::uint32_t h) const { return mesh_.triangles[h / 3][h % 3]; }
  const GaussianInteger& uv(std::uint32_t h) const { return grid_.map.uv[h]; }

  GaussianInteger vertex_in(std::uint32_t v, std::uint32_t triangle) const {
    const GridGraph::Vertex& vertex = grid_.graph.vertices[v];
    if (vertex.place == GridGraph::Place::triangle) return vertex.uv;
    if (vertex.place == GridGraph::Place::edge)
      return vertex.element / 3 == triangle ? vertex.uv : grid_.map.into(grid_.map.opposite[vertex.element], vertex.uv);
    std::uint32_t h = 3 * triangle;
    while (origin(h) != vertex.element) ++h;
    return uv(h);
  }

  /// Whether the half-edge enters the open square.
  bool enters(std::uint32_t h, GaussianInteger low) const {
    const GaussianInteger a = uv(h), b = uv(GridMap::next(h));
    if (std::min(a.re, b.re) >= low.re + unit || std::max(a.re, b.re) <= low.re ||
        std::min(a.im, b.im) >= low.im + unit || std::max(a.im, b.im) <= low.im)
      return false;
    bool is_left = false, is_right = false;
    for (const GaussianInteger c :
         {low, low + GaussianInteger{unit, 0}, low + GaussianInteger{0, unit}, low + GaussianInteger{unit, unit}}) {
      is_left = is_left || side(a, b, c) > 0;
      is_right = is_right || side(a, b, c) < 0;
    }
    return is_left && is_right;
  }

  const Placement* placement(std::uint32_t triangle, GaussianInteger low) const {
    for (const std::uint32_t i : in_triangle_[triangle])
      if (placements_[i].low() == low) return &placements_[i];
    return nullptr;
  }

  /// From the port of each quad over all triangles that it overlaps.
  void spread_quads() {
    in_triangle_.resize(mesh_.triangles.size());
    for (std::uint32_t q = 0; q < quads_.quads.size(); ++q) {
      first_placement_.push_back(static_cast<std::uint32_t>(placements_.size()));
      const GridGraph::Port& port = grid_.graph.ports[grid_.first_port[q]];
      const auto add = [&](const Placement& p) {
        if (placement(p.triangle, p.low())) return;
        in_triangle_[p.triangle].push_back(static_cast<std::uint32_t>(placements_.size()));
        placements_.push_back(p);
      };
      add({q, port.triangle, vertex_in(port.vertex, port.triangle), port.direction});
      for (std::size_t next = first_placement_.back(); next < placements_.size(); ++next) {
        const Placement here = placements_[next];
        for (std::uint32_t h = 3 * here.triangle; h < 3 * here.triangle + 3; ++h) {
          const std::uint32_t g = grid_.map.opposite[h];
          if (g != no_index && enters(h, here.low()))
            add({q, g / 3, grid_.map.into(g, here.corner), (here.direction + grid_.map.turns[g]) & 3});
        }
      }
    }
    first_placement_.push_back(static_cast<std::uint32_t>(placements_.size()));
  }

  /// The place on the surface of (x, y) in the unit square of a quad, exactly found.
  std::optional<Vec3> locate(std::uint32_t quad, double x, double y) const {
    for (std::uint32_t i = first_placement_[quad]; i < first_placement_[quad + 1]; ++i) {
      const Placement& p = placements_[i];
      const GaussianInteger at = p.at(std::llround(x * unit), std::llround(y * unit));
      const std::uint32_t h = 3 * p.triangle;
      const Int128 w[3] = {area(uv(h + 1), uv(h + 2), at), area(uv(h + 2), uv(h), at), area(uv(h), uv(h + 1), at)};
      if (w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
      const auto all = static_cast<double>(w[0] + w[1] + w[2]);
      Vec3 sum;
      for (std::uint32_t k = 0; k < 3; ++k) sum = sum + (static_cast<double>(w[k]) / all) * mesh_.points[origin(h + k)];
      return sum;
    }
    return std::nullopt;
  }

  // ---- curves

  Failure fail(const Trail& trail, const std::string& what) const {
    return {FailureCode::geometry_failed,
            "'" + mesh_.features[trail.features[0]].name + "' cannot be laid into the quads: " + what,
            "ask for smaller quads, or leave that feature out"};
  }
  std::string place(const Vec3& p) const { return place_text(p, mesh_.local_origin); }

  std::optional<Failure> trace_curves() {
    point_of_.assign(grid_.graph.vertices.size(), no_index);
    for (std::uint32_t p = 0; p < grid_.vertex_of.size(); ++p) point_of_[grid_.vertex_of[p]] = p;
    std::vector<FeatureEdge> edges;  // where features coincide, once
    std::map<Side, std::vector<std::uint32_t>> features;
    for (const FeatureEdge& e : loose_) {
      features[{e.a, e.b}].push_back(e.feature);
      if (edges.empty() || edges.back().a != e.a || edges.back().b != e.b) edges.push_back({e.a, e.b, 0});
    }
    for (const auto& chain : feature_chains(edges, mesh_.corners, 0)) {
      Trail trail;
      trail.features = features.at(side_between(chain[0], chain[1]));
      if (const auto failure = trace(chain, trail)) return *failure;
      trails_.push_back(std::move(trail));
    }
    return std::nullopt;
  }

  std::uint32_t vertex_at(std::uint32_t point) const {
    const std::uint32_t v = grid_.graph.at_point[point];
    return v == no_index ? no_index : point_of_[v];
  }

  /// Which side or corner of the quad a place on its border is. What is on a line of the grid is told, not measured.
  std::optional<Event> border(const Placement& p, GaussianInteger at, bool on_re, bool on_im) const {
    const GaussianInteger local = turned(at - p.corner, -p.direction);
    if (p.direction % 2 == 1) std::swap(on_re, on_im);
    const auto& quad = quads_.quads[p.quad];
    const bool right = 2 * local.re > unit, up = 2 * local.im > unit;
    if (on_re && on_im) return Event{.vertex = quad[up ? (right ? 2 : 3) : (right ? 1 : 0)]};
    if (!on_re && !on_im) return std::nullopt;
    const double x = static_cast<double>(local.re) / unit, y = static_cast<double>(local.im) / unit;
    const std::size_t k = on_im ? (up ? 2 : 0) : (right ? 1 : 3);
    const double along = k == 0 ? x : k == 1 ? y : k == 2 ? 1 - x : 1 - y;
    Event event{.side = side_between(quad[k], quad[(k + 1) % 4])};
    event.along = event.side[0] == quad[k] ? along : 1 - along;
    return event;
  }

  struct Break {
    std::int64_t part = 0, whole = 1;  // share of the mesh edge
    bool on_re = false, on_im = false;
    bool operator<(const Break& other) const { return Int128(part) * other.whole < Int128(other.part) * whole; }
  };

  /// Where the mesh edge from a to b crosses lines of the grid, in order, from a itself on.
  static std::vector<Break> breaks_of(GaussianInteger a, GaussianInteger b) {
    std::vector<Break> breaks{{0, 1, a.re % unit == 0, a.im % unit == 0}};
    const bool along_re = a.re == b.re && breaks[0].on_re, along_im = a.im == b.im && breaks[0].on_im;
    for (const bool real : {true, false}) {
      const std::int64_t from = real ? a.re : a.im, to = real ? b.re : b.im;
      const std::int64_t low = std::min(from, to), high = std::max(from, to);
      for (std::int64_t x = floor_whole(low) + unit; x < high; x += unit)
        breaks.push_back({std::abs(x - from), high - low, real || along_re, !real || along_im});
    }
    std::sort(breaks.begin() + 1, breaks.end());
    std::size_t kept = 0;
    for (std::size_t i = 1; i < breaks.size(); ++i) {
      if (breaks[kept] < breaks[i]) {
        breaks[++kept] = breaks[i];
        continue;
      }
      breaks[kept].on_re = breaks[kept].on_re || breaks[i].on_re;
      breaks[kept].on_im = breaks[kept].on_im || breaks[i].on_im;
    }
    breaks.resize(kept + 1);
    return breaks;
  }

  /// The lower left corner of the square that the way from `at` towards b enters; along a line, the one to the left,
  /// or to the right.
  static GaussianInteger square_ahead(GaussianInteger at, GaussianInteger step, bool on_re, bool on_im, bool to_left) {
    GaussianInteger low{floor_whole(at.re), floor_whole(at.im)};
    const std::int64_t left_re = -step.im, left_im = step.re;
    const std::int64_t towards_re = step.re != 0 ? step.re : to_left ? left_re : -left_re;
    const std::int64_t towards_im = step.im != 0 ? step.im : to_left ? left_im : -left_im;
    if (on_re && towards_re < 0) low.re -= unit;
    if (on_im && towards_im < 0) low.im -= unit;
    return low;
  }

  std::optional<Failure> trace(const std::vector<std::uint32_t>& chain, Trail& trail) {
    for (const std::uint32_t p : chain) {
      const Vec3& x = mesh_.points[p];
      trail.arc_m.push_back(trail.points.empty() ? 0 : trail.arc_m.back() + length(x - trail.points.back()));
      trail.points.push_back(x);
    }
    const std::uint32_t first = vertex_at(chain.front()), last = vertex_at(chain.back());
    trail.is_closed = chain.front() == chain.back() && first == no_index;
    if (!trail.is_closed && (first == no_index || last == no_index))
      return fail(trail,
                  "it ends inside a quad at " + place(mesh_.points[first == no_index ? chain.front() : chain.back()]));
    if (!trail.is_closed) trail.events.push_back({.vertex = first});
    std::uint32_t quad = no_index, start_quad = no_index;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      std::uint32_t h = grid_.map.half_edge_between(mesh_, chain[i], chain[i + 1]);
      if (h == no_index) return fail(trail, "it leaves the mesh at " + place(mesh_.points[chain[i]]));
      // Always the triangle to the left, if there is one: a curve on a line of the grid keeps to one side.
      if (origin(h) != chain[i] && grid_.map.opposite[h] != no_index) h = grid_.map.opposite[h];
      const bool is_forward = origin(h) == chain[i];
      const GaussianInteger a = is_forward ? uv(h) : uv(GridMap::next(h)),
                            b = is_forward ? uv(GridMap::next(h)) : uv(h);
      for (const Break& at : breaks_of(a, b)) {
        const double share = static_cast<double>(at.part) / static_cast<double>(at.whole);
        const auto moved = [&](std::int64_t d) { return static_cast<std::int64_t>(Int128(d) * at.part / at.whole); };
        GaussianInteger here = a + GaussianInteger{moved(b.re - a.re), moved(b.im - a.im)};
        if (at.on_re) here.re = floor_whole(here.re + unit / 2);
        if (at.on_im) here.im = floor_whole(here.im + unit / 2);
        const GaussianInteger low = square_ahead(here, b - a, at.on_re, at.on_im, is_forward);
        const Placement* p = placement(h / 3, low);
        if (!p)
          return fail(trail, "there is no quad at " + place(between(trail.points[i], trail.points[i + 1], share)));
        if (p->quad == quad) continue;
        const bool is_start = quad == no_index;
        quad = p->quad;
        if (is_start) {
          start_quad = quad;
          if (!trail.is_closed) trail.quads.push_back(quad);
          continue;
        }
        auto event = border(*p, here, at.on_re, at.on_im);
        if (!event) return fail(trail, "it jumps at " + place(between(trail.points[i], trail.points[i + 1], share)));
        event->arc_m = trail.arc_m[i] + share * (trail.arc_m[i + 1] - trail.arc_m[i]);
        trail.events.push_back(*event);
        trail.quads.push_back(quad);
      }
    }
    if (!trail.is_closed) {
      trail.events.push_back({.vertex = last, .arc_m = trail.arc_m.back()});
    } else if (trail.events.size() < 3 || trail.quads.back() != start_quad) {
      return fail(trail, "it closes within a quad or two at " + place(trail.points[0]));
    }
    return std::nullopt;
  }

  /// Lets curves pass through vertices that they nearly meet: the nearest curve takes a vertex, over one stretch.
  void snap_to_vertices() {
    std::vector<char> is_held = boundary_points(quads_);
    for (const FeatureEdge& e : quads_.edges) is_held[e.a] = is_held[e.b] = 1;
    for (const std::uint32_t p : quads_.corner_points)
      if (p != no_index) is_held[p] = 1;
    struct Stretch {
      std::size_t trail = 0, first = 0, last = 0;
      bool is_taken = false;
    };
    std::vector<Stretch> taken(quads_.points.size());
    const auto take = [&](std::uint32_t vertex, std::size_t trail, std::size_t event) {
      Stretch& s = taken[vertex];
      if (is_held[vertex] || (s.is_taken && (s.trail != trail || event + 1 < s.first || event > s.last + 1))) return;
      s = {trail, s.is_taken ? std::min(s.first, event) : event, s.is_taken ? std::max(s.last, event) : event, true};
      trails_[trail].events[event].vertex = vertex;
    };
    struct Wish {
      double away;
      std::size_t trail, event;
      std::uint32_t vertex;
    };
    std::vector<Wish> wishes;
    for (std::size_t t = 0; t < trails_.size(); ++t)
      for (std::size_t e = 0; e < trails_[t].events.size(); ++e) {
        const Event& event = trails_[t].events[e];
        if (event.vertex != no_index) {
          wishes.push_back({-1, t, e, event.vertex});
        } else {
          const bool is_low = event.along < 0.5;
          const double away = is_low ? event.along : 1 - event.along;
          if (away < snap_) wishes.push_back({away, t, e, event.side[is_low ? 0 : 1]});
        }
      }
    std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
      return std::tie(a.away, a.trail, a.event) < std::tie(b.away, b.trail, b.event);
    });
    for (const Wish& wish : wishes) take(wish.vertex, wish.trail, wish.event);
    // A curve that has only just left a vertex on one of its sides, or is about to come back to it, has not been away.
    for (std::uint32_t p = 0; p < taken.size(); ++p)
      for (bool any = taken[p].is_taken; any;) {
        any = false;
        const Stretch s = taken[p];
        const auto& events = trails_[s.trail].events;
        for (const std::size_t e : {s.first - 1, s.last + 1})
          if (e < events.size() && events[e].vertex == no_index && (events[e].side[0] == p || events[e].side[1] == p)) {
            take(p, s.trail, e);
            any = true;
          }
      }
    moved_.assign(quads_.points.size(), {});
    for (std::uint32_t p = 0; p < taken.size(); ++p) {
      const Stretch& s = taken[p];
      if (!s.is_taken) continue;
      auto& events = trails_[s.trail].events;
      double arc = 0.5 * (events[s.first].arc_m + events[s.last].arc_m);
      for (std::size_t e = s.first; e <= s.last; ++e)
        if (events[e].side[0] == no_index) arc = events[e].arc_m;  // it meets the vertex anyway
      for (std::size_t e = s.first; e <= s.last; ++e) events[e].arc_m = arc;
      moved_[p] = trails_[s.trail].at(arc) - quads_.points[p];
      quads_.points[p] = quads_.points[p] + moved_[p];
    }
    for (Trail& trail : trails_) straighten(trail);
  }

  /// A curve that goes from one end of a side across it to the other end, or back, runs along it.
  static void straighten(Trail& trail) {
    for (std::size_t e = 1; e + 1 < trail.events.size();) {
      const Event& event = trail.events[e];
      const auto is_end = [&](const Event& other) {
        return other.vertex != no_index && (other.vertex == event.side[0] || other.vertex == event.side[1]);
      };
      if (event.vertex == no_index && is_end(trail.events[e - 1]) && is_end(trail.events[e + 1])) {
        trail.events.erase(trail.events.begin() + static_cast<std::ptrdiff_t>(e));
        trail.quads.erase(trail.quads.begin() + static_cast<std::ptrdiff_t>(e));
      } else {
        ++e;
      }
    }
  }

  // ---- cells

  /// New points on sides, and the quads as cells with them.
  void place_nodes() {
    for (Trail& trail : trails_)
      for (Event& event : trail.events) {
        if (event.vertex != no_index) continue;
        event.vertex = static_cast<std::uint32_t>(quads_.points.size());
        quads_.points.push_back(trail.at(event.arc_m));
        on_side_[event.side].push_back({event.along, event.vertex});
      }
    for (auto& [side, nodes] : on_side_) std::sort(nodes.begin(), nodes.end());
    moved_.resize(quads_.points.size());
    constexpr double x[4] = {0, 1, 1, 0}, y[4] = {0, 0, 1, 1};
    for (const auto& quad : quads_.quads) {
      Cell cell;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t n = (k + 1) % 4;
        cell.push_back({quad[k], x[k], y[k]});
        const auto found = on_side_.find(side_between(quad[k], quad[n]));
        if (found == on_side_.end()) continue;
        const bool is_forward = found->first[0] == quad[k];
        const auto& nodes = found->second;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          const auto& [along, node] = nodes[is_forward ? i : nodes.size() - 1 - i];
          const double s = is_forward ? along : 1 - along;
          cell.push_back({node, x[k] + s * (x[n] - x[k]), y[k] + s * (y[n] - y[k])});
        }
      }
      cells_.push_back({std::move(cell)});
    }
  }

  std::optional<Failure> split_cells() {
    for (const Trail& trail : trails_) {
      const std::size_t count = trail.events.size();
      for (std::size_t e = 0; e + (trail.is_closed ? 0 : 1) < count; ++e) {
        const Event &from = trail.events[e], &to = trail.events[(e + 1) % count];
        if (from.vertex == to.vertex) continue;
        const double end = e + 1 < count ? to.arc_m : to.arc_m + trail.arc_m.back();
        if (!split(cells_[trail.quads[e]], from.vertex, to.vertex))
          return fail(trail, "curves cross each other at " + place(trail.at(from.arc_m)));
        Piece& piece = pieces_[side_between(from.vertex, to.vertex)];
        if (piece.features.empty()) piece.middle = trail.at(0.5 * (from.arc_m + end));
        piece.features.insert(piece.features.end(), trail.features.begin(), trail.features.end());
      }
    }
    return std::nullopt;
  }

  /// Splits the cell that holds both points, unless they are neighbours in it.
  static bool split(std::vector<Cell>& cells, std::uint32_t a, std::uint32_t b) {
    for (Cell& cell : cells) {
      const auto find = [&](std::uint32_t p) {
        return std::find_if(cell.begin(), cell.end(), [&](const Corner& c) { return c.point == p; });
      };
      if (find(a) == cell.end() || find(b) == cell.end()) continue;
      std::rotate(cell.begin(), find(a), cell.end());
      const auto at = find(b);
      if (at == cell.begin() + 1 || at == cell.end() - 1) return true;
      Cell rest{cell.front()};
      rest.insert(rest.end(), at, cell.end());
      cell.erase(at + 1, cell.end());
      cells.push_back(std::move(rest));
      return true;
    }
    return false;
  }

  /// The middle of corners of a cell: in the map, moved along with them.
  Vec3 middle(std::uint32_t quad, std::span<const Corner> corners) const {
    const double share = 1.0 / static_cast<double>(corners.size());
    double x = 0, y = 0;
    Vec3 moved, mean;
    for (const Corner& c : corners) {
      x += share * c.x;
      y += share * c.y;
      moved = moved + share * moved_[c.point];
      mean = mean + share * quads_.points[c.point];
    }
    const std::optional<Vec3> found = locate(quad, x, y);
    return found ? *found + moved : mean;
  }

  Result<ImprintedCurves> subdivide() {
    ImprintedCurves out;
    const std::vector<std::uint32_t> valence = quad_valence(grid_.quads);
    std::vector<std::array<std::uint32_t, 4>> quads;
    std::map<Side, std::uint32_t> middle_of;
    for (std::uint32_t q = 0; q < cells_.size(); ++q)
      for (const Cell& cell : cells_[q]) {
        std::vector<std::uint32_t> middles;
        for (std::size_t k = 0; k < cell.size(); ++k) {
          const std::array<Corner, 2> ends{cell[k], cell[(k + 1) % cell.size()]};
          const Side side = side_between(ends[0].point, ends[1].point);
          const auto [place, is_new] = middle_of.try_emplace(side, static_cast<std::uint32_t>(quads_.points.size()));
          if (is_new) {
            const auto piece = pieces_.find(side);
            quads_.points.push_back(piece != pieces_.end() ? piece->second.middle : middle(q, ends));
            moved_.push_back({});
          }
          middles.push_back(place->second);
        }
        const auto centre = static_cast<std::uint32_t>(quads_.points.size());
        quads_.points.push_back(middle(q, cell));
        moved_.push_back({});
        for (std::size_t k = 0; k < cell.size(); ++k)
          quads.push_back({cell[k].point, middles[k], centre, middles[(k + cell.size() - 1) % cell.size()]});
      }
    std::vector<FeatureEdge> edges;
    const auto add = [&](Side side, std::uint32_t feature) {
      const std::uint32_t m = middle_of.at(side);
      for (const std::uint32_t end : side) edges.push_back({std::min(end, m), std::max(end, m), feature});
    };
    for (const FeatureEdge& e : quads_.edges) {
      std::uint32_t from = e.a;
      if (const auto found = on_side_.find({e.a, e.b}); found != on_side_.end())
        for (const auto& [along, node] : found->second) {
          add(side_between(from, node), e.feature);
          from = node;
        }
      add(side_between(from, e.b), e.feature);
    }
    for (const auto& [side, piece] : pieces_)
      for (const std::uint32_t feature : piece.features) add(side, feature);
    out.quads = std::move(quads_);
    out.quads.quads = std::move(quads);
    out.quads.edges = sorted_unique(std::move(edges));
    if (const Result<void> sound = check_quads(out.quads); !sound) return sound.failure();
    const std::vector<std::uint32_t> now = quad_valence(out.quads);
    const std::vector<char> is_boundary = boundary_points(out.quads);
    for (std::uint32_t p = 0; p < now.size(); ++p)
      if (!is_boundary[p] && now[p] != 4 && (p >= valence.size() || now[p] != valence[p])) out.created.push_back(p);
    return out;
  }

  struct Piece {
    std::vector<std::uint32_t> features;
    Vec3 middle;
  };

  const FeatureMesh& mesh_;
  const std::vector<FeatureEdge>& loose_;
  const double snap_;
  const QuadsOnGrid& grid_;  ///< as extracted
  QuadMesh quads_;           ///< as it becomes
  std::vector<Placement> placements_;
  std::vector<std::uint32_t> first_placement_;           ///< per quad, plus one
  std::vector<std::vector<std::uint32_t>> in_triangle_;  ///< per triangle: placements
  std::vector<std::uint32_t> point_of_;                  ///< per vertex of the graph
  std::vector<Trail> trails_;
  std::vector<Vec3> moved_;               ///< per point: how far it went to meet a curve
  std::vector<std::vector<Cell>> cells_;  ///< per quad
  std::map<Side, std::vector<std::pair<double, std::uint32_t>>> on_side_;  ///< new points, ascending
  std::map<Side, Piece> pieces_;                                           ///< of curves
};

}  // namespace

Result<ImprintedCurves> imprint_curves(const FeatureMesh& mesh, const QuadsOnGrid& grid,
                                       const std::vector<FeatureEdge>& loose, double snap) {
  return CurveImprint(mesh, loose, snap, grid).run();
}

}  // namespace strataflow
