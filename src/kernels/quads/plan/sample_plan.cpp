#include "kernels/quads/plan/sample_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/id.h"
#include "kernels/quads/plan/plane_geometry.h"
#include "model/box3.h"

namespace strataflow {

namespace {

/// Short parts of all segments, sorted into square cells: who is near?
class NearbyCurves {
 public:
  NearbyCurves(const PlanGraph& graph, double reach_m) : graph_(graph), reach_m_(reach_m), cell_m_(2 * reach_m) {
    for (const Vec3& p : graph.points) box_.take(p);
    columns_ = static_cast<std::uint64_t>((box_.high.x - box_.low.x) / cell_m_) + 1;
    rows_ = static_cast<std::uint64_t>((box_.high.y - box_.low.y) / cell_m_) + 1;
  }
  std::uint64_t cell_count() const { return columns_ * rows_; }

  void fill() {
    for (std::uint32_t s = 0; s < graph_.segments.size(); ++s) {
      const Vec3 a = graph_.points[graph_.segments[s].a], b = graph_.points[graph_.segments[s].b];
      const int n = static_cast<int>(length(b - a) / reach_m_) + 1;
      for (int i = 0; i < n; ++i)
        chunks_.push_back({between(a, b, double(i) / n), between(a, b, double(i + 1) / n), s});
    }
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p)
      if (graph_.is_required[p]) chunks_.push_back({graph_.points[p], graph_.points[p], no_index});
    first_.assign(cell_count() + 1, 0);
    for (const Chunk& c : chunks_) ++first_[cell(0.5 * (c.a + c.b)) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    sorted_.resize(chunks_.size());
    for (std::uint32_t i = 0; i < chunks_.size(); ++i) sorted_[next[cell(0.5 * (chunks_[i].a + chunks_[i].b))]++] = i;
  }

  /// Distance to the nearest curve other than those that meet `segment` close to p; at most the reach.
  double gap(const Vec3& p, std::uint32_t segment) const {
    double least = reach_m_;
    const auto& own = graph_.segments[segment];
    const bool near_a = length(p - graph_.points[own.a]) < reach_m_,
               near_b = length(p - graph_.points[own.b]) < reach_m_;
    const std::int64_t column = column_of(p.x), row = row_of(p.y);
    for (std::int64_t r = std::max<std::int64_t>(0, row - 1); r <= row + 1 && r < std::int64_t(rows_); ++r)
      for (std::int64_t c = std::max<std::int64_t>(0, column - 1); c <= column + 1 && c < std::int64_t(columns_); ++c) {
        const auto index = std::uint64_t(r) * columns_ + std::uint64_t(c);
        for (std::uint32_t i = first_[index]; i < first_[index + 1]; ++i) {
          const Chunk& chunk = chunks_[sorted_[i]];
          if (chunk.segment == segment) continue;
          if (chunk.segment == no_index) {
            const double away = length(p - chunk.a);
            if (away > 0) least = std::min(least, away);
            continue;
          }
          const auto& other = graph_.segments[chunk.segment];
          if (near_a && (other.a == own.a || other.b == own.a)) continue;
          if (near_b && (other.a == own.b || other.b == own.b)) continue;
          const double away = distance_to_segment(p, chunk.a, chunk.b);
          if (away > 0) least = std::min(least, away);
        }
      }
    return least;
  }

 private:
  struct Chunk {
    Vec3 a, b;
    std::uint32_t segment;
  };
  std::int64_t column_of(double x) const { return static_cast<std::int64_t>((x - box_.low.x) / cell_m_); }
  std::int64_t row_of(double y) const { return static_cast<std::int64_t>((y - box_.low.y) / cell_m_); }
  std::uint64_t cell(const Vec3& p) const {
    return std::uint64_t(std::clamp<std::int64_t>(row_of(p.y), 0, std::int64_t(rows_) - 1)) * columns_ +
           std::uint64_t(std::clamp<std::int64_t>(column_of(p.x), 0, std::int64_t(columns_) - 1));
  }

