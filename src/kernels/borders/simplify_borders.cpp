#include "kernels/borders/simplify_borders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/id.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/borders/border_lines.h"
#include "kernels/borders/relax_ring.h"
#include "kernels/borders/resample_borders.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/scars/drop_unused_points.h"
#include "kernels/topology/building/weld_points.h"
#include "kernels/topology/keep_triangles.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

/// The number of separate fans of surfaces at each point.
std::vector<std::uint32_t> count_fans(std::size_t point_count, const std::vector<Triangle>& triangles,
                                      const EdgeTable& edges, const std::vector<char>& is_feature) {
  UnionFind corners(3 * triangles.size());
  for (std::uint32_t e = 0; e < edges.edge_count(); ++e) {
    if (is_feature[e]) continue;
    const std::uint32_t h = edges.around(e)[0], other = edges.around(e)[1];
    const std::uint32_t u = other / 3;
    for (const std::uint32_t c : {h, h / 3 * 3 + (h % 3 + 1) % 3})
      for (std::uint32_t k = 0; k < 3; ++k)
        if (triangles[u][k] == triangles[c / 3][c % 3]) corners.unite(c, 3 * u + k);
  }
  std::vector<std::uint32_t> count(point_count, 0);
  for (std::uint32_t c = 0; c < 3 * triangles.size(); ++c)
    if (corners.find(c) == c) ++count[triangles[c / 3][c % 3]];
  return count;
}

/// One pass: tries to resample every border that has too many nodes; each failure takes borders out and starts anew.
class Pass {
 public:
  Pass(TriangleSoup& soup, const SimplifyBordersOptions& options)
      : soup_(soup),
        options_(options),
        network_(find_radial_borders(soup.points, soup.triangles, soup.triangle_patch, options.corner_angle_deg)),
        is_chosen_(network_.borders.size(), 0),
        is_pinned_(soup.points.size(), 0) {}

  const BorderNetwork& network() const { return network_; }
  const std::vector<RefusedBorder>& refused() const { return refused_; }
  std::uint64_t resampled() const {
    return static_cast<std::uint64_t>(std::count(is_chosen_.begin(), is_chosen_.end(), 1));
  }
  std::uint64_t relaxed() const { return relaxed_; }

  /// Changes the soup; false if no border can be simplified.
  bool run() {
    for (std::size_t b = 0; b < is_chosen_.size(); ++b)
      is_chosen_[b] = network_.borders[b].wanted_edge_count() < network_.borders[b].edge_count();
    if (resampled() == 0) return false;
    fans_before_ = count_fans(soup_.points.size(), soup_.triangles, network_.edges, network_.is_feature);
    while (resampled() > 0)
      if (attempt()) return true;
    return false;
  }

 private:
  bool attempt() {
    mesh_ = resample_borders(soup_.points, soup_.triangles, network_, is_chosen_);
    doomed_.assign(network_.borders.size(), std::nullopt);
    is_ring_.assign(mesh_.points.size(), 0);
    has_new_pin_ = false;
    keep_upright_pieces();
    check_normals();
    check_edges_and_fans();
    check_surfaces();
    if (refuse_doomed()) return false;
    relax();
    check_crossings();
    check_orders();
    if (has_new_pin_ || refuse_doomed()) return false;
    check_gain();
    if (refuse_doomed()) return false;
    commit();
    return true;
  }

  void keep_upright_pieces() {
    triangles_.clear();
    piece_.clear();
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
      if (!mesh_.is_flat[i]) {
        triangles_.push_back(mesh_.triangles[i]);
        piece_.push_back(i);
      }
  }

  /// The last border that moved a corner of the piece is given up; the others have their chance alone.
  void blame_piece(std::uint32_t piece, BorderRefusal reason) {
    std::uint32_t last = no_index;
    for (const std::uint32_t b : mesh_.borders[piece])
      if (b != no_index && (last == no_index || b > last)) last = b;
    if (last != no_index && !doomed_[last]) doomed_[last] = reason;
  }

