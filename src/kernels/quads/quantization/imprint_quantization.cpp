#include "kernels/quads/quantization/imprint_quantization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {
namespace {

constexpr std::uint32_t outside = FlatMesh::outside;
constexpr double too_near = 1e-6;  // of an edge

Failure give_up(const std::string& what) {
  return {FailureCode::geometry_failed, "imprinting the integer map: " + what,
          "use a finer triangulation, or the constrained map instead"};
}

WideInteger wide_cross(GaussianInteger a, GaussianInteger b) {
  return WideInteger(a.re) * b.im - WideInteger(a.im) * b.re;
}
WideInteger wide_dot(GaussianInteger a, GaussianInteger b) {
  return WideInteger(a.re) * b.re + WideInteger(a.im) * b.im;
}

/// Where a triangle of the mesh lies in the chart of a decimated triangle: z ↦ i^turns · z + offset, both measured
/// from their first corners.
struct Placement {
  std::uint32_t triangle = outside;
  int turns = 0;
  GaussianInteger offset;
};

/// A point of the refinement: a point of the mesh, or where a path crosses an edge.
struct Node {
  std::uint32_t path = outside;  // decimated half-edge it lies on, the one that was traced
  double along_path = 0;         // 0 … 1
  std::uint32_t edge = outside;  // half-edge crossed, the lower of its two; outside: a point of the mesh
  double along_edge = 0;         // 0 … 1
  std::uint32_t end = outside;   // the point of the mesh that stands for it, if it is too near
};

/// A piece of a path inside a triangle, from node to node; left and right of it two decimated triangles.
struct Chord {
  std::uint32_t from, to;
  std::uint32_t left, right;  // placements; right may be outside
};

/// A part of a half-edge that a path runs along, and the placement of its face.
struct Wall {
  std::uint32_t from, to, placement;
};

/// A side of a face: with the half-edge it is part of, or a chord.
struct Side {
  std::uint32_t node;       // where it starts
  std::uint32_t half_edge;  // outside: a chord
  std::uint32_t placement;  // of the face, if this side is part of a path
};
using Face = std::vector<Side>;

class Imprint {
 public:
  Imprint(const FeatureMesh& mesh, const CornerMap& map, const Quantization& q)
      : mesh_(mesh), map_(map), q_(q), flat_(q.flat), coarse_(q.decimated.mesh) {}

  Result<ImprintedMap> run() {
    if (!q_.decimated.is_embedded) return give_up("curves were straightened; quantize with keep_shape");
    bearing_ = quarter_bearings(flat_, q_.cut, q_.decimated.quarters);
    nodes_.resize(mesh_.points.size());
    chords_.resize(mesh_.triangles.size());
    crossings_.resize(flat_.half_edge_count());
    walls_.resize(flat_.half_edge_count());
    for (std::uint32_t h = 0; h < coarse_.half_edge_count(); ++h)
      if (coarse_.opposite[h] == outside || h < coarse_.opposite[h])
        if (!trace(h))
          return give_up("the path from point " + std::to_string(coarse_.origin[h]) + " to " +
                         std::to_string(coarse_.end(h)) + " is lost");
    settle_crossings();
    if (auto problem = split_triangles()) return *problem;
    spread_placements();
    return write();
  }

 private:
  // ---- paths

  static GaussianInteger corner_at(const FlatMesh& m, std::uint32_t h) {
    return h % 3 == 0 ? GaussianInteger{} : h % 3 == 1 ? m.vector[h - 1] : m.vector[h - 2] + m.vector[h - 1];
  }

  struct Start {
    std::uint32_t corner = outside;
    GaussianInteger direction;  // in the chart of the corner's triangle
  };

  /// The corner of p, and the direction in its chart, that `bearing` and z (turned into its first quarter) name.
  Start locate(std::uint32_t p, std::int32_t bearing, GaussianInteger z) const {
    const GaussianInteger inside = turned(z, -quadrant(z));
    const std::uint32_t first = q_.cut.first_corner[p];
    const bool is_closed = flat_.opposite[first] != outside;
    const std::int32_t all = q_.decimated.quarters[p];
    std::uint32_t c = first;
    do {
      std::int32_t ahead = bearing - bearing_[c];
      if (is_closed) ahead = ((ahead % all) + all) % all;
      if (ahead >= 0 && ahead <= 2) {
        const GaussianInteger e = flat_.vector[c], d = turned(inside, quadrant(e) + ahead);
        const int left = cross_sign(e, d);
        if ((left > 0 || (left == 0 && wide_dot(e, d) > 0)) && cross_sign(d, -flat_.vector[FlatMesh::before(c)]) > 0)
          return {c, d};
      }
      c = flat_.left_of(c);
    } while (c != outside && c != first);
    return {};
  }

