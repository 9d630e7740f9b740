#include "kernels/hexes/refinement/refine_quads.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/id.h"

namespace strataflow {
namespace {

/// A place in a quad: 4·row + column of its 4 × 4 thirds, the quad's corners being 0, 3, 15 and 12.
using Cell = std::array<std::uint8_t, 4>;

// By how many corners are marked; turned so that these come first.
constexpr std::array<Cell, 3> one_marked{{{0, 1, 5, 4}, {1, 3, 15, 5}, {4, 5, 15, 12}}};
constexpr std::array<Cell, 7> two_marked{
    {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 9, 12}, {5, 6, 10, 9}, {6, 7, 15, 10}, {9, 10, 15, 12}}};
// Corners 3, 0, 1 of the quad, 2 is the one that is not.
constexpr std::array<Cell, 8> three_marked{{{0, 1, 5, 4},
                                            {1, 2, 6, 5},
                                            {2, 3, 7, 6},
                                            {4, 5, 9, 8},
                                            {5, 6, 10, 9},
                                            {6, 7, 15, 10},
                                            {8, 9, 13, 12},
                                            {9, 10, 15, 13}}};
constexpr std::array<Cell, 9> four_marked{{{0, 1, 5, 4},
                                           {1, 2, 6, 5},
                                           {2, 3, 7, 6},
                                           {4, 5, 9, 8},
                                           {5, 6, 10, 9},
                                           {6, 7, 11, 10},
                                           {8, 9, 13, 12},
                                           {9, 10, 14, 13},
                                           {10, 11, 15, 14}}};

struct Side {
  std::uint32_t a, b;  ///< a < b
  std::array<std::uint32_t, 2> third{no_index, no_index};  ///< the point near a, near b
};

class Refinement {
 public:
  Refinement(const QuadMesh& plan, const std::vector<char>& is_fine, const std::vector<char>& keeps)
      : plan_(plan), is_kept_(keeps), is_marked_(plan.points.size(), 0) {
    is_kept_.resize(plan.points.size(), 0);
    for (std::size_t q = 0; q < plan.quads.size(); ++q)
      for (const std::uint32_t p : plan.quads[q])
        if (is_fine[q] && !is_kept_[p]) is_marked_[p] = 1;
    part_diagonals();
  }

  QuadMesh refine() {
    QuadMesh refined = plan_;
    refined.quads.clear();
    refined.edges.clear();
    find_sides();
    for (Side& side : sides_) {
      const Vec3 &a = plan_.points[side.a], &b = plan_.points[side.b];
      for (std::size_t end = 0; end < 2; ++end) {
        if (!is_marked_[end == 0 ? side.a : side.b]) continue;
        side.third[end] = static_cast<std::uint32_t>(refined.points.size());
        refined.points.push_back(end == 0 ? a + (1.0 / 3) * (b - a) : b + (1.0 / 3) * (a - b));
      }
    }
    for (const auto& quad : plan_.quads) cut(quad, refined);
    for (const FeatureEdge& edge : plan_.edges) {
      std::uint32_t from = edge.a;
      const Side* side = side_of(edge.a, edge.b);
      if (side == nullptr) continue;
      for (const std::uint32_t to : {side->third[0], side->third[1], edge.b}) {
        if (to == no_index) continue;
        refined.edges.push_back({std::min(from, to), std::max(from, to), edge.feature});
        from = to;
      }
    }
    std::sort(refined.edges.begin(), refined.edges.end());
    return refined;
  }

 private:
  /// Where two opposite corners alone are marked, a third one must be: the first that may, or else none is, for good.
  void part_diagonals() {
    for (bool changes = true; changes;) {
      changes = false;
      for (const auto& quad : plan_.quads) {
        std::array<bool, 4> marked{};
        for (std::size_t k = 0; k < 4; ++k) marked[k] = is_marked_[quad[k]] != 0;
        if (marked[0] != marked[2] || marked[1] != marked[3] || marked[0] == marked[1]) continue;
        changes = true;
        const std::size_t open = marked[0] ? 1 : 0;
        if (!is_kept_[quad[open]])
          is_marked_[quad[open]] = 1;
        else if (!is_kept_[quad[open + 2]])
          is_marked_[quad[open + 2]] = 1;
        else
          for (const std::size_t k : {1 - open, 3 - open}) {
            is_marked_[quad[k]] = 0;
            is_kept_[quad[k]] = 1;
          }
      }
    }
  }

