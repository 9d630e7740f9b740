#include "kernels/hexes/baselines/assign_pillar_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>

#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {
namespace {

constexpr double straight_cos = 0.70710678118654752;  // 45°
constexpr std::array<const char*, 4> side_names{"the side of low I", "the side of high I", "the side of low J",
                                                "the side of high J"};

Failure no_pillars(std::string what) {
  return {FailureCode::unsupported, std::move(what),
          "use hex.method = \"conforming\" or \"stairs\", or name the fault in hex.drop_alignment"};
}

class Assignment {
 public:
  explicit Assignment(const FeatureMesh& problem)
      : problem_(problem), table_(build_edge_table(problem.points.size(), problem.triangles)) {}

  Result<PillarLines> assign() {
    for (const Feature& feature : problem_.features)
      if (feature.strip_quads > 0)
        return no_pillars(feature.name + " has a thickness (quad.fault_thickness_m), which pillar grids have no cells for");
    if (const Result<void> found = find_sides(); !found) return found.failure();
    find_traces();
    find_relations();
    if (const Result<void> chosen = choose(); !chosen) return chosen.failure();
    return std::move(found_);
  }

 private:
  Vec3 direction(std::uint32_t from, std::uint32_t to) const {
    const Vec3 d = problem_.points[to] - problem_.points[from];
    return (1 / length(d)) * d;
  }

  /// The boundary as one loop, and which of four sides each of its edges belongs to.
  Result<void> find_sides() {
    std::vector<std::uint32_t> next(problem_.points.size(), no_index);
    std::uint32_t first = no_index, count = 0;
    FrameFit fit;
    for (std::uint32_t e = 0; e < table_.edge_count(); ++e) {
      if (table_.around(e).size() != 1) continue;
      const std::uint32_t h = table_.around(e)[0];
      const std::uint32_t a = problem_.triangles[h / 3][h % 3], b = problem_.triangles[h / 3][(h + 1) % 3];
      next[a] = b;
      first = std::min(first, a);
      ++count;
      fit.take(problem_.points[b] - problem_.points[a], length(problem_.points[b] - problem_.points[a]));
    }
    found_.frame = fit.frame();
    // Counter-clockwise: the low side of J runs along I, the high side of I along J, …
    const auto side_of = [&](std::uint32_t a) {
      const Vec3 d = direction(a, next[a]);
      const double i = dot(d, found_.frame.i), j = dot(d, found_.frame.j);
      return std::abs(i) >= std::abs(j) ? (i > 0 ? 2u : 3u) : (j > 0 ? 1u : 0u);
    };
    for (const char* name : side_names) found_.lines.push_back({name, no_index, true, {}});
    found_.lines[2].is_along_j = found_.lines[3].is_along_j = false;
    std::uint32_t turns = 0, walked = 0;
    for (std::uint32_t a = first; walked < count && (walked == 0 || a != first); a = next[a], ++walked) {
      const std::uint32_t side = side_of(a), b = next[a];
      found_.lines[side].points.push_back(a);
      found_.lines[side].points.push_back(b);
      if (side_of(b) != side) ++turns;
    }
    if (walked != count) return no_pillars("the plan has a hole, around which no rows of cells run");
    for (std::size_t side = 0; side < 4; ++side)
      if (turns != 4 || found_.lines[side].points.empty())
        return no_pillars("the outline of the plan turns " + std::to_string(turns) + " times, and pillar grids have four sides");
    for (PillarLine& line : found_.lines) line.points = sorted_unique(std::move(line.points));
    return {};
  }