  /// After relaxation: nodes moved are put back first.
  void blame_relaxed(std::uint32_t triangle, BorderRefusal reason) {
    bool pinned = false;
    for (const std::uint32_t v : triangles_[triangle])
      if (v < is_pinned_.size() && is_ring_[v] && !is_pinned_[v]) {
        is_pinned_[v] = 1;
        pinned = true;
      }
    has_new_pin_ = has_new_pin_ || pinned;
    if (!pinned) blame_piece(piece_[triangle], reason);
  }

  bool is_changed(std::uint32_t triangle) const {
    for (const std::uint32_t b : mesh_.borders[piece_[triangle]])
      if (b != no_index) return true;
    for (const std::uint32_t v : triangles_[triangle])
      if (is_ring_[v]) return true;
    return false;
  }

  static Vec3 normal(const std::vector<Vec3>& points, const Triangle& t) {
    return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
  }

  void check_normals() {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!is_changed(t)) continue;
      const Triangle &now = triangles_[t], &before = soup_.triangles[mesh_.source[piece_[t]]];
      if (is_degenerate(mesh_.points, now) ||
          (!is_degenerate(soup_.points, before) && !(dot(normal(mesh_.points, now), normal(soup_.points, before)) > 0)))
        blame_piece(piece_[t], BorderRefusal::folded);
    }
  }

  /// The edges that bound surfaces must be those of the resampled chains and the untouched rest, with as many triangles
  /// around, and the fans at every point as many as before.
  void check_edges_and_fans() {
    std::vector<std::uint32_t> label(triangles_.size());
    for (std::size_t t = 0; t < label.size(); ++t) label[t] = network_.surface_of[mesh_.source[piece_[t]]];
    edges_ = build_edge_table(mesh_.points.size(), triangles_);
    struct Bound {
      std::array<std::uint32_t, 2> ends;
      std::size_t around;
      std::uint32_t border;
    };
    std::vector<Bound> expected;
    for (std::uint32_t b = 0; b < mesh_.chains.size(); ++b) {
      if (!is_chosen_[b]) continue;
      const auto& chain = mesh_.chains[b];
      const auto& nodes = network_.borders[b].nodes;
      const std::size_t around = network_.edges.around(find_edge(network_.edges, nodes[0], nodes[1])).size();
      for (std::size_t i = 0; i + (network_.borders[b].is_closed ? 0 : 1) < chain.size(); ++i) {
        const std::uint32_t from = chain[i], to = chain[(i + 1) % chain.size()];
        expected.push_back({{std::min(from, to), std::max(from, to)}, around, b});
      }
    }
    std::vector<char> is_replaced(network_.edges.edge_count(), 0);
    for (std::uint32_t b = 0; b < is_chosen_.size(); ++b) {
      const auto& nodes = network_.borders[b].nodes;
      for (std::size_t i = 0; is_chosen_[b] && i < network_.borders[b].edge_count(); ++i)
        is_replaced[find_edge(network_.edges, nodes[i], nodes[(i + 1) % nodes.size()])] = 1;
    }
    for (std::uint32_t e = 0; e < network_.edges.edge_count(); ++e)
      if (network_.is_feature[e] && !is_replaced[e])
        expected.push_back({network_.edges.edges[e], network_.edges.around(e).size(), no_index});
    std::sort(expected.begin(), expected.end(),
              [](const Bound& a, const Bound& b) { return a.ends != b.ends ? a.ends < b.ends : a.border < b.border; });
    std::vector<char> is_feature(edges_.edge_count());
    std::size_t next = 0;
    const auto doom = [&](std::uint32_t border) {
      if (border != no_index && !doomed_[border]) doomed_[border] = BorderRefusal::pinched;
    };
    for (std::uint32_t e = 0; e < edges_.edge_count(); ++e) {
      is_feature[e] = is_feature_edge(edges_, e, label);
      for (; next < expected.size() && expected[next].ends < edges_.edges[e]; ++next)
        doom(expected[next].border);  // lost
      bool is_expected = false;
      for (; next < expected.size() && expected[next].ends == edges_.edges[e]; ++next) {
        if (is_expected || expected[next].around != edges_.around(e).size()) doom(expected[next].border);
        is_expected = true;
      }
      if (is_feature[e] != static_cast<char>(is_expected))
        for (const std::uint32_t h : edges_.around(e)) blame_piece(piece_[h / 3], BorderRefusal::pinched);
    }
    for (; next < expected.size(); ++next) doom(expected[next].border);

    const std::vector<std::uint32_t> fans = count_fans(mesh_.points.size(), triangles_, edges_, is_feature);
    std::vector<char> is_wrong(mesh_.points.size(), 0), stays(mesh_.points.size(), 0);
    for (const auto& chain : mesh_.chains)
      for (const std::uint32_t v : chain) stays[v] = 1;
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      const std::uint32_t b = mesh_.border_of[v];
      if (v < soup_.points.size() ? (b == no_index || stays[v]) && fans[v] != fans_before_[v] : false) is_wrong[v] = 1;
    }
    for (std::uint32_t b = 0; b < mesh_.chains.size();
         ++b) {  // inner nodes are alike: as many fans as triangles on an edge
      if (!is_chosen_[b]) continue;
      const std::uint32_t fan_count = fans_before_[network_.borders[b].nodes[network_.borders[b].is_closed ? 0 : 1]];
      for (const std::uint32_t v : mesh_.chains[b])
        if (v >= soup_.points.size() && fans[v] != fan_count) is_wrong[v] = 1;
    }
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
      for (const std::uint32_t v : mesh_.triangles[i])
        if (is_wrong[v]) {
          blame_piece(i, BorderRefusal::pinched);
          break;
        }
  }

  void check_surfaces() {
    std::vector<char> is_left(network_.surface_count, 0);
    for (const std::uint32_t i : piece_) is_left[network_.surface_of[mesh_.source[i]]] = 1;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
      if (!is_left[network_.surface_of[mesh_.source[i]]]) blame_piece(i, BorderRefusal::emptied);
  }

  /// Names the doomed borders and takes them out.
  bool refuse_doomed() {
    bool any = false;
    for (std::size_t b = 0; b < doomed_.size(); ++b) {
      if (!doomed_[b]) continue;
      const RadialBorder& border = network_.borders[b];
      is_chosen_[b] = 0;
      refused_.push_back({soup_.points[border.nodes.front()],
                          soup_.points[border.is_closed ? border.nodes.front() : border.nodes.back()], *doomed_[b]});
      any = true;
    }
    return any;
  }

  void relax() {
    std::vector<char> is_on_border(mesh_.points.size(), 0), is_on_chain(mesh_.points.size(), 0);
    for (std::uint32_t e = 0; e < network_.edges.edge_count(); ++e)
      if (network_.is_feature[e])
        for (const std::uint32_t v : network_.edges.edges[e]) is_on_border[v] = 1;
    for (std::size_t v = soup_.points.size(); v < mesh_.points.size(); ++v) is_on_border[v] = 1;
    for (std::uint32_t b = 0; b < mesh_.chains.size(); ++b)
      if (is_chosen_[b])
        for (const std::uint32_t v : mesh_.chains[b]) is_on_chain[v] = 1;
    std::vector<std::uint32_t> ring;
    for (const auto& [a, b] : edges_.edges) {
      if (is_on_chain[a] && !is_on_border[b]) ring.push_back(b);
      if (is_on_chain[b] && !is_on_border[a]) ring.push_back(a);
    }
    std::erase_if(ring, [&](std::uint32_t v) { return is_pinned_[v]; });
    const std::vector<std::uint32_t> moved =
        relax_ring(mesh_.points, triangles_, sorted_unique(std::move(ring)), options_.corner_angle_deg);
    for (const std::uint32_t v : moved) is_ring_[v] = 1;
    relaxed_ = moved.size();
  }

  bool met_before(std::uint32_t s, std::uint32_t t) const {
    const Triangle &v = soup_.triangles[s], &w = soup_.triangles[t];
    return s != t && !is_degenerate(soup_.points, v) && !is_degenerate(soup_.points, w) &&
           meeting_of(soup_.points, v, w) != PairMeeting::proper;
  }

  void check_crossings() {
    std::vector<char> changed(triangles_.size());
    for (std::uint32_t t = 0; t < changed.size(); ++t) changed[t] = is_changed(t);
    for (const IntersectingPair& pair : find_intersections_of(mesh_.points, triangles_, changed)) {
      if (met_before(mesh_.source[piece_[pair.first]], mesh_.source[piece_[pair.second]])) continue;
      blame_relaxed(pair.first, BorderRefusal::crossing);
      blame_relaxed(pair.second, BorderRefusal::crossing);
    }
  }

  void check_orders() {
    std::vector<std::uint32_t> label(triangles_.size());
    for (std::size_t t = 0; t < label.size(); ++t) label[t] = network_.surface_of[mesh_.source[piece_[t]]];
    for (std::uint32_t b = 0; b < mesh_.chains.size(); ++b) {
      if (network_.borders[b].radial_order.empty()) continue;
      const auto& chain = mesh_.chains[b];
      for (std::size_t i = 0; i + (network_.borders[b].is_closed ? 0 : 1) < chain.size(); ++i) {
        const std::uint32_t edge = find_edge(edges_, chain[i], chain[(i + 1) % chain.size()]);
        const auto around = edges_.around(edge);
        if (std::none_of(around.begin(), around.end(), [&](std::uint32_t h) { return is_changed(h / 3); })) continue;
        const auto order = surfaces_in_order(mesh_.points, triangles_, edges_, label, edge, chain[i]);
        if (order.empty() || order == network_.borders[b].radial_order) continue;
        for (const std::uint32_t h : around) blame_relaxed(h / 3, BorderRefusal::reordered);
      }
    }
  }

  static double smallest_angle(const std::vector<Vec3>& points, const Triangle& t) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = points[t[(k + 1) % 3]] - points[t[k]], w = points[t[(k + 2) % 3]] - points[t[k]];
      least = std::min(least, std::atan2(length(cross(u, w)), dot(u, w)));
    }
    return least;
  }

  /// The aim is better triangles: the worst beside a border, its relaxed ring included, must not get worse.
  void check_gain() {
    constexpr double straight = 4;  // more than any angle
    std::vector<double> before(mesh_.chains.size(), straight), after(mesh_.chains.size(), straight);
    const auto take = [&](std::vector<double>& least, const std::array<std::uint32_t, 3>& borders, double angle) {
      for (const std::uint32_t b : borders)
        if (b != no_index) least[b] = std::min(least[b], angle);
    };
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const Triangle& old = soup_.triangles[mesh_.source[i]];
      std::array<std::uint32_t, 3> borders{};
      for (int k = 0; k < 3; ++k) borders[k] = mesh_.border_of[old[k]];
      take(before, borders, smallest_angle(soup_.points, old));
    }
    std::vector<std::uint32_t> ring_border(mesh_.points.size(), no_index);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t v : triangles_[t])
        if (is_ring_[v])
          for (const std::uint32_t b : mesh_.borders[piece_[t]]) ring_border[v] = std::min(ring_border[v], b);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const double now = smallest_angle(mesh_.points, triangles_[t]);
      take(after, mesh_.borders[piece_[t]], now);
      const Triangle& old = soup_.triangles[mesh_.source[piece_[t]]];
      const double was = smallest_angle(soup_.points, old);
      for (const std::uint32_t v : triangles_[t])
        if (is_ring_[v] && ring_border[v] != no_index) {
          take(before, {ring_border[v], no_index, no_index}, was);
          take(after, {ring_border[v], no_index, no_index}, now);
        }
    }
    for (std::uint32_t b = 0; b < mesh_.chains.size(); ++b)
      if (is_chosen_[b] && after[b] < before[b]) doomed_[b] = BorderRefusal::no_gain;
  }

  void commit() {
    std::vector<std::uint32_t> patch(triangles_.size());
    for (std::size_t t = 0; t < patch.size(); ++t) patch[t] = soup_.triangle_patch[mesh_.source[piece_[t]]];
    for (PointProperty& property : soup_.properties)
      for (const auto& [a, b, share] : mesh_.new_points)
        for (std::size_t w = 0; w < property.width; ++w)
          property.values.push_back((1 - share) * property.values[a * std::size_t{property.width} + w] +
                                    share * property.values[b * std::size_t{property.width} + w]);
    std::vector<char> is_kept(mesh_.points.size(), 1);
    for (const Triangle& t : soup_.triangles)
      for (const std::uint32_t v : t) is_kept[v] = 0;
    soup_.points = std::move(mesh_.points);
    soup_.triangles = std::move(triangles_);
    soup_.triangle_patch = std::move(patch);
    drop_unused_points(soup_, std::move(is_kept));
  }

  TriangleSoup& soup_;
  SimplifyBordersOptions options_;
  BorderNetwork network_;
  std::vector<char> is_chosen_;
  std::vector<char> is_pinned_;  ///< per old point: not to be relaxed
  std::vector<std::uint32_t> fans_before_;
  std::vector<RefusedBorder> refused_;
  std::uint64_t relaxed_ = 0;

  // Of the present attempt:
  ResampledMesh mesh_;
  std::vector<Triangle> triangles_;   ///< pieces that are not flat
  std::vector<std::uint32_t> piece_;  ///< per triangle: its piece
  EdgeTable edges_;
  std::vector<std::optional<BorderRefusal>> doomed_;
  std::vector<char> is_ring_;  ///< per point: relaxed
  bool has_new_pin_ = false;
};

