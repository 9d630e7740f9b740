#include "kernels/hybrid/thin_zone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/quality/cell_shape.h"
#include "kernels/quality/match_cell_faces.h"

namespace strataflow {

namespace {

using Face = std::array<std::uint32_t, 4>;  ///< counter-clockwise from outside; face[3] is no_index for a triangle

/// How the side of a pair is divided.
enum class SideState : std::uint8_t {
  edge,           ///< both links are points: no face
  shared,         ///< two pairs have it
  wall,           ///< a quadrilateral on the outside of the model
  capped,         ///< a quadrilateral with a pyramid on it
  split_rising,   ///< into triangles along the diagonal from bottom[j] to top[k]
  split_falling,  ///< … from top[j] to bottom[k]
  split_freely,
};

/// Heights of pyramids on sides, in edges, that are tried in turn.
constexpr std::array<double, 3> cap_heights{0.4, 0.2, 0.08};

bool is_split(SideState state) { return state >= SideState::split_rising; }

/// From a bottom corner to the top corner it faces; low ≤ high. Equal: the surfaces meet there.
struct Link {
  std::uint32_t low = 0, high = 0;
  bool is_point() const { return low == high; }
  friend auto operator<=>(const Link&, const Link&) = default;
};

/// One side of one pair, by its links.
struct SideKey {
  std::uint32_t first = 0, second = 0, pair = 0, side = 0;
  friend auto operator<=>(const SideKey&, const SideKey&) = default;
};

/// A triangle around the region, by its vertices.
struct SurfaceFace {
  Triangle vertices{};  ///< ascending
  std::uint32_t triangle = 0;
  friend auto operator<=>(const SurfaceFace&, const SurfaceFace&) = default;
};

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

class ZoneBuilder {
 public:
  ZoneBuilder(const StructuralModel& model, std::uint32_t region, std::span<const FacingPair> pairs,
              std::uint32_t layers)
      : model_(model),
        region_(region),
        pairs_(pairs),
        layers_(layers),
        is_alive_(pairs.size(), 1),
        cap_tries_(pairs.size(), {0, 0, 0}),
        cap_refused_in_(pairs.size(), {0, 0, 0}) {
    for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
      const Surface& surface = model.surfaces[s];
      if (surface.region_minus != region && surface.region_plus != region) continue;
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
        faces_.push_back({sorted(model.triangles[t]), t});
        for (const std::uint32_t corner : model.triangles[t]) corners_.push_back({corner, t});
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t a = model.triangles[t][k], b = model.triangles[t][(k + 1) % 3];
          surface_edges_.push_back({std::min(a, b), std::max(a, b)});
        }
      }
    }
    std::sort(faces_.begin(), faces_.end());
    std::sort(surface_edges_.begin(), surface_edges_.end());
    std::sort(corners_.begin(), corners_.end());
  }

  ThinZone build() {
    drop_crossed_pairs();
    do {
      is_changed_ = false;
      ++pass_;
      find_sides();
      if (layers_ > 1) place_layers();
      make_cells();
      if (is_changed_) continue;  // what was dropped changes its neighbours' sides
      close();
    } while (is_changed_);
    return std::move(zone_);
  }

 private:
  static constexpr std::uint8_t no_side = 3;  ///< of cells that cap none

  std::uint32_t add_point(const Vec3& p) {
    zone_.points.push_back(p);
    all_points_.push_back(p);
    return static_cast<std::uint32_t>(all_points_.size() - 1);
  }
  void drop(std::uint32_t pair, std::uint64_t& count) {
    if (!is_alive_[pair]) return;
    is_alive_[pair] = 0;
    ++count;
    is_changed_ = true;
  }
  std::uint32_t surface_face(const Triangle& vertices) const {
    const auto found = std::lower_bound(faces_.begin(), faces_.end(), SurfaceFace{sorted(vertices), 0});
    return found != faces_.end() && found->vertices == sorted(vertices) ? found->triangle : no_index;
  }
  bool is_on_surface(const Link& edge) const {
    return std::binary_search(surface_edges_.begin(), surface_edges_.end(), edge);
  }
  bool looks_outside(std::uint32_t triangle) const {
    const Surface& surface = model_.surfaces[model_.triangle_surface[triangle]];
    return surface.region_minus == universe || surface.region_plus == universe;
  }
  Link link(std::uint32_t pair, std::size_t k) const {
    const std::uint32_t b = pairs_[pair].bottom[k], t = pairs_[pair].top[k];
    return {std::min(b, t), std::max(b, t)};
  }

  /// Gives up pairs with a surface through a side: it would lie inside the cells, unseen.
  void drop_crossed_pairs() {
    std::vector<FloatBox> boxes;
    for (const SurfaceFace& face : faces_) {
      Box3 box;
      for (const std::uint32_t v : face.vertices) box.take(model_.points[v]);
      boxes.push_back(enclosing(box));
    }
    const BoundingVolumeTree tree(boxes);
    for (std::uint32_t p = 0; p < pairs_.size(); ++p)
      for (std::size_t j = 0; j < 3; ++j) {
        std::array<std::uint32_t, 4> quad = corners(p, j);
        std::vector<Triangle> halves;  // along either diagonal: the bilinear face lies between
        const auto& [bj, tj, bk, tk] = quad;
        for (const Triangle& half : {Triangle{bj, bk, tk}, {bj, tk, tj}, {bj, bk, tj}, {bk, tk, tj}})
          if (half[0] != half[1] && half[1] != half[2] && half[2] != half[0] && !is_degenerate(model_.points, half))
            halves.push_back(half);
        Box3 box;
        for (const std::uint32_t v : quad) box.take(model_.points[v]);
        bool is_crossed = false;
        tree.visit_items(enclosing(box), [&](std::uint32_t f) {
          if (is_crossed) return;
          const Triangle& face = faces_[f].vertices;
          const auto is_corner = [&](std::uint32_t v) { return std::find(quad.begin(), quad.end(), v) != quad.end(); };
          if (std::all_of(face.begin(), face.end(), is_corner)) return;  // the wall itself
          for (const Triangle& half : halves)
            is_crossed = is_crossed || meeting_of(model_.points, half, face) != PairMeeting::proper;
        });
        if (is_crossed) drop(p, zone_.dropped.crossing);
      }
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
      const Triangle &b = pairs_[p].bottom, &t = pairs_[p].top;
      Box3 box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.take(model_.points[b[k]]);
        box.take(model_.points[t[k]]);
      }
      bool holds_surface = false;
      tree.visit_items(enclosing(box), [&](std::uint32_t f) {
        const Triangle& v = faces_[f].vertices;
        std::uint32_t met_links = 0, corners = 0;
        for (const std::uint32_t corner : v)
          for (std::size_t k = 0; k < 3; ++k)
            if (b[k] == corner || t[k] == corner) {
              met_links |= 1u << k;
              ++corners;
            }
        if (corners == 3) {  // on a side, or bottom or top, or across
          holds_surface = holds_surface || (met_links == 7 && v != sorted(b) && v != sorted(t));
          return;
        }
        const Vec3 middle = (1.0 / 3) * (model_.points[v[0]] + model_.points[v[1]] + model_.points[v[2]]);
        holds_surface = holds_surface || is_inside(middle, {b[0], b[1], b[2], t[2]}) ||
                        is_inside(middle, {b[0], b[1], t[2], t[1]}) || is_inside(middle, {b[0], t[1], t[2], t[0]});
      });
      if (holds_surface) drop(p, zone_.dropped.crossing);  // it ends inside, without passing through a side
    }
  }

  bool is_inside(const Vec3& p, const std::array<std::uint32_t, 4>& tet) const {
    const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
      return orientation_3d(model_.points[tet[a]], model_.points[tet[b]], model_.points[tet[c]], p);
    };
    return side(0, 1, 2) > 0 && side(0, 3, 1) > 0 && side(1, 3, 2) > 0 && side(0, 2, 3) > 0;
  }

  void find_sides() {
    links_.clear();
    for (std::uint32_t p = 0; p < pairs_.size(); ++p)
      if (is_alive_[p])
        for (std::size_t k = 0; k < 3; ++k) links_.push_back(link(p, k));
    std::sort(links_.begin(), links_.end());
    links_.erase(std::unique(links_.begin(), links_.end()), links_.end());
    pair_links_.assign(pairs_.size(), {});
    states_.assign(pairs_.size(), {SideState::edge, SideState::edge, SideState::edge});
    std::vector<SideKey> keys;
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
      if (!is_alive_[p]) continue;
      for (std::size_t k = 0; k < 3; ++k)
        pair_links_[p][k] =
            static_cast<std::uint32_t>(std::lower_bound(links_.begin(), links_.end(), link(p, k)) - links_.begin());
      for (std::uint32_t j = 0; j < 3; ++j) {
        const std::uint32_t a = pair_links_[p][j], b = pair_links_[p][(j + 1) % 3];
        if (!links_[a].is_point() || !links_[b].is_point()) keys.push_back({std::min(a, b), std::max(a, b), p, j});
      }
    }
    std::sort(keys.begin(), keys.end());
    is_layered_.assign(links_.size(), layers_ > 1);
    for (std::uint32_t l = 0; l < links_.size(); ++l)
      if (links_[l].is_point() || is_on_surface(links_[l])) is_layered_[l] = 0;
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
      while (end < keys.size() && keys[end].first == keys[begin].first && keys[end].second == keys[begin].second) ++end;
      for (std::size_t i = begin + 2; i < end; ++i) drop(keys[i].pair, zone_.dropped.nonconforming);
      const bool is_shared = end - begin > 1;
      for (std::size_t i = begin; i < std::min(end, begin + 2); ++i) {
        SideState state = single_side(keys[i]);
        // A surface that ends inside the region may lie between two pairs: then they share its triangles.
        if (is_shared && (state == SideState::capped || state == SideState::split_freely)) state = SideState::shared;
        states_[keys[i].pair][keys[i].side] = state;
        if (state == SideState::wall || is_split(state)) is_layered_[keys[i].first] = is_layered_[keys[i].second] = 0;
      }
    }
  }

  /// What a side becomes that one pair alone has.
  SideState single_side(const SideKey& key) const {
    const auto [bj, tj, bk, tk] = corners(key.pair, key.side);
    if (bj == tj || bk == tk) return SideState::shared;  // a triangle: fits whatever is beyond
    const std::array<std::uint32_t, 2> rising{surface_face({bj, bk, tk}), surface_face({bj, tj, tk})};
    const std::array<std::uint32_t, 2> falling{surface_face({bj, bk, tj}), surface_face({bk, tj, tk})};
    for (const auto& halves : {rising, falling}) {
      if (halves[0] == no_index || halves[1] == no_index) continue;
      if (looks_outside(halves[0]) && model_.triangle_surface[halves[0]] == model_.triangle_surface[halves[1]] &&
          orientation_3d(model_.points[bj], model_.points[bk], model_.points[tj], model_.points[tk]) == 0)
        return SideState::wall;
    }
    const auto known = [](const auto& halves) { return (halves[0] != no_index) + (halves[1] != no_index); };
    if (known(rising) != known(falling))
      return known(rising) > known(falling) ? SideState::split_rising : SideState::split_falling;
    return cap_tries_[key.pair][key.side] < cap_heights.size() ? SideState::capped : SideState::split_freely;
  }

  /// bottom[j], top[j], bottom[k], top[k] of side j, k = j + 1.
  std::array<std::uint32_t, 4> corners(std::uint32_t pair, std::size_t j) const {
    const std::size_t k = (j + 1) % 3;
    return {pairs_[pair].bottom[j], pairs_[pair].top[j], pairs_[pair].bottom[k], pairs_[pair].top[k]};
  }

  void restart_points() {
    zone_.points.clear();
    zone_.layer_points = 0;
    all_points_ = model_.points;
  }

  /// Points between the layers, on links inside the zone.
  void place_layers() {
    restart_points();
    first_layer_point_.assign(links_.size(), no_index);
    for (std::uint32_t l = 0; l < links_.size(); ++l) {
      if (!is_layered_[l]) continue;
      const Vec3 low = model_.points[links_[l].low], step = model_.points[links_[l].high] - low;
      for (std::uint32_t i = 1; i < layers_; ++i) {
        const std::uint32_t added = add_point(low + (static_cast<double>(i) / layers_) * step);
        if (i == 1) first_layer_point_[l] = added;
      }
    }
    zone_.layer_points = zone_.points.size();
    layer_end_ = zone_.points.size();
  }

  bool is_layered(std::uint32_t pair, std::size_t k) const { return is_layered_[pair_links_[pair][k]] != 0; }
  std::uint32_t steps(std::uint32_t pair, std::size_t k) const { return is_layered(pair, k) ? layers_ : 1; }

  /// Point i of `steps`, from the bottom.
  std::uint32_t at(std::uint32_t pair, std::size_t k, std::uint32_t i) const {
    const std::uint32_t b = pairs_[pair].bottom[k], t = pairs_[pair].top[k];
    if (i == 0) return b;
    if (i == steps(pair, k)) return t;
    return first_layer_point_[pair_links_[pair][k]] + (b < t ? i : layers_ - i) - 1;
  }

  /// The faces of side j, as its owner sees them from outside. `diagonal` stands for split_freely.
  void add_side_faces(std::uint32_t pair, std::size_t j, SideState diagonal, std::vector<Face>& faces) const {
    const SideState state = states_[pair][j] == SideState::split_freely ? diagonal : states_[pair][j];
    if (state == SideState::edge) return;
    const std::size_t k = (j + 1) % 3;
    const auto [bj, tj, bk, tk] = corners(pair, j);
    const std::uint32_t steps_j = steps(pair, j), steps_k = steps(pair, k);
    if (state == SideState::split_rising) {
      faces.push_back({bk, tk, bj, no_index});
      faces.push_back({tk, tj, bj, no_index});
    } else if (state == SideState::split_falling) {
      faces.push_back({bk, tk, tj, no_index});
      faces.push_back({bk, tj, bj, no_index});
    } else if (bk == tk) {
      for (std::uint32_t i = 0; i < steps_j; ++i) faces.push_back({bk, at(pair, j, i + 1), at(pair, j, i), no_index});
    } else if (bj == tj) {
      for (std::uint32_t i = 0; i < steps_k; ++i) faces.push_back({at(pair, k, i), at(pair, k, i + 1), bj, no_index});
    } else if (steps_j == steps_k) {
      for (std::uint32_t i = 0; i < steps_j; ++i)
        faces.push_back({at(pair, k, i), at(pair, k, i + 1), at(pair, j, i + 1), at(pair, j, i)});
    } else {
      // Layers on one link only: a fan from either end of the other, the same seen from both pairs.
      const std::size_t layered = steps_k > 1 ? k : j;
      const bool starts_low = pairs_[pair].bottom[layered] < pairs_[pair].top[layered];
      const std::uint32_t below = starts_low ? layers_ / 2 : layers_ - layers_ / 2;
      for (std::uint32_t i = 0; i < layers_; ++i) {
        const std::uint32_t low = at(pair, layered, i), high = at(pair, layered, i + 1);
        if (layered == k)
          faces.push_back({low, high, i < below ? bj : tj, no_index});
        else
          faces.push_back({i < below ? bk : tk, high, low, no_index});
      }
      const std::uint32_t middle = at(pair, layered, below);
      faces.push_back(layered == k ? Face{middle, tj, bj, no_index} : Face{bk, tk, middle, no_index});
    }
  }

  /// Keeps cells if all are positive. Returns the smallest volume, or nothing.
  std::optional<double> smallest_volume(const std::vector<ThinCell>& cells) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const ThinCell& cell : cells) {
      if (state_of(cell, all_points_) != ThinCellState::sound) return std::nullopt;
      smallest = std::min(smallest, volume_of(cell, all_points_));
    }
    return smallest;
  }

  void take(std::uint32_t pair, const std::vector<ThinCell>& cells, std::uint8_t cap_side = no_side) {
    for (const ThinCell& cell : cells) {
      zone_.cells.push_back(cell);
      owner_.push_back(pair);
      cap_side_.push_back(cap_side);
    }
  }

  /// Pyramids (tetrahedra where layers end) on the outside of side j, their apex one of the cap heights away.
  void add_cap(std::uint32_t pair, std::size_t j) {
    const auto [bj, tj, bk, tk] = corners(pair, j);
    const Vec3 &a = model_.points[bk], &b = model_.points[tk], &c = model_.points[tj], &d = model_.points[bj];
    const Vec3 normal = cross(c - a, d - b);
    const double size = length(normal), edge = 0.5 * (length(d - a) + length(c - b));
    const double height = cap_heights[cap_tries_[pair][j]] * edge;
    const Vec3 middle = 0.25 * (a + b + (c + d));
    const std::uint32_t apex = add_point(size > 0 ? middle + (height / size) * normal : middle);
    std::vector<Face> faces;
    add_side_faces(pair, j, SideState::split_rising, faces);
    std::vector<ThinCell> cells;
    for (const auto& [p, q, r, s] : faces)  // seen from beyond
      cells.push_back(cone_over(s == no_index ? Face{r, q, p, no_index} : Face{s, r, q, p}, apex));
    if (!smallest_volume(cells)) {
      refuse_cap(pair, j);
      return;
    }
    ++zone_.apex_points;
    take(pair, cells, static_cast<std::uint8_t>(j));
  }
  void refuse_cap(std::uint32_t pair, std::size_t j) {
    if (cap_refused_in_[pair][j] == pass_) return;  // its cells may be refused one by one
    cap_refused_in_[pair][j] = pass_;
    ++cap_tries_[pair][j];
    is_changed_ = true;
  }
  /// Gives up what a cell is there for.
  void refuse_cell(std::uint32_t cell, std::uint64_t& count) {
    if (cap_side_[cell] == no_side)
      drop(owner_[cell], count);
    else
      refuse_cap(owner_[cell], cap_side_[cell]);
  }

  void make_cells() {
    if (layers_ > 1) {
      zone_.points.resize(layer_end_);
      all_points_.resize(model_.points.size() + layer_end_);
    } else {
      restart_points();
    }
    zone_.centre_points = zone_.apex_points = 0;
    zone_.cells.clear();
    owner_.clear();
    cap_side_.clear();
    std::vector<ThinCell> cells;
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
      if (!is_alive_[p]) continue;
      const Triangle &b = pairs_[p].bottom, &t = pairs_[p].top;
      const int meeting = (b[0] == t[0]) + (b[1] == t[1]) + (b[2] == t[2]);
      const auto& states = states_[p];
      const bool is_whole = !is_split(states[0]) && !is_split(states[1]) && !is_split(states[2]);
      std::array<std::uint32_t, 3> layers;
      for (std::size_t k = 0; k < 3; ++k) layers[k] = b[k] == t[k] ? 0 : steps(p, k);
      const std::uint32_t most = std::max({layers[0], layers[1], layers[2]});
      const bool is_even = std::all_of(layers.begin(), layers.end(), [&](auto n) { return n == 0 || n == most; });
      cells.clear();
      if (is_whole && is_even) {
        for (std::uint32_t i = 0; i < most; ++i) {
          Triangle low, high;
          for (std::size_t k = 0; k < 3; ++k) {
            low[k] = layers[k] == 0 ? b[k] : at(p, k, i);
            high[k] = layers[k] == 0 ? b[k] : at(p, k, i + 1);
          }
          cells.push_back(cell_between(low, high));
        }
      } else if (meeting == 1) {
        const std::size_t apex = b[0] == t[0] ? 0 : b[1] == t[1] ? 1 : 2;
        cells = best_cells([&](SideState diagonal, std::vector<ThinCell>& made) {
          std::vector<Face> faces;
          add_side_faces(p, (apex + 1) % 3, diagonal, faces);
          for (const Face& face : faces) made.push_back(cone_over(face, b[apex]));
        });
      } else {
        const int splits = is_split(states[0]) + is_split(states[1]) + is_split(states[2]);
        if (splits == 3) {
          drop(p, zone_.dropped.isolated);
          continue;
        }
        if (splits == 2 && most == 1) cells = from_a_corner(p);
        if (cells.empty()) cells = from_the_middle(p);
      }
      if (cells.empty() || !smallest_volume(cells)) {
        drop(p, zone_.dropped.inverted);
        continue;
      }
      take(p, cells);
      for (std::size_t j = 0; j < 3; ++j)
        if (states[j] == SideState::capped) add_cap(p, j);
    }
  }

  /// Of the cells made with either diagonal, those whose smallest volume is larger; none if neither is positive.
  template <class Make>
  std::vector<ThinCell> best_cells(Make&& make) const {
    std::vector<ThinCell> best;
    double best_volume = 0;
    for (const SideState diagonal : {SideState::split_rising, SideState::split_falling}) {
      std::vector<ThinCell> made;
      make(diagonal, made);
      const std::optional<double> volume = smallest_volume(made);
      if (volume && *volume > best_volume) {
        best_volume = *volume;
        best = std::move(made);
      }
    }
    return best;
  }

  /// Two split sides: a pyramid over the third and a tetrahedron, from a corner between the two that both diagonals
  /// reach.
  std::vector<ThinCell> from_a_corner(std::uint32_t p) const {
    std::size_t whole = 0;
    while (is_split(states_[p][whole])) ++whole;
    const std::size_t before = (whole + 1) % 3, after = (whole + 2) % 3;  // sides; they meet at link `after`
    std::vector<ThinCell> best;
    double best_volume = 0;
    for (const bool from_bottom : {true, false}) {
      // Side `before` runs from link before to after, side `after` from link after on.
      const SideState wanted_before = from_bottom ? SideState::split_falling : SideState::split_rising;
      const SideState wanted_after = from_bottom ? SideState::split_rising : SideState::split_falling;
      const auto suits = [](SideState state, SideState wanted) {
        return state == SideState::split_freely || state == wanted;
      };
      if (!suits(states_[p][before], wanted_before) || !suits(states_[p][after], wanted_after)) continue;
      const Triangle &b = pairs_[p].bottom, &t = pairs_[p].top;
      const std::uint32_t apex = from_bottom ? b[after] : t[after];
      std::vector<Face> faces{from_bottom ? Face{t[0], t[1], t[2], no_index} : Face{b[0], b[2], b[1], no_index}};
      add_side_faces(p, whole, SideState::split_rising, faces);
      std::vector<ThinCell> made;
      for (const Face& face : faces) made.push_back(cone_over(face, apex));
      const std::optional<double> volume = smallest_volume(made);
      if (volume && *volume > best_volume) {
        best_volume = *volume;
        best = std::move(made);
      }
    }
    return best;
  }

  /// Pyramids and tetrahedra from the middle to every face.
  std::vector<ThinCell> from_the_middle(std::uint32_t p) {
    const Triangle &b = pairs_[p].bottom, &t = pairs_[p].top;
    Vec3 sum;
    for (std::size_t k = 0; k < 3; ++k) sum = sum + (model_.points[b[k]] + model_.points[t[k]]);
    const std::uint32_t middle = add_point((1.0 / 6) * sum);
    std::vector<ThinCell> cells = best_cells([&](SideState diagonal, std::vector<ThinCell>& made) {
      std::vector<Face> faces{{b[0], b[2], b[1], no_index}, {t[0], t[1], t[2], no_index}};
      for (std::size_t j = 0; j < 3; ++j) add_side_faces(p, j, diagonal, faces);
      for (const Face& face : faces) made.push_back(cone_over(face, middle));
    });
    if (cells.empty()) {
      zone_.points.pop_back();
      all_points_.pop_back();
    } else {
      ++zone_.centre_points;
    }
    return cells;
  }

  /// Finds what the cells leave open: surfaces they cover, and the envelope. Drops pairs that do not conform or whose
  /// sides cross something.
  void close() {
    zone_.covered.clear();
    zone_.wall_quads.clear();
    zone_.envelope.clear();
    zone_.volume_m3 = 0;
    VolumeMesh mesh;
    mesh.points = all_points_;
    for (const ThinCell& cell : zone_.cells) {
      mesh.add_cell(cell.type, cell.vertices.data(), 0);
      zone_.volume_m3 += volume_of(cell, all_points_);
    }
    const FaceMatching matching = match_cell_faces(mesh);
    for (const CellFace& face : matching.nonconforming_examples) refuse_cell(face.cell, zone_.dropped.nonconforming);
    if (is_changed_) return;

    // Also faces with cells on both sides may lie on a surface: on one that ends inside the region.
    for (std::uint32_t cell = 0; cell < zone_.cells.size(); ++cell)
      for (const LocalFace& face : shape_of(zone_.cells[cell].type).faces) {
        if (face[3] != no_local_vertex) continue;
        const auto& v = zone_.cells[cell].vertices;
        const Triangle outward{v[face[0]], v[face[1]], v[face[2]]};
        if (const std::uint32_t triangle = surface_face(outward); triangle != no_index) cover(outward, triangle, cell);
      }
    std::vector<std::uint32_t> envelope_cell;
    for (const CellFace& face : matching.boundary_faces) {
      const auto& v = face.vertices;
      if (!face.is_triangle()) {
        close_wall(face);
        continue;
      }
      if (surface_face({v[0], v[1], v[2]}) != no_index) continue;
      zone_.envelope.push_back({v[0], v[1], v[2]});
      envelope_cell.push_back(face.cell);
    }
    if (is_changed_ || zone_.envelope.empty()) return;

    std::vector<Triangle> triangles;
    for (const SurfaceFace& face : faces_) triangles.push_back(model_.triangles[face.triangle]);
    const std::size_t first = triangles.size();
    triangles.insert(triangles.end(), zone_.envelope.begin(), zone_.envelope.end());
    std::vector<char> is_envelope(triangles.size(), 0);
    std::fill(is_envelope.begin() + static_cast<std::ptrdiff_t>(first), is_envelope.end(), 1);
    for (const IntersectingPair& crossing : find_intersections_of(all_points_, triangles, is_envelope)) {
      const std::uint32_t cell = envelope_cell[crossing.second - first];
      const std::uint32_t other = crossing.first < first ? cell : envelope_cell[crossing.first - first];
      refuse_cell(cap_side_[cell] == no_side && cap_side_[other] != no_side ? other : cell, zone_.dropped.crossing);
    }
    for (std::size_t i = 0; i < zone_.envelope.size(); ++i)
      if (is_degenerate(all_points_, zone_.envelope[i])) refuse_cell(envelope_cell[i], zone_.dropped.crossing);
    if (!is_changed_) refuse_edges_on_surfaces(envelope_cell);
  }

  /// Refuses cells with an edge inside the region that lies on a surface from one of its ends on, as between points of
  /// two traces on a plane fault with other triangles: it crosses nothing, but only flat tetrahedra fit between.
  void refuse_edges_on_surfaces(const std::vector<std::uint32_t>& envelope_cell) {
    constexpr double sine_1_deg = 0.017452406437283512;
    for (std::size_t i = 0; i < zone_.envelope.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (const bool turned : {false, true}) {
          std::uint32_t a = zone_.envelope[i][k], b = zone_.envelope[i][(k + 1) % 3];
          if (turned) std::swap(a, b);
          if (a >= model_.points.size() || is_on_surface({std::min(a, b), std::max(a, b)})) continue;
          const Vec3 along = all_points_[b] - all_points_[a];
          const auto begin = std::lower_bound(corners_.begin(), corners_.end(), std::array{a, 0u});
          for (auto corner = begin; corner != corners_.end() && (*corner)[0] == a; ++corner) {
            Triangle t = model_.triangles[(*corner)[1]];
            std::rotate(t.begin(), std::find(t.begin(), t.end(), a), t.end());
            const Vec3 u = model_.points[t[1]] - model_.points[a], v = model_.points[t[2]] - model_.points[a];
            const Vec3 normal = cross(u, v);
            if (std::abs(dot(along, normal)) < sine_1_deg * length(along) * length(normal) &&
                dot(cross(u, along), normal) >= 0 && dot(cross(along, v), normal) >= 0)
              refuse_cell(envelope_cell[i], zone_.dropped.crossing);
          }
        }
  }

  void cover(const Triangle& outward, std::uint32_t triangle, std::uint32_t cell) {
    // Equal turn: the triangle's normal points away from the cell, which lies on its negative side.
    const Triangle& own = model_.triangles[triangle];
    const std::size_t k = static_cast<std::size_t>(std::find(own.begin(), own.end(), outward[0]) - own.begin());
    const std::uint32_t side = own[(k + 1) % 3] == outward[1] ? 0 : 1;
    const Surface& surface = model_.surfaces[model_.triangle_surface[triangle]];
    if ((side == 0 ? surface.region_minus : surface.region_plus) != region_)
      refuse_cell(cell, zone_.dropped.crossing);  // it lies on the wrong side of a surface
    zone_.covered.push_back({triangle, side, cell});
  }

  void close_wall(const CellFace& face) {
    const auto& v = face.vertices;
    for (const bool first : {true, false}) {
      const Triangle one = first ? Triangle{v[0], v[1], v[2]} : Triangle{v[0], v[1], v[3]};
      const Triangle other = first ? Triangle{v[0], v[2], v[3]} : Triangle{v[1], v[2], v[3]};
      const std::uint32_t one_of = surface_face(one), other_of = surface_face(other);
      if (one_of == no_index || other_of == no_index) continue;
      cover(one, one_of, face.cell);
      cover(other, other_of, face.cell);
      zone_.wall_quads.push_back({v, {one_of, other_of}, model_.triangle_surface[one_of], face.cell});
      return;
    }
    refuse_cell(face.cell, zone_.dropped.nonconforming);
  }

  const StructuralModel& model_;
  std::uint32_t region_;
  std::span<const FacingPair> pairs_;
  std::uint32_t layers_;
  std::vector<SurfaceFace> faces_;
  std::vector<Link> surface_edges_;
  std::vector<std::array<std::uint32_t, 2>> corners_;  ///< point and triangle around the region, ascending
  std::vector<char> is_alive_;
  std::vector<std::array<std::uint8_t, 3>> cap_tries_;        ///< per pair and side: caps that had no room
  std::vector<std::array<std::uint32_t, 3>> cap_refused_in_;  ///< the pass that last counted one
  std::uint32_t pass_ = 0;
  bool is_changed_ = false;

  std::vector<Link> links_;
  std::vector<std::array<std::uint32_t, 3>> pair_links_;
  std::vector<std::array<SideState, 3>> states_;
  std::vector<char> is_layered_;                  ///< per link
  std::vector<std::uint32_t> first_layer_point_;  ///< per link
  std::size_t layer_end_ = 0;
  std::vector<Vec3> all_points_;        ///< the model's, then the zone's
  std::vector<std::uint32_t> owner_;    ///< per cell: its pair
  std::vector<std::uint8_t> cap_side_;  ///< per cell: the side of the pair that it caps
  ThinZone zone_;
};

}  // namespace

ThinZone build_thin_zone(const StructuralModel& model, std::uint32_t region, std::span<const FacingPair> pairs,
                         std::uint32_t layers) {
  return ZoneBuilder(model, region, pairs, layers).build();
}

}  // namespace strataflow
