#include "kernels/hexes/baselines/pillar_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/sparse/symmetric_system.h"
#include "kernels/hexes/baselines/assign_pillar_lines.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {
namespace {

/// How far fields stay smooth, in diagonals of the plan; tried one after the other until no cell turns over.
constexpr std::array<double, 3> smooth_ratios{0.25, 0.05, 1};
constexpr double same_plane_ratio = 0.5;  // lines nearer than this, in edges, share a plane of pillars if side by side

/// The two indices as fields over the plan, metres: z 0.
using Fields = std::vector<Vec3>;

class FieldSolver {
 public:
  FieldSolver(const FeatureMesh& problem, const PillarLines& lines)
      : problem_(problem), lines_(lines), table_(build_edge_table(problem.points.size(), problem.triangles)) {
    for (const Triangle& t : problem.triangles) {
      const Vec3 &a = problem.points[t[0]], &b = problem.points[t[1]], &c = problem.points[t[2]];
      const double twice = cross(b - a, c - a).z;
      area_.push_back(0.5 * twice);
      std::array<Vec3, 3>& gradient = gradient_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 d = problem.points[t[(k + 2) % 3]] - problem.points[t[(k + 1) % 3]];
        gradient[k] = {-d.y / twice, d.x / twice, 0};
      }
    }
  }

  /// min Σ A |∇f − a|² + ℓ² Σ (jump of the gradient)², f constant on every group of lines of its direction (S7).
  /// `group` says per line which lines share a value.
  Result<Fields> solve(const std::vector<std::uint32_t>& group, double smooth_m) const {
    Fields fields(problem_.points.size());
    for (const bool is_i : {true, false}) {
      UnionFind classes(problem_.points.size());
      std::vector<std::uint32_t> first_of(lines_.lines.size(), no_index);
      for (std::uint32_t line = 0; line < lines_.lines.size(); ++line) {
        if (lines_.lines[line].is_along_j != is_i) continue;
        std::uint32_t& first = first_of[group[line]];
        if (first == no_index) first = lines_.lines[line].points.front();
        for (const std::uint32_t p : lines_.lines[line].points) classes.unite(first, p);
      }
      const std::uint32_t zero = classes.find(lines_.lines[is_i ? 0 : 2].points.front());
      std::vector<std::uint32_t> unknown(problem_.points.size(), no_index);
      std::uint32_t count = 0;
      for (std::uint32_t p = 0; p < unknown.size(); ++p) {
        const std::uint32_t root = classes.find(p);  // the lowest of its class: numbered before the others
        if (root == zero) continue;
        unknown[p] = root == p ? count++ : unknown[root];
      }
      const Result<std::vector<double>> values = solve_one(is_i ? lines_.frame.i : lines_.frame.j, unknown, count, smooth_m);
      if (!values) return values.failure();
      for (std::size_t p = 0; p < fields.size(); ++p) {
        const double value = unknown[p] == no_index ? 0 : (*values)[unknown[p]];
        (is_i ? fields[p].x : fields[p].y) = value;
      }
    }
    return fields;
  }

  /// Triangles that the fields turn over or carry beyond the sides.
  std::vector<std::uint32_t> turned_over(const Fields& fields) const {
    const Vec3 high{fields[lines_.lines[1].points.front()].x, fields[lines_.lines[3].points.front()].y, 0};
    std::vector<std::uint32_t> turned;
    for (std::uint32_t t = 0; t < problem_.triangles.size(); ++t) {
      const auto& [a, b, c] = problem_.triangles[t];
      bool is_good = cross(fields[b] - fields[a], fields[c] - fields[a]).z > 1e-9 * area_[t];
      for (const std::uint32_t p : {a, b, c})
        is_good = is_good && fields[p].x >= 0 && fields[p].y >= 0 && fields[p].x <= high.x && fields[p].y <= high.y;
      if (!is_good) turned.push_back(t);
    }
    return turned;
  }