  /// Placements of triangle t left and right of the path h; `origin` is the path's start seen from t's first corner.
  std::array<std::uint32_t, 2> place(std::uint32_t h, int turns, GaussianInteger origin) {
    const std::uint32_t o = coarse_.opposite[h];
    placements_.push_back({h / 3, turns & 3, corner_at(coarse_, h) - turned(origin, turns)});
    const auto left = static_cast<std::uint32_t>(placements_.size()) - 1;
    if (o == outside) return {left, outside};
    const int other = turns + coarse_.turns[o];
    placements_.push_back({o / 3, other & 3, corner_at(coarse_, FlatMesh::next(o)) - turned(origin, other)});
    return {left, left + 1};
  }

  /// Marks half-edge c, and its opposite, as part of the path h. `turns` leads from the chart of c to that of the path,
  /// `gone` from the path's start to c.
  void add_wall(std::uint32_t h, std::uint32_t c, int turns, GaussianInteger gone) {
    const std::uint32_t from = flat_.origin[c], to = flat_.end(c), o = flat_.opposite[c];
    walls_[c].push_back({from, to, place(h, turns, corner_at(flat_, c) - turned(gone, -turns))[0]});
    if (o == outside) return;
    const int other = turns + flat_.turns[c];
    walls_[o].push_back({to, from, place(h, other, corner_at(flat_, FlatMesh::next(o)) - turned(gone, -other))[1]});
  }

  double share_of(GaussianInteger gone, GaussianInteger whole) const {
    return static_cast<double>(wide_dot(gone, whole)) / static_cast<double>(wide_dot(whole, whole));
  }

  /// The half-edge out of p along the curve of the path h: the nearest to its direction; and the turns to its chart.
  std::pair<std::uint32_t, int> start_of_curve(std::uint32_t h) const {
    const GaussianInteger whole = coarse_.vector[h], inside = turned(whole, -quadrant(whole));
    const std::uint32_t p = coarse_.origin[h], first = q_.cut.first_corner[p];
    const std::int32_t all = q_.decimated.quarters[p];
    std::pair<std::uint32_t, int> best{outside, 0};
    double nearest = 1e-3;
    std::uint32_t c = first;
    do {
      const std::int32_t gap = q_.decimated.bearing[h] - bearing_[c];
      for (const std::int32_t ahead : {-1, 0, 1}) {
        const bool fits = flat_.opposite[first] == outside ? gap == ahead : (gap - ahead) % all == 0;
        if (flat_.curve[c] != coarse_.curve[h] || !fits) continue;
        const GaussianInteger e = flat_.vector[c], d = turned(inside, quadrant(e) + ahead);
        const double off = std::abs(static_cast<double>(wide_cross(e, d)) / static_cast<double>(wide_dot(e, d)));
        if (wide_dot(e, d) <= 0 || off >= nearest) continue;
        nearest = off;
        best = {c, quadrant(whole) - quadrant(d)};
      }
      c = flat_.left_of(c);
    } while (c != outside && c != first);
    return best;
  }

  /// Follows a curve that is straight but for rounding.
  bool follow(std::uint32_t h) {
    auto [c, turns] = start_of_curve(h);
    if (c == outside) return false;
    GaussianInteger gone;
    for (std::uint32_t steps = 0; steps < flat_.half_edge_count(); ++steps) {
      add_wall(h, c, turns, gone);
      gone = gone + turned(flat_.vector[c], turns);
      const std::uint32_t p = flat_.end(c);
      if (gone == coarse_.vector[h]) return p == coarse_.end(h);
      if (q_.decimated.kind[p] != PointKind::gone) return false;
      lie_on(p, h, share_of(gone, coarse_.vector[h]));
      for (c = FlatMesh::next(c); flat_.curve[c] == 0; c = flat_.right_of(c)) turns += flat_.turns[c];
    }
    return false;
  }

