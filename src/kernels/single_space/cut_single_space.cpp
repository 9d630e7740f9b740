#include "kernels/single_space/cut_single_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/scars/pair_borders.h"
#include "kernels/scars/polygon_fill.h"
#include "kernels/single_space/cutting_surface.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

class SingleSpaceCutter {
 public:
  SingleSpaceCutter(const TriangleSoup& soup, std::uint32_t cut, std::uint32_t cutting,
                    const SingleSpaceOptions& options)
      : options_(options), cut_(cut), cutter_(soup.points, triangles_of(soup, cutting)) {
    out_.soup = soup;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
      if (soup.patch_entity[soup.triangle_patch[t]] == cut) {
        triangles_.push_back(soup.triangles[t]);
        patch_.push_back(soup.triangle_patch[t]);
        source_.push_back(t);
      }
    mates_ = find_mates(soup.points.size(), triangles_, patch_);
    apex_.assign(3 * triangles_.size(), no_index);
    piece_.assign(3 * triangles_.size(), no_index);
  }

  SingleSpaceCut run() {
    find_crossings();
    elect_vertices();
    insert_nodes();
    join_nodes();
    trace_old_edges();
    split();
    return std::move(out_);
  }

  static std::vector<Triangle> triangles_of(const TriangleSoup& soup, std::uint32_t entity) {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      if (soup.patch_entity[soup.triangle_patch[t]] == entity) triangles.push_back(soup.triangles[t]);
    return triangles;
  }