  const PlanGraph& graph_;
  double reach_m_, cell_m_;
  Box3 box_;
  std::uint64_t columns_ = 0, rows_ = 0;
  std::vector<Chunk> chunks_;
  std::vector<std::uint32_t> first_, sorted_;
};

/// Wanted sizes at equal steps along one segment, ends included.
struct Profile {
  double length_m = 0;
  std::vector<double> size_m;
  double step_m() const { return length_m / static_cast<double>(size_m.size() - 1); }
  void limit_growth() {
    for (std::size_t i = 1; i < size_m.size(); ++i)
      size_m[i] = std::min(size_m[i], size_m[i - 1] + size_growth * step_m());
    for (std::size_t i = size_m.size() - 1; i-- > 0;)
      size_m[i] = std::min(size_m[i], size_m[i + 1] + size_growth * step_m());
  }
  double at(double along_m) const {
    const double place = std::clamp(along_m / step_m(), 0.0, static_cast<double>(size_m.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(place), size_m.size() - 2);
    const double part = place - static_cast<double>(i);
    return (1 - part) * size_m[i] + part * size_m[i + 1];
  }
};

class PlanSampler {
 public:
  PlanSampler(const PlanGraph& graph, double edge_m) : graph_(graph), edge_m_(edge_m), around_(graph.incident()) {}

  SampledPlan run(const NearbyCurves& nearby) {
    measure(nearby);
    find_shells();
    plan_.points = graph_.points;
    plan_.node_count = graph_.points.size();
    plan_.size_m = node_size_m_;
    for (std::uint32_t s = 0; s < graph_.segments.size(); ++s) cut(s);
    return std::move(plan_);
  }

 private:
  void measure(const NearbyCurves& nearby) {
    const double floor_m = smallest_size * edge_m_;
    node_size_m_.assign(graph_.points.size(), edge_m_);
    profiles_.resize(graph_.segments.size());
    for (std::uint32_t s = 0; s < graph_.segments.size(); ++s) {
      const auto& segment = graph_.segments[s];
      const Vec3 a = graph_.points[segment.a], b = graph_.points[segment.b];
      Profile& profile = profiles_[s];
      profile.length_m = length(b - a);
      const auto steps = static_cast<std::size_t>(profile.length_m / (0.25 * edge_m_)) + 1;
      for (std::size_t i = 0; i <= steps; ++i) {
        const double gap = nearby.gap(between(a, b, double(i) / double(steps)), s);
        profile.size_m.push_back(std::clamp(gap, floor_m, edge_m_));
      }
      profile.size_m.front() = std::min(profile.size_m.front(), std::max(profile.length_m, floor_m));
      profile.size_m.back() = std::min(profile.size_m.back(), std::max(profile.length_m, floor_m));
    }
    // Sizes meet at the nodes; a few rounds carry them on along chains of short segments.
    for (int round = 0; round < 8; ++round)
      for (std::uint32_t s = 0; s < graph_.segments.size(); ++s) {
        double& at_a = node_size_m_[graph_.segments[s].a];
        double& at_b = node_size_m_[graph_.segments[s].b];
        Profile& profile = profiles_[s];
        profile.size_m.front() = at_a = std::min(at_a, profile.size_m.front());
        profile.size_m.back() = at_b = std::min(at_b, profile.size_m.back());
        profile.limit_growth();
        at_a = profile.size_m.front();
        at_b = profile.size_m.back();
      }
  }