 private:
  Result<std::vector<double>> solve_one(const Vec3& wanted, const std::vector<std::uint32_t>& unknown,
                                        std::uint32_t count, double smooth_m) const {
    std::vector<MatrixEntry> entries;
    std::vector<double> right(count, 0.0);
    const auto add = [&](std::uint32_t p, std::uint32_t q, double value) {  // both orders are given
      const std::uint32_t row = unknown[p], column = unknown[q];
      if (row != no_index && column != no_index && row >= column) entries.push_back({row, column, value});
    };
    for (std::uint32_t t = 0; t < problem_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = problem_.triangles[t][k];
        if (unknown[p] != no_index) right[unknown[p]] += area_[t] * dot(wanted, gradient_[t][k]);
        for (std::size_t l = 0; l < 3; ++l)
          add(p, problem_.triangles[t][l], area_[t] * dot(gradient_[t][k], gradient_[t][l]));
      }
    for (std::uint32_t e = 0; e < table_.edge_count(); ++e) {
      const auto around = table_.around(e);
      if (around.size() != 2) continue;
      const Vec3 along = problem_.points[table_.edges[e][1]] - problem_.points[table_.edges[e][0]];
      const std::uint32_t s = around[0] / 3, t = around[1] / 3;
      const double weight = 3 * smooth_m * smooth_m / (area_[s] + area_[t]);
      std::array<std::pair<std::uint32_t, double>, 6> jump;  // across the edge, times its length
      for (std::size_t k = 0; k < 3; ++k) {
        jump[k] = {problem_.triangles[s][k], cross(along, gradient_[s][k]).z};
        jump[3 + k] = {problem_.triangles[t][k], -cross(along, gradient_[t][k]).z};
      }
      for (const auto& [p, x] : jump)
        for (const auto& [q, y] : jump) add(p, q, weight * x * y);
    }
    const Result<SymmetricSystem> system = SymmetricSystem::factorize(count, entries);
    if (!system) return system.failure();
    return system->solve(right);
  }

  const FeatureMesh& problem_;
  const PillarLines& lines_;
  EdgeTable table_;
  std::vector<double> area_;
  std::vector<std::array<Vec3, 3>> gradient_;
};

/// Lines that share a value: those nearly in one plane of pillars that are nowhere beside each other. Every line alone
/// where there are none such.
std::vector<std::uint32_t> lines_in_one_plane(const FeatureMesh& problem, const PillarLines& lines, const Fields& fields) {
  UnionFind planes(lines.lines.size());
  struct Span {
    double value, low, high;
  };
  std::vector<Span> spans;
  for (const PillarLine& line : lines.lines) {
    Span span{0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const std::uint32_t p : line.points) {
      const double along = line.is_along_j ? fields[p].y : fields[p].x;
      span = {line.is_along_j ? fields[p].x : fields[p].y, std::min(span.low, along), std::max(span.high, along)};
    }
    spans.push_back(span);
  }
  const double near_m = same_plane_ratio * problem.edge_length_m;
  for (std::uint32_t a = 4; a < spans.size(); ++a)
    for (std::uint32_t b = a + 1; b < spans.size(); ++b) {
      if (lines.lines[a].is_along_j != lines.lines[b].is_along_j || std::abs(spans[a].value - spans[b].value) > near_m)
        continue;
      bool is_beside = false;  // any of one plane and any of the other
      for (std::uint32_t c = 4; c < spans.size(); ++c)
        for (std::uint32_t d = 4; d < spans.size() && planes.find(c) == planes.find(a); ++d)
          is_beside = is_beside || (planes.find(d) == planes.find(b) && c != d && spans[c].low < spans[d].high &&
                                    spans[d].low < spans[c].high);
      if (!is_beside) planes.unite(a, b);
    }
  std::vector<std::uint32_t> plane;
  for (std::uint32_t line = 0; line < spans.size(); ++line) plane.push_back(planes.find(line));
  return plane;
}

