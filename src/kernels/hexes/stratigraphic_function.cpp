#include "kernels/hexes/stratigraphic_function.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/internal_error.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/hexes/conjugate_gradients.h"
#include "kernels/hexes/gather_entries.h"
#include "kernels/hexes/level_ranges.h"
#include "kernels/topology/union_find.h"
#include "kernels/volumes/tet_faces.h"

namespace strataflow {
namespace {

constexpr std::int64_t most_layers = 100000;

Failure bad_option(std::string what, std::string remedy) {
  return {FailureCode::invalid_options, std::move(what), std::move(remedy)};
}

double six_volumes(const std::vector<Vec3>& p, const Tet& t) {
  return dot(p[t[1]] - p[t[0]], cross(p[t[2]] - p[t[0]], p[t[3]] - p[t[0]]));
}

struct LayerPlan {
  std::vector<std::uint32_t> heights;  ///< whole numbers per level: 0 at the bottom, the sum of the layers at the top
  std::vector<UnitLayers> units;
};

Result<LayerPlan> plan_layers(const LabelledTets& tets, const StratigraphicLevels& levels,
                              const LayerOptions& options) {
  if (options.layers < 1) return bad_option("layers must be at least 1", "raise it");
  if (options.thickness_m && !(*options.thickness_m > 0 && std::isfinite(*options.thickness_m)))
    return bad_option("thickness_m must be positive", "raise it");
  for (const auto& [unit, count] : options.unit_layers) {
    if (std::find(levels.names.begin() + 1, levels.names.end(), unit) == levels.names.end())
      return bad_option("unit_layers names '" + unit + "', which is the roof of no unit", "name a horizon, or Top");
    if (count < 1) return bad_option("unit_layers must be at least 1, for " + unit, "raise it");
  }
  for (const auto& [unit, layout] : options.unit_layout)
    if (std::find(levels.names.begin() + 1, levels.names.end(), unit) == levels.names.end())
      return bad_option("unit_layout names '" + unit + "', which is the roof of no unit", "name a horizon, or Top");
  std::vector<double> volume(levels.unit_count(), 0);
  for (std::size_t t = 0; t < tets.tets.size(); ++t)
    volume[levels.unit[t]] += six_volumes(tets.points, tets.tets[t]) / 6;
  double area = 0;
  for (const SheetFacet& facet : tets.facets) {
    if (facet.kind != SheetKind::top) continue;
    const Vec3 &p = tets.points[facet.vertices[0]], &q = tets.points[facet.vertices[1]];
    area += 0.5 * std::abs(cross(q - p, tets.points[facet.vertices[2]] - p).z);
  }
  LayerPlan plan{{0}, {}};
  std::int64_t sum = 0;
  for (std::uint32_t unit = 0; unit < levels.unit_count(); ++unit) {
    std::int64_t count = options.layers;
    if (options.thickness_m && area > 0)
      count = std::max<std::int64_t>(
          1, std::llround(std::min(volume[unit] / area / *options.thickness_m, double(most_layers))));
    if (const auto named = options.unit_layers.find(levels.names[unit + 1]); named != options.unit_layers.end())
      count = named->second;
    sum += std::min(count, most_layers);
    if (sum > most_layers) return bad_option("more than 100000 layers", "lower the counts or raise thickness_m");
    plan.heights.push_back(static_cast<std::uint32_t>(sum));
    UnitLayers unit_layers{options.layout, 0};
    if (const auto named = options.unit_layout.find(levels.names[unit + 1]); named != options.unit_layout.end())
      unit_layers.layout = named->second;
    unit_layers.thickness_m =
        options.thickness_m.value_or(area > 0 ? volume[unit] / area / static_cast<double>(count) : 0);
    plan.units.push_back(unit_layers);
  }
  return plan;
}

class FunctionSearch {
 public:
  FunctionSearch(const LabelledTets& tets, const StratigraphicLevels& levels) : tets_(tets), levels_(levels) {}

  Result<StratigraphicTets> find(LayerPlan plan, const StratigraphicTets* near) {
    split_ = split_along_faults(tets_);
    ranges_ = level_ranges(tets_, levels_, split_);
    result_.level_w = std::move(plan.heights);
    result_.units = std::move(plan.units);
    result_.level_names = levels_.names;
    make_copies();
    make_tets();
    connect();
    if (near) start_from(*near);
    if (const Result<void> solved = solve(); !solved) return solved.failure();
    return std::move(result_);
  }

