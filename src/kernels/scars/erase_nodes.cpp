#include "kernels/scars/erase_nodes.h"

#include <algorithm>
#include <optional>
#include <queue>

#include "base/id.h"

namespace strataflow {

namespace {

class Eraser {
 public:
  Eraser(const std::vector<Vec3>& points, std::vector<Triangle>& triangles, std::vector<std::uint32_t>& patch,
         const std::vector<std::uint32_t>& nodes, const std::vector<char>& is_shared,
         const std::vector<std::array<std::uint32_t, 2>>& original_edge, const ErasureOptions& options)
      : points_(points),
        triangles_(triangles),
        patch_(patch),
        is_shared_(is_shared),
        original_edge_(original_edge),
        options_(options),
        alive_(triangles.size(), 1),
        rank_(points.size(), no_index),
        slot_(points.size(), no_index) {
    for (std::uint32_t i = 0; i < nodes.size(); ++i) rank_[nodes[i]] = i;
    // Stars of the nodes and of their neighbours: any node ever met on a rim is one of these.
    for (const Triangle& t : triangles)
      if (rank_[t[0]] != no_index || rank_[t[1]] != no_index || rank_[t[2]] != no_index)
        for (const std::uint32_t v : t)
          if (slot_[v] == no_index) slot_[v] = star_count_++;
    stars_.resize(star_count_);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (const std::uint32_t v : triangles[t])
        if (slot_[v] != no_index) stars_[slot_[v]].push_back(t);
    reason_.assign(nodes.size(), ErasureRefusal::on_border);
    is_erased_.assign(nodes.size(), 0);
    stamp_.assign(nodes.size(), 0);
    for (const std::uint32_t v : nodes) {
      if (slot_[v] == no_index) continue;
      if (find_rim(v)) {
        const std::size_t valence = star(v).size();
        if (report_.valence_count.size() <= valence) report_.valence_count.resize(valence + 1, 0);
        ++report_.valence_count[valence];
      }
      queue(v);
    }
  }

  ErasureReport run(const std::vector<std::uint32_t>& nodes) {
    while (!queue_.empty()) {
      const auto [key, rank, stamp] = queue_.top();
      queue_.pop();
      if (stamp != stamp_[rank] || is_erased_[rank]) continue;
      const std::uint32_t v = nodes[rank];
      if (const std::optional<ErasureRefusal> refusal = erase(v)) {
        reason_[rank] = *refusal;
        continue;  // tried again when its star changes
      }
      is_erased_[rank] = 1;
      report_.erased.push_back(v);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!is_erased_[i] && slot_[nodes[i]] != no_index) report_.refused.push_back({nodes[i], reason_[i]});
    std::sort(report_.refused.begin(), report_.refused.end(),
              [](const RefusedErasure& a, const RefusedErasure& b) { return a.node < b.node; });
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!alive_[t]) continue;
      triangles_[kept] = triangles_[t];
      patch_[kept++] = patch_[t];
    }
    triangles_.resize(kept);
    patch_.resize(kept);
    return std::move(report_);
  }

 private:
  struct Entry {
    std::uint32_t key, rank, stamp;
    bool operator<(const Entry& other) const {  // the queue's top is the greatest
      return key != other.key ? key > other.key : rank > other.rank;
    }
  };

  std::vector<std::uint32_t>& star(std::uint32_t v) { return stars_[slot_[v]]; }

  void queue(std::uint32_t v) {
    const std::uint32_t rank = rank_[v];
    const auto valence = static_cast<std::uint32_t>(star(v).size());
    queue_.push({options_.order == ErasureOrder::valence_priority ? valence : rank, rank, ++stamp_[rank]});
  }