  void find_sides() {
    for (const auto& quad : plan_.quads)
      for (std::size_t k = 0; k < 4; ++k)
        sides_.push_back({std::min(quad[k], quad[(k + 1) % 4]), std::max(quad[k], quad[(k + 1) % 4])});
    const auto by_ends = [](const Side& x, const Side& y) { return std::array{x.a, x.b} < std::array{y.a, y.b}; };
    std::sort(sides_.begin(), sides_.end(), by_ends);
    sides_.erase(std::unique(sides_.begin(), sides_.end(),
                             [](const Side& x, const Side& y) { return x.a == y.a && x.b == y.b; }),
                 sides_.end());
  }

  const Side* side_of(std::uint32_t a, std::uint32_t b) const {
    const std::array ends{std::min(a, b), std::max(a, b)};
    const auto side = std::lower_bound(sides_.begin(), sides_.end(), ends,
                                       [](const Side& s, const auto& wanted) { return std::array{s.a, s.b} < wanted; });
    return side != sides_.end() && side->a == ends[0] && side->b == ends[1] ? &*side : nullptr;
  }

  std::uint32_t third_near(std::uint32_t end, std::uint32_t other) const {
    return side_of(end, other)->third[end < other ? 0 : 1];
  }

  void cut(const std::array<std::uint32_t, 4>& quad, QuadMesh& refined) const {
    std::size_t marked = 0;
    for (const std::uint32_t p : quad) marked += is_marked_[p] ? 1 : 0;
    if (marked == 0) {
      refined.quads.push_back(quad);
      return;
    }
    // The corner that comes first: one marked, the first of two in a row, the middle of three.
    std::size_t turn = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool here = is_marked_[quad[k]], next = is_marked_[quad[(k + 1) % 4]], before = is_marked_[quad[(k + 3) % 4]];
      if (marked == 1 ? here : marked == 2 ? here && next : marked == 3 ? here && next && before : k == 0) turn = k;
    }
    std::array<std::uint32_t, 4> corner{};
    for (std::size_t k = 0; k < 4; ++k) corner[k] = quad[(turn + k) % 4];
    std::array<std::uint32_t, 16> at{};
    at.fill(no_index);
    constexpr std::array<std::uint8_t, 4> place{0, 3, 15, 12};
    constexpr std::array<std::uint8_t, 4> near_first{1, 7, 14, 8}, near_last{2, 11, 13, 4};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t a = corner[k], b = corner[(k + 1) % 4];
      at[place[k]] = a;
      at[near_first[k]] = third_near(a, b);
      at[near_last[k]] = third_near(b, a);
    }
    const auto inner = [&](std::uint8_t n) {
      const double u = n % 4 / 3.0, v = n / 4 / 3.0;
      return (1 - u) * (1 - v) * plan_.points[corner[0]] + u * (1 - v) * plan_.points[corner[1]] +
             u * v * plan_.points[corner[2]] + (1 - u) * v * plan_.points[corner[3]];
    };
    const auto add = [&](std::span<const Cell> cells) {
      for (const Cell& cell : cells) {
        std::array<std::uint32_t, 4> points{};
        for (std::size_t k = 0; k < 4; ++k) {
          std::uint32_t& p = at[cell[k]];
          if (p == no_index) {
            p = static_cast<std::uint32_t>(refined.points.size());
            refined.points.push_back(inner(cell[k]));
          }
          points[k] = p;
        }
        refined.quads.push_back(points);
      }
    };
    if (marked == 1) add(one_marked);
    if (marked == 2) add(two_marked);
    if (marked == 3) add(three_marked);
    if (marked == 4) add(four_marked);
  }

  const QuadMesh& plan_;
  std::vector<char> is_kept_, is_marked_;
  std::vector<Side> sides_;  ///< by ends
};

}  // namespace

QuadMesh refine_quads(const QuadMesh& plan, const std::vector<char>& is_fine, const std::vector<char>& keeps) {
  return Refinement(plan, is_fine, keeps).refine();
}

}  // namespace strataflow