/// The names of the faults nearest to triangles that turn over.
Failure collapsed(const FeatureMesh& problem, const PillarLines& lines, const std::vector<std::uint32_t>& turned) {
  const Triangle& t = problem.triangles[turned.front()];
  const Vec3 at = (1.0 / 3) * (problem.points[t[0]] + problem.points[t[1]] + problem.points[t[2]]);
  std::vector<std::pair<double, std::uint32_t>> nearest;
  for (std::uint32_t line = 4; line < lines.lines.size(); ++line) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t p : lines.lines[line].points) least = std::min(least, length(problem.points[p] - at));
    nearest.push_back({least, line});
  }
  std::sort(nearest.begin(), nearest.end());
  std::string names;
  for (std::size_t n = 0; n < nearest.size() && n < 2; ++n)
    names += (n > 0 ? " and " : " beside ") + lines.lines[nearest[n].second].name;
  return {FailureCode::unsupported, "the cells of a pillar grid would turn over" + names,
          "use hex.method = \"conforming\" or \"stairs\", or name the fault in hex.drop_alignment"};
}

/// Values of lines, and others between them about an edge apart; ascending.
std::vector<double> cut_values(std::vector<double> values, double edge_m) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<double> cuts{values.front()};
  for (std::size_t n = 1; n < values.size(); ++n) {
    const double low = values[n - 1], gap = values[n] - low;
    const double parts = std::max(1.0, std::round(gap / edge_m));
    for (double part = 1; part < parts; ++part) cuts.push_back(low + part / parts * gap);
    cuts.push_back(values[n]);
  }
  return cuts;
}

class PillarCutter {
 public:
  PillarCutter(const FeatureMesh& problem, const PillarLines& lines, const Fields& fields)
      : problem_(problem), lines_(lines), fields_(fields) {
    std::array<std::vector<double>, 2> values;
    for (const PillarLine& line : lines.lines)
      values[line.is_along_j ? 0 : 1].push_back(value_of(line));
    for (std::size_t d = 0; d < 2; ++d) cuts_[d] = cut_values(std::move(values[d]), problem.edge_length_m);
  }

  Result<QuadMesh> cut() {
    if (static_cast<double>(cuts_[0].size()) * static_cast<double>(cuts_[1].size()) > double(1 << 28))
      return Failure{FailureCode::geometry_failed, "more than 2^28 pillars", "ask for longer hex.edge_length_m"};
    QuadMesh plan;
    plan.local_origin = problem_.local_origin;
    plan.features = problem_.features;
    plan.changes = problem_.changes;
    plan.points = find_points();
    const auto columns = static_cast<std::uint32_t>(cuts_[0].size());
    const auto rows = static_cast<std::uint32_t>(cuts_[1].size());
    const auto point = [&](std::uint32_t i, std::uint32_t j) { return i + columns * j; };
    for (std::uint32_t j = 0; j + 1 < rows; ++j)
      for (std::uint32_t i = 0; i + 1 < columns; ++i)
        plan.quads.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
    for (const PillarLine& line : lines_.lines) add_edges(plan, line);
    add_outline(plan, columns, rows);
    plan.edges = sorted_unique(std::move(plan.edges));
    return plan;
  }

 private:
  double value_of(const PillarLine& line) const {
    const Vec3& at = fields_[line.points.front()];
    return line.is_along_j ? at.x : at.y;
  }

  /// Every (I, J) back in the plan, exactly on lines and sides.
  std::vector<Vec3> find_points() const {
    const std::vector<FloatBox> boxes = parallel_map(
        problem_.triangles.size(),
        [&](std::size_t t) {
          Box3 box;
          for (const std::uint32_t p : problem_.triangles[t]) box.take(fields_[p]);
          return enclosing(box);
        },
        4096);
    const BoundingVolumeTree tree(boxes);
    return parallel_map(
        cuts_[0].size() * cuts_[1].size(),
        [&](std::size_t n) {
          const Vec3 at{cuts_[0][n % cuts_[0].size()], cuts_[1][n / cuts_[0].size()], 0};
          std::array<double, 3> best{};
          double deepest = -std::numeric_limits<double>::infinity();
          std::uint32_t holder = 0;
          tree.visit_items(enclosing({at, at}), [&](std::uint32_t t) {
            const auto& corners = problem_.triangles[t];
            std::array<double, 3> share{};
            double all = 0;
            for (std::size_t k = 0; k < 3; ++k) {
              share[k] = cross(fields_[corners[(k + 1) % 3]] - at, fields_[corners[(k + 2) % 3]] - at).z;
              all += share[k];
            }
            for (double& s : share) s /= all;
            const double depth = *std::min_element(share.begin(), share.end());
            if (depth < deepest || (depth == deepest && t > holder)) return;
            deepest = depth;
            best = share;
            holder = t;
          });
          constexpr double on_edge = 1e-9;
          double all = 0;
          for (double& s : best) all += s = s < on_edge ? 0 : s;
          Vec3 position;
          for (std::size_t k = 0; k < 3; ++k)
            position = position + best[k] / all * problem_.points[problem_.triangles[holder][k]];
          return position;
        },
        64);
  }