  /// The closed rim around v in the sense of its triangles, from its lowest node; nothing when v is on a border.
  bool find_rim(std::uint32_t v) {
    const std::vector<std::uint32_t>& around = star(v);
    sides_.clear();
    for (const std::uint32_t t : around) {
      if (patch_[t] != patch_[around[0]]) return false;
      const Triangle& n = triangles_[t];
      const int k = n[0] == v ? 0 : n[1] == v ? 1 : 2;
      sides_.push_back({n[(k + 1) % 3], n[(k + 2) % 3]});
    }
    std::sort(sides_.begin(), sides_.end());
    rim_.assign(1, sides_.empty() ? no_index : sides_[0][0]);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const auto next = std::lower_bound(sides_.begin(), sides_.end(), std::array<std::uint32_t, 2>{rim_.back(), 0});
      if (next == sides_.end() || (*next)[0] != rim_.back()) return false;
      if (next + 1 != sides_.end() && (next[1])[0] == rim_.back()) return false;
      if ((*next)[1] == rim_[0]) return rim_.size() == sides_.size() && rim_.size() > 2;
      rim_.push_back((*next)[1]);
    }
    return false;
  }

  bool is_in_star(std::uint32_t t, std::uint32_t v) const {
    return triangles_[t][0] == v || triangles_[t][1] == v || triangles_[t][2] == v;
  }

  /// The diagonals of the rim that are edges outside the star of v.
  void find_taken(std::uint32_t v) {
    const std::size_t n = rim_.size();
    taken_.assign(n * n, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (const std::uint32_t t : star(rim_[i])) {
        if (is_in_star(t, v)) continue;
        for (std::size_t j = i + 1; j < n; ++j)
          if (is_in_star(t, rim_[j])) taken_[i * n + j] = taken_[j * n + i] = 1;
      }
  }

  /// The filling that holds the edge `v` was put on, if both its ends are on the rim and it fits.
  std::optional<std::vector<Triangle>> fill_along_original_edge(std::uint32_t v) const {
    if (original_edge_.empty() || options_.diagonal == QuadDiagonal::shortest) return std::nullopt;
    const std::size_t n = rim_.size();
    std::size_t i = static_cast<std::size_t>(std::find(rim_.begin(), rim_.end(), original_edge_[v][0]) - rim_.begin());
    std::size_t j = static_cast<std::size_t>(std::find(rim_.begin(), rim_.end(), original_edge_[v][1]) - rim_.begin());
    if (i > j) std::swap(i, j);
    if (j >= n || j - i < 2 || i + n - j < 2 || taken_[i * n + j] || !project_polygon(points_, rim_))
      return std::nullopt;
    const auto part = [&](std::size_t from, std::size_t count) {
      std::vector<std::size_t> at(count);
      std::vector<std::uint32_t> polygon(count);
      for (std::size_t k = 0; k < count; ++k) {
        at[k] = (from + k) % n;
        polygon[k] = rim_[at[k]];
      }
      std::vector<char> taken(count * count);
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b) taken[a * count + b] = taken_[at[a] * n + at[b]];
      return fill_polygon(points_, polygon, taken);
    };
    auto first = part(i, j - i + 1);
    const auto second = part(j, i + n - j + 1);
    if (!first || !second) return std::nullopt;
    first->insert(first->end(), second->begin(), second->end());
    return first;
  }

  std::optional<ErasureRefusal> erase(std::uint32_t v) {
    if (is_shared_[v]) return ErasureRefusal::shared_place;
    if (!find_rim(v)) return ErasureRefusal::on_border;
    const std::size_t n = rim_.size();
    find_taken(v);
    if (n == 3) {  // no diagonal, but the triangle itself may exist: v is the apex of a closed tetrahedron
      for (const std::uint32_t t : star(rim_[0]))
        if (is_in_star(t, rim_[1]) && is_in_star(t, rim_[2])) return ErasureRefusal::repeated_edge;
    }
    std::optional<std::vector<Triangle>> fill = n > 3 ? fill_along_original_edge(v) : std::nullopt;
    if (!fill && n == 4) {  // the diagonal between the other scar nodes would keep the scar alive
      const auto is_scar = [&](std::size_t i) { return rank_[rim_[i]] != no_index; };
      const std::size_t on_tie = is_scar(0) + is_scar(2) > is_scar(1) + is_scar(3) ? 1 : 0;
      fill = fill_quad(points_, rim_, points_[v], options_.diagonal, taken_, on_tie);
    } else if (!fill) {
      fill = fill_polygon(points_, rim_, taken_);
    }
    if (!fill)
      return std::find(taken_.begin(), taken_.end(), 1) != taken_.end() && fill_polygon(points_, rim_)
                 ? ErasureRefusal::repeated_edge
                 : ErasureRefusal::crossing_fill;
    ++(n <= 4 ? report_.direct_fills : report_.delaunay_fills);

    // The new triangles take the lowest places of the old ones.
    std::vector<std::uint32_t> places = star(v);
    std::sort(places.begin(), places.end());
    for (const std::uint32_t t : places)
      for (const std::uint32_t w : triangles_[t]) {
        if (w == v) continue;
        std::vector<std::uint32_t>& other = star(w);
        other.erase(std::remove(other.begin(), other.end(), t), other.end());
      }
    star(v).clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
      alive_[places[i]] = i < fill->size();
      if (!alive_[places[i]]) continue;
      triangles_[places[i]] = (*fill)[i];
      for (const std::uint32_t w : (*fill)[i]) star(w).push_back(places[i]);
    }
    for (const std::uint32_t w : rim_)
      if (rank_[w] != no_index && !is_erased_[rank_[w]]) queue(w);
    return std::nullopt;
  }

  const std::vector<Vec3>& points_;
  std::vector<Triangle>& triangles_;
  std::vector<std::uint32_t>& patch_;
  const std::vector<char>& is_shared_;
  const std::vector<std::array<std::uint32_t, 2>>& original_edge_;
  ErasureOptions options_;
  std::vector<char> alive_;
  std::vector<std::uint32_t> rank_;  ///< per point: its place among the nodes
  std::vector<std::uint32_t> slot_;  ///< per point: its star
  std::uint32_t star_count_ = 0;
  std::vector<std::vector<std::uint32_t>> stars_;
  std::vector<ErasureRefusal> reason_;
  std::vector<char> is_erased_;
  std::vector<std::uint32_t> stamp_;
  std::priority_queue<Entry> queue_;
  std::vector<std::array<std::uint32_t, 2>> sides_;
  std::vector<std::uint32_t> rim_;
  std::vector<char> taken_;
  ErasureReport report_;
};

}  // namespace

ErasureReport erase_nodes(const std::vector<Vec3>& points, std::vector<Triangle>& triangles,
                          std::vector<std::uint32_t>& triangle_patch, const std::vector<std::uint32_t>& nodes,
                          const std::vector<char>& is_shared,
                          const std::vector<std::array<std::uint32_t, 2>>& original_edge,
                          const ErasureOptions& options) {
  return Eraser(points, triangles, triangle_patch, nodes, is_shared, original_edge, options).run(nodes);
}

}  // namespace strataflow