 private:
  /// Free copies of points that were there take what they had; the new ones, the mean of those around them.
  void start_from(const StratigraphicTets& near) {
    std::size_t next = 0;
    for (std::uint32_t c = 0; c < result_.point.size(); ++c) {
      while (next < near.point.size() && near.point[next] < result_.point[c]) ++next;
      const bool is_known = next < near.point.size() && near.point[next] == result_.point[c];
      if (is_free_[c]) result_.w[c] = is_known ? near.w[next] : std::nan("");
      if (is_known) ++next;
    }
    std::vector<std::array<double, 2>> mean(result_.point.size(), {0, 0});
    for (std::uint32_t t = 0; t < result_.model_tets; ++t)
      for (const std::uint32_t to : result_.tets[t])
        for (const std::uint32_t from : result_.tets[t])
          if (std::isnan(result_.w[to]) && !std::isnan(result_.w[from]))
            mean[to] = {mean[to][0] + 1, mean[to][1] + result_.w[from]};
    for (std::uint32_t c = 0; c < mean.size(); ++c)
      if (std::isnan(result_.w[c])) result_.w[c] = mean[c][0] > 0 ? mean[c][1] / mean[c][0] : 0;
  }

  std::uint32_t copy_in(std::uint32_t copy, std::uint32_t unit) const {
    const LevelRange& range = ranges_[copy];
    return range.is_empty() ? first_[copy] : first_[copy] + range.level_in(unit) - range.low;
  }

  void make_copies() {
    for (std::uint32_t c = 0; c < split_.original.size(); ++c) {
      first_.push_back(static_cast<std::uint32_t>(result_.point.size()));
      const LevelRange& range = ranges_[c];
      for (std::uint32_t level = range.low; range.is_empty() || level <= range.high; ++level) {
        result_.point.push_back(split_.original[c]);
        result_.w.push_back(range.is_empty() ? 0.0 : result_.level_w[level]);
        is_free_.push_back(range.is_empty() ? 1 : 0);
        if (range.is_empty()) break;
      }
    }
  }

  void make_tets() {
    for (std::uint32_t t = 0; t < split_.tets.size(); ++t) {
      Tet tet = split_.tets[t];
      for (std::uint32_t& v : tet) v = copy_in(v, levels_.unit[t]);
      result_.tets.push_back(tet);
    }
    result_.model_tets = static_cast<std::uint32_t>(result_.tets.size());
    for (std::uint32_t face = 0; face < tets_.facet_of.size(); ++face) {
      if (tets_.facet_of[face] == no_index) continue;
      const SheetKind kind = tets_.facets[tets_.facet_of[face]].kind;
      const std::uint32_t unit = levels_.unit[face / 4];
      Triangle up = face_vertices(split_.tets[face / 4], face % 4);  // counter-clockwise from outside
      if (kind == SheetKind::top) fill(up, unit, levels_.unit_count());
      if (kind == SheetKind::bottom) {
        std::swap(up[1], up[2]);
        fill_from_bottom(up, unit);
      }
      if (kind == SheetKind::horizon) {
        const std::uint32_t above = levels_.unit[tets_.neighbour[face] / 4];
        if (unit < above) fill(up, unit, above);
      }
    }
  }

  /// Tetrahedra without volume that lift a triangle, counter-clockwise from above, from where unit `from` holds its
  /// corners to where unit `to` does: unit by unit, corners in the order of their numbers, so that neighbours agree.
  void fill(Triangle corners, std::uint32_t from, std::uint32_t to) {
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return corners[a] < corners[b]; });
    Triangle at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = copy_in(corners[k], from);
    for (std::uint32_t unit = from; unit < to; ++unit)
      for (const std::size_t k : order) raise(at, k, copy_in(corners[k], unit + 1));
  }