  /// Pieces of traces inside the plan: edges of one fault that go on into each other.
  void find_traces() {
    for (const FeatureEdge& edge : problem_.edges)
      if (problem_.features[edge.feature].role == Role::fault &&
          table_.around(find_edge(table_, edge.a, edge.b)).size() == 2)
        edges_.push_back(edge);
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const FeatureEdge& a, const FeatureEdge& b) { return a.feature < b.feature; });
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      for (const std::uint32_t p : {edges_[e].a, edges_[e].b}) ends_.push_back({p, e});
    std::sort(ends_.begin(), ends_.end());
    UnionFind pieces(edges_.size());
    visit_pairs([&](std::uint32_t, std::uint32_t e, std::uint32_t f, bool is_straight) {
      if (edges_[e].feature == edges_[f].feature && is_straight) pieces.unite(e, f);
    });
    line_of_.assign(edges_.size(), no_index);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const std::uint32_t root = pieces.find(e);
      if (root == e) {
        line_of_[e] = static_cast<std::uint32_t>(found_.lines.size());
        found_.lines.push_back({problem_.features[edges_[e].feature].name, edges_[e].feature, true, {}});
      }
      line_of_[e] = line_of_[root];
      for (const std::uint32_t p : {edges_[e].a, edges_[e].b}) found_.lines[line_of_[e]].points.push_back(p);
    }
    for (PillarLine& line : found_.lines) line.points = sorted_unique(std::move(line.points));
  }

  /// Calls visit(point, edge, edge, whether one goes on straight into the other) for all edges that meet.
  template <class Visit>
  void visit_pairs(Visit&& visit) const {
    const auto away = [&](const FeatureEdge& e, std::uint32_t p) { return direction(p, e.a == p ? e.b : e.a); };
    for (std::size_t begin = 0, end = 0; begin < ends_.size(); begin = end) {
      while (end < ends_.size() && ends_[end][0] == ends_[begin][0]) ++end;
      const std::uint32_t p = ends_[begin][0];
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = i + 1; j < end; ++j)
          visit(p, ends_[i][1], ends_[j][1],
                dot(away(edges_[ends_[i][1]], p), away(edges_[ends_[j][1]], p)) <= -straight_cos);
    }
  }

  void find_relations() {
    using Meeting = std::array<std::uint32_t, 2>;  // point, line
    std::vector<Meeting> going_on;  // lines through a point rather than up to it
    visit_pairs([&](std::uint32_t p, std::uint32_t e, std::uint32_t f, bool) {
      if (line_of_[e] == line_of_[f]) going_on.push_back({p, line_of_[e]});
    });
    std::sort(going_on.begin(), going_on.end());
    const auto ends_at = [&](std::uint32_t p, std::uint32_t line) {
      return !std::binary_search(going_on.begin(), going_on.end(), Meeting{p, line});
    };
    visit_pairs([&](std::uint32_t p, std::uint32_t e, std::uint32_t f, bool is_straight) {
      const std::uint32_t a = line_of_[e], b = line_of_[f];
      if (a == b) return;
      const bool continues = is_straight && ends_at(p, a) && ends_at(p, b);
      relations_.push_back({std::min(a, b), std::max(a, b), !continues});
    });
    for (std::uint32_t side = 0; side < 4; ++side)
      for (std::uint32_t line = 4; line < found_.lines.size(); ++line)
        for (const std::uint32_t p : found_.lines[line].points)
          if (std::binary_search(found_.lines[side].points.begin(), found_.lines[side].points.end(), p))
            relations_.push_back({side, line, true});
    std::sort(relations_.begin(), relations_.end());
    relations_.erase(std::unique(relations_.begin(), relations_.end()), relations_.end());
  }

  /// Spreads the choice of the sides, then of the straightest line of every group that touches none.
  Result<void> choose() {
    std::vector<char> is_chosen(found_.lines.size(), 0);
    std::vector<std::uint32_t> front{0, 1, 2, 3};
    for (const std::uint32_t side : front) is_chosen[side] = 1;
    for (;;) {
      for (std::size_t n = 0; n < front.size(); ++n)
        for (const Relation& relation : relations_) {
          if (relation.a != front[n] && relation.b != front[n]) continue;
          const std::uint32_t other = relation.a + relation.b - front[n];
          const bool wanted = found_.lines[front[n]].is_along_j != relation.must_differ;
          if (is_chosen[other]) {
            if (found_.lines[other].is_along_j != wanted) return clash(std::max(front[n], other), std::min(front[n], other));
            continue;
          }
          is_chosen[other] = 1;
          found_.lines[other].is_along_j = wanted;
          front.push_back(other);
        }
      std::uint32_t best = no_index;
      double clearest = -1;
      for (std::uint32_t line = 4; line < found_.lines.size(); ++line) {
        const double along = along_j(line);
        if (is_chosen[line] || !(std::abs(along) > clearest)) continue;
        clearest = std::abs(along);
        best = line;
      }
      if (best == no_index) return {};
      found_.lines[best].is_along_j = along_j(best) >= 0;
      is_chosen[best] = 1;
      front = {best};
    }
  }

  /// Metres a trace runs along J more than along I.
  double along_j(std::uint32_t line) const {
    double sum = 0;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (line_of_[e] != line) continue;
      const Vec3 d = direction(edges_[e].a, edges_[e].b);
      const double i = dot(d, found_.frame.i), j = dot(d, found_.frame.j);
      sum += (j * j - i * i) * length(problem_.points[edges_[e].b] - problem_.points[edges_[e].a]);
    }
    return sum;
  }

  /// Two lines that touch and cannot differ; what else the first one touches says why.
  Failure clash(std::uint32_t line, std::uint32_t other) const {
    std::string others = found_.lines[other].name;
    for (const Relation& relation : relations_) {
      if ((relation.a != line && relation.b != line) || relation.a + relation.b - line == other) continue;
      const std::string& name = found_.lines[relation.a + relation.b - line].name;
      if (others.find(name) == std::string::npos) others += ", " + name;
    }
    return no_pillars("fault " + found_.lines[line].name + " bounds cells neither in I nor in J: beside " + others +
                      " they would collapse");
  }

  struct Relation {
    std::uint32_t a = 0, b = 0;  ///< lines, a < b
    bool must_differ = true;
    friend auto operator<=>(const Relation&, const Relation&) = default;
  };

  const FeatureMesh& problem_;
  EdgeTable table_;
  PillarLines found_;
  std::vector<FeatureEdge> edges_;                   ///< of faults inside the plan
  std::vector<std::array<std::uint32_t, 2>> ends_;   ///< point, index into edges_
  std::vector<std::uint32_t> line_of_;               ///< per edge of edges_
  std::vector<Relation> relations_;
};

}  // namespace

Result<PillarLines> assign_pillar_lines(const FeatureMesh& problem) {
  if (problem.triangles.empty()) return Failure{FailureCode::invalid_input, "the plan has no triangles", "report the job"};
  return Assignment(problem).assign();
}

}  // namespace strataflow
