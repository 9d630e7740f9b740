#include "kernels/quads/quantization/cut_chart.h"

#include <algorithm>
#include <utility>

#include "kernels/topology/union_find.h"

namespace strataflow {
namespace {

constexpr std::uint32_t outside = FlatMesh::outside;

class Cutter {
 public:
  explicit Cutter(const FlatMesh& flat) : flat_(flat), is_cut_(flat.half_edge_count(), 1) {}

  CutChart run() {
    span_triangles();
    prune();
    name_branches();
    write_corners();
    return std::move(chart_);
  }

 private:
  /// Turns across h between the charts of the pieces.
  int turns(std::uint32_t h) const {
    return (flat_.turns[h] + chart_.turns[h / 3] - chart_.turns[flat_.opposite[h] / 3]) & 3;
  }

  /// A tree over the triangles of each piece.
  void span_triangles() {
    const std::uint32_t count = flat_.half_edge_count() / 3;
    chart_.turns.assign(count, 0);
    chart_.entered_by.assign(count, outside);
    chart_.rank.assign(count, outside);
    const auto reach = [&](std::uint32_t t) {
      chart_.rank[t] = static_cast<std::uint32_t>(chart_.walk.size());
      chart_.walk.push_back(t);
    };
    for (std::uint32_t seed = 0; seed < count; ++seed) {
      if (chart_.rank[seed] != outside) continue;
      std::size_t at = chart_.walk.size();
      reach(seed);
      for (; at < chart_.walk.size(); ++at)
        for (std::uint32_t h = 3 * chart_.walk[at]; h < 3 * chart_.walk[at] + 3; ++h) {
          const std::uint32_t other = flat_.opposite[h];
          if (other == outside || chart_.rank[other / 3] != outside) continue;
          chart_.turns[other / 3] = (chart_.turns[h / 3] + flat_.turns[h]) & 3;
          chart_.entered_by[other / 3] = h;
          is_cut_[h] = is_cut_[other] = 0;
          reach(other / 3);
        }
    }
    for (std::uint32_t h = 0; h < is_cut_.size(); ++h)
      if (flat_.opposite[h] == outside) is_cut_[h] = 0;
  }

  /// Closes the cut again from its free ends, up to cone points and boundaries.
  void prune() {
    std::uint32_t points = 0;
    for (const std::uint32_t p : flat_.origin) points = std::max(points, p + 1);
    chart_.first_corner.assign(points, outside);
    cut_out_.assign(points, {});
    is_boundary_.assign(points, 0);
    for (std::uint32_t h = 0; h < is_cut_.size(); ++h) {
      const std::uint32_t p = flat_.origin[h];
      if (chart_.first_corner[p] == outside) chart_.first_corner[p] = h;
      if (flat_.opposite[h] == outside) is_boundary_[p] = is_boundary_[flat_.end(h)] = 1;
      if (flat_.right_of(h) == outside) chart_.first_corner[p] = h;
      if (is_cut_[h]) cut_out_[p].push_back(h);
    }
    std::vector<std::uint32_t> ends;
    for (std::uint32_t p = points; p-- > 0;)
      if (cut_out_[p].size() == 1) ends.push_back(p);
    while (!ends.empty()) {
      const std::uint32_t p = ends.back();
      ends.pop_back();
      if (is_boundary_[p] || cut_out_[p].size() != 1 || turns(cut_out_[p][0]) != 0) continue;
      const std::uint32_t h = cut_out_[p][0], other = flat_.opposite[h], q = flat_.origin[other];
      is_cut_[h] = is_cut_[other] = 0;
      cut_out_[p].clear();
      std::erase(cut_out_[q], other);
      if (cut_out_[q].size() == 1) ends.push_back(q);
    }
  }

  /// Along a chain of cut edges through regular points the translation is the same.
  void name_branches() {
    UnionFind sides(is_cut_.size());
    for (std::uint32_t p = 0; p < cut_out_.size(); ++p) {
      if (is_boundary_[p] || cut_out_[p].size() != 2) continue;
      for (int k = 0; k < 2; ++k) {
        const std::uint32_t arriving = flat_.opposite[cut_out_[p][k]], leaving = cut_out_[p][1 - k];
        if (turns(arriving) == turns(leaving)) sides.unite(arriving, leaving);
      }
    }
    branch_.assign(is_cut_.size(), outside);
    for (std::uint32_t h = 0; h < is_cut_.size(); ++h) {
      if (!is_cut_[h]) continue;
      const std::uint32_t first = sides.find(h), other = sides.find(flat_.opposite[h]);
      if (other < first) continue;  // the other side names it
      if (first == h) {
        branch_[h] = static_cast<std::uint32_t>(chart_.branch_edges.size());
        chart_.branch_edges.push_back(h);
      } else {
        branch_[h] = branch_[first];
      }
    }
  }