  /// The same from level 0, where the outside below the bottom holds them.
  void fill_from_bottom(Triangle corners, std::uint32_t to) {
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return corners[a] < corners[b]; });
    Triangle at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = first_[corners[k]];
    for (std::uint32_t unit = 0; unit <= to; ++unit)
      for (const std::size_t k : order) raise(at, k, copy_in(corners[k], unit));
  }

  void raise(Triangle& at, std::size_t k, std::uint32_t to) {
    if (at[k] == to) return;
    result_.tets.push_back({at[0], at[1], at[2], to});
    at[k] = to;
  }

  /// Away from level surfaces neighbours stay; there the tetrahedra without volume come between.
  void connect() {
    result_.neighbour.assign(4 * result_.tets.size(), no_index);
    std::vector<std::uint32_t> near;  // tetrahedra with a face on a level surface, and those between
    for (std::uint32_t t = 0; t < result_.tets.size(); ++t) {
      bool is_near = t >= result_.model_tets;
      for (std::uint32_t face = 4 * t; face < 4 * t + 4 && t < result_.model_tets; ++face) {
        if (is_on_level(face)) is_near = true;
        if (tets_.facet_of[face] == no_index) result_.neighbour[face] = tets_.neighbour[face];
      }
      if (is_near) near.push_back(t);
    }
    std::vector<Tet> corners;
    std::vector<char> is_closed;
    for (const std::uint32_t t : near) {
      corners.push_back(result_.tets[t]);
      for (std::uint32_t face = 4 * t; face < 4 * t + 4; ++face)
        is_closed.push_back(t < result_.model_tets && !is_on_level(face));
    }
    const std::vector<std::uint32_t> partner = face_partners(corners, result_.point.size(), is_closed);
    for (std::uint32_t i = 0; i < partner.size(); ++i)
      if (partner[i] != no_index)
        result_.neighbour[4 * near[i / 4] + i % 4] = 4 * near[partner[i] / 4] + partner[i] % 4;
  }

  bool is_on_level(std::uint32_t face) const {
    if (tets_.facet_of[face] == no_index) return false;
    const SheetKind kind = tets_.facets[tets_.facet_of[face]].kind;
    return kind != SheetKind::fault && kind != SheetKind::side;
  }

  Result<void> solve() {
    if (const Result<void> bounded = check_compartments(); !bounded) return bounded;
    std::vector<std::uint32_t> unknown(result_.point.size(), no_index);
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < unknown.size(); ++c)
      if (is_free_[c]) unknown[c] = count++;
    if (count == 0) return {};
    const auto visit_pairs = [&](std::size_t t, auto&& visit) {
      const Tet& tet = result_.tets[t];
      std::array<Vec3, 4> gradient;  // times the determinant
      const auto at = [&](std::size_t k) { return tets_.points[result_.point[tet[k]]]; };
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& face = face_corners[k];
        gradient[k] = cross(at(face[2]) - at(face[0]), at(face[1]) - at(face[0]));
      }
      const double determinant = dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0)));
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          if (unknown[tet[i]] != no_index) visit(tet[i], tet[j], dot(gradient[i], gradient[j]) / determinant);
    };
    const std::vector<MatrixEntry> matrix =
        gather_entries(result_.model_tets, [&](std::size_t t, std::vector<MatrixEntry>& entries) {
          visit_pairs(t, [&](std::uint32_t i, std::uint32_t j, double value) {
            if (unknown[j] != no_index && unknown[i] >= unknown[j]) entries.push_back({unknown[i], unknown[j], value});
          });
        });
    std::vector<double> right(count, 0);
    for (std::uint32_t t = 0; t < result_.model_tets; ++t) {
      const auto free = std::count_if(result_.tets[t].begin(), result_.tets[t].end(),
                                      [&](std::uint32_t c) { return is_free_[c] != 0; });
      if (free == 0 || free == 4) continue;
      visit_pairs(t, [&](std::uint32_t i, std::uint32_t j, double value) {
        if (unknown[j] == no_index) right[unknown[i]] -= value * result_.w[j];
      });
    }
    std::vector<double> start;
    for (std::uint32_t c = 0; c < unknown.size(); ++c)
      if (is_free_[c]) start.push_back(result_.w[c]);
    const auto solved = solve_symmetric(count, matrix, {right}, {std::move(start)});
    if (!solved) return solved.failure();
    const std::vector<double>& w = solved->front();
    for (std::uint32_t c = 0; c < unknown.size(); ++c)
      if (is_free_[c]) result_.w[c] = w[unknown[c]];
    lead_back();
    return {};
  }

  /// Calls visit(a, b) for each edge of the model's tetrahedra, once per tetrahedron.
  template <class Visit>
  void visit_edges(Visit&& visit) const {
    for (std::uint32_t t = 0; t < result_.model_tets; ++t)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) visit(result_.tets[t][i], result_.tets[t][j]);
  }

  /// Copies outside their unit get the mean of their neighbours.
  void lead_back() {
    constexpr int sweeps = 30;
    std::vector<std::uint32_t> unit(result_.point.size(), 0);
    for (std::uint32_t t = 0; t < result_.model_tets; ++t)
      for (const std::uint32_t c : result_.tets[t]) unit[c] = levels_.unit[t];
    std::vector<char> is_outside(result_.point.size(), 0);
    for (std::uint32_t c = 0; c < is_outside.size(); ++c)
      is_outside[c] =
          is_free_[c] && !(result_.w[c] > result_.level_w[unit[c]] && result_.w[c] < result_.level_w[unit[c] + 1]);
    if (std::count(is_outside.begin(), is_outside.end(), 1) == 0) return;
    std::vector<std::array<std::uint32_t, 2>> edges;
    visit_edges([&](std::uint32_t a, std::uint32_t b) {
      if (is_outside[a] || is_outside[b]) edges.push_back({std::min(a, b), std::max(a, b)});
    });
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      std::vector<std::array<double, 2>> mean(result_.point.size(), {0, 0});
      for (const auto& [a, b] : edges)
        for (const auto& [to, from] : {std::array{a, b}, std::array{b, a}})
          if (is_outside[to]) mean[to] = {mean[to][0] + 1, mean[to][1] + result_.w[from]};
      for (std::uint32_t c = 0; c < is_outside.size(); ++c)
        if (is_outside[c]) result_.w[c] = mean[c][1] / mean[c][0];
    }
  }

  /// Everything must hang on some level.
  Result<void> check_compartments() const {
    UnionFind pieces(result_.point.size());
    visit_edges([&](std::uint32_t a, std::uint32_t b) {
      if (is_free_[a] || is_free_[b]) pieces.unite(a, b);
    });
    std::vector<char> has_level(result_.point.size(), 0);
    for (std::uint32_t c = 0; c < has_level.size(); ++c)
      if (!is_free_[c]) has_level[pieces.find(c)] = 1;
    for (std::uint32_t t = 0; t < result_.model_tets; ++t)
      for (const std::uint32_t c : result_.tets[t]) {
        if (!is_free_[c] || has_level[pieces.find(c)]) continue;
        const auto r = static_cast<std::size_t>(tets_.region[t]);
        return Failure{FailureCode::unsupported,
                       (r < tets_.region_names.size() ? tets_.region_names[r] : "region " + std::to_string(r)) +
                           " is cut off by faults from every horizon, from the top and from the bottom",
                       "leave one of these faults out"};
      }
    return {};
  }

  const LabelledTets& tets_;
  const StratigraphicLevels& levels_;
  FaultSplit split_;
  std::vector<LevelRange> ranges_;    // per copy of split_
  std::vector<std::uint32_t> first_;  // per copy of split_: its lowest copy here
  std::vector<char> is_free_;
  StratigraphicTets result_;
};

}  // namespace