  /// Follows the decimated half-edge h straight through the mesh.
  bool trace(std::uint32_t h) {
    if (coarse_.curve[h] != 0) return follow(h);
    const GaussianInteger whole = coarse_.vector[h];
    std::uint32_t p = coarse_.origin[h];
    std::int32_t bearing = q_.decimated.bearing[h];
    GaussianInteger gone;  // from the start to p, in the chart of the path
    for (std::uint64_t steps = 0; steps < 10ull * flat_.half_edge_count() + 100; ++steps) {
      const Start start = locate(p, bearing, whole);
      if (start.corner == outside) return false;
      const std::uint32_t c = start.corner;
      int turns = quadrant(whole) - quadrant(start.direction);  // from the triangle's chart to the path's
      const std::uint32_t g = FlatMesh::next(c);
      if (cross_sign(flat_.vector[c], start.direction) == 0) {  // along an edge
        add_wall(h, c, turns, gone);
        gone = gone + turned(flat_.vector[c], turns);
        p = flat_.end(c);
        if (gone == whole) return p == coarse_.end(h);
        bearing = bearing_[g] + flat_.corner_quarters(g) - 2;
      } else {
        // Across triangles until a point is hit. `right` and `left` are the ends of the edge g to cross, from the
        // path's start, in the path's chart.
        GaussianInteger right = gone + turned(flat_.vector[c], turns), left = right + turned(flat_.vector[g], turns);
        std::uint32_t crossed = g, from = p, t = c / 3;
        GaussianInteger origin = corner_at(flat_, c) - turned(gone, -turns);
        for (;; ++steps) {
          if (steps > 10ull * flat_.half_edge_count() + 100) return false;
          const std::uint32_t o = flat_.opposite[crossed];
          if (o == outside || flat_.curve[crossed] != 0) return false;
          const std::uint32_t to = add_crossing(h, crossed, left, right);
          add_chord(t, from, to, place(h, turns, origin));
          turns += flat_.turns[crossed];
          t = o / 3;
          from = to;
          origin = corner_at(flat_, o) - turned(left, -turns);
          const std::uint32_t n = FlatMesh::next(o);
          const GaussianInteger apex = right + turned(flat_.vector[n], turns);
          const int side = cross_sign(whole, apex);
          if (side == 0) {
            p = flat_.end(n);
            add_chord(t, from, p, place(h, turns, origin));
            gone = apex;
            if (gone == whole) return p == coarse_.end(h);
            const std::uint32_t v = FlatMesh::before(o);
            const GaussianInteger back = -turned(whole, -turns);
            bearing = bearing_[v] + ((quadrant(back) - quadrant(flat_.vector[v])) & 3) - 2;
            break;
          }
          crossed = side > 0 ? n : FlatMesh::before(o);
          (side > 0 ? left : right) = apex;
        }
      }
      if (wide_dot(gone, whole) > wide_dot(whole, whole)) return false;
      lie_on(p, h, share_of(gone, whole));
    }
    return false;
  }

  void lie_on(std::uint32_t p, std::uint32_t path, double along) {
    nodes_[p].path = path;
    nodes_[p].along_path = along;
  }

  std::uint32_t add_crossing(std::uint32_t path, std::uint32_t g, GaussianInteger left, GaussianInteger right) {
    const GaussianInteger d = coarse_.vector[path];
    const auto from_left = static_cast<double>(wide_cross(d, left)),
               from_right = -static_cast<double>(wide_cross(d, right));
    const double share = from_right / (from_left + from_right);  // 0 at the right end, the origin of g
    const double length = static_cast<double>(wide_dot(d, d));
    const double along_path =
        ((1 - share) * static_cast<double>(wide_dot(d, right)) + share * static_cast<double>(wide_dot(d, left))) /
        length;
    Node node{path, along_path, std::min(g, flat_.opposite[g]), 0, outside};
    node.along_edge = node.edge == g ? share : from_left / (from_left + from_right);
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size()) - 1;
  }