  /// Translation across h, from the opposite chart into ours.
  LinearForm translation(std::uint32_t h) const {
    if (!is_cut_[h]) return {};
    const auto points = static_cast<std::uint32_t>(chart_.first_corner.size());
    if (branch_[h] != outside) return {{points + branch_[h], {1, 0}}};
    const std::uint32_t other = flat_.opposite[h];
    return {{points + branch_[other], turned(GaussianInteger{1, 0}, turns(h) + 2)}};
  }

  void write_corners() {
    chart_.corners.assign(is_cut_.size(), {});
    for (std::uint32_t p = 0; p < chart_.first_corner.size(); ++p) {
      const std::uint32_t first = chart_.first_corner[p];
      if (first == outside) continue;
      chart_.corners[first] = {{p, {1, 0}}};
      for (std::uint32_t h = first, next = flat_.left_of(h); next != outside && next != first;
           h = next, next = flat_.left_of(h))
        chart_.corners[next] = combine(chart_.corners[h], turns(next), translation(next), 0);
    }
  }

  const FlatMesh& flat_;
  CutChart chart_;
  std::vector<std::uint8_t> is_cut_;                 // per half-edge
  std::vector<std::uint8_t> is_boundary_;            // per point
  std::vector<std::vector<std::uint32_t>> cut_out_;  // per point: half-edges out of it on the cut
  std::vector<std::uint32_t> branch_;                // per half-edge on the naming side of its branch
};

}  // namespace

std::vector<IntegerTerm> CutChart::expand(const FlatMesh& flat, const LinearForm& form) const {
  std::vector<IntegerTerm> terms;
  std::vector<std::pair<std::uint32_t, GaussianInteger>>
      waiting;  // ranks of triangles whose charts must be carried back
  const auto wait = [&](std::uint32_t triangle, GaussianInteger coefficient) {
    waiting.emplace_back(rank[triangle], coefficient);
    std::push_heap(waiting.begin(), waiting.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  };
  const auto take = [&] {
    const auto top = waiting.front();
    std::pop_heap(waiting.begin(), waiting.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    waiting.pop_back();
    return top;
  };
  const auto add_corner = [&](std::uint32_t corner, GaussianInteger coefficient) {
    terms.push_back({corner, turned(coefficient, turns[corner / 3])});
    wait(corner / 3, coefficient);
  };
  const auto points = static_cast<std::uint32_t>(first_corner.size());
  for (const LinearTerm& term : form) {
    if (term.variable < points) {
      add_corner(first_corner[term.variable], term.coefficient);
    } else {
      const std::uint32_t h = branch_edges[term.variable - points], other = flat.opposite[h];
      add_corner(h, term.coefficient);
      add_corner(FlatMesh::next(other), -turned(term.coefficient, flat.turns[h] + turns[h / 3] - turns[other / 3]));
    }
  }
  // A chart lies in its piece's as the one before it does, and the translation between the two. Where all that is
  // wanted of a triangle cancels, so does the rest of the way back.
  while (!waiting.empty()) {
    auto [last, coefficient] = take();
    while (!waiting.empty() && waiting.front().first == last) coefficient = coefficient + take().second;
    const std::uint32_t h = entered_by[walk[last]];
    if (coefficient == GaussianInteger{} || h == outside) continue;
    terms.push_back({h, turned(coefficient, turns[h / 3])});
    terms.push_back({FlatMesh::next(flat.opposite[h]), -turned(coefficient, turns[h / 3] + flat.turns[h])});
    wait(h / 3, coefficient);
  }
  std::sort(terms.begin(), terms.end(), [](const IntegerTerm& a, const IntegerTerm& b) { return a.corner < b.corner; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms.size();) {
    IntegerTerm sum = terms[i];
    for (++i; i < terms.size() && terms[i].corner == sum.corner; ++i)
      sum.coefficient = sum.coefficient + terms[i].coefficient;
    if (!(sum.coefficient == GaussianInteger{})) terms[kept++] = sum;
  }
  terms.resize(kept);
  return terms;
}

CutChart cut_chart(const FlatMesh& flat) { return Cutter(flat).run(); }

}  // namespace strataflow