  /// Per node: how far the triangle of its acute corners reaches along their sides.
  void find_shells() {
    shell_m_.assign(graph_.segments.size(), {0, 0});
    for (std::uint32_t n = 0; n < graph_.points.size(); ++n) {
      std::vector<std::pair<double, std::uint32_t>> sides;
      for (const std::uint32_t s : around_[n]) {
        const Vec3 d = graph_.points[other_end(s, n)] - graph_.points[n];
        sides.emplace_back(std::atan2(d.y, d.x), s);
      }
      std::sort(sides.begin(), sides.end());
      if (sides.size() < 2) continue;
      std::vector<std::uint32_t> acute;
      double reach = node_size_m_[n];
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto& [from, s] = sides[i];
        const auto& [to, t] = sides[(i + 1) % sides.size()];
        double angle = to - from;
        if (i + 1 == sides.size()) angle += 2 * std::numbers::pi;
        if (angle >= acute_angle_deg * std::numbers::pi / 180) continue;
        for (const std::uint32_t side : {s, t}) {
          acute.push_back(side);
          reach = std::min(reach, 0.5 * profiles_[side].length_m);
        }
      }
      for (const std::uint32_t s : acute) shell_m_[s][graph_.segments[s].a == n ? 0 : 1] = reach;
    }
  }

  std::uint32_t other_end(std::uint32_t s, std::uint32_t p) const {
    return graph_.segments[s].a == p ? graph_.segments[s].b : graph_.segments[s].a;
  }

  void cut(std::uint32_t s) {
    const Profile& profile = profiles_[s];
    const auto& segment = graph_.segments[s];
    const double from = shell_m_[s][0], to = profile.length_m - shell_m_[s][1];
    std::vector<double> places;
    if (from > 0) places.push_back(from);
    // Equal parts of the integral of 1/size between the shells.
    constexpr int parts_per_size = 4;
    double total = 0;
    std::vector<std::pair<double, double>> integral{{from, 0}};
    while (integral.back().first < to) {
      const double x = integral.back().first;
      const double step = std::min(profile.at(x) / parts_per_size, to - x);
      total += step / profile.at(x + 0.5 * step);
      integral.emplace_back(to - x <= step ? to : x + step, total);
    }
    const int n = std::max(1, static_cast<int>(std::ceil(total - 0.25)));
    std::size_t at = 0;
    for (int i = 1; i < n; ++i) {
      const double want = total * i / n;
      while (at + 1 < integral.size() && integral[at + 1].second < want) ++at;
      const auto& [x0, i0] = integral[at];
      const auto& [x1, i1] = integral[at + 1];
      places.push_back(x0 + (x1 - x0) * (want - i0) / (i1 - i0));
    }
    if (shell_m_[s][1] > 0 && to > from) places.push_back(to);
    std::uint32_t last = segment.a;
    const auto piece = [&](std::uint32_t end, bool is_locked) {
      plan_.pieces.push_back({{std::min(last, end), std::max(last, end)}, s, is_locked});
      last = end;
    };
    const Vec3 a = graph_.points[segment.a], b = graph_.points[segment.b];
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto point = static_cast<std::uint32_t>(plan_.points.size());
      plan_.points.push_back(between(a, b, places[i] / profile.length_m));
      plan_.size_m.push_back(profile.at(places[i]));
      piece(point, i == 0 && from > 0);
    }
    piece(segment.b, shell_m_[s][1] > 0);
  }

  const PlanGraph& graph_;
  double edge_m_;
  std::vector<std::vector<std::uint32_t>> around_;
  std::vector<Profile> profiles_;
  std::vector<double> node_size_m_;
  std::vector<std::array<double, 2>> shell_m_;  ///< per segment, at a and b; 0: none
  SampledPlan plan_;
};

}  // namespace

Result<SampledPlan> sample_plan(const PlanGraph& graph, double triangle_edge_m) {
  NearbyCurves nearby(graph, triangle_edge_m);
  constexpr std::uint64_t cell_limit = 20'000'000;
  if (!(nearby.cell_count() < cell_limit))
    return Failure{
        FailureCode::invalid_options,
        "triangles of " + short_number(triangle_edge_m) + " m would be more than " + std::to_string(cell_limit),
        "choose a larger edge length"};
  nearby.fill();
  return PlanSampler(graph, triangle_edge_m).run(nearby);
}

}  // namespace strataflow