  /// The edges of the grid along a trace; where it dies between two pillars, up to the one beyond.
  void add_edges(QuadMesh& plan, const PillarLine& line) const {
    if (line.feature == no_index) return;
    const std::size_t across = line.is_along_j ? 0 : 1, along = 1 - across;
    const auto columns = static_cast<std::uint32_t>(cuts_[0].size());
    const auto cut = static_cast<std::uint32_t>(
        std::lower_bound(cuts_[across].begin(), cuts_[across].end(), value_of(line)) - cuts_[across].begin());
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t p : line.points) {
      low = std::min(low, line.is_along_j ? fields_[p].y : fields_[p].x);
      high = std::max(high, line.is_along_j ? fields_[p].y : fields_[p].x);
    }
    const double least = 1e-6 * problem_.edge_length_m;  // of an edge that the trace covers
    for (std::uint32_t n = 0; n + 1 < cuts_[along].size(); ++n) {
      if (!(std::min(high, cuts_[along][n + 1]) - std::max(low, cuts_[along][n]) > least)) continue;
      const std::uint32_t a = line.is_along_j ? cut + columns * n : n + columns * cut;
      plan.edges.push_back({a, a + (line.is_along_j ? columns : 1), line.feature});
    }
  }

  void add_outline(QuadMesh& plan, std::uint32_t columns, std::uint32_t rows) const {
    const auto outline = std::find_if(problem_.features.begin(), problem_.features.end(),
                                      [](const Feature& feature) { return feature.role == Role::outline; });
    if (outline == problem_.features.end()) return;
    const auto feature = static_cast<std::uint32_t>(outline - problem_.features.begin());
    for (std::uint32_t i = 0; i + 1 < columns; ++i)
      for (const std::uint32_t a : {i, i + columns * (rows - 1)}) plan.edges.push_back({a, a + 1, feature});
    for (std::uint32_t j = 0; j + 1 < rows; ++j)
      for (const std::uint32_t a : {columns * j, columns * j + columns - 1}) plan.edges.push_back({a, a + columns, feature});
  }

  const FeatureMesh& problem_;
  const PillarLines& lines_;
  const Fields& fields_;
  std::array<std::vector<double>, 2> cuts_;  ///< values of I and J where pillars stand
};

}  // namespace

Result<QuadMesh> pillar_plan(const FeatureMesh& problem) {
  if (!(problem.edge_length_m > 0))
    return Failure{FailureCode::invalid_options, "the edge length is not positive", "give hex.edge_length_m"};
  const Result<PillarLines> lines = assign_pillar_lines(problem);
  if (!lines) return lines.failure();
  const FieldSolver solver(problem, *lines);
  Box3 box;
  for (const Vec3& p : problem.points) box.take(p);
  std::vector<std::uint32_t> turned, alone;
  for (std::uint32_t line = 0; line < lines->lines.size(); ++line) alone.push_back(line);
  for (const double ratio : smooth_ratios) {
    Result<Fields> fields = solver.solve(alone, ratio * box.diagonal_m());
    if (!fields) return fields.failure();
    turned = solver.turned_over(*fields);
    if (!turned.empty()) continue;
    const std::vector<std::uint32_t> planes = lines_in_one_plane(problem, *lines, *fields);
    if (planes != alone) {
      const Result<Fields> joined = solver.solve(planes, ratio * box.diagonal_m());
      if (joined && solver.turned_over(*joined).empty()) return PillarCutter(problem, *lines, *joined).cut();
    }
    return PillarCutter(problem, *lines, *fields).cut();
  }
  return collapsed(problem, *lines, turned);
}

}  // namespace strataflow