 private:
  using Crossing = CuttingSurface::Crossing;
  const Vec3& at(std::uint32_t v) const { return out_.soup.points[v]; }
  std::uint32_t from(std::uint32_t h) const { return triangles_[h / 3][h % 3]; }
  std::uint32_t to(std::uint32_t h) const { return triangles_[h / 3][(h % 3 + 1) % 3]; }
  Vec3 normal(const Triangle& t) const { return cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])); }

  void find_crossings() {
    const auto found = parallel_map(
        3 * triangles_.size(),
        [&](std::size_t i) -> std::optional<Crossing> {
          const auto h = static_cast<std::uint32_t>(i);
          if (mates_[h] < h) return std::nullopt;  // asked from the other side
          const std::uint32_t low = std::min(from(h), to(h)), high = std::max(from(h), to(h));
          return cutter_.cross_segment(at(low), at(high));
        },
        1024);
    crossing_.resize(found.size());
    for (std::uint32_t h = 0; h < found.size(); ++h) crossing_[h] = mates_[h] < h ? found[mates_[h]] : found[h];
  }

  /// The crossed sides of a triangle, if it is crossed plainly: two sides, once each.
  std::optional<std::array<std::uint32_t, 2>> plain_crossing(std::uint32_t t) const {
    std::array<std::uint32_t, 2> sides{};
    int count = 0;
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (!crossing_[h]) continue;
      if (!crossing_[h]->is_single || count == 2) return std::nullopt;
      sides[count++] = h;
    }
    if (count != 2) return std::nullopt;
    return sides;
  }

  void elect_vertices() {
    const std::size_t point_count = out_.soup.points.size();
    is_on_.assign(point_count, 0);
    std::vector<char> is_border(point_count, 0), is_fixed(point_count, 0);
    for (std::uint32_t h = 0; h < mates_.size(); ++h)
      if (mates_[h] == no_index) is_border[from(h)] = is_border[to(h)] = 1;
    for (std::size_t t = 0; t < out_.soup.triangles.size(); ++t)
      if (out_.soup.patch_entity[out_.soup.triangle_patch[t]] != cut_)
        for (const std::uint32_t v : out_.soup.triangles[t]) is_fixed[v] = 1;
    struct Vote {
      std::uint32_t vertex;
      double distance;
      std::uint32_t triangle;
      Vec3 target;
    };
    std::vector<Vote> votes;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      bool is_crossed = false;
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) is_crossed = is_crossed || crossing_[h];
      out_.report.crossed_triangles += is_crossed;
      const auto sides = plain_crossing(t);
      if (!sides) continue;
      const Vec3 &x = crossing_[(*sides)[0]]->point, &y = crossing_[(*sides)[1]]->point;
      double shortest = std::numeric_limits<double>::infinity(), nearest = shortest;
      int best = 0;
      for (int k = 0; k < 3; ++k) {
        shortest = std::min(shortest, length(at(triangles_[t][(k + 1) % 3]) - at(triangles_[t][k])));
        const double distance = distance_to_segment(at(triangles_[t][k]), x, y);
        if (distance < nearest) {
          nearest = distance;
          best = k;
        }
      }
      const std::uint32_t v = triangles_[t][best];
      const double most = is_border[v] || is_fixed[v] ? 1e-9 : options_.close_ratio;  // those move by rounding at most
      if (!(nearest <= most * shortest)) continue;
      const Vec3 d = y - x;
      const double square = dot(d, d), s = square > 0 ? std::clamp(dot(at(v) - x, d) / square, 0.0, 1.0) : 0.0;
      Vec3 target = x + s * d;
      // Along the triangle's plane onto the cutting surface, which may be curved between x and y.
      const Vec3 n = normal(triangles_[t]), slope = cutter_.normal(crossing_[(*sides)[0]]->triangle);
      const Vec3 way = dot(n, n) * slope - dot(n, slope) * n;
      if (length(way) > 0) {
        const Vec3 reach = (0.1 * shortest / length(way)) * way;
        if (const auto hit = cutter_.cross_segment(target - reach, target + reach)) target = hit->point;
      }
      votes.push_back({v, nearest, t, is_border[v] || is_fixed[v] ? at(v) : target});
    }
    std::sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) {
      if (a.vertex != b.vertex) return a.vertex < b.vertex;
      return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
    });
    std::vector<std::vector<std::uint32_t>> star(votes.size());
    std::vector<std::uint32_t> first_vote(point_count, no_index);
    for (std::uint32_t i = 0; i < votes.size(); ++i)
      if (i == 0 || votes[i].vertex != votes[i - 1].vertex) first_vote[votes[i].vertex] = i;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t v : triangles_[t])
        if (first_vote[v] != no_index) star[first_vote[v]].push_back(t);
    for (std::uint32_t i = 0; i < votes.size(); ++i) {
      const std::uint32_t v = votes[i].vertex;
      if (first_vote[v] != i) continue;
      const Vec3 old = at(v);
      std::vector<Vec3> before;
      for (const std::uint32_t t : star[i]) before.push_back(normal(triangles_[t]));
      out_.soup.points[v] = votes[i].target;
      bool is_upright = true;
      for (std::size_t s = 0; s < star[i].size(); ++s)
        is_upright = is_upright && !is_degenerate(out_.soup.points, triangles_[star[i][s]]) &&
                     dot(before[s], normal(triangles_[star[i][s]])) > 0;
      if (!is_upright) {
        out_.soup.points[v] = old;
        continue;
      }
      is_on_[v] = 1;
      out_.report.moved_vertices += !(old == votes[i].target);
    }
    for (std::uint32_t h = 0; h < crossing_.size(); ++h)
      if (is_on_[from(h)] || is_on_[to(h)]) crossing_[h].reset();
  }

  /// A new point as a mean of old ones; its values follow.
  std::uint32_t add_point(const Vec3& p, const std::array<std::uint32_t, 3>& of, const std::array<double, 3>& weight) {
    out_.soup.points.push_back(p);
    for (PointProperty& property : out_.soup.properties)
      for (std::size_t w = 0; w < property.width; ++w) {
        double value = 0;
        for (int k = 0; k < 3; ++k)
          if (weight[k] != 0) value += weight[k] * property.values[of[k] * std::size_t{property.width} + w];
        property.values.push_back(value);
      }
    is_on_.push_back(1);
    return static_cast<std::uint32_t>(out_.soup.points.size() - 1);
  }
  std::uint32_t add_point_on(std::uint32_t h) {
    const std::uint32_t low = std::min(from(h), to(h)), high = std::max(from(h), to(h));
    const double share = crossing_[h]->share;
    return add_point(crossing_[h]->point, {low, high, low}, {1 - share, share, 0});
  }
  /// Adds a piece of triangle t; `h`, if any, is the crossed side it keeps and `apex` the node it reaches from it.
  void add_piece(std::uint32_t t, const Triangle& piece, std::uint32_t h = no_index, std::uint32_t apex = no_index) {
    if (h != no_index) {
      piece_[h] = static_cast<std::uint32_t>(pieces_.size());
      apex_[h] = apex;
    }
    pieces_.push_back(piece);
    piece_source_.push_back(t);
  }
  void add_trace(std::uint32_t a, std::uint32_t b) { out_.trace.push_back({std::min(a, b), std::max(a, b)}); }

  void insert_nodes() {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const Triangle& n = triangles_[t];
      std::vector<std::uint32_t> crossed;
      bool is_plain = true;
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
        if (crossing_[h]) {
          crossed.push_back(h);
          is_plain = is_plain && crossing_[h]->is_single;
        }
      if (crossed.empty()) {
        add_piece(t, n);
      } else if (crossed.size() == 1 && is_plain && is_on_[n[(crossed[0] % 3 + 2) % 3]]) {
        cut_from_vertex(t, crossed[0]);
      } else if (crossed.size() == 2 && is_plain) {
        // Turn it so that its lone corner comes first: crossed[0] leaves it, crossed[1] returns to it.
        if (to(crossed[0]) == from(crossed[1])) std::swap(crossed[0], crossed[1]);
        cut_across(t, crossed[0], crossed[1]);
      } else {
        out_.report.skipped_triangles.push_back(source_[t]);
        add_piece(t, n);
      }
    }
  }

  void cut_from_vertex(std::uint32_t t, std::uint32_t h) {
    const std::uint32_t a = from(h), b = to(h), v = triangles_[t][(h % 3 + 2) % 3];
    if (mates_[h] != no_index) return add_piece(t, triangles_[t], h, v);
    const std::uint32_t node = add_point_on(h);
    ++out_.report.inserted_nodes;
    add_piece(t, {v, a, node});
    add_piece(t, {v, node, b});
    add_trace(v, node);
  }

  void cut_across(std::uint32_t t, std::uint32_t leaving, std::uint32_t returning) {
    const std::uint32_t a = from(leaving), b = to(leaving), c = from(returning);
    const bool b_border = mates_[leaving] == no_index, c_border = mates_[returning] == no_index;
    if (b_border && c_border) {
      const std::uint32_t p = add_point_on(leaving), q = add_point_on(returning);
      out_.report.inserted_nodes += 2;
      add_piece(t, {a, p, q});
      add_piece(t, {p, b, c});
      add_piece(t, {p, c, q});
      add_trace(p, q);
    } else if (b_border) {
      const std::uint32_t p = add_point_on(leaving);
      ++out_.report.inserted_nodes;
      add_piece(t, {a, p, c}, returning, p);
      add_piece(t, {p, b, c});
    } else if (c_border) {
      const std::uint32_t q = add_point_on(returning);
      ++out_.report.inserted_nodes;
      add_piece(t, {a, b, q}, leaving, q);
      add_piece(t, {q, b, c});
    } else {
      // Wherever the barycentre lies, its three edges and the rules of §2.7 step 3 move it along the median from a.
      const Vec3 middle = 0.5 * (at(b) + at(c));
      const auto hit = cutter_.cross_segment(at(a), middle);
      const Vec3 half_way = 0.5 * (crossing_[leaving]->point + crossing_[returning]->point);
      const double share = hit ? hit->share : 0.5;
      const std::uint32_t g = add_point(hit ? hit->point : half_way, {a, b, c}, {1 - share, share / 2, share / 2});
      ++out_.report.inserted_nodes;
      add_piece(t, {g, a, b}, leaving, g);
      add_piece(t, {g, b, c});
      add_piece(t, {g, c, a}, returning, g);
    }
  }

  void join_nodes() {
    for (std::uint32_t h = 0; h < mates_.size(); ++h) {
      const std::uint32_t mate = mates_[h];
      if (mate == no_index || mate < h || apex_[h] == no_index || apex_[mate] == no_index) continue;
      const std::uint32_t p = from(h), q = to(h), x = apex_[h], y = apex_[mate];
      Triangle &one = pieces_[piece_[h]], &two = pieces_[piece_[mate]];
      const Vec3 mean = normal(one) + normal(two);
      const Triangle first{x, p, y}, second{x, y, q};
      if (from(mate) == q && is_upright(first, mean) && is_upright(second, mean)) {
        one = first;
        two = second;
        add_trace(x, y);
        ++out_.report.flipped_edges;
        continue;
      }
      const std::uint32_t m = add_point_on(h);
      const std::uint32_t source_one = piece_source_[piece_[h]], source_two = piece_source_[piece_[mate]];
      one = {x, p, m};
      two = {y, from(mate), m};
      add_piece(source_one, {x, m, q});
      add_piece(source_two, {y, m, to(mate)});
      add_trace(x, m);
      add_trace(m, y);
      ++out_.report.split_edges;
    }
  }

  bool is_upright(const Triangle& t, const Vec3& mean) const {
    return dot(normal(t), mean) > 0 && !is_degenerate(out_.soup.points, t);
  }

  /// Old edges whose two ends have moved onto the trace belong to it, unless they close a triangle of three such ends.
  void trace_old_edges() {
    for (std::uint32_t h = 0; h < mates_.size(); ++h) {
      if (mates_[h] == no_index || mates_[h] < h || !is_on_[from(h)] || !is_on_[to(h)]) continue;
      bool is_closing = false;
      for (const std::uint32_t side : {h, mates_[h]}) {
        const Vec3 &third = at(triangles_[side / 3][(side % 3 + 2) % 3]), &a = at(from(side)), &b = at(to(side));
        if (is_on_[triangles_[side / 3][(side % 3 + 2) % 3]] &&
            length(b - a) > std::max(length(third - a), length(third - b)))
          is_closing = true;
      }
      if (!is_closing) add_trace(from(h), to(h));
    }
    std::sort(out_.trace.begin(), out_.trace.end());
    out_.trace.erase(std::unique(out_.trace.begin(), out_.trace.end()), out_.trace.end());
  }

  void split() {
    std::vector<std::uint32_t> patch(pieces_.size());
    for (std::size_t i = 0; i < patch.size(); ++i) patch[i] = patch_[piece_source_[i]];
    const std::vector<std::uint32_t> mates = find_mates(out_.soup.points.size(), pieces_, patch);
    UnionFind corners(3 * pieces_.size());
    const auto next = [](std::uint32_t h) { return h / 3 * 3 + (h % 3 + 1) % 3; };
    const auto node = [&](std::uint32_t corner) { return pieces_[corner / 3][corner % 3]; };
    for (std::uint32_t h = 0; h < mates.size(); ++h) {
      if (mates[h] == no_index || mates[h] < h) continue;
      const std::array<std::uint32_t, 2> edge{std::min(node(h), node(next(h))), std::max(node(h), node(next(h)))};
      if (std::binary_search(out_.trace.begin(), out_.trace.end(), edge)) continue;
      const bool same_way = node(h) == node(mates[h]);
      corners.unite(h, same_way ? mates[h] : next(mates[h]));
      corners.unite(next(h), same_way ? next(mates[h]) : mates[h]);
    }
    std::vector<char> is_traced(out_.soup.points.size(), 0);
    for (const auto& edge : out_.trace) is_traced[edge[0]] = is_traced[edge[1]] = 1;
    std::vector<std::uint32_t> copy(3 * pieces_.size(), no_index), owner(out_.soup.points.size(), no_index);
    std::vector<Triangle> doubled = pieces_;
    for (std::uint32_t c = 0; c < 3 * pieces_.size(); ++c) {
      const std::uint32_t v = node(c), root = corners.find(c);
      if (!is_traced[v]) continue;
      if (owner[v] == no_index) owner[v] = root;
      if (owner[v] == root) continue;
      if (copy[root] == no_index) {
        const Vec3 p = at(v);
        copy[root] = add_point(p, {v, v, v}, {1, 0, 0});
        ++out_.report.doubled_nodes;
      }
      doubled[c / 3][c % 3] = copy[root];
    }

    std::vector<std::uint32_t> order(pieces_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return piece_source_[a] < piece_source_[b]; });
    const std::vector<Triangle> old = std::move(out_.soup.triangles);
    const std::vector<std::uint32_t> old_patch = std::move(out_.soup.triangle_patch);
    out_.soup.triangles.clear();
    out_.soup.triangle_patch.clear();
    std::size_t i = 0;
    for (std::uint32_t t = 0; t < old.size(); ++t) {
      if (out_.soup.patch_entity[old_patch[t]] != cut_) {
        out_.soup.triangles.push_back(old[t]);
        out_.soup.triangle_patch.push_back(old_patch[t]);
      }
      for (; i < order.size() && source_[piece_source_[order[i]]] == t; ++i) {
        out_.soup.triangles.push_back(doubled[order[i]]);
        out_.soup.triangle_patch.push_back(old_patch[t]);
      }
    }
  }

  SingleSpaceOptions options_;
  std::uint32_t cut_;
  SingleSpaceCut out_;
  CuttingSurface cutter_;
  std::vector<Triangle> triangles_;  ///< of the cut entity
  std::vector<std::uint32_t> patch_;
  std::vector<std::uint32_t> source_;
  std::vector<std::uint32_t> mates_;
  std::vector<std::optional<Crossing>> crossing_;  ///< per half-edge
  std::vector<char> is_on_;                        ///< per point: on the trace
  std::vector<Triangle> pieces_;
  std::vector<std::uint32_t> piece_source_;
  std::vector<std::uint32_t> piece_, apex_;  ///< per half-edge that is crossed
};

}  // namespace

Result<SingleSpaceCut> cut_single_space(const TriangleSoup& soup, std::uint32_t cut, std::uint32_t cutting,
                                        const SingleSpaceOptions& options) {
  if (!(options.close_ratio >= 0 && options.close_ratio < 0.5))
    return Failure{FailureCode::invalid_options, "close_ratio must be in [0, 0.5)", "correct it"};
  if (cut == cutting || cut >= soup.entities.size() || cutting >= soup.entities.size())
    return Failure{FailureCode::invalid_options, "a single-space cut needs two different surfaces", "name two"};
  for (const std::uint32_t entity : {cut, cutting})
    if (SingleSpaceCutter::triangles_of(soup, entity).empty())
      return Failure{FailureCode::invalid_input, "surface '" + soup.entities[entity].name + "' has no triangle",
                     "give a triangulated surface"};
  for (const Triangle& t : SingleSpaceCutter::triangles_of(soup, cut))
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      return Failure{FailureCode::invalid_input,
                     "surface '" + soup.entities[cut].name + "' has a triangle with a repeated point",
                     "drop such triangles first; `strataflow check --repair` does"};
  return SingleSpaceCutter(soup, cut, cutting, options).run();
}

}  // namespace strataflow