/// Equal positions become one point; triangles that repeat one then go.
TriangleSoup welded(TriangleSoup soup) {
  const WeldedPoints points = weld_points(soup.points);
  std::vector<char> is_kept(soup.triangles.size());
  for (std::size_t t = 0; t < is_kept.size(); ++t) {
    Triangle& v = soup.triangles[t];
    for (std::uint32_t& corner : v) corner = points.source[points.id[corner]];
    is_kept[t] = v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
  }
  keep_triangles(soup, is_kept);
  for (std::uint32_t& v : soup.border_stones) v = points.source[points.id[v]];
  for (auto& ends : soup.border_starts)
    for (std::uint32_t& v : ends) v = points.source[points.id[v]];
  drop_unused_points(soup, std::vector<char>(soup.points.size(), 0));
  return soup;
}

std::uint64_t inner_node_count(const BorderNetwork& network) {
  std::uint64_t count = 0;
  for (const RadialBorder& border : network.borders) count += border.edge_count() - (border.is_closed ? 0 : 1);
  return count;
}

}  // namespace

Result<SimplifiedSoup> simplify_borders(const TriangleSoup& soup, const SimplifyBordersOptions& options) {
  if (options.passes < 1 || !(options.corner_angle_deg > 0 && options.corner_angle_deg <= 180))
    return Failure{FailureCode::invalid_options, "simplification needs passes ≥ 1 and corner_angle_deg in (0, 180]",
                   "correct the section [simplify] of the job file"};
  SimplifiedSoup simplified{welded(soup), {}};
  SimplificationReport& report = simplified.report;
  for (std::int64_t pass = 0; pass <= options.passes; ++pass) {
    Pass next(simplified.soup, options);
    if (pass == 0) {
      report.border_count = next.network().borders.size();
      report.nodes_before = inner_node_count(next.network());
    }
    report.nodes_after = inner_node_count(next.network());
    if (pass == options.passes) break;
    const bool has_changed = next.run();
    report.refused = next.refused();
    if (!has_changed) break;
    ++report.passes;
    report.resampled_borders += next.resampled();
    report.relaxed_nodes += next.relaxed();
  }
  return simplified;
}

}  // namespace strataflow