  /// Moves crossings near the end of an edge to that end. A point holds one path, a kept point none.
  void settle_crossings() {
    for (auto k = static_cast<std::uint32_t>(mesh_.points.size()); k < nodes_.size(); ++k) {
      Node& node = nodes_[k];
      if (node.along_edge < too_near) node.end = flat_.origin[node.edge];
      if (node.along_edge > 1 - too_near) node.end = flat_.end(node.edge);
      if (node.end != outside) {
        const std::uint32_t other = nodes_[node.end].path;
        if (q_.decimated.kind[node.end] != PointKind::gone || (other != outside && other != node.path))
          node.end = outside;
        else if (other == outside)
          lie_on(node.end, node.path, node.along_path);
      }
      if (node.end == outside) crossings_[node.edge].push_back(k);
    }
    for (auto& list : crossings_)
      std::sort(list.begin(), list.end(), [&](std::uint32_t a, std::uint32_t b) {
        return nodes_[a].along_edge != nodes_[b].along_edge ? nodes_[a].along_edge < nodes_[b].along_edge : a < b;
      });
  }

  void add_chord(std::uint32_t t, std::uint32_t from, std::uint32_t to, std::array<std::uint32_t, 2> sides) {
    chords_[t].push_back({from, to, sides[0], sides[1]});
  }

  // ---- faces

  std::uint32_t settled(std::uint32_t node) const { return nodes_[node].end == outside ? node : nodes_[node].end; }

  std::optional<Failure> split_triangles() {
    // Chords that snapping laid onto edges run along them: the triangles on both sides must know.
    for (std::uint32_t t = 0; t < chords_.size(); ++t)
      std::erase_if(chords_[t], [&](Chord& chord) {
        chord.from = settled(chord.from);
        chord.to = settled(chord.to);
        if (chord.from == chord.to) return true;
        for (std::uint32_t g = 3 * t; g < 3 * t + 3; ++g) {
          const double from = place_on(g, chord.from), to = place_on(g, chord.to);
          if (from < 0 || to < 0) continue;
          const bool is_forward = from < to;
          const std::uint32_t low = is_forward ? chord.from : chord.to, high = is_forward ? chord.to : chord.from;
          walls_[g].push_back({low, high, is_forward ? chord.left : chord.right});
          const std::uint32_t o = flat_.opposite[g];
          if (o != outside) walls_[o].push_back({high, low, carry(is_forward ? chord.right : chord.left, g)});
          return true;
        }
        return false;
      });
    for (std::uint32_t t = 0; t < chords_.size(); ++t) {
      std::vector<Face> faces(1);
      for (std::uint32_t g = 3 * t; g < 3 * t + 3; ++g) {
        const std::size_t first = faces[0].size();
        faces[0].push_back({flat_.origin[g], g, outside});
        const std::uint32_t o = flat_.opposite[g];
        const bool is_lower = o == outside || g < o;
        const auto& list = crossings_[is_lower ? g : o];
        for (std::size_t k = 0; k < list.size(); ++k)
          faces[0].push_back({list[is_lower ? k : list.size() - 1 - k], g, outside});
        for (const Wall& wall : walls_[g]) {
          bool is_on = false;
          for (std::size_t k = first; k < faces[0].size(); ++k) {
            is_on = (is_on || faces[0][k].node == wall.from) && faces[0][k].node != wall.to;
            if (is_on) faces[0][k].placement = wall.placement;
          }
        }
      }
      for (const Chord& chord : chords_[t])
        if (!split(faces, chord)) return give_up("paths cross in triangle " + std::to_string(t));
      for (Face& face : faces) {
        faces_.push_back(std::move(face));
        triangle_of_.push_back(t);
      }
    }
    return std::nullopt;
  }

  /// Where on half-edge g a node lies, 0 … 1; −1 if it does not.
  double place_on(std::uint32_t g, std::uint32_t node) const {
    if (node == flat_.origin[g]) return 0;
    if (node == flat_.end(g)) return 1;
    const Node& n = nodes_[node];
    if (n.edge == g) return n.along_edge;
    return n.edge != outside && n.edge == flat_.opposite[g] ? 1 - n.along_edge : -1;
  }

  /// The placement of the triangle beyond g, in the same decimated triangle.
  std::uint32_t carry(std::uint32_t placement, std::uint32_t g) {
    if (placement == outside) return outside;
    placements_.push_back(beyond(placements_[placement], g));
    return static_cast<std::uint32_t>(placements_.size()) - 1;
  }
  Placement beyond(const Placement& here, std::uint32_t g) const {
    Placement there{here.triangle, (here.turns + flat_.turns[g]) & 3, {}};
    there.offset = turned(corner_at(flat_, g), here.turns) + here.offset -
                   turned(corner_at(flat_, FlatMesh::next(flat_.opposite[g])), there.turns);
    return there;
  }