Result<StratigraphicTets> find_stratigraphic_function(const LabelledTets& tets, const StratigraphicLevels& levels,
                                                      const LayerOptions& options, const StratigraphicTets* near) {
  if (tets.tets.size() > (std::size_t{1} << 28))
    return Failure{FailureCode::geometry_failed, "too many tetrahedra for layers", "coarsen the model"};
  Result<LayerPlan> plan = plan_layers(tets, levels, options);
  if (!plan) return plan.failure();
  return FunctionSearch(tets, levels).find(std::move(*plan), near);
}

std::vector<std::uint32_t> flipped_in_layers(const StratigraphicTets& tets, const std::vector<Vec3>& plan) {
  constexpr double flat_ratio = 1e-9;  // of a prism around the tetrahedron; below it, rounding decides what it holds
  const auto at = [&](std::uint32_t copy) {
    const Vec3& p = plan[tets.point[copy]];
    return Vec3{p.x, p.y, tets.w[copy]};
  };
  const std::vector<char> is_flipped = parallel_map(
      tets.tets.size(),
      [&](std::size_t t) -> char {
        std::array<Vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = at(tets.tets[t][k]);
        if (orientation_3d(p[0], p[1], p[2], p[3]) <= 0) return 1;
        double wide = 0, high = 0;
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < i; ++j) {
            const Vec3 d = p[i] - p[j];
            wide = std::max(wide, d.x * d.x + d.y * d.y);
            high = std::max(high, std::abs(d.z));
          }
        return dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0])) <= flat_ratio * wide * high;
      },
      1024);
  std::vector<std::uint32_t> flipped;
  for (std::uint32_t t = 0; t < is_flipped.size(); ++t)
    if (is_flipped[t]) flipped.push_back(t);
  return flipped;
}

}  // namespace strataflow