  static bool split(std::vector<Face>& faces, const Chord& chord) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      Face& face = faces[f];
      const auto find = [&](std::uint32_t node) {
        return std::find_if(face.begin(), face.end(), [&](const Side& s) { return s.node == node; }) - face.begin();
      };
      const auto from = find(chord.from), to = find(chord.to);
      const auto size = static_cast<std::ptrdiff_t>(face.size());
      if (from == size || to == size) continue;
      Face left, right;  // left: … to → … → from, then along the chord
      for (auto k = to; k != from; k = (k + 1) % size) left.push_back(face[static_cast<std::size_t>(k)]);
      left.push_back({chord.from, outside, chord.left});
      for (auto k = from; k != to; k = (k + 1) % size) right.push_back(face[static_cast<std::size_t>(k)]);
      right.push_back({chord.to, outside, chord.right});
      if (left.size() < 3 || right.size() < 3) return false;
      face = std::move(left);
      faces.push_back(std::move(right));
      return true;
    }
    return false;
  }

  /// Faces that no path touches lie where their neighbours lie.
  void spread_placements() {
    placed_.assign(faces_.size(), {});
    struct Key {
      std::uint32_t low, high, face, half_edge;
    };
    std::vector<Key> keys;
    std::vector<std::uint32_t> queue;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const Face& face = faces_[f];
      for (std::size_t k = 0; k < face.size(); ++k) {
        const std::uint32_t a = face[k].node, b = face[(k + 1) % face.size()].node;
        if (face[k].placement != outside)
          placed_[f] = placements_[face[k].placement];
        else if (face[k].half_edge != outside)
          keys.push_back({std::min(a, b), std::max(a, b), f, face[k].half_edge});
      }
      if (placed_[f].triangle != outside) queue.push_back(f);
    }
    std::sort(keys.begin(), keys.end(), [](const Key& x, const Key& y) {
      return std::array{x.low, x.high, x.half_edge} < std::array{y.low, y.high, y.half_edge};
    });
    std::vector<std::vector<std::array<std::uint32_t, 2>>> next(faces_.size());  // face beyond, half-edge crossed
    for (std::size_t k = 0; k + 1 < keys.size(); ++k)
      if (keys[k].low == keys[k + 1].low && keys[k].high == keys[k + 1].high) {
        next[keys[k].face].push_back({keys[k + 1].face, keys[k].half_edge});
        next[keys[k + 1].face].push_back({keys[k].face, keys[k + 1].half_edge});
      }
    for (std::size_t at = 0; at < queue.size(); ++at)
      for (const auto& [face, g] : next[queue[at]]) {
        if (placed_[face].triangle != outside) continue;
        placed_[face] = beyond(placed_[queue[at]], g);
        queue.push_back(face);
      }
  }

  // ---- values

  std::complex<double> snapped(std::complex<double> z) const {
    return {std::nearbyint(z.real() / grid_) * grid_, std::nearbyint(z.imag() / grid_) * grid_};
  }
  static std::complex<double> as_complex(GaussianInteger z) {
    return {static_cast<double>(z.re), static_cast<double>(z.im)};
  }
  GaussianInteger integer_corner(std::uint32_t h) const {
    const auto& v = q_.integers.vectors;
    return h % 3 == 0 ? GaussianInteger{} : h % 3 == 1 ? v[h - 1] : v[h - 2] + v[h - 1];
  }

  /// Value of a node in the chart of the decimated triangle in which face f lies.
  std::complex<double> value(std::uint32_t f, std::uint32_t node) const {
    const Placement& place = placed_[f];
    const std::uint32_t t = 3 * place.triangle;
    const bool is_point = node < mesh_.points.size();
    GaussianInteger z;
    if (is_point) {
      std::uint32_t g = 3 * triangle_of_[f];
      while (flat_.origin[g] != node) ++g;
      z = turned(corner_at(flat_, g), place.turns) + place.offset;
      if (q_.decimated.kind[node] != PointKind::gone) {
        for (std::uint32_t h = t; h < t + 3; ++h)
          if (coarse_.origin[h] == node && corner_at(coarse_, h) == z) return as_complex(integer_corner(h));
      }
    }
    if (nodes_[node].path != outside) {
      // The side of t on that path; if both are, the nearer one.
      const Node& n = nodes_[node];
      std::uint32_t best = outside;
      double nearest = 0;
      for (std::uint32_t h = t; h < t + 3; ++h) {
        if (h != n.path && coarse_.opposite[h] != n.path) continue;
        const double s = h == n.path ? n.along_path : 1 - n.along_path;
        const std::complex<double> at = as_complex(corner_at(coarse_, h)) + s * as_complex(coarse_.vector[h]);
        const double distance = std::abs(at - (is_point ? as_complex(z) : crossing_at(f, node)));
        if (best == outside || distance < nearest) best = h, nearest = distance;
      }
      if (best != outside) {
        const std::complex<double> start = as_complex(integer_corner(n.path));
        const std::complex<double> own = snapped(start + n.along_path * as_complex(q_.integers.vectors[n.path]));
        if (best == n.path) return own;
        const std::complex<double> start_beyond = as_complex(integer_corner(FlatMesh::next(best)));
        return start_beyond + turned(own - start, coarse_.turns[best]);
      }
    }
    // Inside: barycentric.
    const GaussianInteger a = coarse_.vector[t], b = -coarse_.vector[t + 2];
    const auto area = static_cast<double>(wide_cross(a, b));
    const double s = static_cast<double>(wide_cross(z, b)) / area, r = static_cast<double>(wide_cross(a, z)) / area;
    return snapped(s * as_complex(q_.integers.vectors[t]) - r * as_complex(q_.integers.vectors[t + 2]));
  }

  /// A crossing in the chart of the decimated triangle, roughly.
  std::complex<double> crossing_at(std::uint32_t f, std::uint32_t node) const {
    const Placement& place = placed_[f];
    const Node& n = nodes_[node];
    std::uint32_t g = n.edge;
    double s = n.along_edge;
    if (g / 3 != triangle_of_[f]) g = flat_.opposite[g], s = 1 - s;
    const std::complex<double> z = as_complex(corner_at(flat_, g)) + s * as_complex(flat_.vector[g]);
    return turned(z, place.turns) + as_complex(place.offset);
  }

  Result<ImprintedMap> write() {
    double extent = 1;
    for (const GaussianInteger v : q_.integers.vectors)
      extent = std::max({extent, std::abs(static_cast<double>(v.re)), std::abs(static_cast<double>(v.im))});
    int exponent = 0;
    std::frexp(extent, &exponent);
    grid_ = std::ldexp(1.0, exponent - 48);

    ImprintedMap out;
    out.mesh = mesh_;
    out.mesh.triangles.clear();
    std::vector<std::uint32_t> point_of(nodes_.size(), outside);
    for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
      const Node& n = nodes_[k];
      if (k < mesh_.points.size()) {
        point_of[k] = k;
      } else if (n.end == outside) {
        point_of[k] = static_cast<std::uint32_t>(out.mesh.points.size());
        const Vec3& a = mesh_.points[flat_.origin[n.edge]];
        const Vec3& b = mesh_.points[flat_.end(n.edge)];
        out.mesh.points.push_back((1 - n.along_edge) * a + n.along_edge * b);
        out.on_edge.push_back({flat_.origin[n.edge], flat_.end(n.edge)});
      }
    }
    out.map.valence = map_.valence;
    out.map.valence.resize(out.mesh.points.size(), 4);
    std::vector<std::complex<double>> uv;
    std::vector<std::uint32_t> nodes, sides;  // of the polygon that is left; per node the half-edge that follows
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (placed_[f].triangle == outside)
        return give_up("triangle " + std::to_string(triangle_of_[f]) + " was not reached");
      uv.clear();
      nodes.clear();
      sides.clear();
      for (const Side& side : faces_[f]) {
        uv.push_back(value(f, side.node));
        nodes.push_back(side.node);
        sides.push_back(side.half_edge);
      }
      while (nodes.size() >= 3) {
        const std::size_t ear = best_ear(uv);
        if (ear == nodes.size())
          return give_up("a part of triangle " + std::to_string(triangle_of_[f]) + " is not positive");
        const std::size_t n = nodes.size(), a = (ear + n - 1) % n, b = (ear + 1) % n;
        out.mesh.triangles.push_back({point_of[nodes[a]], point_of[nodes[ear]], point_of[nodes[b]]});
        for (const std::size_t k : {a, ear, b}) out.map.uv.push_back({uv[k].real(), uv[k].imag()});
        for (const std::uint32_t g : {sides[a], sides[ear], n == 3 ? sides[b] : outside})
          out.map.axes.push_back(g == outside ? MapAxis::none : turned(map_.axes[g], placed_[f].turns));
        sides[a] = outside;
        uv.erase(uv.begin() + static_cast<std::ptrdiff_t>(ear));
        nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(ear));
        sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(ear));
        if (n == 3) break;
      }
    }
    return turn_edges(std::move(out));
  }

  /// The corner to cut off next: its triangle and the rest stay positive; the one with the largest smallest angle.
  static std::size_t best_ear(const std::vector<std::complex<double>>& uv) {
    const std::size_t n = uv.size();
    std::size_t best = n;
    double best_shape = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const auto a = uv[(k + n - 1) % n], b = uv[k], c = uv[(k + 1) % n];
      if (orientation_2d(a.real(), a.imag(), b.real(), b.imag(), c.real(), c.imag()) <= 0) continue;
      if (n > 3 && !is_rest_positive(uv, k)) continue;
      const double area = (std::conj(b - a) * (c - a)).imag();
      const double shape = area / (std::norm(b - a) + std::norm(c - b) + std::norm(a - c));
      if (best == n || shape > best_shape) best = k, best_shape = shape;
    }
    return best;
  }
  /// Whether, without corner k, a corner remains: not all of the rest lies on one line.
  static bool is_rest_positive(const std::vector<std::complex<double>>& uv, std::size_t k) {
    const std::size_t n = uv.size();
    for (std::size_t j = 0; j < n; ++j) {
      if (j == k) continue;
      std::size_t i = (j + n - 1) % n, l = (j + 1) % n;
      if (i == k) i = (i + n - 1) % n;
      if (l == k) l = (l + 1) % n;
      if (orientation_2d(uv[i].real(), uv[i].imag(), uv[j].real(), uv[j].imag(), uv[l].real(), uv[l].imag()) > 0)
        return true;
    }
    return false;
  }

  /// Turns across edges, exactly from the coordinates.
  Result<ImprintedMap> turn_edges(ImprintedMap out) const {
    const auto count = static_cast<std::uint32_t>(out.map.uv.size());
    out.map.turns.assign(count, 0);
    std::vector<std::array<std::uint32_t, 3>> keys;
    for (std::uint32_t h = 0; h < count; ++h) {
      const std::uint32_t a = out.mesh.triangles[h / 3][h % 3], b = out.mesh.triangles[h / 3][(h + 1) % 3];
      keys.push_back({std::min(a, b), std::max(a, b), h});
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
      if (keys[k][0] != keys[k + 1][0] || keys[k][1] != keys[k + 1][1]) continue;
      const std::uint32_t h = keys[k][2], o = keys[k + 1][2];
      const auto here = out.map.at(FlatMesh::next(h)) - out.map.at(h),
                 there = out.map.at(o) - out.map.at(FlatMesh::next(o));
      int turns = 0;
      while (turns < 4 && turned(there, turns) != here) ++turns;
      if (turns == 4)
        return give_up("edge " + std::to_string(keys[k][0]) + "–" + std::to_string(keys[k][1]) + " does not fit");
      out.map.turns[h] = static_cast<std::uint8_t>(turns);
      out.map.turns[o] = static_cast<std::uint8_t>(-turns & 3);
    }
    return out;
  }

  const FeatureMesh& mesh_;
  const CornerMap& map_;
  const Quantization& q_;
  const FlatMesh& flat_;
  const FlatMesh& coarse_;
  std::vector<std::int32_t> bearing_;
  std::vector<Node> nodes_;  // points of the mesh first
  std::vector<Placement> placements_;
  std::vector<std::vector<Chord>> chords_;             // per triangle
  std::vector<std::vector<std::uint32_t>> crossings_;  // per half-edge, the lower of two: nodes
  std::vector<std::vector<Wall>> walls_;               // per half-edge
  std::vector<Face> faces_;
  std::vector<std::uint32_t> triangle_of_;  // per face
  std::vector<Placement> placed_;           // per face
  double grid_ = 0;
};

}  // namespace

Result<ImprintedMap> imprint_quantization(const FeatureMesh& mesh, const CornerMap& map,
                                          const Quantization& quantization) {
  return Imprint(mesh, map, quantization).run();
}

}  // namespace strataflow
